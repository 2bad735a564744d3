"""Words that Rerun's fonts can draw: its viewer stops, or shows boxes, at other glyphs."""

import unicodedata

_RANGES = ((0x20, 0x7E), (0xA1, 0xAC), (0xAE, 0x148), (0x14A, 0x17E), (0x388, 0x3CE))
_SAFE = frozenset(
    "\n–—‘’“”„•…′″‰€™←↑→↓↔⇒⇔−≤≥≠≈≡≪≫∞√∂∆∑∏∫‖■□▲△▶▷▼▽◀◆◇○●✓✗⁰ⁱ⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁿ₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₒₓₕₖₗₘₙₚₛₜᵢⱼᵣᵤᵥ"
) | {chr(code) for low, high in _RANGES for code in range(low, high + 1)}
_INSTEAD = {
    "∈": " in ",
    "∉": " not in ",
    "∇": "grad ",
    "⟨": "<",
    "⟩": ">",
    "⊤": "^T",
    "ᵀ": "^T",
    "∥": "‖",
    "∘": "·",
    "⋅": "·",
    "∗": "*",
    "⟶": "→",
    "⟵": "←",
    "↦": "→",
    "⟂": " perpendicular to ",
    "⊥": " perpendicular to ",
    "∝": " proportional to ",
    "⋯": "…",
    "⌊": "floor(",
    "⌋": ")",
    "⌈": "ceil(",
    "⌉": ")",
    "ℓ": "l",
    "∣": "|",
    "∧": " and ",
    "∨": " or ",
    "∪": " or ",
    "∩": " and ",
    "∖": " without ",
    "⊂": " in ",
    "⊆": " in ",
    "∅": "{}",
    "∀": "for all ",
    "∃": "there is ",
    "≅": "≈",
    "∼": "~",
    "≃": "≈",
    "⊗": "×",
    "⊙": "·",
    "∓": "-/+",
    "∠": "angle ",
    "∬": "∫∫",
    "\t": "    ",
    "\u2009": " ",
    "\u202f": " ",
    "\u00a0": " ",
    "\u200b": "",
}


def safe(text: str) -> str:
    """Return the text with every glyph that Rerun may not have replaced by ones it has."""
    return "".join(_glyph(char) for char in unicodedata.normalize("NFC", text))


def _glyph(char: str) -> str:
    if char in _SAFE:
        return char
    if char in _INSTEAD:
        return _INSTEAD[char]
    plain = "".join(
        part for part in unicodedata.normalize("NFKD", char) if not unicodedata.combining(part)
    )
    if plain != char and plain and all(part in _SAFE for part in plain):
        return plain
    return "" if unicodedata.combining(char) or unicodedata.category(char).startswith("C") else "?"
