"""A page's scene on its way: what only moves is seen moving, what is read of stands out, and every way ends at its step."""

from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import viser

from tests import fake
from workbench.motion import FRAMES
from workbench.scene import Caption, Points, Scene
from workbench.session import Look, Session
from workbench.viewer.live_scene import LiveScene

P = np.eye(3)
REST = Points(P + 5.0, "target", 0.02)


def draw(k: int) -> Scene:
    """A cloud that goes one metre a step, beside one that rests."""
    T = np.eye(4)
    T[0, 3] = k
    return {
        "cloud": Points(P, "source", 0.01, T_world_object=T),
        "rest": REST,
        "caption": Caption(f"This is step {k}."),
    }


LESSON = replace(fake.lesson, run=lambda params: iter(range(4)), draw=draw, presets=(), questions=(), first_step=0)


@pytest.fixture(scope="module")
def client() -> Iterator[viser.ViserServer]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


@pytest.fixture
def live(client, monkeypatch) -> tuple[LiveScene, list[Scene]]:
    """A scene, and what it showed."""
    monkeypatch.setattr("workbench.viewer.stage.set_stage", lambda client, view, eye: None)
    camera = SimpleNamespace(on_update=lambda act: act, image_width=4, image_height=3)
    monkeypatch.setattr(client, "camera", camera, raising=False)
    scene, shown = LiveScene(lambda **values: None, lambda p_origin, v_ray: None), []
    scene.take(client)
    assert scene._sink is not None
    show, place = scene._sink.show, scene._sink.place

    def placed(poses) -> None:
        there = {path: replace(shown[-1][path], T_world_object=T) for path, T in poses.items()}  # type: ignore[type-var]
        shown.append(shown[-1] | there)
        place(poses)

    monkeypatch.setattr(scene._sink, "show", lambda seen: (shown.append(seen), show(seen)))
    monkeypatch.setattr(scene._sink, "place", placed)
    return scene, shown


@pytest.fixture
def session() -> Session:
    session = Session(LESSON)
    session.timeline.complete()
    return session


def at(session: Session, k: int) -> Look:
    session.seek(k)
    look = session.look()
    assert look is not None
    return look


def places(shown: list[Scene]) -> list[float]:
    return [seen["cloud"].T_world_object[0, 3] for seen in shown]  # type: ignore[union-attr, index]


def to_its_end(scene: LiveScene) -> None:
    for _ in range(3 * FRAMES):
        if not scene.go_on(at_once=False):
            return
    raise AssertionError("it moves for ever")


@pytest.mark.parametrize(("start", "end"), [(1, 2), (2, 1)])
def test_a_step_beside_is_gone_to_and_ends_where_it_says(live, session, start, end):
    scene, shown = live
    scene.show(at(session, start), current=True)
    shown.clear()
    look = at(session, end)
    assert scene.show(look, current=True) is None
    to_its_end(scene)
    assert len(shown) == FRAMES > 3
    assert places(shown) == sorted(places(shown), reverse=end < start)
    assert all(min(start, end) < x < max(start, end) for x in places(shown[:-1]))
    assert shown[-1] == look.scene


def test_who_is_impatient_sees_the_end_at_once(live, session):
    scene, shown = live
    scene.show(at(session, 0), current=True)
    scene.show(at(session, 1), current=True)
    scene.go_on(at_once=False)
    assert not scene.go_on(at_once=True)
    assert places(shown)[-1] == 1.0
    assert not scene.go_on(at_once=False)


@pytest.mark.parametrize(("k", "still"), [(2, False), (0, False), (1, True)])
def test_jumps_and_reduced_motion_go_nowhere_between(live, session, k, still):
    scene, shown = live
    scene.wear(dark=False, still=still)
    scene.show(at(session, 0), current=True)
    shown.clear()
    scene.show(at(session, k), current=True)
    assert not scene.go_on(at_once=False)
    assert places(shown) == [float(k)]


def test_what_is_read_of_stands_out_until_it_is_not(live, session):
    scene, shown = live
    look = at(session, 1)
    scene.path = "cloud"
    scene.show(look, current=True)
    assert shown[-1]["cloud"].radius > 0.01
    assert shown[-1]["rest"].opacity < 1.0
    scene.path = ""
    scene.show(look, current=True)
    assert shown[-1] == look.scene
