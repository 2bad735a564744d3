"""A lesson's page for a reader without maths: Rerun shows Markdown, so formulas become plain signs."""

import re
from xml.etree import ElementTree

from workbench.recording.glyphs import safe
from workbench.typeset import math_html

_RAISED = dict(zip("0123456789+-−in", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁻ⁱⁿ", strict=True))
_ALONE = {"⊤": "^T", "∘": "°", "′": "′", "*": "*"}
_LOWERED = dict(zip("0123456789+-−aeoxhklmnpstijruv", "₀₁₂₃₄₅₆₇₈₉₊₋₋ₐₑₒₓₕₖₗₘₙₚₛₜᵢⱼᵣᵤᵥ", strict=True))
_ACCENTS = {"¯": "mean ", "^": "^", "~": "~", "→": "", "˙": "d/dt ", "―": "", "_": ""}
_SPACED = frozenset("=+−-±∓×·⋅≠≤≥<>≈≡∼~→←↦⇒∝≪≫∧∨∪∩∖⊂⊆⊥∣∇")
_LETTERS = {"mi", "msub", "msup", "msubsup", "mover", "msqrt", "mfrac", "mtext"}


def plain_page(markdown: str) -> str:
    """Return a page as Markdown with its formulas in plain signs and pictures as their words; code is left as it is."""
    code_or_picture = r"(```.*?```|`[^`\n]*`)|!\[([^\]]*)\]\([^)]*\)"  # Rerun shows no picture in a document
    markdown = re.sub(code_or_picture, lambda found: found[1] or found[2], markdown, flags=re.DOTALL)
    parts = re.split(r"(```.*?```|`[^`\n]*`|\$\$.*?\$\$|\$[^$\n]+\$)", markdown, flags=re.DOTALL)
    return safe("".join(_part(part) for part in parts))


def _part(part: str) -> str:
    if part.startswith("$$"):
        return "\n" + "\n".join(f"    {line}" for line in plain_formula(part[2:-2]).splitlines()) + "\n"
    if part.startswith("$") and part.endswith("$") and len(part) > 1:
        return re.sub(r"([*_`|<\\])", r"\\\1", plain_formula(part[1:-1]).replace("\n", " "))
    return part


def plain_formula(tex: str) -> str:
    r"""Return a TeX formula in plain signs a line for each `\qquad`, rows of a matrix behind semicolons."""
    try:
        formula = ElementTree.fromstring(math_html(tex).replace(">&<", "><"))  # signs of alignment, not escaped
    except ElementTree.ParseError:
        formula = None
    if formula is None or formula.tag == "code":
        return safe(re.sub(r"[\\{}$]", "", tex)).strip()
    text = re.sub(r" *\n *", "\n", re.sub(r"[^\S\n]+", " ", safe(_text(formula))))
    return re.sub(r"([(\[{]) | (?=[,;.)\]}])", r"\1", text).strip()


def _text(node: ElementTree.Element) -> str:
    """Return what an element of MathML says."""
    kind, parts = _kind(node), [_text(child) for child in node]
    match kind:
        case "mi" | "mtext" | "mn":
            word = (node.text or "").lstrip("\\")
            return f"{word} " if kind == "mi" and len(word) > 1 else word
        case "mo":
            word = node.text or ""
            return f" {word} " if word in _SPACED or word.isalpha() else f"{word} " if word in ",;:" else word
        case "mspace":
            return "; " if node.get("linebreak") else "\n" if node.get("width") == "2em" else "\u00a0"
        case "mfrac" if node.get("linethickness") == "0":
            return " over ".join(parts)
        case "mfrac":
            return f"{_bracketed(parts[0])}/{_bracketed(parts[1])}"
        case "msqrt" | "mroot":
            return f"√{_bracketed(parts[0])}"
        case "mover":
            word = parts[1].strip()
            return _ACCENTS[word] + parts[0] if word in _ACCENTS else parts[0] + _script(word, below=False)
        case "msub" | "munder":
            return parts[0].rstrip() + _script(parts[1], below=True) + _gap(parts[0])
        case "msup":
            return parts[0].rstrip() + _script(parts[1], below=False)
        case "msubsup" | "munderover":
            return parts[0].rstrip() + _script(parts[1], below=True) + _script(parts[2], below=False) + _gap(parts[0])
        case "mtable":
            return "; ".join(part.strip() for part in parts)
        case "mtd":
            return _row(node, parts) + " "
    return _row(node, parts)


def _row(node: ElementTree.Element, parts: list[str]) -> str:
    """Return what stands side by side: a sign before its number closed up, letters that are multiplied apart."""
    said = ""
    kinds = [_kind(child) for child in node]
    for i, (kind, part) in enumerate(zip(kinds, parts, strict=True)):
        if part in (" − ", " - ", " + ") and (not said.strip() or said.rstrip()[-1:] in "=<>≤≥≈(,[;:/|+−"):
            part = part.strip()
        elif i and {kind, kinds[i - 1]} <= _LETTERS and node[i].get("mathvariant") != "normal":
            said += " "
        said += part
    return said


def _kind(node: ElementTree.Element) -> str:
    return node.tag.rpartition("}")[2]


def _gap(word: str) -> str:
    """Return the room behind a word with bounds: a sum, or `min`."""
    return " " if word.strip() in ("∑", "∏", "∫") or (len(word.strip()) > 1 and word.strip().isalpha()) else ""


def _script(word: str, below: bool) -> str:
    word = word.strip()
    signs, bare = (_LOWERED if below else _RAISED), word.replace(" ", "")
    if not below and bare[:1] in _ALONE:
        return _ALONE[bare[0]] + (_script(bare[1:], below) if bare[1:] else "")
    if all(sign in signs for sign in bare):
        return "".join(signs[sign] for sign in bare)
    return ("_" if below else "^") + (bare if re.fullmatch(r"[\w′()×]+", bare) else f"({word.replace('⊤', 'T')})")


def _bracketed(word: str) -> str:
    word = word.strip()
    return word if re.fullmatch(r"\d+|\w[₀-₉ₐ-ₜᵢⱼᵣᵤᵥ¹²³⁰⁴-⁹ⁱⁿ]*", word) else f"({word})"
