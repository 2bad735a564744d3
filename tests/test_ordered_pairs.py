"""Whatever was shown before leaves no trace: for all ordered pairs of a lesson's presets, A then B
shows what B shows.

A sink sends what differs, so what it holds can be stale. Every pair goes through a page's feed and
through a recording: all presets at the step at which they open; steps some way on are seen between
them. Runs that only a question opens are seen between two presets.
"""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import pytest
import rerun as rr

from tests.browser.feeding import Fed
from tests.runs import finished
from workbench.lesson import catalog
from workbench.recording.sink import RerunSink
from workbench.run.timeline import Timeline
from workbench.scene import Camera, Classes, Field, Mesh, Picture, Points, Scene, Segments, in_space

LESSONS = list(catalog())
MORE = 8  # steps
SPARSE = 25  # one point or segment of so many is kept


def scenes_of(name: str) -> tuple[list[Scene], list[Scene]]:
    """Return every preset's scene where it opens, and up to MORE steps later."""
    lesson = catalog()[name]
    opening, later = [], []
    for preset in lesson.presets:
        timeline = finished(name, preset.params)
        k = (lesson.first_step if preset.step is None else preset.step) % len(timeline)
        opening.append(thinned(timeline[k].scene))
        later.append(thinned(timeline[min(k + MORE, len(timeline) - 1)].scene))
    return opening, later


def asked_alone(name: str) -> list[Scene]:
    """Return the scenes of questions whose run is no preset's, where they open."""
    lesson = catalog()[name]
    scenes = []
    for question in lesson.questions:
        if question.params != lesson.params() and lesson.preset_of(question.params) is None:
            timeline = finished(name, question.params)
            scenes.append(
                thinned(
                    timeline[(-1 if question.step is None else question.step) % len(timeline)].scene
                )
            )
    return scenes


def thinned(scene: Scene) -> Scene:
    """Return a scene with few points and small images, the same in everything that a sink decides
    by.
    """
    return {path: _thinned(primitive) for path, primitive in scene.items()}


def _thinned(primitive: Any) -> Any:
    if isinstance(primitive, Points):
        return replace(primitive, p=primitive.p[::SPARSE], color=_every(primitive.color))
    if isinstance(primitive, Segments):
        return replace(primitive, ends=primitive.ends[::SPARSE], color=_every(primitive.color))
    if isinstance(primitive, Mesh):
        return replace(primitive, faces=primitive.faces[::SPARSE])
    if isinstance(primitive, (Camera, Picture)) and primitive.image is not None:
        return replace(primitive, image=_coarse(primitive.image))
    return primitive


def _every(color: Any) -> Any:
    if isinstance(color, Field):
        return replace(color, values=color.values[::SPARSE])
    if isinstance(color, Classes):
        return replace(color, ids=color.ids[::SPARSE])
    return color if isinstance(color, str) else color[::SPARSE]


def _coarse(image: Any) -> Any:
    return (
        replace(image, values=image.values[::16, ::16])
        if isinstance(image, Field)
        else image[::16, ::16]
    )


def all_pairs(n: int) -> Iterator[int]:
    """Yield 0 to n - 1 so that each follows each other one at least once."""
    for i in range(n):
        for j in range(i + 1, n):
            yield from (i, j)
    yield 0


def test_each_follows_each():
    walk = list(all_pairs(5))
    assert {(a, b) for a in range(5) for b in range(5) if a != b} <= set(itertools.pairwise(walk))


@pytest.fixture(scope="module")
def fed(chromium) -> Iterator[Fed]:
    fed = Fed(chromium)
    yield fed
    fed.close()


def walk_live(fed: Fed, scenes: Sequence[Scene], order: Sequence[int], *, by: int = 0) -> None:
    """Show scenes in this order on a page; hold what its client draws to what it draws of each
    alone.
    """
    numbers = fed.add(scenes)
    for together in (1, 3):  # messages of so many are handled at once: a browser that draws slowly
        walk = "([order, by, together]) => walked(order, by, together)"
        assert fed(walk, [[numbers[i] for i in order], by, together]) == ""


@pytest.mark.parametrize("name", LESSONS)
def test_a_preset_after_another_shows_what_it_shows_alone(fed, name):
    opening, later = scenes_of(name)
    n = len(opening)
    walk_live(fed, opening, list(all_pairs(n)))
    asked = asked_alone(name)
    onwards = [i for k in range(n) for i in (n + k, k, n + (k + 1) % n)]
    there_and_back = [
        i for k in range(len(asked)) for i in (2 * k % n, 2 * n + k, (2 * k + 1) % n, 2 * n + k)
    ]
    walk_live(fed, opening + later + asked, onwards + there_and_back)
    walk_live(fed, opening + later, onwards, by=1)


@pytest.mark.parametrize("name", LESSONS)
def test_a_preset_after_another_is_recorded_as_it_is_alone(name):
    opening, _ = scenes_of(name)
    n = len(opening)
    in_space_only = [
        {path: thing for path, thing in scene.items() if in_space(thing)} for scene in opening
    ]
    walk_recorded(in_space_only, list(all_pairs(n)))
    # charts take their time
    walk_recorded(opening, [*range(n), *reversed(range(n)), *range(0, n, 2), *range(1, n, 2)])


def test_a_walk_through_all_lessons_shows_each_as_alone(fed):
    scenes = []
    for lesson in catalog().values():
        timeline = Timeline(lesson, lesson.params())
        assert timeline.extend()
        scenes.append(thinned(timeline[0].scene))
    walk_live(fed, scenes, list(all_pairs(len(scenes))))


class Stream:
    """A recording stream that keeps the latest value of every component, as a viewer looks it
    up.
    """

    def __init__(self) -> None:
        self._latest: dict[str, dict[str, Any]] = {}
        self._classes: dict[int, Any] = {}

    def set_time(self, *_: Any, **__: Any) -> None:
        """Steps come in order."""

    def log(self, entity: str, *archetypes: Any, static: bool = False) -> None:
        for archetype in archetypes:
            if isinstance(archetype, rr.Clear):
                self._latest.pop(entity, None)
                continue
            for batch in archetype.as_component_batches():
                values = batch.as_arrow_array()
                if isinstance(archetype, rr.AnnotationContext):
                    infos = [entry["class_description"]["info"] for entry in values.to_pylist()[0]]
                    self._classes = {info["id"]: (info["label"], info["color"]) for info in infos}
                else:
                    self._latest.setdefault(entity, {})[str(batch.component_descriptor())] = values

    def seen(self) -> dict[str, dict[str, Any]]:
        """Return what is shown by entity and component, classes by name and colour; nothing of what
        was emptied.
        """
        return {
            entity: {
                name: (
                    [self._classes[i] for i in values.to_pylist()]
                    if name.endswith("class_ids")
                    else values
                )
                for name, values in components.items()
                if len(values) or not name.startswith("EncodedImage")
            }
            for entity, components in self._latest.items()
            if len(components.get("EncodedImage:blob", "there"))
        }


def walk_recorded(scenes: Sequence[Scene], order: Sequence[int]) -> None:
    """Record scenes in this order; hold what a viewer shows to what it shows of each alone."""
    alone = [recorded(scene) for scene in scenes]
    stream = Stream()
    sink = RerunSink(stream)
    for k, i in enumerate(order):
        sink.show(k, scenes[i])
        assert stream.seen() == alone[i], f"preset {i} as number {k}"


def recorded(scene: Scene) -> dict[str, dict[str, Any]]:
    stream = Stream()
    RerunSink(stream).show(0, scene)
    return stream.seen()
