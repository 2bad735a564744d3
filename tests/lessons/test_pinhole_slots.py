"""The pinhole lesson in awkward places, and driven by a student's functions."""

import numpy as np
import pytest

from lessons.pinhole.captions import back_error
from lessons.pinhole.inputs import Input as Params
from lessons.pinhole.inputs import Mistake
from lessons.pinhole.lesson import lesson
from lessons.pinhole.presets import BACK, DISTORT, DIVIDE, PIXELS
from lessons.pinhole.shot import heights
from lessons.pinhole.shot import setup as shot_of
from tests.lessons.pinhole_runs import look, orange, states, tone
from workbench.geometry.cameras import camera_center, project
from workbench.geometry.cameras.distortion import distort
from workbench.run.timeline import Timeline
from workbench.scene import Segments

# Awkward places


def captions(params: Params, **slots) -> list[str]:
    timeline = Timeline(lesson, params, slots).complete()
    assert timeline.stopped is None, timeline.failure
    return [step.caption.text for step in timeline.known()]


def test_an_inverse_that_is_the_same_motion_is_not_blamed():
    """From straight above the diagonal, T_camera_world is its own inverse."""
    params = Params(camera=(1.0, 1.0, 5.0), target=(1.0, 1.0, 0.0), mistake="pose inverted")
    T = shot_of(params).T_camera_world
    np.testing.assert_allclose(T @ T, np.eye(4), atol=1e-12)
    assert not any("inverted" in text for text in captions(params))
    assert tone(params, 1) == "info"


def test_heights_that_no_picture_shows_are_not_said():
    params = Params(camera=(0.5, 30.0, 1.7), target=(0.3, 50.0, 1.0), dolly=2.0, heights=True)
    assert not np.isfinite(shot_of(params).crate)
    assert "crate" not in captions(params)[PIXELS]


def test_a_dolly_about_another_target_does_not_keep_the_crate():
    params = Params(dolly=3.0, k1=0.0, k2=0.0, heights=True)
    shot = shot_of(params)
    before = heights(params, 1.0)[0]
    assert shot.crate < 0.9 * before
    assert f"The crate is {shot.crate:.0f} px high" in captions(params)[PIXELS]


def test_a_point_in_front_that_a_function_loses_is_not_said_to_be_behind():
    def nothing(p_world, T_camera_world, K):
        return np.full((len(p_world), 2), np.nan)

    assert captions(Params(), project=nothing)[DIVIDE].startswith(
        "Z = 16.03 m: it is in front of the camera"
    )
    assert "Z = −2.25 m: it is not in front of the camera" in captions(Params(point=5))[DIVIDE]


def test_a_lens_that_bends_where_there_is_none_is_not_said_to_do_nothing():
    texts = captions(Params(k1=0.0, k2=0.0), distort=lambda xy, k1, k2, p1, p2: 1.1 * xy)
    assert "bends nothing" not in texts[DISTORT]


def test_round_trips_end_where_they_began_and_not_at_a_rounding():
    assert captions(Params())[BACK].endswith("we come out where we began.")
    assert "1.09 m from where we began" in captions(lesson.preset("ray-length").params)[BACK]


# The functions of the exercises


def test_a_wrong_project_shows_in_every_later_stage_and_in_the_picture():
    def upside_down(p_world, T_camera_world, K):
        return project(p_world, T_camera_world, K) * [1, -1] + [0, 2 * K[1, 2]]

    run_ = states(Params(), project=upside_down)
    right = states(Params())
    assert all(state.error > 20 for state in run_[DIVIDE:])
    assert run_[1].now.p_camera is not None
    flipped = orange(run_[-1].picture)[::-1]
    assert (flipped & orange(right[-1].picture)).sum() > 0.5 * flipped.sum()


def test_a_wrong_distort_shows_from_the_lens_on():
    run_ = states(Params(), distort=lambda xy, k1, k2, p1, p2: xy)
    assert run_[DIVIDE].error < 1e-9
    assert run_[DISTORT].error > 0.5
    assert (run_[-1].picture != states(Params())[-1].picture).any()
    assert back_error(look(run_, BACK)) > 0.01


def test_a_wrong_camera_center_shows_on_the_way_back():
    run_ = states(Params(), camera_center=lambda T: camera_center(T) + np.array([0, 0, 1.0]))
    assert run_[PIXELS].error < 1e-9
    assert back_error(look(run_, BACK)) == pytest.approx(1.0)


def test_a_function_that_answers_nothing_is_shown_not_raised():
    slots = {"project": lambda p, T, K: np.full((len(p), 2), np.nan)}
    timeline = Timeline(lesson, Params(), slots).complete()
    assert timeline.stopped is None, timeline.failure
    assert timeline[PIXELS].caption.tone == "wrong"
    assert timeline[PIXELS].state.found == 0


def test_the_given_functions_are_asked_few_times():
    """Each call goes to another process when a student's function runs."""
    calls = {"project": 0, "distort": 0, "camera_center": 0}

    def counted(name, function):
        def wrapper(*args):
            calls[name] += 1
            return function(*args)

        return wrapper

    slots = {"project": project, "distort": distort, "camera_center": camera_center}
    states(Params(), **{name: counted(name, function) for name, function in slots.items()})
    assert calls["project"] == calls["distort"] == 2
    assert calls["camera_center"] == 1


def test_every_mistake_has_its_sentence():
    from lessons.pinhole.captions import MISTAKES

    assert {*Mistake.__args__} == {"none", *MISTAKES}


def test_rays_of_the_division_start_in_the_camera():
    timeline = Timeline(lesson, Params()).complete()
    rays = timeline[DIVIDE].scene["rays"]
    assert isinstance(rays, Segments)
    np.testing.assert_allclose(
        rays.ends[:, 0], np.tile(Params().camera, (len(rays.ends), 1)), atol=1e-9
    )
    assert len(rays.ends) == 83
