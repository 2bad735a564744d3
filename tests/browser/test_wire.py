"""What a page reads of scenes is what was sent: arrays by their types, equal ones once, whole runs
step by step.
"""

import base64
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from tests import fake
from tests.browser.feeding import VIEW, Fed
from tests.wire.reading import Reader
from workbench.run.timeline import Timeline
from workbench.wire.nodes import Maker
from workbench.wire.packing import PageWire, packed, run_bytes

pytestmark = pytest.mark.browser
PLAIN = """
  const numbers = (value) => (ArrayBuffer.isView(value) ? [value.constructor.name, [...value]] : value);
  const plainly = ({ kind, wxyz, position }) => ({ type: kind.type, fade: kind.fade, visible: kind.visible,
    pose: [...wxyz, ...position],
    props: Object.fromEntries(Object.entries(kind.props).map(([key, value]) => [key, numbers(value)])) });
  const steps = (all) => all.map((nodes) => [...nodes].map(([name, node]) => [name, plainly(node)]));
  const bytes = (content) => Uint8Array.from(atob(content), (c) => c.charCodeAt(0)).buffer;
"""
ARRAYS = {
    "f2": "Uint16",
    "f4": "Float32",
    "f8": "Float64",
    "u1": "Uint8",
    "u2": "Uint16",
    "u4": "Uint32",
    "i4": "Int32",
}


@pytest.fixture(scope="module")
def fed(chromium) -> Iterator[Fed]:
    fed = Fed(chromium)
    yield fed
    fed.close()


@pytest.fixture(scope="module")
def timeline() -> Timeline:
    return Timeline(fake.lesson, fake.Params(points=9, steps=4)).complete()


def plain(node: dict[str, Any]) -> dict[str, Any]:
    """Return a node as the page is asked for it."""
    props = {}
    for name, value in node["props"].items():
        is_array = isinstance(value, np.ndarray)
        props[name] = [f"{ARRAYS[value.dtype.str[1:]]}Array", value.tolist()] if is_array else value
    more = {"fade": node.get("fade", 1), "visible": node.get("visible", True)}
    return {"type": node["type"], "pose": node["pose"], "props": props} | more


def coded(content: bytes) -> str:
    return base64.b64encode(content).decode()


def test_each_step_is_read_as_it_was_sent(fed, timeline):
    wire = PageWire(Maker())
    reader = Reader()
    fed("() => { window.own = new Wire(); }")
    for step in timeline.known():
        message = wire.step({"k": step.state.k}, step.scene, VIEW)
        wanted = reader.nodes(reader.read(message)["nodes"])
        read = f"""(content) => {{ {PLAIN}
          const head = own.read(bytes(content));
          return [head.k, steps([own.nodes(head.nodes)])];
        }}"""
        k, (nodes,) = fed(read, coded(message))
        assert k == step.state.k
        assert nodes == [[name, plain(node)] for name, node in wanted.items()]


def test_a_whole_run_is_read_as_its_steps(fed, timeline):
    view = timeline.lesson.view_of(timeline.params)
    wanted = []
    for step in timeline.known():
        reader = Reader()
        nodes = reader.nodes(reader.read(PageWire(Maker()).step({}, step.scene, view))["nodes"])
        wanted.append([[name, plain(node)] for name, node in nodes.items()])
    read = f"""(content) => {{ {PLAIN}
      const own = new Wire(), head = own.read(bytes(content));
      return steps(own.steps(head.steps));
    }}"""
    assert fed(read, coded(run_bytes(timeline, Maker()))) == wanted


def test_equal_kinds_are_one_object_and_equal_arrays_one_array(fed, timeline):
    run = coded(run_bytes(timeline, Maker()))
    same = f"""(content) => {{ {PLAIN}
      const own = new Wire(), all = own.steps(own.read(bytes(content)).steps), names = ["/scene/source", "/scene/frame"];
      const [first, second] = [all[0], all[1]].map((nodes) => names.map((name) => nodes.get(name)));
      return names.map((_, i) => [first[i].kind === second[i].kind, first[i] === second[i],
        Object.entries(first[i].kind.props).every(([key, value]) => value === second[i].kind.props[key])]);
    }}"""
    assert fed(same, run) == [
        [True, False, True],
        [True, False, True],
    ], "they moved, and are what they were"


def test_who_is_told_to_forget_forgets(fed, timeline):
    wire = PageWire(Maker())
    head = "(content) => { read(own, content); return [own.kinds.size, own.arrays.size]; }"
    fed("() => { window.own = new Wire(); }")
    sizes = [fed(head, coded(wire.step({}, step.scene, VIEW))) for step in timeline.known()]
    wire.forget()
    again = fed(head, coded(wire.step({}, timeline[0].scene, VIEW)))
    assert again == sizes[0]
    assert sizes[-1][0] > sizes[0][0]
    assert fed(head, coded(packed({"fresh": True, "nodes": []}, [], []))) == [0, 0]
