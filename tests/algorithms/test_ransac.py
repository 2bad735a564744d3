from itertools import chain, islice, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lessons.ransac.robust_scenes import (
    circle_scene,
    line_scene,
    match_scene,
    plane_scene,
    sphere_scene,
    two_planes_scene,
    wire_scene,
)
from workbench.algorithms.robust.models import (
    CIRCLE,
    FUNDAMENTAL,
    HOMOGRAPHY,
    LINE,
    MODELS,
    PLANE,
    SPHERE,
    rms_distance,
)
from workbench.algorithms.robust.ransac import (
    Fit,
    Judge,
    Stop,
    iterations_needed,
    polished,
    ransac,
    refit_rounds,
)
from workbench.algorithms.robust.samplers import prosac_samples, uniform_samples
from workbench.algorithms.robust.scores import count_score, msac_score
from workbench.data.files import read_cloud
from workbench.geometry.shapes.lines_planes import angle_between_planes
from workbench.tracing import listening

SCENES = {
    "line": lambda rng: line_scene(rng, count=200, outlier_ratio=0.4, sigma=0.01),
    "plane": lambda rng: plane_scene(rng, count=300, outlier_ratio=0.4, sigma=0.01),
    "circle": lambda rng: circle_scene(rng, count=200, outlier_ratio=0.4, sigma=0.01),
    "sphere": lambda rng: sphere_scene(rng, count=300, outlier_ratio=0.4, sigma=0.01),
    "homography": lambda rng: match_scene(rng, count=200, outlier_ratio=0.4, sigma=0.5, flat=True),
    "fundamental matrix": lambda rng: match_scene(rng, count=200, outlier_ratio=0.3, sigma=0.5),
}
WITHIN = {"m": 0.03, "px": 2.0}


def found(state) -> Fit:
    """The best fit so far, which has to be there."""
    assert state.best is not None
    return state.best


def run_of(model, scene, seed=0, *, score=count_score, distance=None, **options):
    return run_on(scene.p, model, seed, score=score, distance=distance, **options)


def run_on(p, model, seed=0, *, score=count_score, distance=None, **options):
    rng = np.random.default_rng(seed)
    judge = Judge(p, model, distance or WITHIN[model.unit], score)
    return list(
        ransac(p, model, uniform_samples(len(p), model.sample_size, rng), judge=judge, **options)
    )


@pytest.mark.parametrize(("ratio", "needed"), [(0.5, 35), (0.3, 169), (0.2, 574)])
def test_the_numbers_of_samples_for_a_plane(ratio, needed):
    assert iterations_needed(ratio, 3, 0.99) == needed


@settings(max_examples=50, deadline=None)
@given(ratio=st.floats(0.05, 0.99), size=st.integers(2, 7), confidence=st.floats(0.5, 0.9999))
def test_so_many_samples_suffice_and_one_less_does_not(ratio, size, confidence):
    needed = iterations_needed(ratio, size, confidence)

    def clean_one(samples):
        return -np.expm1(samples * np.log1p(-(ratio**size)))

    assert clean_one(needed) >= confidence - 1e-9
    if needed > 1:
        assert clean_one(needed - 1) < confidence + 1e-9


def test_the_ends_of_the_formula():
    assert iterations_needed(1.0, 3, 0.99) == 1
    assert iterations_needed(0.0, 3, 0.99) == np.inf
    assert iterations_needed(1e-4, 7, 0.99) > 1e25
    assert iterations_needed(0.999, 2, 0.5) == 1


@pytest.mark.parametrize("name", list(MODELS))
def test_every_model_is_found_among_outliers(name):
    scene = SCENES[name](np.random.default_rng(3))
    last = run_of(MODELS[name], scene, max_iterations=2000)[-1]
    assert last.phase == "stop"
    assert last.stop is Stop.ENOUGH
    assert (
        rms_distance(MODELS[name], found(last).estimate, scene.p_true)
        < {"m": 0.004, "px": 0.35}[MODELS[name].unit]
    )
    assert found(last).inliers[scene.is_inlier].mean() > 0.9


