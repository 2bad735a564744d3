"""How much processor time a knob costs until its first new picture, and until the end of its run,
in every lesson.

    python -m tests.benchmarks.bench_knobs [LESSON ...]

As the live page does it: a run is open and whole, a knob is turned, and the first step of the new
run is shown, drawn and as plain data, once it is there. Every knob is turned by one step of its
slider, every switch and choice to each of its other values, from the default and from every preset;
whole runs are measured of the default alone. A run that was made before is never measured: what one
knob's run has left in a lesson's caches, the next one finds, as on a page. What took too long is
measured three times more.
"""

import dataclasses
import sys
import time
from collections.abc import Callable, Iterator
from multiprocessing import get_context
from typing import Any

from workbench.machinery.threads import one_each
from workbench.machinery.warming import load_parts

one_each()  # as the server does, before numpy comes

# ruff: noqa: E402
from workbench.errors import InputError
from workbench.knobs import ParamField, fields_of
from workbench.lesson import Lesson, catalog
from workbench.page.steps import Steps
from workbench.run.timeline import Timeline
from workbench.viewer.runs import settle

MOST = 0.1
"""Seconds of processor time that a first picture may need."""
ADDITIONS = 10_000_000


def turned(field: ParamField, value: Any) -> Iterator[Any]:
    """Yield other values of a field: of a number the next that its slider has."""
    if field.kind == "bool":
        yield not value
    elif field.kind == "choice":
        yield from (choice for choice in field.choices if choice != value)
    elif field.kind in ("float", "int"):
        other = value + field.step
        yield field.clean(
            other if other <= (field.knob.high or 0.0) else value - field.step, clamp=True
        )
    elif field.kind in ("floats", "ints"):
        first, *rest = value
        other = first + field.step
        yield field.clean(
            (other if other <= (field.knob.high or 0.0) else first - field.step, *rest),
            clamp=True,
        )


def first_picture(lesson: Lesson, params: Any) -> tuple[Timeline, float]:
    """Return a run with its first step, and the processor time that it took to show that,
    seconds.
    """
    began = time.process_time()
    timeline = Timeline(lesson, params)
    if timeline.extend():
        Steps(timeline).step(0)
    return timeline, time.process_time() - began


@dataclasses.dataclass(frozen=True)
class Turn:
    """A knob turned: from which run, to which, and the processor time that it took, seconds."""

    name: str
    base: Any
    params: Any
    first: float
    whole: float | None = None


def additions() -> float:
    """Return how long ADDITIONS take here, seconds of processor time: what to hold figures of
    another machine against.
    """
    began = time.process_time()
    total = 0
    for i in range(ADDITIONS):
        total += i
    return time.process_time() - began


def main(names: list[str]) -> None:
    """Print a row per lesson, and below it the knobs whose first picture takes too long."""
    load_parts()  # as the server does when it starts
    settle()
    print(f"this machine: beside each lesson what {ADDITIONS:,} additions in Python took then")
    print(
        f"{'processor time, ms':<18}{'opened':>8}{'its run':>9}{'knobs':>7}"
        f"{'median':>8}{'worst':>7}{'additions':>11}  of a whole run",
        flush=True,
    )
    for name in catalog():
        if not names or name in names:
            _measure(name)


def _measure(name: str) -> None:
    before = additions()
    opened, whole, turns = elsewhere(survey, name)
    turns = [
        dataclasses.replace(turn, first=settled(name, turn)) if turn.first > MOST else turn
        for turn in turns
    ]
    turns.sort(key=lambda turn: turn.first)
    longest = max((turn for turn in turns if turn.whole is not None), key=lambda turn: turn.whole)
    print(
        f"{name:<18}{1000 * opened:8.0f}{1000 * whole:9.0f}{len(turns):7d}"
        f"{1000 * turns[len(turns) // 2].first:8.0f}{1000 * turns[-1].first:7.0f}"
        f"{1000 * max(before, additions()):11.0f}"
        f"  {1000 * longest.whole:.0f} ({longest.name})",
        flush=True,
    )
    worst = [turn for turn in reversed(turns) if turn.first > MOST]
    for turn in worst[:12]:
        print(f"    {1000 * turn.first:.0f} ms: {turn.name}")
    if worst[12:]:
        print(f"    and {len(worst) - 12} more")


def survey(name: str) -> tuple[float, float, list[Turn]]:
    """Return the processor time of a lesson's first picture and whole run, seconds, and of each
    turn of a knob.
    """
    lesson = catalog()[name]
    timeline, opened = first_picture(lesson, lesson.params())
    began = time.process_time()
    timeline.complete()
    whole = opened + time.process_time() - began
    turns: list[Turn] = []
    bases = {"": lesson.params()} | {f"{preset.name}, ": preset.params for preset in lesson.presets}
    seen = set(bases.values())
    for base, params in bases.items():
        seconds = first_picture(lesson, params)[1]
        turns.append(Turn(f"{base}as it opens", lesson.params(), params, seconds))
        for field in fields_of(lesson.params):
            for value in turned(field, getattr(params, field.name)) if field.kind != "path" else ():
                other = dataclasses.replace(params, **{field.name: value})
                if other in seen:
                    continue
                seen.add(other)
                try:
                    timeline, seconds = first_picture(lesson, other)
                    all_of_it = None
                    if not base:
                        began = time.process_time()
                        timeline.complete()
                        all_of_it = seconds + time.process_time() - began
                except InputError:
                    continue
                called = f"{base}{field.name} {value}"
                turns.append(Turn(called, params, other, seconds, all_of_it))
    return opened, whole, turns


def settled(name: str, turn: Turn) -> float:
    """Return the median of three measurements of a turn, each in a process of its own where only
    the run that it starts from was shown: one of thousands is slow by chance.
    """
    return sorted(elsewhere(again, name, turn) for _ in range(3))[1]


def again(name: str, turn: Turn) -> float:
    """Return the processor time of a turn's first picture, seconds."""
    lesson = catalog()[name]
    first_picture(lesson, turn.base)[0].complete()
    return first_picture(lesson, turn.params)[1]


def elsewhere(function: Callable[..., Any], *args: Any) -> Any:
    """Return what a function returns in a fork of this process, which has measured nothing."""
    with get_context("fork").Pool(1) as pool:
        return pool.apply(function, args)


if __name__ == "__main__":
    main(sys.argv[1:])
