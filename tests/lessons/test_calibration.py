"""Every claim of the calibration lesson in numbers: presets, questions, page and slots."""

from dataclasses import replace

import numpy as np
import pytest

from lessons.calibration import presets
from lessons.calibration.lesson import draw, lesson, run
from lessons.calibration.state import Ending, Params, State
from tests.runs import finished
from tests.truths.calibration import deviation_of_f, rms_of, worst_ray
from workbench.algorithms.least_squares.board_adjustment import Stop
from workbench.certain import sure
from workbench.errors import InputError
from workbench.geometry.cameras import calibration
from workbench.scene import Caption, Mesh, Picture, Points, Segments, Table, caption_of

SQRT2 = np.sqrt(2)


def states(params: Params) -> list[State]:
    return list(finished("calibration", params).states())


def preset(name: str) -> Params:
    return lesson.preset(name).params


def end(params: Params) -> State:
    return states(params)[-1]


def f_of(state: State) -> float:
    assert state.now.K is not None
    return float(state.now.K[0, 0])


def sd_of(params: Params) -> float:
    return presets.f_deviation(states(params))


def ending(params: Params, kind: str) -> tuple[State, Ending]:
    ended = next(
        state for state in states(params) if state.ending is not None and state.ending.kind == kind
    )
    assert ended.ending is not None
    return ended, ended.ending


# presets ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "f", "sd", "rms", "worst"),
    [
        ("home", 535.6, 1.57, 0.276, 4.1),
        ("few", 533.2, 3.6, 0.244, 8.5),
        ("pinhole", 554.5, 7.9, 1.28, 164),
        ("middle", 537.3, 5.7, 0.274, 82_400),
        ("bad", 531.9, 2.9, 0.413, 14.6),
        ("dropped", 534.1, 2.04, 0.265, 6.3),
        ("cauchy", 534.0, 1.6, 0.466, 3.9),
        ("stretched", 539.0, 1.71, 0.304, 11.6),
        ("bent", 526.2, 1.72, 0.313, 17.0),
    ],
)
def test_the_presets_end_where_they_should(name, f, sd, *, rms, worst):
    last = end(preset(name))
    assert f_of(last) == pytest.approx(f, abs=0.1)
    assert sd_of(preset(name)) == pytest.approx(sd, rel=0.03)
    assert last.rms == pytest.approx(rms, rel=0.01)
    assert last.worst_in_picture == pytest.approx(worst, rel=0.02)
    assert last.now.K is not None
    assert worst_ray(last.now.K, tuple(last.now.lens)) == pytest.approx(
        last.worst_in_picture, rel=1e-4
    )
    np.testing.assert_allclose(rms_of(last), last.per_view, rtol=1e-9)


def test_the_plus_minus_is_that_of_all_unknowns():
    for name in ("home", "cauchy"):
        assert deviation_of_f(end(preset(name))) == pytest.approx(sd_of(preset(name)), rel=1e-3)


def test_the_closed_form_knows_no_lens():
    home = states(Params())
    poses, lens, first = home[presets.POSES : presets.POSES + 3]
    assert (poses.now.phase, lens.now.phase, first.now.phase) == ("poses", "lens", "refine")
    assert f_of(poses) == pytest.approx(477.2, abs=0.1)
    assert poses.rms == pytest.approx(4.88, abs=0.01)
    assert lens.rms == pytest.approx(4.58, abs=0.01)
    assert abs(lens.now.lens.k1) < 0.03
    assert [state.rms for state in home[11:15]] == pytest.approx(
        [1.13, 0.554, 0.318, 0.276], abs=0.01
    )
    assert home[0].rms > 1.8 * SQRT2 * 0.2


def test_boards_hardly_tilted_come_to_rest_where_opencv_does():
    """What Levenberg-Marquardt was cut off at, f = 613 px after 30 iterations, is no answer of the
    method.
    """
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    last = end(presets.FLAT)
    adjustment = last.now.adjustment
    assert adjustment is not None
    assert adjustment.stop is Stop.CONVERGED
    assert f_of(last) == pytest.approx(493.26, abs=0.05)
    assert last.rms == pytest.approx(0.27804, abs=1e-5)
    p = np.column_stack([last.subject.p_board[:, :2], np.zeros(len(last.subject.p_board))]).astype(
        np.float32
    )
    rms, K, *_ = cv2.calibrateCamera(
        [p] * len(last.subject.uv),
        [uv.astype(np.float32)[:, None] for uv in last.subject.uv],
        last.subject.size,
        np.empty((3, 3)),
        np.empty(5),
        flags=cv2.CALIB_FIX_K3,
        criteria=(cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 300, 1e-12),
    )
    assert f_of(last) == pytest.approx(K[0, 0], abs=0.5)
    assert last.rms == pytest.approx(rms, abs=1e-4)


