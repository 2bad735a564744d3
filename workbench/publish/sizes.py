"""Holds a site to its sizes and its links, and tells what it weighs."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from html.parser import HTMLParser
from pathlib import Path, PurePosixPath
from urllib.parse import unquote, urlsplit

from workbench.errors import InputError
from workbench.page.bundles import COMPUTING, SITE_STORY
from workbench.publish.runs import PAGE

COURSE_PAGE = "index.html"
PAGE_BUDGET = 300_000
PICTURES_BUDGET = 1_000_000
REPLAY_BUDGET = 4_000_000
RECORDING_BUDGET = 3_000_000
TOLD_BUDGET = 420_000
"""Of a page with a story: it has two faces, and the scripts of both."""
COMPUTING_BUDGET = 40_000
"""What a page may have more that can compute."""


def checked(out: Path, names: Iterable[str]) -> list[tuple[str, int]]:
    """Return these files of a site with their sizes.

    Raises:
        InputError: If a link leads nowhere, or a page, replay or recording is over its budget.
    """
    sizes = [(name, (out / name).stat().st_size) for name in sorted(names)]
    budgets = {".js": REPLAY_BUDGET, ".rrd": RECORDING_BUDGET}
    for name, size in sizes:
        budget = budgets.get(Path(name).suffix, size)
        if size > budget:
            raise InputError(_over(name, size, budget))
    for name, size in sizes:
        if not name.endswith(".html"):
            continue
        page = out / name
        weight = size
        pictures = 0
        text = page.read_text(encoding="utf-8")
        for link in links_in(text):
            if link.startswith("data:image/"):
                pictures += len(link)
                continue
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or not parts.path:
                continue
            linked = page.parent / unquote(parts.path)
            if not linked.exists():
                raise InputError(f"{name}: the link {link} leads nowhere")
            if linked.suffix in (".css", ".js"):
                weight += linked.stat().st_size
        if pictures > PICTURES_BUDGET:
            raise InputError(_over(f"the pictures of {name}", pictures, PICTURES_BUDGET))
        weight -= pictures
        budget = TOLD_BUDGET if f"{PAGE}/{SITE_STORY}" in text else PAGE_BUDGET
        budget += COMPUTING_BUDGET if f"{PAGE}/{COMPUTING[1]}" in text else 0
        if weight > budget:
            raise InputError(_over(f"{name} with its styles and scripts", weight, budget))
    return sizes


def _over(subject: str, size: int, budget: int) -> str:
    return f"{subject} has {size / 1e6:.2f} MB, over the budget of {budget / 1e6:.2f} MB"


def sizes_told(out: Path, files: Sequence[tuple[str, int]], swept: Collection[str] = ()) -> str:
    """Return a summary of what a site holds, by kind of file, and where to begin; `swept` are the
    files of sweeps.
    """
    kinds = {"pages": "*.html", "runs": "*/runs/*.js", "recordings": "*.rrd"}
    lines = [
        _sizes(kind, [size for name, size in files if PurePosixPath(name).match(p)])
        for kind, p in kinds.items()
    ]
    if swept:
        lines.append(
            _sizes("of these runs are of sweeps", [size for name, size in files if name in swept])
        )
    return "\n".join([*lines, f"begin at {out / COURSE_PAGE}"])


def _sizes(kind: str, sizes: Sequence[int]) -> str:
    return (
        f"{len(sizes)} {kind}, {sum(sizes) / 1e6:.1f} MB, the largest"
        f" {max(sizes, default=0) / 1e6:.2f} MB"
    )


def links_in(page: str) -> Iterator[str]:
    """Return the addresses that a page's links, scripts, styles and pictures name."""
    parser = _Links()
    parser.feed(page)
    yield from parser.found


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "base":  # no link: where the others begin
            return
        self.found += [value for name, value in attrs if name in ("href", "src") and value]