@pytest.mark.parametrize("name", list(MODELS))
def test_a_model_keeps_its_contract(name):
    model = MODELS[name]
    scene = SCENES[name](np.random.default_rng(4))
    samples = np.stack(
        list(islice(uniform_samples(len(scene.p), model.sample_size, np.random.default_rng(0)), 20))
    )
    estimates = model.solve(scene.p[samples])
    assert estimates.shape[1:] == scene.truth.shape
    assert np.isfinite(estimates).all()
    for sample in samples:
        for estimate in model.solve(scene.p[sample][None]):
            assert model.distances(estimate, scene.p[sample]).max() < 1e-3
    distances = model.distances(estimates, scene.p)
    assert distances.shape == (len(estimates), len(scene.p))
    assert (distances >= 0).all()
    np.testing.assert_allclose(
        distances[2], model.distances(estimates[2], scene.p), rtol=1e-9, atol=1e-9
    )
    assert model.distances(scene.truth, scene.p_true).max() < 1e-6
    repeated = np.repeat(scene.p[:1], model.sample_size, axis=0)
    assert len(model.solve(repeated[None])) == 0
    inliers = scene.p[scene.is_inlier]
    for start in (None, scene.truth):
        refit = model.refit(inliers, np.ones(len(inliers)), start)
        truth = (model.distances(scene.truth, inliers) ** 2).sum()
        assert (model.distances(refit, inliers) ** 2).sum() <= truth * (1 + 1e-6)
    assert (
        model.distances(estimates.astype(np.float32), scene.p.astype(np.float32)).dtype
        == np.float32
    )


def test_the_order_of_the_parts_and_what_they_hold():
    states = run_of(PLANE, SCENES["plane"](np.random.default_rng(0)))
    follows = {
        "sample": {"model", "degenerate"},
        "model": {"inliers"},
        "inliers": {"best", "sample", "refit"},
        "best": {"sample", "refit"},
        "refit": {"refit", "stop"},
    }
    for first, second in pairwise(states):
        assert second.phase in follows[first.phase]
    assert all((state.stop is None) == (state.phase != "stop") for state in states)
    assert all(
        state.iteration == len([s for s in states[: k + 1] if s.phase == "sample"])
        for k, state in enumerate(states)
    )
    for state in states:
        if state.phase == "inliers":
            trial = state.trial
            assert trial is not None
            assert trial.count == np.count_nonzero(trial.distances <= 0.03) == trial.score


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 1000), name=st.sampled_from(["line", "plane", "homography"]))
def test_best_never_falls_and_needed_never_rises_with_it(seed, name):
    states = run_of(
        MODELS[name], SCENES[name](np.random.default_rng(seed)), seed, max_iterations=300
    )
    sampled = [state for state in states if state.phase not in ("refit", "stop")]
    scores = [state.best.score for state in sampled if state.best]
    assert scores == sorted(scores)
    needed = [state.needed for state in sampled]
    assert needed == sorted(needed, reverse=True)


@settings(max_examples=15, deadline=None)
@given(
    seed=st.integers(0, 1000),
    name=st.sampled_from(["line", "plane", "circle", "homography", "fundamental matrix"]),
)
def test_no_round_of_the_refit_lowers_the_msac_score(seed, name):
    model = MODELS[name]
    scene = SCENES[name](np.random.default_rng(seed))
    judge = Judge(scene.p, model, WITHIN[model.unit], msac_score)
    trials = [
        judge(estimate)
        for estimate in model.solve(
            np.stack([scene.p[np.flatnonzero(scene.is_inlier)[: model.sample_size]]])
        )
    ]
    for fit in trials:
        scores = [fit.score] + [
            again.score for again in refit_rounds(scene.p, model, fit, judge=judge)
        ]
        assert (np.diff(scores) >= -1e-6 * scores[0] - 1e-9).all()
        assert polished(scene.p, model, fit, judge=judge).score >= fit.score


def test_the_refit_betters_what_a_sample_found():
    gains = []
    for seed in range(10):
        scene = SCENES["plane"](np.random.default_rng(seed))
        states = run_of(PLANE, scene, seed)
        before = next(found(s) for s in reversed(states) if s.phase in ("inliers", "best"))
        gains.append(
            rms_distance(PLANE, found(states[-1]).estimate, scene.p_true)
            / rms_distance(PLANE, before.estimate, scene.p_true)
        )
    assert np.median(gains) < 0.5