def test_of_a_long_refinement_every_tenth_iteration_is_shown_and_the_last():
    shown = [
        state.now.adjustment
        for state in states(presets.FLAT)
        if state.now.phase == "refine" and state.ending is None
    ]
    numbers = [adjustment.iteration for adjustment in shown if adjustment is not None]
    assert numbers[:31] == [*range(1, 31), 40]
    assert all(number % 10 == 0 for number in numbers[30:-1])
    assert shown[-1] is not None
    assert shown[-1].stop is Stop.CONVERGED


def test_a_refinement_that_its_limit_ended_says_so_to_the_end():
    cut = list(run(Params(tilt=2.0, seed=2)))
    assert cut[-1].now.adjustment is not None
    assert cut[-1].now.adjustment.stop is Stop.MAX_ITERATIONS
    for state in (
        cut[-4],
        cut[-2],
        cut[-1],
    ):  # the last iteration, without the worst view, how well all is known
        assert "not at rest" in caption_of(draw(state)).text


@pytest.mark.parametrize(("tilt", "median", "sd"), [(2, 195, 270), (10, 6, 9), (30, 1.2, 1.7)])
def test_f_over_the_tilt(tilt, median, sd):
    """The rms says nothing of it: medians over seeds."""
    ends = [list(run(Params(tilt=float(tilt), seed=seed)))[-1] for seed in range(5)]
    assert np.median([abs(f_of(state) - 536) for state in ends]) == pytest.approx(median, rel=0.6)
    assert np.median([sure(state.now.adjustment).deviations[0] for state in ends]) == pytest.approx(
        sd, rel=0.3
    )
    assert np.median([state.rms for state in ends]) == pytest.approx(0.275, abs=0.006)


def test_the_curve_over_the_tilt_is_what_runs_at_those_tilts_promise():
    _, known = ending(Params(), "known")
    assert known.tilts is not None
    tilts, deviations = known.tilts
    for tilt in (10.0, 30.0):
        assert deviations[tilts == tilt][0] == pytest.approx(sd_of(Params(tilt=tilt)), rel=0.1)
    assert (np.diff(deviations[:7]) < 0).all()


def test_three_bad_corners_in_the_bars_left_out_and_with_cauchys_loss():
    views, told = ending(preset("bad"), "views")
    assert views.subject.views[told.worst] == 1
    assert views.per_view[1] > 3 * np.median(views.per_view)
    _, without = ending(preset("bad"), "without")
    assert without.without is not None
    assert without.without.K[0, 0] == pytest.approx(f_of(end(preset("dropped"))), abs=0.01)
    assert 1 not in end(preset("dropped")).subject.views
    robust = end(preset("cauchy")).now.adjustment
    assert robust is not None
    assert robust.weights[1, [0, 9, 18]].max() < 0.02
    assert sorted(np.flatnonzero(robust.weights[1] < 0.05)) == [0, 9, 18]


def test_wrong_boards():
    stretched = end(preset("stretched")).now.K
    assert stretched is not None
    assert stretched[1, 1] / stretched[0, 0] == pytest.approx(0.984, abs=0.006)
    ratio = presets.distance_ratio(states(presets.LARGER))
    assert ratio == pytest.approx(1 / 1.02, abs=0.002)
    assert f_of(end(presets.LARGER)) == pytest.approx(f_of(end(Params())), abs=0.3)
    assert abs(f_of(end(preset("bent"))) - 536) > 4 * sd_of(preset("bent"))


def test_more_terms_fit_better_and_promise_nothing_outside():
    middle = preset("middle")
    few = end(replace(middle, lens="k1"))
    assert end(middle).rms <= few.rms
    assert few.worst_in_picture < 60
    _, known = ending(middle, "known")
    # the lens that was found folds there: no ray is seen at these pixels
    unseen = np.isnan(known.deviation)
    assert unseen[[0, 0, -1, -1], [0, -1, 0, -1]].all()
    assert 0.3 < unseen.mean() < 0.9
    assert not unseen[12, 16]


def test_four_things_are_called_the_error():
    views, _ = ending(Params(), "views")
    table = draw(views)["names"]
    assert isinstance(table, Table)
    point, coordinate, length, tutorial = (float(row[1].removesuffix(" px")) for row in table.rows)
    assert point == pytest.approx(views.rms, abs=0.001)
    assert coordinate == pytest.approx(point / SQRT2, abs=0.001)
    assert coordinate < length < point
    assert tutorial == pytest.approx(point / np.sqrt(54), abs=0.002)


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "right"),
    [("flat-rms", 0), ("noise-rms", 0.276), ("views", 2), ("larger", 1), ("bent-error", 2)],
)
def test_the_answers(name, right):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == pytest.approx(right, abs=0.001)
    # the usual wrong answer
    assert abs(right - {"noise-rms": 0.2, "views": 3}.get(name, 9)) > question.tolerance


