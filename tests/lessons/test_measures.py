"""Every claim of the measures lesson in numbers: presets, questions, page and slots."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.measures.lesson import draw, lesson, run
from lessons.measures.state import Params, State
from lessons.measures.subjects import built_in
from tests.runs import finished
from workbench.algorithms.surfaces.measures import Cells, Sums
from workbench.algorithms.surfaces.monte_carlo import Balls, Lines, Sampled, Throws
from workbench.errors import InputError
from workbench.geometry.meshes.measures import area_centroid, signed_volume, volume_centroid
from workbench.geometry.points.sampling import volume_by_chance
from workbench.scene import caption_of


def states(params: Params) -> tuple[Any, ...]:
    return finished(lesson.name, params).states()


def last_of(params: Params, **slots: Any) -> Any:
    *_, last = run(params, **slots)
    return last


def of(name: str) -> tuple[Any, ...]:
    return states(lesson.preset(name).params)


def whole(run_: tuple[Any, ...]) -> tuple[State, Sums]:
    state = next(state for state in reversed(run_) if state.study is None)
    assert isinstance(state.now, Sums)
    return state, state.now


def cells_of(name: str) -> tuple[State, Cells]:
    state = of(name)[-1]
    assert isinstance(state.now, Cells)
    return state, state.now


def tone(name: str) -> str:
    return caption_of(draw(whole(of(name))[0])).tone


# presets ------------------------------------------------------------------------------------------


def test_the_sum_falls_below_zero_and_comes_back():
    run_ = states(Params())
    volumes = [state.now.volume for state in run_ if isinstance(state.now, Sums)]
    assert min(volumes) < -0.2
    assert volumes[8] < 0  # where the page says that near ones are mostly minus
    state, sums = whole(run_)
    assert state.volume_error == pytest.approx(0, abs=1e-12)
    assert sums.area == pytest.approx(6.888, abs=1e-3)
    assert caption_of(draw(state)).tone == "good"
    minus = run_[8].now.parts[run_[8].now.order[: run_[8].now.count]] < 0
    assert minus.mean() > 0.6


def test_far_away_the_sum_is_the_same():
    state, sums = whole(of("origin"))
    assert abs(state.volume_error) < 1e-10
    assert sums.parts[sums.parts > 0].sum() > 10 * sums.volume
    assert min(s.now.volume for s in of("origin")) < -7


def test_a_hole_makes_the_volume_depend_on_the_origin():
    params = lesson.preset("hole").params
    assert whole(of("hole"))[0].volume_error == pytest.approx(-0.0665, abs=1e-3)
    assert whole(of("hole"))[0].area_error == pytest.approx(-0.01, abs=1e-3)
    errors = []
    for origin in ((0.0, 0.0, 0.0), (0.0, -2.8, -0.9), (10.0, 20.0, -6.0)):
        last = last_of(replace(params, origin=origin))
        errors.append(round(last.volume_error, 3))
    assert errors == [-0.011, 0.041, pytest.approx(-0.44, abs=0.03)]
    assert tone("hole") == "wrong"


def test_turned_faces_cost_twice_their_volume_and_no_area():
    state, sums = whole(of("flipped"))
    assert state.area_error == pytest.approx(0, abs=1e-12)
    assert state.volume_error == pytest.approx(-0.101, abs=2e-3)
    unsigned = np.abs(sums.parts).sum() / state.subject.volume - 1
    assert unsigned > 1  # what absolute values would give
    assert tone("flipped") == "wrong"
    errors = [whole(states(params))[0].volume_error for params in lesson.swept(lesson.sweeps[0])]
    assert (np.diff(errors) < 0).all()


def test_overlaps_count_twice_but_not_in_voxels():
    state, sums = whole(of("overlap"))
    assert sums.volume == pytest.approx(2 * signed_volume(*_ball()), rel=1e-9)
    assert state.volume_error == pytest.approx(0.175, abs=1e-3)
    assert tone("overlap") == "wrong"
    assert abs(cells_of("union")[0].volume_error) < 0.01


def _ball() -> tuple[np.ndarray, np.ndarray]:
    sphere = built_in("sphere", 3, 4, rings=4)
    return sphere.p, sphere.faces


def test_an_inscribed_sphere_is_too_small_with_the_square_of_the_edges():
    state, _ = whole(of("inscribed"))
    assert len(state.subject.p) == 642
    assert (state.area_error, state.volume_error) == (
        pytest.approx(-0.0048, abs=1e-4),
        pytest.approx(-0.0086, abs=1e-4),
    )
    study = of("inscribed")[-1].study
    assert study is not None
    for errors in study.errors.values():
        np.testing.assert_allclose(errors[2:-1] / errors[3:], 4, rtol=0.05)


def test_the_volume_of_voxels_converges_and_the_area_does_not():
    state, cells = cells_of("staircase")
    assert cells.across == (4, 6, 8, 11, 16, 23, 32, 45, 64)
    assert abs(state.volume_error) < 1e-3
    shares = np.array(cells.areas) / state.subject.area
    np.testing.assert_allclose(shares[3:], 1.5, atol=0.02)
    np.testing.assert_allclose(np.array(cells.marched)[4:] / state.subject.area, 1.087, atol=0.01)
    off = [
        [s.volume_error for s in states(replace(state.params, seed=seed, cells=16))][-1]
        for seed in range(6)
    ]
    assert np.sqrt(np.mean(np.square(off))) < 0.01


def test_the_lantern_has_five_times_the_area():
    state, sums = whole(of("lantern"))
    assert sums.area / state.subject.area == pytest.approx(4.935, abs=1e-3)
    assert np.isnan(state.subject.volume)
    study = of("lantern")[-1].study
    assert study is not None
    straight, square, cube = study.errors.values()
    assert straight[-1] == pytest.approx(1.04, abs=0.005)
    assert square[-1] == pytest.approx(np.sqrt(1 + np.pi**4 / 4), rel=0.01)  # the limit, 5.035
    assert cube[-1] == pytest.approx(78, rel=0.01)


def test_throws_fall_with_the_root_and_even_draws_faster():
    last = of("throws")[-1]
    assert isinstance(last.now, Throws)
    counts, errors = (np.array(x) for x in (last.now.estimates.counts, last.now.estimates.errors))
    slope = np.polyfit(np.log(counts[8:]), np.log(errors[8:]), 1)[0]
    assert slope == pytest.approx(-0.5, abs=0.02)
    standard = errors[-1] / last.subject.volume
    assert standard == pytest.approx(0.003, abs=2e-4)
    for name in ("stratified", "sobol"):
        params = replace(lesson.preset(name).params, throws=30_000)
        off = [[s.volume_error for s in run(replace(params, seed=seed))][-1] for seed in range(8)]
        assert np.sqrt(np.mean(np.square(off))) < 0.5 * np.sqrt((6 / np.pi - 1) / 30_000)


def test_intervals_hold_the_truth_about_as_often_as_they_say():
    held = []
    for seed in range(60):
        last = last_of(Params(method="chance", shape="sphere", seed=seed))
        held.append(
            abs(last.volume_error * last.subject.volume) <= 1.96 * last.now.estimates.errors[-1]
        )
    assert 0.87 <= np.mean(held) <= 1.0


def test_who_looks_at_every_step_sees_the_truth_outside_in_most_runs():
    """Whole runs by the lesson itself, beside the shares that its last caption tells."""
    params = lesson.preset("throws").params
    ever = 0
    at_last = 0
    for seed in range(120):
        last = list(run(replace(params, seed=seed)))[-1].now
        assert isinstance(last, Throws)
        values, errors = np.array(last.estimates.values), np.array(last.estimates.errors)
        outside = np.abs(values - 4 * np.pi / 3) > 1.96 * errors
        ever = ever + outside.any()
        at_last = at_last + outside[-1]
    assert (ever, at_last) == (69, 4)  # 57 % and 3 %
    at_end, at_any_step = of("throws")[-1].peeked
    assert at_end == pytest.approx(0.05, abs=0.01)
    assert at_any_step == pytest.approx(ever / 120, abs=0.05)
    assert (
        "56 % missed it at one or more of the 33 looks"
        in finished("measures", params)[-1].caption.text
    )
    assert of("sobol")[-1].peeked is None


def test_stratified_throws_are_made_once_for_each_number_of_cubes():
    counts = of("stratified")[-1].now.estimates.counts
    assert counts[:5] == (8, 27, 64, 125, 216)
    assert (np.diff(counts) > 0).all()


def test_what_a_hole_takes_is_the_cone_from_the_origin():
    state, total = whole(of("hole"))
    subject = state.subject
    kept = {tuple(face) for face in subject.faces.tolist()}
    gone = subject.p[[face for face in subject.whole.tolist() if tuple(face) not in kept]]
    a, b, c = (gone - np.array(state.params.origin)).transpose(1, 0, 2)
    cone = float(np.einsum("fx,fx->f", a, np.cross(b, c)).sum()) / 6
    assert cone == pytest.approx(0.074, abs=0.0005)
    assert total.volume + cone == pytest.approx(subject.volume)
    assert subject.volume == pytest.approx(1.108, abs=0.0005)


def test_in_many_dimensions_nothing_hits():
    balls = of("dimensions")[-1].now
    assert isinstance(balls, Balls)
    hits = dict(zip(balls.dimensions, balls.hits, strict=True))
    assert hits[2] == pytest.approx(78_540, abs=500)
    assert hits[10] == pytest.approx(249, abs=60)
    assert hits[20] == 0


def test_faces_alike_pull_the_mean_to_the_small_faces():
    last = of("alike")[-1]
    assert last.half_share == pytest.approx(0.598, abs=1e-3)
    assert last.half_hits == pytest.approx(4 * 0.6 / (4 * 0.6 + 0.4), abs=0.03)
    assert isinstance(last.now, Sampled)
    gap = np.linalg.norm(last.now.mean - last.middle) / last.subject.diagonal
    assert gap > 0.06
    fair = last_of(replace(last.params, pick="by area"))
    assert np.linalg.norm(fair.now.mean - fair.middle) / fair.subject.diagonal < 0.02


@pytest.mark.parametrize(
    ("place", "shares"),
    [
        ("with the root", (0.25, 0.25, 0.25, 0.25)),
        ("without the root", (0.5, 0.153, 0.153, 0.193)),
        ("normalised", (1 / 6, 1 / 6, 1 / 6, 0.5)),
    ],
)
def test_quarters_of_a_triangle(place, shares):
    in_triangle = [
        state
        for state in run(Params(method="samples", place=place, throws=100))
        if state.in_triangle
    ]
    np.testing.assert_allclose(in_triangle[-1].quarters, shares, atol=0.025)


def test_lines_tell_the_area():
    last = of("lines")[-1]
    assert isinstance(last.now, Lines)
    assert abs(last.area_error) < 0.05
    assert last.now.estimates.errors[-1] / last.subject.area == pytest.approx(0.023, abs=0.002)


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("predict-walls", 1),
        ("predict-tenth", 100),
        ("predict-hits", 2),
        ("predict-inscribed", 1),
        ("predict-lantern", 2),
    ],
)
def test_answers(name, answer):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == answer


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    cube = tuple(run(Params(method="voxels", shape="box", cells=64)))
    assert asked["predict-walls"].answer(cube) == 0  # its walls lie along the grid
    flat = tuple(run(Params(shape="lantern", rings=11)))
    assert asked["predict-lantern"].answer(flat) == 1
    low = tuple(run(Params(method="dimensions", throws=100_000, dimension=4)))
    assert asked["predict-hits"].answer(low) == 0


# the page and the knobs ---------------------------------------------------------------------------


def test_three_middles_are_three_points():
    rabbit = built_in("rabbit", 0, 4, rings=4)
    middles = (
        rabbit.p.mean(axis=0),
        area_centroid(rabbit.p, rabbit.faces),
        volume_centroid(rabbit.p, rabbit.faces),
    )
    gaps = [np.linalg.norm(middles[k] - middles[k - 1]) / rabbit.diagonal for k in range(3)]
    assert min(gaps) > 0.002
    assert max(gaps) > 0.03


@pytest.mark.parametrize("method", ["voxels", "chance"])
def test_what_is_open_has_no_inside(method):
    with pytest.raises(InputError, match="open"):
        next(run(Params(method=method, shape="lantern")))


def test_every_grid_begins_elsewhere_and_its_cells_are_halved_every_second_step():
    grids = of("staircase")[0].subject.grids
    edges = np.array([grid.spacing[0] for _, grid in grids])
    assert [n for n, _ in grids][::2] == [4, 8, 16, 32, 64]
    np.testing.assert_allclose(edges[2::2] / edges[:-2:2], 0.5)
    starts = np.array([grid.low for _, grid in grids])
    assert len(np.unique(starts[:, 0])) == len(starts)


# slots --------------------------------------------------------------------------------------------


def test_slots_drive_the_run():
    last = last_of(Params(), signed_volume=lambda p, faces: 42.0)
    assert last.now.volume == 42.0
    assert caption_of(draw(last)).tone == "wrong"
    last = last_of(Params(method="chance"), volume_by_chance=lambda inside, box: (2.0, 0.5))
    assert (last.now.estimates.values[-1], last.now.estimates.errors[-1]) == (2.0, 0.5)
    first, *_ = run(
        Params(method="samples"), points_on_faces=lambda p, faces, u: np.tile(p[0], (len(u), 1))
    )
    np.testing.assert_allclose(first.quarters, [1, 0, 0, 0], atol=1e-9)


def test_a_slot_is_asked_about_the_origin_that_was_set():
    seen = []

    def spy(p, faces):
        seen.append(p)
        return signed_volume(p, faces)

    tuple(run(Params(origin=(1.0, 2.0, 3.0)), signed_volume=spy))
    np.testing.assert_allclose(seen[0], built_in("rabbit", 0, 4, rings=4).p - [1, 2, 3])


def test_what_is_thrown_is_counted():
    last = last_of(Params(method="chance", shape="sphere"))
    assert volume_by_chance(last.now.inside, 8.0)[0] == pytest.approx(last.now.estimates.values[-1])
