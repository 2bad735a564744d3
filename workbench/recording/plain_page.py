"""A lesson's page for a reader without maths: Rerun shows Markdown, so TeX becomes plain signs."""

import re

from workbench.recording.glyphs import safe

_SIGNS = {
    "sum": "∑", "prod": "∏", "int": "∫", "infty": "∞", "partial": "∂", "nabla": "grad ", "times": "×", "cdot": "·",
    "pm": "±", "mp": "-/+", "le": "≤", "leq": "≤", "ge": "≥", "geq": "≥", "ne": "≠", "neq": "≠", "approx": "≈", "to": "→",
    "rightarrow": "→", "leftarrow": "←", "mapsto": "→", "Rightarrow": "→", "ldots": "…", "dots": "…", "cdots": "…",
    "top": "T", "circ": "°", "prime": "′", "lVert": "‖", "rVert": "‖", "Vert": "‖", "|": "‖", "lvert": "|", "rvert": "|",
    "langle": "<", "rangle": ">", "in": " in ", "notin": " not in ", "quad": "  ", "qquad": "   ", "equiv": "=", "sim": "~",
    "propto": " proportional to ", "ll": "<<", "gg": ">>", "arg": "arg ", "min": "min ", "max": "max ", "log": "log ",
    "exp": "exp ", "sin": "sin ", "cos": "cos ", "tan": "tan ", "atan": "atan ", "arctan": "arctan ", "arccos": "arccos ",
    "det": "det ", "operatorname": "", "left": "", "right": "", "bigl": "", "bigr": "", "Bigl": "", "Bigr": "", "big": "",
    "lfloor": "floor(", "rfloor": ")", "lceil": "ceil(", "rceil": ")", "mid": " | ", "ell": "l", "cup": " or ",
    "cap": " and ", "setminus": " without ", "subset": " in ", "forall": "for all ", "exists": "there is ", "star": "*",
    "ast": "*", "otimes": "×", "perp": " perpendicular to ", "parallel": "‖", "displaystyle": "", "limits": "",
    "dagger": "+",
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "varepsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "vartheta": "θ", "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π",
    "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "varphi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω",
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ",
    "Omega": "Ω",
}  # fmt: skip
_FONTS = ("text", "mathrm", "mathbf", "mathit", "mathcal", "mathbb", "mathsf", "boldsymbol", "operatorname", "textbf")
_ABOVE = {"bar": "mean ", "hat": "^", "tilde": "~", "vec": "", "dot": "d/dt ", "overline": "", "widehat": "^"}
_RAISED = dict(zip("0123456789+-−in", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁻ⁱⁿ", strict=True))
_LOWERED = dict(zip("0123456789+-aeoxhklmnpstijruv", "₀₁₂₃₄₅₆₇₈₉₊₋ₐₑₒₓₕₖₗₘₙₚₛₜᵢⱼᵣᵤᵥ", strict=True))


def plain_page(markdown: str) -> str:
    """Return a page as Markdown with its formulas in plain signs and pictures as their words; code is left as it is."""
    markdown = _without_pictures(markdown)
    parts = re.split(r"(```.*?```|`[^`\n]*`|\$\$.*?\$\$|\$[^$\n]+\$)", markdown, flags=re.DOTALL)
    return safe("".join(_part(part) for part in parts))


def _without_pictures(markdown: str) -> str:
    """Return Markdown with the words of a picture in its place, code apart: Rerun shows no picture in a document."""
    code_or_picture = r"(```.*?```|`[^`\n]*`)|!\[([^\]]*)\]\([^)]*\)"
    return re.sub(code_or_picture, lambda found: found[1] or found[2], markdown, flags=re.DOTALL)


def _part(part: str) -> str:
    if part.startswith("$$"):
        return "\n" + "\n".join(f"    {line}" for line in plain_formula(part[2:-2]).splitlines()) + "\n"
    if part.startswith("$") and part.endswith("$") and len(part) > 1:
        return re.sub(r"([*_`|<\\])", r"\\\1", plain_formula(part[1:-1]))
    return part


def plain_formula(tex: str) -> str:
    """Return a TeX formula in plain signs, one line per row of a matrix or of aligned equations."""
    text = re.sub(r"\\begin\{(\w+\*?)\}(?:\{[^}]*\})?", lambda m: "[" if "matrix" in m[1] else "", tex)
    text = re.sub(r"\\end\{(\w+\*?)\}", lambda m: "]" if "matrix" in m[1] else "", text)
    text = re.sub(r"\\\\(\[[^\]]*\])?", "; ", text).replace("&", "  ")
    text = re.sub(r"\\[,:;! ]|~", " ", text)
    text = re.sub(r"\\([{}%$_#&])", r"\1", text) if "{" not in text else text.replace("\\{", "⦃").replace("\\}", "⦄")
    text, _ = _read(text, 0, until="")
    text = text.replace("⦃", "{").replace("⦄", "}")
    lines = [re.sub(r" {2,}", " ", line).strip() for line in text.splitlines()]
    return "\n".join(line for line in lines if line)


def _read(text: str, i: int, until: str) -> tuple[str, int]:
    """Read up to an unmatched `until`; return what it says and the place behind it."""
    said: list[str] = []
    while i < len(text):
        if until and text[i] == until:
            return "".join(said), i + 1
        word, i = _item(text, i)
        said.append(word)
    return "".join(said), i


def _item(text: str, i: int) -> tuple[str, int]:
    """Read one sign, group or command with its arguments."""
    if text[i] == "{":
        return _read(text, i + 1, "}")
    if text[i] in "^_":
        below = text[i] == "_"
        word, end = _argument(text, i + 1)
        return _script(word.strip(), below), end
    if text[i] != "\\":
        return text[i], i + 1
    match = re.compile(r"\\([A-Za-z]+|.)").match(text, i)
    if match is None:
        return "", i + 1
    name, end = match[1], match.end()
    if name in ("frac", "tfrac", "dfrac"):
        over, end = _argument(text, end)
        under, end = _argument(text, end)
        return f"{_bracketed(over)}/{_bracketed(under)} ", end
    if name == "sqrt":
        word, end = _argument(text, end)
        return f"√{_bracketed(word)}", end
    if name in _FONTS or name in _ABOVE:
        word, end = _argument(text, end)
        return _ABOVE.get(name, "") + word, end
    return _SIGNS.get(name, name), end


def _argument(text: str, i: int) -> tuple[str, int]:
    while i < len(text) and text[i] == " ":
        i += 1
    return _item(text, i) if i < len(text) else ("", i)


def _script(word: str, below: bool) -> str:
    if word in ("°", "′", "*") and not below:
        return word
    if not word:
        return ""
    signs = _LOWERED if below else _RAISED
    if all(sign in signs for sign in word):
        return "".join(signs[sign] for sign in word)
    plain = re.fullmatch(r"[\w′()]+", word) is not None
    return ("_" if below else "^") + (word if plain else f"({word})")


def _bracketed(word: str) -> str:
    word = word.strip()
    return word if len(word) <= 1 or word.isalnum() else f"({word})"
