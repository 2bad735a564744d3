"""Turns a lesson's page.md into HTML with typeset maths, for the live page and for published ones.

Markdown with `$...$` and `$$...$$`; raw HTML in the text is shown as text. Formulas become MathML,
which browsers draw themselves; they need a font with a MATH table, which `math_font_css` supplies.
"""

import base64
import contextlib
import functools
import html
import importlib.util
import io
import re
import threading
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from workbench.errors import AuthorError
from workbench.machinery.atomic import write_atomic
from workbench.machinery.version import __version__

PICTURES = {".svg": "svg+xml", ".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".webp": "webp"}
LARGEST_PICTURE = 300_000  # bytes
WORDING = re.compile(r"\{\{(live|site):\s*(.*?)\}\}", re.DOTALL)
"""What stands in one home only: the home, and its words."""


def wording(markdown: str, home: str) -> str:
    """Return a lesson's page as one home has it: what stands as `{{live: ...}}` or `{{site: ...}}`
    is for that one only.

    `site` is every home that cannot compute: a published page, a notebook, a recording.
    """
    return WORDING.sub(lambda match: match[2] if match[1] == home else "", markdown)


def page_of(markdown: str, file: Path | None) -> str:
    """Return the HTML of a lesson's page, with the pictures it names below the folder of its file.

    Raises:
        AuthorError: If a picture is not there, is of another kind than PICTURES, or larger than
            LARGEST_PICTURE.
    """
    return page_html(markdown, None if file is None else lambda name: _picture_data(file, name))


def page_html(markdown: str, picture: Callable[[str], str] | None = None) -> str:
    """Return the HTML of a page; every second-level heading and what follows it is one `<section
    class="s-...">`.

    `picture` returns the address of a picture by the name that the page gives it; without it
    pictures are their words.
    """
    with _one_at_a_time, _pictures_by(picture):
        return _sections(markdown)


@contextlib.contextmanager
def typesetting(file: Path | None) -> Iterator[None]:
    """Let a parser be used, by one thread at a time; pictures are those below the folder of a
    page's file.
    """
    picture = None if file is None else lambda name: _picture_data(file, name)
    with _one_at_a_time, _pictures_by(picture):
        yield


TERM = re.compile(r"\[\[([a-z][\w/. ~-]*?)(?:\|([^\]|<]+))?\]\]")
"""Words of a page that name a thing of the scene: its path, and what stands there or nothing."""


def with_terms(text: str) -> str:
    """Return the HTML of a page with its terms as elements: `[[source|the scan]]` names a thing
    of the scene.
    """
    return TERM.sub(lambda term: _term(term[1], term[2] or term[1]), text)


def _term(path: str, words: str) -> str:
    return f'<span class="term" tabindex="0" data-thing="{html.escape(path)}">{words}</span>'


def _sections(markdown: str) -> str:
    parts = re.split(r"(?m)^(?=## )", markdown)
    sections = [_parser().render(parts[0])] if parts[0].strip() else []
    for part in parts[1:]:
        heading = part.splitlines()[0][3:].strip().lower()
        name = re.sub(r"[^a-z0-9]+", "-", heading).strip("-")
        sections.append(f'<section class="s-{name}">{_parser().render(part)}</section>')
    return "\n".join(sections)


def inline_html(markdown: str) -> str:
    """Return the HTML of one line of text with maths."""
    with _one_at_a_time:
        return _parser().renderInline(markdown)


_one_at_a_time = threading.RLock()
"""The parser's tables of addresses (mdurl) are filled at first use, and not safe while they are."""


@functools.cache
def _parser() -> Any:
    return new_parser()


def new_parser() -> Any:
    """Return a parser of pages, with maths, tables and pictures; use it inside `typesetting`."""
    from markdown_it import MarkdownIt
    from mdit_py_plugins.dollarmath import dollarmath_plugin

    parser = MarkdownIt("commonmark", {"html": False, "typographer": True}).enable(
        ["table", "replacements", "smartquotes"]
    )
    parser.add_render_rule("image", _image)
    return parser.use(dollarmath_plugin, renderer=_math, double_inline=True)


_picture: ContextVar[Callable[[str], str] | None] = ContextVar("picture", default=None)


@contextlib.contextmanager
def _pictures_by(picture: Callable[[str], str] | None) -> Iterator[None]:
    before = _picture.set(picture)
    try:
        yield
    finally:
        _picture.reset(before)


def _image(renderer: Any, tokens: Any, i: int, options: Any, env: Any) -> str:  # noqa: PLR0917
    words = html.escape(renderer.renderInlineAsText(tokens[i].children, options, env))
    address = _picture.get()
    if address is None:
        return words
    return (
        f'<img class="wb-picture" src="{html.escape(address(unquote(tokens[i].attrs["src"])))}"'
        f' alt="{words}">'
    )


def _picture_data(page: Path, name: str) -> str:
    """Return a picture below a page's folder as a data address; names are looked up, one part after
    the other.
    """
    place: Path | None = page.parent.resolve()
    for part in name.removeprefix("./").split("/"):
        entries = (
            {entry.name: entry for entry in place.iterdir()}
            if place is not None and place.is_dir()
            else {}
        )
        place = entries.get(part)
    if (
        place is None
        or not place.is_file()
        or not place.resolve().is_relative_to(page.parent.resolve())
    ):
        raise AuthorError(
            f"{page}: there is no picture {name!r} in the page's folder; name it relative to the"
            " page"
        )
    kind = PICTURES.get(place.suffix.lower())
    if kind is None:
        raise AuthorError(f"{page}: the picture {name!r} is none of {', '.join(PICTURES)}")
    if place.stat().st_size > LARGEST_PICTURE:
        size = (
            f"{place.stat().st_size / 1e3:,.0f} kB, over the limit of"
            f" {LARGEST_PICTURE / 1e3:,.0f} kB"
        )
        raise AuthorError(f"{page}: the picture {name!r} has {size}")
    return f"data:image/{kind};base64,{base64.b64encode(place.read_bytes()).decode()}"


def _math(tex: str, options: dict[str, Any]) -> str:
    return math_html(tex, block=bool(options.get("display_mode")))


@functools.lru_cache(maxsize=2048)
def math_html(tex: str, block: bool = False) -> str:
    """Return MathML of a TeX formula; what cannot be read is shown as it was written."""
    from latex2mathml.converter import convert

    try:
        mathml = convert(
            re.sub(r"\\arg(?![a-zA-Z])", r"\\operatorname{arg}", tex.strip()),
            display="block" if block else "inline",
        )
    except (
        Exception
    ):  # the converter raises many kinds; the text itself is the best answer to all of them
        return f"<code>{html.escape(tex)}</code>"
    # bars written without \\left and \\right keep the height of a letter
    return re.sub(
        r"<mo>(&#x02016;|&#x0007C;|&#x02225;|\\||‖|∥)</mo>", r'<mo stretchy="false">\1</mo>', mathml
    )


def math_font_css(file: str = "") -> str:
    """Return a style sheet with the letters of formulas, or nothing where they are missing.

    Args:
        file: The address of `math_font()` beside the style sheet; in it, a third larger, where
            there is none.
    """
    data = math_font()
    if not data:
        return ""
    where = file or f"data:font/woff2;base64,{base64.b64encode(data).decode()}"
    return (
        f"@font-face{{font-family:'Workbench Math';src:url({where}) format('woff2');"
        "font-display:swap} math{font-family:'Workbench Math',math}"
    )


@functools.cache
def math_font() -> bytes:
    """Return a subset of STIX Two Math, some 115 kB, or nothing where the font is missing."""
    kept = cache_folder() / "stix-two-math-subset-4.woff2"
    try:
        return kept.read_bytes()
    except OSError:
        pass
    try:
        data = _subset()
    except (ImportError, StopIteration, OSError):
        return b""
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
    path = (
        next(Path(package.origin).parent.rglob("STIXTwoMath*.ttf"))
        if package and package.origin
        else None
    )
    if path is None:
        raise FileNotFoundError("no font with a MATH table")
    # letters, Greek, signs, and the styles that formulas have: bold, italic, and capitals in script
    # and double-struck
    chosen = [
        *range(0x20, 0x7F),
        *range(0xA0, 0x100),
        *range(0x391, 0x3D7),
        0x3F5,
        *range(0x2010, 0x2040),
    ]
    chosen += [
        *range(0x2C6, 0x2DE),
        *range(0x2070, 0x20A0),
        *range(0x20D0, 0x20DD),
        *map(ord, "ℂℋℌℍℎℏℐℑℒℓℕ℘ℙℚℛℜℝ™ℤℨÅℬℰℱℳℵ"),
    ]
    chosen += [
        *range(0x2190, 0x21A0),
        0x21A6,
        *range(0x21D0, 0x21D5),
        *range(0x2200, 0x2300),
        *range(0x2308, 0x230C),
    ]
    chosen += [
        0x27E8,
        0x27E9,
        *range(0x1D400, 0x1D468),
        *range(0x1D49C, 0x1D4B6),
        *range(0x1D538, 0x1D552),
    ]
    chosen += [*range(0x1D6A4, 0x1D71C)]
    features = ["ssty", "flac", "dtls"]  # what a browser asks of a math font
    options = subset.Options(
        layout_features=features, hinting=False, notdef_outline=True, drop_tables=["DSIG"]
    )
    # trademark, licence and its address: who hands the font on has to
    options.name_IDs += [7, 13, 14]
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
    return Path(base) / "geometry-workbench" / __version__