def test_two_views_determine_k_and_not_well():
    two = states(presets.TWO)
    assert two[1].now.K is None
    assert f_of(two[2]) == pytest.approx(519, abs=1)


# slots --------------------------------------------------------------------------------------------


def captions(**slots) -> list[Caption]:
    return [caption_of(draw(state)) for state in run(Params(), **slots)]


def test_rows_drive_the_closed_form():
    shown_captions = captions(constraint_rows=lambda H: calibration.constraint_rows(H.T))
    assert any("no camera sees such views" in caption.text for caption in shown_captions[:10])
    assert "f is guessed as the picture's width" in shown_captions[presets.POSES].text


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda T: np.diag([1, 1, -1, 1]) @ T, "stand behind the camera"),
        (lambda T: T @ np.diag([1.01, 1, 1, 1]), "an R that is not orthonormal"),
        (lambda T: T @ np.diag([1.0, 1, -1, 1]), "8 boards are mirror images"),
    ],
)
def test_poses_that_are_none_are_told(change, message):
    told = captions(
        pose_from_homography=lambda K, H: change(calibration.pose_from_homography(K, H))
    )
    assert message in told[presets.POSES].text
    assert told[presets.POSES].tone == "wrong"


def test_the_rms_of_the_slot_is_drawn_and_told():
    told = list(run(Params(), reprojection_rms=lambda residuals: 7.25))
    assert {state.rms for state in told} == {7.25}
    assert "7.25 px" in caption_of(draw(told[12])).text


def test_corners_at_depth_0_are_refused():
    with pytest.raises(InputError, match="depth 0"):
        list(run(Params(), pose_from_homography=lambda K, H: np.zeros((4, 4))))


# knobs and pictures -------------------------------------------------------------------------------


def test_leaving_out():
    assert end(Params(leave_out=3)).subject.views == (0, 1, 2, 4, 5, 6, 7)
    assert end(Params(leave_out=30)).subject.views == tuple(range(8))
    with pytest.raises(InputError, match="two views"):
        list(run(Params(views=2, leave_out=0)))


def test_the_view_that_is_clicked_is_shown():
    shown = states(Params(shown=5))[presets.POSES]
    assert shown.subject.views[shown.shown] == 5
    scene = draw(shown)
    other = draw(states(Params())[presets.POSES])
    picture, another = scene["picture"], other["picture"]
    assert isinstance(picture, Picture)
    assert isinstance(another, Picture)
    assert (picture.rgb() != another.rgb()).any()
    squares, outline = scene["squares"], scene["boards/5"]
    assert isinstance(squares, Mesh)
    assert isinstance(outline, Segments)
    np.testing.assert_array_equal(squares.T_world_object, outline.T_world_object)  # type: ignore[arg-type]


def test_corners_in_the_picture_lie_where_squares_meet():
    """Around a measured corner the photograph has dark and light in turn."""
    scene = draw(states(Params())[0])
    picture = scene["picture"]
    assert isinstance(picture, Picture)
    image = picture.rgb()[..., 0].astype(float)
    subject = states(Params())[0].subject
    inner = (subject.uv[0].reshape(6, 9, 2)[1:-1, 1:-1] + 0.5) / 2 - 0.5
    right, down = np.gradient(inner, axis=1), np.gradient(inner, axis=0)
    around = [inner + 0.4 * (a * right + b * down) for a, b in ((1, 1), (1, -1), (-1, -1))]
    u, v = np.moveaxis(np.stack(around).round().astype(int), -1, 0)
    level = image[v, u]
    assert (np.abs(level[0] - level[2]) < 60).mean() > 0.9
    assert (np.abs(level[0] - level[1]) > 120).mean() > 0.9


def test_residuals_are_drawn_from_the_corner_twenty_times_as_long():
    worst = int(np.argmax(states(Params())[presets.POSES].per_view))
    state = states(Params(shown=worst))[presets.POSES]
    scene = draw(state)
    picture, corners, residuals = scene["picture"], scene["corners"], scene["residuals"]
    assert isinstance(picture, Picture)
    assert isinstance(corners, Points)
    assert isinstance(residuals, Segments)
    pixel = 0.66 / 640
    T = picture.T_world_object
    assert T is not None
    xy = (corners.p - T[:3, 3]) @ T[:3, :2] / pixel  # from the middle of the picture, in its pixels
    np.testing.assert_allclose(xy, state.subject.uv[worst] - [319.5, 239.5], atol=1e-6)
    np.testing.assert_allclose((residuals.ends[:, 0] - T[:3, 3]) @ T[:3, :2] / pixel, xy, atol=1e-6)
    lengths = np.linalg.norm(residuals.ends[:, 1] - residuals.ends[:, 0], axis=1) / pixel
    expected = np.minimum(20 * np.linalg.norm(state.now.residuals[worst], axis=1), 90)
    assert 0 < (expected == 90).sum() < 54
    np.testing.assert_allclose(lengths, expected, rtol=1e-6)
