"""What a page is sent: every kind and array once, a stage where it is another one, a whole run as
its steps one by one.
"""

import base64
import json
import struct
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import zstandard

from tests import fake
from tests.wire.kinds import KINDS
from tests.wire.reading import Reader, alike
from workbench.lesson import View
from workbench.run.timeline import Timeline
from workbench.scene import Points
from workbench.wire import packing
from workbench.wire.nodes import Content, Maker, NodeKind, digest
from workbench.wire.packing import PageWire, packed, run_bytes, run_text

VIEW = View()
RNG = np.random.default_rng(3)


@pytest.fixture(scope="module", params=["field", "classes", "measured", "role"])
def timeline(request) -> Timeline:
    return Timeline(
        fake.lesson, fake.Params(colors=request.param, wobble=request.param == "role")
    ).complete()


def test_what_is_packed_is_what_is_read():
    for sizes in ([], [0], [1], [8], [7, 0, 9, 16], RNG.integers(0, 99, 20)):
        contents = [RNG.bytes(size) for size in sizes]
        arrays = [Content(f"{i}", content) for i, content in enumerate(contents)]
        texts = ['{"type":"a","props":{"é":"\\u00b7 €"}}', '{"type":"b","props":{}}']
        kinds = [NodeKind(digest(text.encode()), text, ()) for text in texts]
        message = packed({"run": 3, "word": "½ · ∞ <"}, kinds, arrays)
        reader = Reader()
        head = reader.read(message)
        assert (head["run"], head["word"]) == (3, "½ · ∞ <")
        assert reader.kinds == {kind.key: json.loads(kind.text) for kind in kinds}
        assert list(reader.arrays.values()) == contents
        assert (4 + struct.unpack_from("<I", message)[0]) % 8 == 0 == len(message) % 8


def test_a_step_sends_each_kind_and_array_once_and_all_that_it_shows(timeline):
    wire = PageWire(Maker())
    reader = Reader()
    order = [0, 1, 2, 3, 4, 5, 4, 3, 0, 5, 2, 2]
    for k in order:
        scene = timeline[k].scene
        head = reader.read(wire.step({"k": k}, scene, VIEW))  # which refuses what is sent twice
        alone = Reader()
        wanted = alone.nodes(alone.read(PageWire(Maker()).step({}, scene, VIEW))["nodes"])
        nodes = reader.nodes(head["nodes"])
        assert list(nodes) == list(wanted)
        assert alike(nodes, wanted)
        assert head["k"] == k
    again = Reader().read(wire.step({}, timeline[2].scene, VIEW))
    assert (again["arrays"], again["kinds"]) == ([], {})


def test_equal_content_in_other_objects_is_not_sent_again(timeline):
    wire = PageWire(Maker())
    reader = Reader()
    maker = Maker()
    scene = timeline[1].scene
    reader.read(wire.step({}, scene, VIEW))
    copy = {path: replace(primitive) for path, primitive in scene.items()}  # type: ignore[type-var]
    head = reader.read(wire.step({}, copy, VIEW))
    assert (head["arrays"], head["kinds"]) == ([], {})
    keys = [
        [kind.key for kind, _ in maker.nodes(primitives, VIEW).values()]
        for primitives in (scene, copy)
    ]
    assert keys[0] == keys[1]


def test_a_page_that_holds_much_is_told_to_forget_and_sent_all_again(monkeypatch):
    monkeypatch.setattr(packing, "MOST_ON_A_PAGE", 20_000)
    wire = PageWire(Maker())
    reader = Reader()
    fresh = []
    for k in range(12):
        cloud = Points(RNG.uniform(size=(300, 3)))  # 3,600 bytes
        head = reader.read(wire.step({}, {"rest": KINDS[0]["x"], "cloud": cloud}, VIEW))
        points = reader.nodes(head["nodes"])["/scene/cloud"]["props"]["points"]
        np.testing.assert_array_equal(points, cloud.p.astype(np.float32).ravel())
        assert sum(map(len, reader.arrays.values())) < 30_000
        fresh.append(head.get("fresh", False))
        assert fresh[-1] == ("stage" in head), f"step {k}: who forgets forgets the stage too"
    assert fresh[:5] == [True, False, False, False, False]
    assert 2 <= sum(fresh) <= 3


def test_a_stage_is_told_where_the_view_or_the_lesson_is_another():
    wire = PageWire(Maker())
    reader = Reader()
    other = View(eye=(1.0, 1.0, 1.0))

    def told(view: View, lesson: str) -> bool:
        return "stage" in reader.read(wire.step({}, {}, view, stage=lesson))

    asked = [
        (VIEW, "a"),
        (VIEW, "a"),
        (replace(VIEW), "a"),
        (other, "a"),
        (other, "a"),
        (other, "b"),
        (VIEW, "b"),
    ]
    assert [told(*case) for case in asked] == [True, False, False, True, False, True, True]
    wire.forget()
    assert told(VIEW, "b")


def test_a_run_holds_step_by_step_what_a_live_page_is_sent(timeline):
    reader, maker = Reader(), Maker()
    whole = reader.read(run_bytes(timeline, maker))
    live_wire = PageWire(Maker())
    live = Reader()
    view = timeline.lesson.view_of(timeline.params)
    before: dict[str, Any] = {}
    assert len(whole["steps"]) == len(timeline)
    names_alone = 0
    for step, listed in zip(timeline.known(), whole["steps"], strict=True):
        head = live.read(live_wire.step({}, step.scene, view))
        shown = {}
        for entry in listed:
            names_alone += isinstance(entry, str)
            name, node = (
                (entry, before[entry])
                if isinstance(entry, str)
                else (entry[0], reader.node(entry[1], entry[2]))
            )
            assert not (isinstance(entry, list) and alike(before.get(name), node)), (
                f"{name} is as it was, and said again"
            )
            shown[name] = node
        assert list(shown) == [name for name, _, _ in head["nodes"]]
        assert alike(shown, live.nodes(head["nodes"]))
        if "stage" in head:
            assert head["stage"] == whole["stage"]
        before = shown
    assert names_alone > len(timeline)


def test_a_run_as_text_is_its_bytes(timeline):
    file = base64.b64decode(run_text(timeline))
    content = zstandard.ZstdDecompressor().decompress(file[8:])
    assert int.from_bytes(file[:8], "little") == len(content)
    assert content == run_bytes(timeline)
    assert len(file) < len(content)