def test_the_local_refit_ends_sooner():
    drawn = {True: [], False: []}
    for seed in range(8):
        scene = plane_scene(np.random.default_rng(seed), count=400, outlier_ratio=0.6, sigma=0.02)
        for local in drawn:
            drawn[local].append(
                run_of(PLANE, scene, seed, distance=0.04, local_refit=local)[-1].iteration
            )
    assert np.mean(drawn[True]) < 0.9 * np.mean(drawn[False])


def test_few_samples_without_outliers_reach_most_of_the_inliers():
    """With noise of half the inlier distance only about 9 % of the clean plane samples reach 90 %
    of the inliers.
    """
    rng = np.random.default_rng(0)
    scene = plane_scene(rng, count=1000, outlier_ratio=0.5, sigma=0.02)
    clean = np.flatnonzero(scene.is_inlier)
    planes = PLANE.solve(scene.p[rng.choice(clean, (2000, 3))])
    reached = (PLANE.distances(planes, scene.p[clean]) <= 0.04).mean(axis=1)
    assert 0.05 < (reached >= 0.9).mean() < 0.16


def test_chosen_samples_come_first_and_may_be_degenerate():
    scene = wire_scene(np.random.default_rng(0), count=200, outlier_ratio=0.3, sigma=0.01)
    rng = np.random.default_rng(0)
    samples = chain([np.array([0, 1, 2])], uniform_samples(200, 3, rng))
    states = list(ransac(scene.p, PLANE, samples, judge=Judge(scene.p, PLANE, 0.03)))
    assert [state.phase for state in states[:2]] == ["sample", "degenerate"]
    assert states[-1].best is not None


def test_no_more_samples_and_no_model_say_so():
    p = np.column_stack([np.arange(5.0), np.zeros((5, 2))])
    only = [np.array([0, 1, 2]), np.array([2, 3, 4])]
    states = list(ransac(p, PLANE, iter(only), judge=Judge(p, PLANE, 0.1)))
    assert states[-1].stop is Stop.NO_MODEL
    assert states[-1].best is None
    p = np.concatenate([p, np.random.default_rng(0).normal(size=(20, 3))])
    p[4] = 0.0, 5.0, 0.0
    assert (
        list(ransac(p, PLANE, iter(only), judge=Judge(p, PLANE, 0.1)))[-1].stop
        is Stop.SAMPLES_USED_UP
    )
    assert states[-1].stop.message


def test_the_maximum_of_iterations_is_kept():
    scene = plane_scene(np.random.default_rng(0), count=300, outlier_ratio=0.8, sigma=0.01)
    last = run_of(PLANE, scene, max_iterations=7)[-1]
    assert last.iteration == 7
    assert last.stop is Stop.MAX_ITERATIONS


def test_bad_rows_are_refused():
    judge = Judge(np.zeros((2, 3)), PLANE, 0.1)
    for p, message in (
        (np.zeros((2, 3)), "only 2"),
        (np.zeros((9, 2)), "3 numbers, not 2"),
        (np.full((9, 3), np.nan), "finite"),
    ):
        with pytest.raises(ValueError, match=message):
            next(ransac(p, PLANE, iter([]), judge=judge))


def test_the_largest_plane_wins_not_the_right_one():
    scene = two_planes_scene(np.random.default_rng(0), count=600, outlier_ratio=0.3, sigma=0.01)
    last = run_of(PLANE, scene)[-1]
    assert found(last).inliers[scene.is_inlier].mean() < 0.2
    assert rms_distance(PLANE, found(last).estimate, scene.p_true) > 0.5


def test_prosac_needs_fewer_samples_than_chance():
    drawn = {"prosac": [], "uniform": []}
    for seed in range(6):
        scene = match_scene(
            np.random.default_rng(seed), count=300, outlier_ratio=0.6, sigma=0.5, flat=True
        )
        for name in drawn:
            rng = np.random.default_rng(seed)
            samples = (
                prosac_samples(scene.quality, 4, rng)
                if name == "prosac"
                else uniform_samples(300, 4, rng)
            )
            states = ransac(scene.p, HOMOGRAPHY, samples, judge=Judge(scene.p, HOMOGRAPHY, 2.5))
            drawn[name].append(
                next(
                    s.iteration
                    for s in states
                    if s.best and s.best.inliers[scene.is_inlier].mean() > 0.8
                )
            )
    assert np.median(drawn["prosac"]) < np.median(drawn["uniform"])


