"""Turns a lesson's page.md into HTML with typeset maths, for the live page and for published ones.

Markdown with `$...$` and `$$...$$`; raw HTML in the text is shown as text. Formulas become MathML, which browsers draw
themselves; they need a font with a MATH table, which `math_font_css` supplies.
"""

import base64
import functools
import html
import importlib.util
import io
import re
from pathlib import Path
from typing import Any

import workbench
from workbench.atomic import write_atomic


def page_html(markdown: str) -> str:
    """Return the HTML of a page; every second-level heading and what follows it is one `<section class="s-...">`."""
    parts = re.split(r"(?m)^(?=## )", markdown)
    sections = [_parser().render(parts[0])] if parts[0].strip() else []
    for part in parts[1:]:
        heading = part.splitlines()[0][3:].strip().lower()
        name = re.sub(r"[^a-z0-9]+", "-", heading).strip("-")
        sections.append(f'<section class="s-{name}">{_parser().render(part)}</section>')
    return "\n".join(sections)


def inline_html(markdown: str) -> str:
    """Return the HTML of one line of text with maths."""
    return _parser().renderInline(markdown)


@functools.cache
def _parser() -> Any:
    from markdown_it import MarkdownIt
    from mdit_py_plugins.dollarmath import dollarmath_plugin

    parser = MarkdownIt("commonmark", {"html": False, "typographer": True}).enable(
        ["table", "replacements", "smartquotes"]
    )
    return parser.use(dollarmath_plugin, renderer=_math, double_inline=True)


def _math(tex: str, options: dict[str, Any]) -> str:
    return math_html(tex, block=bool(options.get("display_mode")))


@functools.lru_cache(maxsize=2048)
def math_html(tex: str, block: bool = False) -> str:
    """Return MathML of a TeX formula; what cannot be read is shown as it was written."""
    from latex2mathml.converter import convert

    try:
        mathml = convert(
            re.sub(r"\\arg(?![a-zA-Z])", r"\\operatorname{arg}", tex.strip()), display="block" if block else "inline"
        )
    except Exception:  # the converter raises many kinds; the text itself is the best answer to all of them
        return f"<code>{html.escape(tex)}</code>"
    # bars written without \\left and \\right keep the height of a letter
    return re.sub(r"<mo>(&#x02016;|&#x0007C;|&#x02225;|\\||‖|∥)</mo>", r'<mo stretchy="false">\1</mo>', mathml)


@functools.cache
def math_font_css() -> str:
    """Return a style sheet with a subset of STIX Two Math as data, below 200 kB, or nothing where the font is missing."""
    data = _font()
    if data is None:
        return ""
    source = f"url(data:font/woff2;base64,{base64.b64encode(data).decode()}) format('woff2')"
    return f"@font-face{{font-family:'Workbench Math';src:{source}}} math{{font-family:'Workbench Math',math}}"


def _font() -> bytes | None:
    kept = cache_folder() / "stix-two-math-subset-2.woff2"
    try:
        return kept.read_bytes()
    except OSError:
        pass
    try:
        data = _subset()
    except (ImportError, StopIteration, OSError):
        return None
    try:
        kept.parent.mkdir(parents=True, exist_ok=True)
        write_atomic(kept, data)
    except OSError:
        pass  # a folder that cannot be written costs a second at the next start, no more
    return data


def _subset() -> bytes:
    from fontTools import subset
    from fontTools.ttLib import TTFont

    package = importlib.util.find_spec("ziamath")  # found, not imported: only its font is wanted
    path = next(Path(package.origin).parent.rglob("STIXTwoMath*.ttf")) if package and package.origin else None
    if path is None:
        raise FileNotFoundError("no font with a MATH table")
    # letters, Greek, signs, and the styles that formulas have: bold, italic, script, double-struck
    chosen = [*range(0x20, 0x7F), *range(0xA0, 0x100), *range(0x391, 0x3D7), 0x3F5, *range(0x2010, 0x2040)]
    chosen += [*range(0x2070, 0x20A0), *range(0x20D0, 0x20DD), *range(0x2100, 0x2150), *range(0x2190, 0x21A0), 0x21A6]
    chosen += [*range(0x21D0, 0x21D5), *range(0x2200, 0x2300), *range(0x2308, 0x230C), 0x27E8, 0x27E9]
    chosen += [*range(0x1D400, 0x1D4D0), *range(0x1D538, 0x1D56C), *range(0x1D6A4, 0x1D756)]
    features = ["ssty", "flac", "dtls"]  # what a browser asks of a math font
    options = subset.Options(layout_features=features, hinting=False, notdef_outline=True, drop_tables=["DSIG"])
    subsetter = subset.Subsetter(options)
    with TTFont(path) as font:
        subsetter.populate(unicodes=chosen)
        subsetter.subset(font)
        font.flavor = "woff2"
        out = io.BytesIO()
        font.save(out)
    return out.getvalue()


def cache_folder() -> Path:
    """Return the folder for things made once per machine."""
    import os

    base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "geometry-workbench" / workbench.__version__
