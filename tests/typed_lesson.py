"""A lesson's Params, run and draw belong together: the type checker refuses one of another lesson
(it reads this file).

An ignored line that is no error is an error, so this fails as soon as the checker lets the wrong
ones pass.
"""

# pyright: reportUnnecessaryTypeIgnoreComment=error

from collections.abc import Iterator
from dataclasses import dataclass

from workbench.lesson import Lesson, Preset
from workbench.scene import Scene


@dataclass(frozen=True)
class Params:
    n: int = 1


@dataclass(frozen=True)
class Others:
    m: int = 1


def run(params: Params, *, twice: bool = False) -> Iterator[int]:
    yield params.n * (1 + twice)


def draw(state: int) -> Scene:
    return {}


def draw_words(state: str) -> Scene:
    return {}


def lessons() -> None:
    """Make one that fits and run it, and make those that do not."""
    fits = Lesson(name="a", title="A", summary="Fits.", params=Params, run=run, draw=draw, order=1)
    fits.run(Params(), twice=True)
    Lesson(name="b", title="B", summary="", params=Others, run=run, draw=draw, order=1)  # pyright: ignore
    Lesson(name="c", title="C", summary="", params=Params, run=run, draw=draw_words, order=1)  # pyright: ignore
    preset = Preset("x", "X", "", Others())
    Lesson(
        name="d",
        title="D",
        summary="",
        params=Params,
        run=run,
        draw=draw,
        order=1,
        presets=(preset,),  # pyright: ignore
    )
