"""The page's own files, and what a document asks for of them: all its styles as one file and all
its scripts as another. A browser that must ask for forty files waits for them longest.
"""

import functools
from pathlib import Path

from workbench.words.typeset import math_font_css

STATIC = Path(__file__).with_name("static")
ICON = "icon.svg"
MATH_FONT = "math.woff2"
THIRD_PARTIES = "third-parties.txt"
"""Whose work is in our pages, and its licences."""
UNSCRIPTED = "unscripted.css"
"""The style of a page where no script runs."""
FONTS = ("source-serif-4-latin-wght-normal.woff2", "source-serif-4-latin-wght-italic.woff2")
"""The letters of the story, beside its styles."""
COMPUTING = ("compute.css", "compute.js", "bench.js", "computing.js", "codemirror.js")
"""What a published page computes with: the last two are loaded when it does."""

SCENE = ("wire.js", "looks.js", "feed.js", "labels.js", "handles.js", "sceneview.js")
"""The scripts that show scenes in viser's client."""
_LIVE = (*SCENE, "files.js", "edited.js", "returning.js", "live.js")
"""The scripts that feed the page from a server."""
_RECORDED = (*SCENE, "shelf.js", "sweeps.js", "recorded.js")
"""The scripts that feed the page from recorded runs, on a site and in a notebook."""
_PARTS = (
    "tools.js",
    "curves.js",
    "stage.js",
    "transport.js",
    "panels.js",
    "article.js",
    "knobs.js",
    "exercise.js",
    "run.js",
    "progress.js",
    "text.js",
)
_STORY = (
    "storyplot.js",
    "storyparts.js",
    "storychart.js",
    "storystage.js",
    "storywords.js",
    "storyask.js",
    "story.js",
)
_PAGE = "page.js"
_STYLES = ("page.css", "ending.css", "course.css")
_MATH = "math.css"

RUN_STYLES, BENCH_STYLES, STORY_STYLES = "run-page.css", "bench-page.css", "story-page.css"
"""Of one run alone; of a lesson without a story, which has a story's look; of a story."""
NOTEBOOK_STYLES = "notebook-page.css"
FRONT_STYLES = "front-page.css"
"""Of a page of words."""
FRONT_SCRIPTS, WORDS_SCRIPTS = "front-page.js", "words-page.js"
"""Of the course page, and of another page of words."""
NOTEBOOK_SCRIPTS, RUN_SCRIPTS = "notebook-page.js", "run-page.js"
"""Of a notebook's page, and of one run alone in a page of somebody else."""
LIVE_STORY, LIVE_BENCH = "live-story.js", "live-bench.js"
SITE_STORY, SITE_BENCH = "site-story.js", "site-bench.js"

BUNDLES: dict[str, tuple[str, ...]] = {
    NOTEBOOK_STYLES: _STYLES,
    RUN_STYLES: (*_STYLES, _MATH),
    BENCH_STYLES: (*_STYLES, "dress.css", _MATH),
    STORY_STYLES: (*_STYLES, "story.css", "storystage.css", "dress.css", _MATH),
    FRONT_STYLES: (*_STYLES, "front.css"),
    FRONT_SCRIPTS: ("tools.js", "progress.js", "front.js"),
    WORDS_SCRIPTS: ("tools.js", "plain.js"),
    NOTEBOOK_SCRIPTS: (*_RECORDED, *_PARTS, _PAGE),
    RUN_SCRIPTS: (*_RECORDED, *_PARTS, "embed.js", _PAGE),
    LIVE_STORY: (*_LIVE, *_PARTS, *_STORY, _PAGE),
    LIVE_BENCH: (*_LIVE, *_PARTS, "dress.js", _PAGE),
    SITE_STORY: (*_RECORDED, *_PARTS, *_STORY, _PAGE),
    SITE_BENCH: (*_RECORDED, *_PARTS, "dress.js", _PAGE),
}
"""What is in each file that a document asks for, in the order in which it counts."""
LIVE_FILES = (BENCH_STYLES, STORY_STYLES, FRONT_STYLES, FRONT_SCRIPTS, LIVE_STORY, LIVE_BENCH)
SITE_FILES = tuple(name for name in BUNDLES if not name.startswith(("live-", "notebook-")))


@functools.cache
def bundle(name: str) -> str:
    """Return the text of a bundle."""
    return "".join(part(file, inside=False) for file in BUNDLES[name])


def part(name: str, *, inside: bool) -> str:
    """Return the text of one of our styles or scripts; `inside` a document, with all that it needs
    in itself.
    """
    if name == _MATH:
        return math_font_css() if inside else math_font_css(MATH_FONT)
    return bare(STATIC / name)


def bare(file: Path) -> str:
    """Return a script or style without the lines that only tell a reader something, and without
    indents.
    """
    lines = (line.strip() for line in file.read_text(encoding="utf-8").splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//")) + "\n"
