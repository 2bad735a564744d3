"""A lesson's page for a reader without maths: formulas in plain signs, for Rerun."""

import re
from collections.abc import Iterable
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from workbench.recording.glyphs import safe
from workbench.words.typeset import math_html

_PARTS = {
    "mfrac": 2,
    "mover": 2,
    "msub": 2,
    "munder": 2,
    "msup": 2,
    "msubsup": 3,
    "munderover": 3,
}
"""How many parts an element of MathML has; a formula where one lacks stays as it was written."""
THIN = "\u2009"
"""A space that an author set; others stand about operators, but not in scripts."""
_SPACED = frozenset("=+−-<>≤≥≈≠≡≪≫×·∣→←↔⇒")
_ABOVE = {"¯": "mean ", "^": "^", "~": "~", "→": "", "˙": "d/dt "}
_RAISED = dict(zip("0123456789+-−in", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁻ⁱⁿ", strict=True))
_LOWERED = dict(
    zip("0123456789+-−aeoxhklmnpstijruv", "₀₁₂₃₄₅₆₇₈₉₊₋₋ₐₑₒₓₕₖₗₘₙₚₛₜᵢⱼᵣᵤᵥ", strict=True)
)


def plain_page(markdown: str) -> str:
    """Return a page with its formulas in plain signs and pictures as words; code stays."""
    code_or_picture = r"(```.*?```|`[^`\n]*`)|!\[([^\]]*)\]\([^)]*\)"
    markdown = re.sub(
        code_or_picture, lambda match: match[1] or match[2], markdown, flags=re.DOTALL
    )
    parts = re.split(r"(```.*?```|`[^`\n]*`|\$\$.*?\$\$|\$[^$\n]+\$)", markdown, flags=re.DOTALL)
    return safe("".join(_part(part) for part in parts))


def _part(part: str) -> str:
    if part.startswith("$$"):
        return f"\n    {plain_formula(part[2:-2])}\n"
    if part.startswith("$") and part.endswith("$") and len(part) > 1:
        return re.sub(r"([*_`|<\\])", r"\\\1", plain_formula(part[1:-1]))
    return part


def plain_formula(tex: str) -> str:
    """Return a TeX formula in plain signs, in one line; as written if it cannot be read."""
    try:
        typeset = ElementTree.fromstring(
            math_html(tex).replace(' xmlns="http://www.w3.org/1998/Math/MathML"', "")
        )
    except ElementTree.ParseError:  # a sign such as & that belongs nowhere
        return tex
    if any(len(part) < _PARTS.get(part.tag, 0) for part in typeset.iter()):  # `^` with nothing
        return tex
    return (
        " ".join(_said(typeset).split())
        .replace("( ", "(")
        .replace(" )", ")")
        .replace(" ]", "]")
        .replace(" ,", ",")
    )


def _said(part: Element) -> str:
    """Return what an element of MathML says."""
    parts = list(part)
    text = (part.text or "").strip()
    match part.tag:
        case "mspace":
            return THIN
        case "mo" if text in _SPACED:
            return f" {text} "
        case "mo" if text == "," or len(text) > 1:
            return f"{text} "
        case "mfrac":
            return f"{_bracketed(parts[0])}/{_bracketed(parts[1])} "
        case "msqrt":
            return f"√{_bracketed(*parts)}"
        case "mover" if (accent := _said(parts[1]).strip()) in _ABOVE:
            return _ABOVE[accent] + _said(parts[0])
        case "msub" | "munder":
            return _said(parts[0]).rstrip() + _script(parts[1], "_", _LOWERED)
        case "msup" | "mover":
            return _said(parts[0]).rstrip() + _script(parts[1], "^", _RAISED)
        case "msubsup" | "munderover":
            below = _script(parts[1], "_", _LOWERED)
            return _said(parts[0]).rstrip() + below + _script(parts[2], "^", _RAISED)
        case "mtable":
            return "; ".join("  ".join(map(_said, row)) for row in parts)
        case _:
            return text + _row(parts)


def _row(parts: Iterable[Element]) -> str:
    """Return what stands side by side, a space between names that are multiplied."""
    row = ""
    named = False
    operand = False
    for part in parts:
        text = (part.text or "").strip()
        is_name = (
            part.tag in ("mi", "msub", "msup", "msubsup", "mover")
            and part.get("mathvariant") != "normal"
        )
        if text in ("+", "−", "-") and not operand:
            row += text
        else:
            word = next(part.itertext(), "").strip()
            row += (" " if is_name and (named or (operand and len(word) > 1)) else "") + _said(part)
        named = is_name
        operand = part.tag not in ("mo", "mspace") or text in (")", "]", "}", "|", "‖")
    return row


def _script(part: Element, mark: str, signs: dict[str, str]) -> str:
    word = (
        _said(part).replace(" ", "").strip().replace(THIN, " ").replace("⊤", "T").replace("∘", "°")
    )
    if mark == "^" and word in ("°", "′", "*", "∗"):
        return word
    if all(sign in signs for sign in word):
        return "".join(signs[sign] for sign in word)
    return mark + (word if re.fullmatch(r"[\w′()]+", word) else f"({word})")


def _bracketed(*parts: Element) -> str:
    word = _row(parts).strip()
    return word if len(word) <= 1 or word.isalnum() else f"({word})"