def test_its_lines_can_be_watched():
    scene = SCENES["line"](np.random.default_rng(0))
    samples = uniform_samples(len(scene.p), 2, np.random.default_rng(0))
    with listening() as moment:
        for state in ransac(scene.p, LINE, samples, judge=Judge(scene.p, LINE, 0.03)):
            last = moment()
            assert last is not None
            lines, first = last.source
            statement = lines[last.line - first :][:2]  # a long one begins on a line of its own
            assert f'"{state.phase}"' in "".join(statement)
    assert {CIRCLE.sample_size, SPHERE.sample_size, FUNDAMENTAL.sample_size} == {3, 4, 7}


def test_far_from_the_origin_the_inliers_are_the_same():
    scene = plane_scene(np.random.default_rng(0), count=500, outlier_ratio=0.5, sigma=0.01)
    near, far = (found(run_on(scene.p + shift, PLANE)[-1]) for shift in (0.0, 1e6))
    np.testing.assert_array_equal(far.inliers, near.inliers)


def test_repeated_rows_are_survived_and_nothing_is_nothing():
    scene = match_scene(np.random.default_rng(0), count=40, outlier_ratio=0.3, sigma=0.5, flat=True)
    assert run_on(np.repeat(scene.p, 10, axis=0), HOMOGRAPHY)[-1].best is not None
    for model in MODELS.values():
        last = run_on(np.ones((20, model.columns)), model, max_iterations=20)[-1]
        assert last.best is None
        assert last.stop is Stop.NO_MODEL


@pytest.mark.parametrize(("model", "bound"), [(HOMOGRAPHY, 1.25), (FUNDAMENTAL, 1.5)])
def test_it_comes_close_to_a_fit_that_knows_the_inliers(model, bound):
    """On 300 matches, a third of them wrong, noise 1 px, with the inlier distance that keeps 95 %
    of the others.
    """
    ratios = []
    flat = model is HOMOGRAPHY
    for seed in range(6):
        scene = match_scene(
            np.random.default_rng(seed), count=300, outlier_ratio=0.33, sigma=1.0, flat=flat
        )
        last = run_of(model, scene, seed, score=msac_score, distance=3.46 if flat else 1.96)[-1]
        oracle = model.refit(scene.p[scene.is_inlier], start=scene.truth)
        errors = [
            rms_distance(model, estimate, scene.p_true)
            for estimate in (found(last).estimate, oracle)
        ]
        ratios.append(errors[0] / errors[1])
    assert np.median(ratios) < bound


def test_the_photographs_give_back_their_true_matches(shared_data):
    """At least 95 % of the matches whose true Sampson error is below 1 px."""
    pair = np.load(shared_data / "ransac" / "fountain-P11" / "gt_and_matches.npz")
    matches = np.concatenate([pair["x1"], pair["x2"]], axis=1).astype(float)
    true = FUNDAMENTAL.distances(pair["F"], matches) < 1.0
    for seed in range(3):
        best = found(run_on(matches, FUNDAMENTAL, seed, score=msac_score, distance=1.0)[-1])
        assert best.inliers[true].mean() >= 0.95
        assert rms_distance(FUNDAMENTAL, best.estimate, matches[true]) < 0.35


def test_floor_and_wall_of_a_real_room_meet_at_a_right_angle(shared_data):
    """The wall is farther away and four times as noisy as the floor: it is refitted with an inlier
    distance of its own.
    """
    p = read_cloud(shared_data / "ransac" / "capture0001.pcd")[::6]
    rest = p
    fits = []
    while len(fits) < 4:
        fits.append(found(run_on(rest, PLANE, 0, score=msac_score, distance=0.02)[-1]))
        rest = rest[fits[-1].distances > 0.04]
    assert fits[0].count / len(p) == pytest.approx(0.27, abs=0.02)
    # the camera's y axis points down
    floor = max((fit.estimate for fit in fits), key=lambda plane: abs(plane[1]))
    wide = Judge(p, PLANE, 0.06, msac_score)
    wall = polished(p, PLANE, wide(fits[0].estimate), judge=wide).estimate
    on_floor = PLANE.distances(floor, p)
    assert 0.004 < np.sqrt(np.mean(on_floor[on_floor < 0.02] ** 2)) < 0.007
    assert 89.0 <= np.degrees(angle_between_planes(wall, floor)) <= 90.5
