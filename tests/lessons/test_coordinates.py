"""Every claim of the coordinates lesson in numbers: presets, questions, page and slots."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.coordinates.lesson import TURNS, draw, lesson, moments, run
from lessons.coordinates.placing import Walked
from lessons.coordinates.state import Params
from tests.runs import finished
from tests.truths.coordinates import CAPS, EARTH, fastest, in_caps, straight_over_shortest
from workbench.errors import InputError
from workbench.geometry.shapes.curvilinear import spherical_from_cartesian
from workbench.geometry.shapes.globe import great_circle_distance
from workbench.scene import Curve, Label, Points, Segments, caption_of


def states(params: Params) -> tuple[Any, ...]:
    return finished(lesson.name, params).states()


def of(name: str) -> tuple[Any, ...]:
    return states(lesson.preset(name).params)


def last(name: str) -> Any:
    return of(name)[-1].now


def last_of(params: Params, **slots: Any) -> Any:
    *_, state = run(params, **slots)
    return state


def tone(name: str) -> str:
    return caption_of(draw(of(name)[-1])).tone


# presets ------------------------------------------------------------------------------------------


def test_past_the_axis_one_coordinate_turns_half_round_within_two_steps():
    for name, column in (("home", 2), ("cylindrical", 1)):
        azimuth = np.degrees(last(name).c[:, column])
        assert np.abs(np.diff(azimuth))[7:9].sum() == pytest.approx(159, abs=0.5)
        assert np.ptp(azimuth) > 175
        assert tone(name) == "good"
    steps = np.abs(np.diff(last("cartesian").c, axis=0))
    assert steps.max() == pytest.approx(0.075)
    # where the page sends a reader
    assert caption_of(draw(of("home")[20])).text.endswith("changed φ by 79.5°.")


def test_a_mount_locks_at_the_zenith_as_the_page_says():
    """Of direction by pan and tilt: sizes 1 and cos(tilt), so that panning is lost at the zenith
    and nothing else.
    """

    def direction(pan: float, tilt: float) -> np.ndarray:
        return np.array([np.cos(tilt) * np.cos(pan), np.cos(tilt) * np.sin(pan), np.sin(tilt)])

    assert lesson.page is not None
    page = lesson.page.read_text(encoding="utf-8")
    for tilt, claim in ((45, "0.71 at 45°"), (89, "0.017 at 89°"), (90, "0 at 90°")):
        at = np.radians(tilt)
        d = 1e-5
        J = np.column_stack(
            [
                (direction(0.3 + d, at) - direction(0.3 - d, at)) / (2 * d),
                (direction(0.3, at + d) - direction(0.3, at - d)) / (2 * d),
            ]
        )
        sizes = np.linalg.svd(J, compute_uv=False)
        np.testing.assert_allclose(sizes, [1.0, np.cos(at)], atol=1e-6)
        assert float(claim.split()[0]) == pytest.approx(sizes[1], abs=0.005)
        assert claim in page
    assert "gimbal lock" in page
    assert "without a lock" not in page


def test_the_walk_turns_by_as_much_in_two_steps_as_the_page_says():
    walked = [state.now.c for state in states(Params()) if isinstance(state.now, Walked)][-1]
    turned = np.degrees(np.unwrap(walked[:, 2]))
    assert np.abs(turned[2:] - turned[:-2]).max() == pytest.approx(159, abs=0.5)
    assert lesson.page is not None
    assert "by 159° within two steps" in lesson.page.read_text(encoding="utf-8")


def test_one_triple_is_three_points():
    state = next(state for state in of("conventions") if type(state.now).__name__ == "Readings")
    p = state.now.p
    np.testing.assert_allclose(p["mathematics"], lesson.preset("conventions").params.point)
    assert (
        min(np.linalg.norm(p[a] - p[b]) for a, b in (("ISO", "mathematics"), ("ISO", "elevation")))
        > 0.1
    )


def test_angles_drawn_evenly_are_not_even():
    assert in_caps(last("poles").p) == pytest.approx(0.333, abs=0.02)
    assert in_caps(last("even").p) == pytest.approx(CAPS, abs=0.02)
    assert (tone("poles"), tone("even")) == ("wrong", "good")


@pytest.mark.parametrize(("sigma", "short"), [(10.0, 0.15), (20.0, 0.59), (30.0, 1.28)])
def test_the_mean_of_a_banana_is_short(sigma, short):
    scatter = last_of(replace(lesson.preset("banana").params, bearing_noise=sigma)).now
    assert 10 - scatter.mean[0] == pytest.approx(short, abs=0.06)
    assert np.linalg.norm(scatter.debiased - scatter.true) < 0.12
    assert np.linalg.norm(scatter.expected - scatter.true) == pytest.approx(
        10 * (1 - np.exp(-(np.radians(sigma) ** 2) / 2))
    )


@pytest.mark.parametrize(
    ("name", "more"), [("great-circle", 11.9), ("anchorage", 33.6), ("equator", 0.0)]
)
def test_straight_on_the_map_costs(name, more):
    voyage = of(name)[-2].now
    assert 100 * (voyage.straight_length / voyage.direct - 1) == pytest.approx(more, abs=0.06)
    assert 100 * (straight_over_shortest(of(name)[0].subject.degrees) - 1) == pytest.approx(
        more, abs=0.06
    )


def test_how_much_longer_is_said_with_digits_that_mean_something():
    texts = [
        caption_of(draw(of(name)[-2])).text for name in ("great-circle", "equator", "dateline")
    ]
    assert [text.rsplit(", ", 1)[1] for text in texts] == [
        "11.9 % more.",
        "less than 0.01 % more.",
        "3,157 % more.",
    ]


def test_the_means_of_numbers():
    assert last("dateline").apart / 1e3 == pytest.approx(16_455, abs=1)
    assert last("great-circle").apart > 2e6
    assert last("equator").apart < 1e4
    assert [tone(name) for name in ("dateline", "great-circle", "equator")] == [
        "wrong",
        "wrong",
        "good",
    ]
    assert last("dateline").direct / 1e3 == pytest.approx(1150, abs=10)  # as the question says


def test_latitudes_differ_most_half_way():
    latitudes = last("latitude")
    off = np.degrees(latitudes.latitude - latitudes.geocentric)
    assert off.max() == pytest.approx(0.192, abs=1e-3)
    assert latitudes.apart.max() / 1e3 == pytest.approx(21.4, abs=0.1)
    assert np.degrees(latitudes.latitude[off.argmax()]) == pytest.approx(45)
    assert np.degrees(np.max(last("saturn").latitude - last("saturn").geocentric)) == pytest.approx(
        5.9, abs=0.05
    )


@pytest.mark.parametrize(
    ("name", "miss", "rate"),
    [("zenith", 1.0, 3282), ("keyhole", 0.1, 32_828), ("wide", 30.0, 99.2)],
)
def test_the_pan_axis_turns_without_bound(name, miss, rate):
    followed = last(name)
    assert (
        np.degrees(followed.pan_peak)
        == pytest.approx(rate, rel=1e-3)
        == pytest.approx(fastest(miss)[0], rel=1e-3)
    )
    assert np.degrees(followed.sight_peak) == pytest.approx(fastest(miss)[1])
    assert tone(name) == "good"
    assert len(of(name)) < 40


def test_the_zenith_itself_is_among_the_moments():
    for miss in (0.1, 1.0, 30.0):
        times = moments(np.tan(np.radians(miss)))
        assert 0.0 in times
        assert (np.diff(times) > 0).all()


def test_parallels_meet_and_come_back():
    steps = of("infinity")
    assert TURNS[11] == 0 == steps[11].now.x_h[2]  # where the page says w = 0
    far = [abs(state.now.x_h[0] / state.now.x_h[2]) for state in steps[:11]]
    assert far[6] == pytest.approx(57.3, abs=0.1)
    assert far[9] == pytest.approx(5730, abs=1)
    assert far[10] == pytest.approx(57.3e6, rel=1e-3)
    assert steps[-1].now.x_h[0] / steps[-1].now.x_h[2] == pytest.approx(2.5)
    np.testing.assert_allclose([state.now.cross_ratio for state in steps], 9 / 7)
    assert tone("horizon") == "good"


def test_the_angle_of_the_knob_is_the_last_one():
    steps = states(Params(stage="projective", angle_between=7.0))
    angles = [np.degrees(state.now.angle) for state in steps]
    assert angles[:4] == pytest.approx([40, 30, 20, 10])
    assert set(np.round(angles[4:], 9)) == {7.0}


def test_vectors_with_other_w_pull_more():
    weighted = last("weights")
    p, q, mean = (h[:3] / h[3] for h in (weighted.p_h, weighted.other_h, weighted.mean_h))
    np.testing.assert_allclose(mean, (p + 3 * q) / 4)


def test_the_eye_steps_back():
    view = last("near-far")
    assert view.near == pytest.approx(0.0101, abs=1e-4)
    assert np.abs(view.perspective - view.parallel).max() < 0.01
    near = [state.now.near for state in of("near-far")]
    assert (np.diff(near) < 0).all()
    last_one = last_of(Params(stage="project", distance=10.0)).now
    assert last_one.near == pytest.approx(0.111, abs=1e-3)


def test_every_stage_ends_at_its_last_step():
    for preset in lesson.presets:
        assert [state.last for state in of(preset.name)].count(True) == 1
        assert of(preset.name)[-1].last


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer", "within"),
    [
        ("predict-poles", 33.3, 1.5),
        ("predict-way", 18.8, 0.06),
        ("predict-pan", 2, 0),
        ("predict-ball", 2 * np.pi**2, 1e-9),
        ("predict-mean", 2, 0),
    ],
)
def test_answers(name, answer, within):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == pytest.approx(answer, abs=within)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["predict-pan"].answer(tuple(run(Params(stage="mount", miss=30.0)))) == 0
    assert asked["predict-mean"].answer(of("equator")) == 0
    assert asked["predict-poles"].answer(of("even")) == pytest.approx(13.4, abs=2)


# slots --------------------------------------------------------------------------------------------


def by_arctan(p: np.ndarray) -> np.ndarray:
    c = spherical_from_cartesian(p)
    with np.errstate(all="ignore"):
        c[:, 2] = np.arctan(p[:, 1] / p[:, 0])
    return c


def test_wrong_angles_are_told_by_the_walk_and_by_the_camera():
    walked = last_of(Params(), spherical_from_cartesian=by_arctan)
    assert caption_of(draw(walked)).tone == "wrong"
    first = next(run(Params(stage="mount"), spherical_from_cartesian=by_arctan))
    assert caption_of(draw(first)).tone == "wrong"


def test_wrong_meetings_are_told():
    for wrong in (
        lambda a, b: a + b,
        lambda a, b: np.full((1, 3), np.nan),
        lambda a, b: np.zeros((1, 3)),
    ):
        state = last_of(Params(stage="projective"), meet=wrong)
        assert caption_of(draw(state)).tone == "wrong"
    by_w = lambda a, b: np.cross(a, b) / np.cross(a, b)[:, 2:]  # noqa: E731
    with np.errstate(all="ignore"):
        tones = [
            caption_of(draw(state)).tone for state in run(Params(stage="projective"), meet=by_w)
        ]
    assert [k for k, tone in enumerate(tones) if tone == "wrong"] == [11]


def test_ways_are_as_long_as_they_are_measured():
    for value in (1e3, 0.0, np.nan):
        steps: list[Any]
        *steps, _ = run(
            Params(stage="globe"),
            great_circle_distance=lambda a, b, radius, v=value: np.full(len(a), v),
        )
        np.testing.assert_equal(steps[-1].now.circle_length, 192 * value)
        assert [caption_of(draw(state)).tone for state in steps] == ["info"] + 16 * ["wrong"]
    assert great_circle_distance(np.zeros((1, 2)), np.array([[0.0, 90.0]]))[0] == pytest.approx(
        EARTH * np.pi / 2
    )


# pictures -----------------------------------------------------------------------------------------


def test_what_leaves_the_picture_is_an_arrow():
    shown = [("point" in draw(state), "arrow" in draw(state)) for state in of("weights")[:-1]]
    assert shown[0] == (True, False)
    assert shown[-1] == (False, True)


def test_the_globe_turns_its_way_to_the_eye():
    scene = draw(of("dateline")[-1])
    label = scene["name/0"]
    assert isinstance(label, Label)
    assert label.T_world_object is not None
    assert (label.T_world_object[:3, :3] @ label.p)[1] < 0
    curve = scene["map circle"]
    assert isinstance(curve, Curve)
    assert np.ptp(curve.x) < 15  # the way across the date line is drawn in one piece


def test_pictures_of_the_eye_are_what_the_eye_computed():
    state = of("near-far")[3]
    picture = draw(state)["perspective"]
    assert isinstance(picture, Segments)
    corners = np.unique(picture.ends.reshape(-1, 3)[:, [0, 2]].round(6), axis=0)
    seen = np.unique(state.now.perspective.round(6), axis=0)
    assert all(np.abs(corners - uv).sum(axis=1).min() < 1e-5 for uv in seen[:5])


def test_the_plumb_line_is_drawn_at_its_latitude():
    scene = draw(of("latitude")[9])
    plumb, place = scene["plumb"], scene["place"]
    assert isinstance(plumb, Segments)
    assert isinstance(place, Points)
    up = plumb.ends[0, 1] - plumb.ends[0, 0]
    assert np.degrees(np.arctan2(up[2], up[0])) == pytest.approx(45)
    assert plumb.ends[0, 0, 2] == pytest.approx(0)  # it ends on the plane of the equator


def test_a_point_at_the_origin_has_no_direction():
    with pytest.raises(InputError, match="origin"):
        next(run(Params(point=(0.0, 0.0, 0.0))))
