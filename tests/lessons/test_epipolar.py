"""Every claim of the epipolar lesson in numbers: presets, questions, page and slots."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.epipolar.lesson import draw, lesson, run
from lessons.epipolar.presets import DEPTH, depth_sigma
from lessons.epipolar.state import Params
from tests.runs import finished
from tests.truths.epipolar import apart, errors, sampson, true_fundamental
from workbench.algorithms.two_views import Followed
from workbench.errors import InputError
from workbench.geometry.motions import apply
from workbench.geometry.motions.rotations import rotation_about
from workbench.geometry.two_views.rectification import growth
from workbench.scene import Caption, Points, Segments, caption_of


def states(params: Params) -> tuple[Any, ...]:
    return finished(lesson.name, params).states()


def steps_of(steps: Iterable[Any]) -> list[Any]:
    return list(steps)


def of(name: str) -> tuple[Any, ...]:
    return states(lesson.preset(name).params)


def at(name: str, stage: str) -> Any:
    return next(state for state in of(name) if state.now.stage == stage)


def end(name: str) -> Caption:
    # not as it is shown: what breaks on purpose is shown calmly
    return caption_of(draw(of(name)[-1]))


def clean(state: Any) -> float:
    return sampson(state.now.F, state.views.clean[:60])


# presets ------------------------------------------------------------------------------------------


def test_home_finds_the_motion():
    for seed in range(5):
        last = steps_of(run(Params(seed=seed)))[-1]
        turn, direction = errors(last) or (np.inf, np.inf)
        assert turn < 0.7
        assert direction < 3
    assert end("home").tone == "good"
    assert len(of("home")) < 30
    kinds = [state.now.stage for state in of("home")]
    assert kinds[:8] == 6 * ["ray"] + ["plane", "pencil"]
    # where the page's links go
    assert [kinds[k] for k in (8, 9, 10, 11, 12, 16, 17)] == [
        "equations",
        "rank three",
        "rank two",
        "essential",
        "pose",
        "points",
        "refined",
    ]


def test_refining_the_pose_helps_more_than_refining_f():
    turned = {route: [] for route in ("eight-point", "refined F", "refined pose")}
    for route, degrees in turned.items():
        for seed in range(12):
            *_, last = run(Params(heading=0.0, route=route, seed=seed))  # type: ignore[arg-type]
            degrees.append(errors(last))
    middle = {route: np.median(degrees, axis=0) for route, degrees in turned.items()}
    assert middle["refined pose"][0] < 0.6 * middle["refined F"][0]
    assert middle["refined pose"][1] < 0.6 * middle["refined F"][1]
    assert middle["eight-point"][1] > 1.5


def test_raw_pixels_miss_by_pixels_and_rank_two_makes_it_worse():
    raw, home = of("raw"), of("home")
    assert clean(raw[10]) > 3 > 10 * clean(home[10])
    three, two, normal = [], [], []
    for seed in range(10):
        steps = steps_of(run(Params(heading=0.0, normalise=False, route="eight-point", seed=seed)))
        three.append(clean(steps[9]))
        two.append(clean(steps[10]))
        normal.append(clean(steps_of(run(Params(heading=0.0, route="eight-point", seed=seed)))[10]))
    assert np.median(two) > 1.4 * np.median(three) > 4 * np.median(normal)
    assert raw[8].now.singular_values[7] / raw[8].now.singular_values[0] < 1e-5
    assert end("raw").tone == "wrong"


def test_lines_of_rank_three_do_not_meet():
    F = at("rank-three", "rank two").now.F
    values = np.linalg.svd(F)[1]
    assert values[2] > 1e-7 * values[1]
    assert np.linalg.svd(at("home", "rank two").now.F)[1][2] < 1e-15
    scene = finished(lesson.name, lesson.preset("rank-three").params)[10].scene
    assert "second/epipole" not in scene
    lines = np.column_stack([of("rank-three")[10].views.matches[:, :2], np.ones(20)]) @ F.T
    lines /= np.linalg.norm(lines[:, :2], axis=1)[:, None]
    middle = np.linalg.lstsq(lines[:, :2], -lines[:, 2], rcond=None)[0]
    assert np.abs(lines @ [*middle, 1]).max() > 2  # px that a line misses the nearest point to all


def test_a_plane_says_nothing_of_the_motion():
    off = []
    for seed in range(8):
        last = steps_of(run(replace(lesson.preset("plane").params, seed=seed)))[-1]
        assert sampson(last.now.F, last.views.matches) < 1.0
        off.append((errors(last) or (0, 0))[1])
    assert np.median(off) > 45
    assert min(off) > 20
    values = of("plane")[8].now.singular_values
    assert values[7] < 0.2 * of("home")[8].now.singular_values[7]
    assert end("plane").tone == "wrong"


def test_a_turn_has_a_rotation_and_no_direction():
    steps = of("turned")
    assert (errors(steps[-1]) or (9, 9))[0] < 1
    assert max(steps[-1].now.in_front) >= 45
    assert [state.now.stage for state in steps[:7]] == [*6 * ["ray"], "equations"]
    assert np.ptp(steps[5].now.uv_second, axis=0).max() < 1e-6
    assert end("turned").tone == "wrong"
    assert "made up" in end("turned").text


def test_a_short_baseline_costs_direction_and_depth():
    short, home = of("short")[-1], of("home")[-1]
    assert sampson(short.now.F, short.views.matches) < 1.2 * sampson(home.now.F, home.views.matches)
    assert (errors(short) or (9, 9))[0] < 1
    assert (errors(short) or (0, 0))[1] > 5
    sigmas = [
        depth_sigma(next(run(Params(heading=0.0, baseline=b)))) for b in (1.0, 0.5, 0.1, 0.02)
    ]
    assert sigmas == pytest.approx([0.11, 0.22, 1.07, 5.4], rel=0.03)


def test_far_away_there_is_a_rotation_and_hardly_more():
    rows = {"far": [], "home": []}
    for name, ends in rows.items():
        for seed in range(12):
            last = steps_of(run(replace(lesson.preset(name).params, seed=seed)))[-1]
            z = last.views.p_first[:, 2]
            # before both cameras, after refinement
            ahead = (last.now.p_first[:, 2] > 0) & (
                apply(last.now.T_second_first, last.now.p_first)[:, 2] > 0
            )
            # of Z over Z, beside each other, 1 m apart
            sigma = np.sqrt(2) * 0.5 * z / (420 * np.cos(np.radians(20)))
            line = sampson(last.now.F, last.views.matches)
            ends.append(
                (
                    *(errors(last) or (9, 9)),
                    ahead.mean(),
                    np.median(sigma),
                    line,
                    last.parallax,
                    z.min(),
                )
            )
    far, home = (np.median(rows[name], axis=0) for name in ("far", "home"))
    assert far[0] < 1.3 * home[0] < 0.4  # degrees of rotation: as good
    assert far[1] > 45 > 20 * home[1]  # of direction
    assert far[2] < 0.8 < 1 == home[2]  # of the points in front
    assert 0.35 < far[3] < 0.7  # of its depth is the uncertainty of a point, by parallax alone
    assert far[4] < 1.1 * home[4]  # px from their lines
    # px of parallax: little more than the noise of both pixels, 0.7
    assert 1.2 < far[5] < 1.8 < 40 < home[5]
    assert min(row[6] for row in rows["far"]) > 180  # baselines
    points = of("far")[16]
    assert points.now.stage == "points"
    assert max(points.now.in_front) < 60
    assert f"parallax is {points.parallax:.2f} px" in caption_of(draw(points)).text
    assert end("far").tone == "wrong"


def test_what_is_far_is_drawn_as_a_model():
    state = of("far")[16]
    scene = draw(state)
    seen = {
        name: scene[name]
        for name in ("true points", "points", "direction/camera", "direction/true camera")
    }
    true, estimated = seen["true points"], seen["points"]
    assert isinstance(true, Points)
    assert isinstance(estimated, Points)
    np.testing.assert_allclose(50 * true.p, state.views.p_first, rtol=1e-12)
    nearest = np.linalg.norm(
        estimated.p[:, None] - state.length * state.now.p_first / 50, axis=2
    ).min(axis=1)
    assert nearest.max() < 1e-9
    for path, T in (
        ("direction/camera", state.T_second_first),
        ("direction/true camera", state.T_true),
    ):
        pointer = seen[path]
        assert isinstance(pointer, Segments)
        way = pointer.ends[0, 1] - pointer.ends[0, 0]
        np.testing.assert_allclose(
            way / np.linalg.norm(way), -T[:3, :3].T @ T[:3, 3] / np.linalg.norm(T[:3, 3]), atol=1e-9
        )
    assert "direction/camera" not in draw(of("home")[16])  # there it is seen
    marks = draw(of("far")[3])["marks"]
    assert isinstance(marks, Points)
    np.testing.assert_allclose(marks.p[:, 2], [3, 4, 6, 8])
    assert [label for label in draw(of("far")[3]) if label.startswith("mark/")] == [
        "mark/150",
        "mark/300",
    ]


def test_ahead_the_epipole_is_in_the_picture_and_rows_cannot_be_had():
    state = of("forward")[7]
    e = np.linalg.svd(true_fundamental(state))[0][:, 2]
    assert ((e[:2] / e[2] > 0) & (e[:2] / e[2] < [480, 320])).all()
    scene = finished(lesson.name, lesson.preset("forward").params)[7].scene
    assert isinstance(scene["second/epipole"], Points)
    assert isinstance(scene["first/epipole"], Points)
    assert "torn" in end("forward").text
    assert end("forward").tone == "good"  # the motion is right all the same
    rectification = at("oblique", "rectified").now.rectification
    assert 3 < growth(rectification.H_first, (480, 320)) < 40
    assert "times as large" in end("oblique").text


def test_the_second_camera_left_of_the_first():
    left, over = (at(name, "rectified").now.rectification for name in ("left", "upside-down"))
    assert left.second_is_left
    assert apart(left.R_rectified_first, np.eye(3)) < 12
    assert apart(over.R_rectified_first, np.eye(3)) == pytest.approx(180, abs=2)
    assert "upside down" in end("upside-down").text
    assert "upside down" not in end("left").text
    for name in ("left", "upside-down"):
        assert end(name).tone == "good"
        assert np.sqrt(np.square(of(name)[-1].disparities[:, 1]).mean()) < 1.0
    assert (of("left")[-1].disparities[:, 0] < 0).all()


def test_a_wrong_focal_length_hides_in_the_motion():
    off = []
    for seed in range(8):
        wrong, fine = (
            steps_of(run(replace(lesson.preset("wrong-f").params, f_error=e, seed=seed)))
            for e in (20.0, 0.0)
        )
        np.testing.assert_array_equal(wrong[10].now.F, fine[10].now.F)
        off.append(((errors(wrong[-1]) or (0, 0))[0], (errors(fine[-1]) or (0, 0))[0]))
        for values in (
            [state.to_lines(state.views.matches) for state in (wrong[-1], fine[-1])],
            [np.sqrt(np.square(state.disparities[:, 1]).mean()) for state in (wrong[-1], fine[-1])],
        ):
            assert values[0] == pytest.approx(values[1], rel=0.1)
    wrong, fine = np.median(off, axis=0)
    assert wrong > 1 > 5 * fine
    assert end("wrong-f").tone == "wrong"


def test_without_noise_all_is_exact():
    last = of("exact")[-1]
    assert max(errors(last) or (9, 9)) < 1e-4
    assert at("exact", "equations").now.singular_values[8] < 1e-12
    np.testing.assert_allclose(last.length * last.now.p_first, last.views.p_first, atol=1e-6)
    assert "rank two already" in caption_of(draw(of("exact")[9])).text


def test_every_run_ends_with_its_rectification():
    for preset in lesson.presets:
        assert [state.last for state in of(preset.name)].count(True) == 1
        assert of(preset.name)[-1].last
        assert len(of(preset.name)) < 40


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer", "within"),
    [
        ("predict-four", 1, 0),
        ("predict-baseline", 21.6, 0.2),
        ("predict-plane", 2, 0),
        ("predict-f", 0, 0),
    ],
)
def test_answers(name, answer, within):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == pytest.approx(answer, abs=within)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["predict-four"].answer(of("short")) >= 1
    assert asked["predict-plane"].answer(of("home")) == 0
    assert asked["predict-f"].answer(of("raw")) == 1
    assert asked["predict-baseline"].answer(of("sideways")) == pytest.approx(11, abs=0.3)
    assert DEPTH == 8  # as the question says


# slots --------------------------------------------------------------------------------------------


def last_tone(**slots: Any) -> str:
    *_, state = run(Params(), **slots)
    return caption_of(draw(state)).tone


def test_wrong_functions_show():
    from workbench.geometry.two_views.epipolar import fit_fundamental
    from workbench.geometry.two_views.essential import essential_to_poses
    from workbench.geometry.two_views.triangulation import triangulate

    transposed = steps_of(run(Params(), eight_point=lambda a, b: fit_fundamental(a, b).T))
    assert transposed[10].to_lines(transposed[10].views.matches) > 3
    assert last_tone(eight_point=lambda a, b: np.eye(3)) == "wrong"
    turned = rotation_about("y", 1.0)

    def turn(E: np.ndarray) -> np.ndarray:
        Ts = essential_to_poses(E)
        Ts[:, :3, :3] = turned @ Ts[:, :3, :3]
        return Ts

    assert last_tone(essential_to_poses=turn) == "wrong"
    assert last_tone(triangulate=lambda P, Q, a, b: -triangulate(P, Q, a, b)) == "wrong"
    with pytest.raises(InputError, match="eight_point"):
        steps_of(run(Params(), eight_point=lambda a, b: np.full((3, 3), np.inf)))
    nothing = steps_of(run(Params(), triangulate=lambda P, Q, a, b: np.full((len(a), 3), np.nan)))
    assert all(draw(state) for state in nothing)


# pictures -----------------------------------------------------------------------------------------


def test_the_followed_pixel_is_where_one_clicks():
    for pixel in ((0, 0), (719, 719), (100, 200)):
        first = next(run(Params(pixel=pixel)))
        assert first.uv_first.tolist() == [min(pixel[0], 479), min(pixel[1], 319)]
        scene = draw(first)
        dot, picture = scene["first/pixel"], scene["first/picture"]
        assert isinstance(dot, Points)
        np.testing.assert_allclose(dot.p[0], picture.places(first.uv_first, 0.12), atol=1e-9)  # type: ignore[union-attr]


def test_rectified_lines_are_level():
    scene = finished(lesson.name, lesson.preset("sideways").params)[-1].scene
    for path in ("second/lines", "first/lines", "second/line"):
        lines = scene[path]
        assert isinstance(lines, Segments)
        assert np.ptp(lines.ends[..., 2], axis=1).max() < 0.02
    state = of("sideways")[3]
    assert isinstance(state.now, Followed)
    shown = draw(state)["marks"]
    assert isinstance(shown, Points)
    np.testing.assert_allclose(shown.p[:, 2], [3, 4, 6, 8])


def test_ellipsoids_are_longer_the_shorter_the_baseline():
    lengths = []
    for baseline in (1.0, 0.1):
        points = next(
            state
            for state in run(Params(baseline=baseline, noise=0.05))
            if state.now.stage == "points"
        )
        shown = draw(points)["uncertainty"]
        assert isinstance(shown, Segments)
        lengths.append(np.linalg.norm(shown.ends[:, 0] - shown.ends[:, 1], axis=1).max())
    assert lengths[1] > 3 * lengths[0]
