"""How much processor time a knob costs until its first new picture, and until the end of its run,
in every lesson.

    python -m tests.benchmarks.bench_knobs [LESSON ...]

As the live page does it: a run is open and whole, a knob is turned, and the first step of the new
run is shown, drawn and as plain data, once it is there. Every knob is turned by one step of its
slider, every switch and choice to each of its other values, from the default and from every preset;
whole runs are measured of the default alone. A run that was made before is never measured: what one
knob's run has left in a lesson's caches, the next one finds, as on a page.
"""

import dataclasses
import sys
import time
from collections.abc import Iterator
from typing import Any

from workbench.machinery.threads import one_each
from workbench.machinery.warming import load_scipy

one_each()  # as the server does, before numpy comes

# ruff: noqa: E402
from workbench.errors import InputError
from workbench.knobs import ParamField, fields_of
from workbench.lesson import Lesson, catalog
from workbench.page.steps import Steps
from workbench.run.timeline import Timeline

MOST = 0.1
"""Seconds of processor time that a first picture may need."""


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


def main(names: list[str]) -> None:
    """Print a row per lesson, and below it the knobs whose first picture takes too long."""
    load_scipy()  # as the server does when it starts
    print(
        f"{'processor time, ms':<18}{'opened':>8}{'its run':>9}{'knobs':>7}{'median':>8}{'worst':>7}"  # noqa: E501
        "  of a whole run"
    )
    for lesson in catalog().values():
        if not names or lesson.name in names:
            _measure(lesson)


def _measure(lesson: Lesson) -> None:
    timeline, opened = first_picture(lesson, lesson.params())
    began = time.process_time()
    timeline.complete()
    whole = opened + time.process_time() - began
    found: list[tuple[float, str]] = []
    runs: list[tuple[float, str]] = []
    bases = {"": lesson.params()} | {f"{preset.name}, ": preset.params for preset in lesson.presets}
    seen = set(bases.values())
    for base, params in bases.items():
        found.append((first_picture(lesson, params)[1], f"{base}as it opens"))
        for field in fields_of(lesson.params):
            for value in turned(field, getattr(params, field.name)) if field.kind != "path" else ():
                other = dataclasses.replace(params, **{field.name: value})
                if other in seen:
                    continue
                seen.add(other)
                try:
                    timeline, seconds = first_picture(lesson, other)
                    began = time.process_time()
                    name = f"{base}{field.name} {value}"
                    found.append((seconds, name))
                    if not base:
                        timeline.complete()
                        runs.append((seconds + time.process_time() - began, name))
                except InputError:
                    continue
    found.sort()
    seconds, name = max(runs)
    worst = [
        f"{1000 * seconds:.0f} ms: {name}" for seconds, name in reversed(found) if seconds > MOST
    ]
    print(
        f"{lesson.name:<18}{1000 * opened:8.0f}{1000 * whole:9.0f}{len(found):7d}{1000 * found[len(found) // 2][0]:8.0f}{1000 * found[-1][0]:7.0f}"  # noqa: E501
        f"  {1000 * seconds:.0f} ({name})",
        flush=True,
    )
    for line in worst[:12]:
        print(f"    {line}")
    if worst[12:]:
        print(f"    and {len(worst) - 12} more")


if __name__ == "__main__":
    main(sys.argv[1:])
