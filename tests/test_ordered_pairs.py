"""Whatever was shown before leaves no trace: for all ordered pairs of a lesson's presets, A then B shows what B shows.

A sink sends what differs, so what it holds can be stale. Every pair goes through the live browser, through the player of
an export and through a recording: all presets at the step at which they open, and at the last step of their run.
"""

import functools
import hashlib
from collections.abc import Iterator
from typing import Any

import pytest
import rerun as rr
import viser

from tests.viewer.browser_scene import Browser, Seen, Windows, difference
from workbench.lesson import catalog
from workbench.recording.images import encoded
from workbench.recording.sink import RerunSink
from workbench.scene import Scene
from workbench.timeline import Timeline
from workbench.viewer.sink import ROOT, ViserSink

LESSONS = list(catalog())


@functools.lru_cache(2)
def scenes_of(name: str) -> tuple[list[Scene], list[Scene]]:
    """Return every preset's scene where it opens and at its end."""
    lesson = catalog()[name]
    opening, last = [], []
    for preset in lesson.presets:
        timeline = Timeline(lesson, preset.params).complete()
        opening.append(timeline[lesson.first_step if preset.step is None else preset.step].scene)
        last.append(timeline[-1].scene)
    return opening, last


def all_pairs(n: int) -> Iterator[int]:
    """Yield 0 to n - 1 so that each follows each other one at least once."""
    for i in range(n):
        for j in range(i + 1, n):
            yield from (i, j)
    yield 0


def test_each_follows_each():
    walk = list(all_pairs(5))
    assert {(a, b) for a in range(5) for b in range(5) if a != b} <= set(zip(walk, walk[1:], strict=False))


@pytest.fixture(scope="module")
def server():
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


def walk_live(server, monkeypatch, scenes: list[Scene]) -> None:
    """Show scenes in all orders; hold a browser that gets all, one that gets every third, and a player to each alone."""
    alone = [in_browser(server, monkeypatch, [scene]) for scene in scenes]
    with monkeypatch.context() as patch:
        windows = Windows(server, patch, browsers=2)
        sink, ends = ViserSink(server.scene), []
        for k, i in enumerate(all_pairs(len(scenes))):
            sink.show(scenes[i])
            ends.append((i, len(windows.recorded)))
            assert difference(windows.send(0).seen(ROOT), alone[i]) == "", f"preset {i} as number {k}"
            if k % 3 == 0:
                assert difference(windows.send(1).seen(ROOT), alone[i]) == "", f"preset {i} as number {k}, in one batch"
        player = Browser()
        for i, end in (ends[-1], ends[len(ends) // 2], ends[3], ends[len(ends) // 3]):
            player.hide_all()
            player.handle(windows.recorded[:end])
            assert difference(player.seen(ROOT), alone[i]) == "", f"preset {i}, sought"
        sink.show({})
        windows.close()


def in_browser(server, monkeypatch, scenes: list[Scene]) -> Seen:
    with monkeypatch.context() as patch:
        windows = Windows(server, patch)
        sink = ViserSink(server.scene)
        for scene in scenes:
            sink.show(scene)
        seen = windows.send().seen(ROOT)
        sink.show({})
        windows.close()
    return seen


@pytest.mark.parametrize("which", [0, 1], ids=["where they open", "at their ends"])
@pytest.mark.parametrize("name", LESSONS)
def test_a_preset_after_another_shows_what_it_shows_alone(server, monkeypatch, name, which):
    walk_live(server, monkeypatch, scenes_of(name)[which])


def test_a_walk_through_all_lessons_shows_each_as_alone(server, monkeypatch):
    scenes = []
    for lesson in catalog().values():
        timeline = Timeline(lesson, lesson.params())
        assert timeline.extend()
        scenes.append(timeline[0].scene)
    walk_live(server, monkeypatch, scenes)


class Stream:
    """A recording stream that keeps the latest value of every component, as a viewer looks it up."""

    def __init__(self) -> None:
        self.shown: dict[str, dict[str, Any]] = {}
        self._classes: Any = None

    def set_time(self, *_: Any, **__: Any) -> None:
        pass

    def log(self, entity: str, *archetypes: Any, static: bool = False) -> None:
        for archetype in archetypes:
            if isinstance(archetype, rr.Clear):
                self.shown.pop(entity, None)
                continue
            for batch in archetype.as_component_batches():
                values = batch.as_arrow_array()
                self.shown.setdefault(entity, {})[str(batch.component_descriptor())] = values

    def seen(self) -> dict[str, dict[str, Any]]:
        found = {}
        for entity, components in self.shown.items():
            kept = {name: values for name, values in components.items() if not name.startswith("AnnotationContext")}
            if kept and any(len(values) for values in kept.values()):
                found[entity] = kept
        return found
