"""What RANSAC knows ahead changes no bit of its states, and no sample drawn ahead is another."""

from dataclasses import replace
from itertools import chain, islice

import numpy as np
import pytest

from lessons.ransac.robust_scenes import match_scene
from tests.algorithms.test_camera_model import alike
from workbench.algorithms.robust.models import FUNDAMENTAL, HOMOGRAPHY, RIGID
from workbench.algorithms.robust.ransac import TOGETHER, Judge, ransac
from workbench.algorithms.robust.samplers import draw_samples, uniform_samples
from workbench.algorithms.robust.scores import count_score, msac_score


@pytest.mark.parametrize("model", [HOMOGRAPHY, FUNDAMENTAL], ids=lambda model: model.name)
@pytest.mark.parametrize("score", [count_score, msac_score])
@pytest.mark.parametrize("refit", [False, True])
def test_samples_solved_and_judged_together_give_the_states_of_one_by_one(model, score, refit):
    scene = match_scene(
        np.random.default_rng(7),
        count=600,
        outlier_ratio=0.5 if refit else 0.3,
        sigma=1.0,
        flat=model is HOMOGRAPHY,
    )
    runs = []
    for variant in (model, replace(model, solve_each=None)):
        drawn = uniform_samples(600, model.sample_size, np.random.default_rng(0))
        samples = chain([np.zeros(model.sample_size, dtype=int)], drawn)
        judge = Judge(scene.p, variant, 2.5, score)
        runs.append(
            list(
                ransac(
                    scene.p, variant, samples, judge=judge, max_iterations=150, local_refit=refit
                )
            )
        )
    together, apart = runs
    assert len(together) == len(apart)
    assert together[-1].iteration > TOGETHER / 2
    assert together[1].phase == "degenerate"
    assert all(alike(a, b) for a, b in zip(together, apart, strict=True))


def test_triangles_solved_and_judged_together_give_the_states_of_one_by_one():
    rng = np.random.default_rng(4)
    p = rng.normal(size=(400, 3))
    q = p @ np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]) + 0.3 + 0.01 * rng.normal(size=p.shape)
    q[:260] = rng.normal(size=(260, 3))
    pairs = np.hstack([p, q])
    runs = []
    for variant in (RIGID, replace(RIGID, solve_each=None)):
        drawn = uniform_samples(400, 3, np.random.default_rng(0))
        samples = chain([np.zeros(3, dtype=int)], drawn)
        runs.append(list(ransac(pairs, variant, samples, judge=Judge(pairs, variant, 0.05))))
    together, apart = runs
    assert len(together) == len(apart)
    assert together[-1].iteration > TOGETHER
    assert {state.phase for state in together} >= {"degenerate", "inliers", "refit"}
    assert all(alike(a, b) for a, b in zip(together, apart, strict=True))


@pytest.mark.parametrize(("most", "batches"), [(10, [10]), (70, [TOGETHER, 70 - TOGETHER])])
def test_no_more_samples_are_solved_than_are_left_to_try(most, batches):
    scene = match_scene(np.random.default_rng(1), count=60, outlier_ratio=0.9, sigma=1.0, flat=True)
    solved = []

    def solve_each(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        solved.append(len(rows))
        assert HOMOGRAPHY.solve_each is not None
        return HOMOGRAPHY.solve_each(rows)

    model = replace(HOMOGRAPHY, solve_each=solve_each)
    samples = uniform_samples(60, 4, np.random.default_rng(0))
    *_, last = ransac(
        scene.p, model, samples, judge=Judge(scene.p, model, 3.0), max_iterations=most
    )
    assert last.iteration == most
    assert solved == batches


def test_a_fit_holds_its_own_distances_alone():
    scene = match_scene(np.random.default_rng(1), count=50, outlier_ratio=0.3, sigma=1.0, flat=True)
    fits = Judge(scene.p, HOMOGRAPHY, 3.0).each(np.stack([scene.truth, np.eye(3)]))
    assert [fit.distances.base for fit in fits] == [None, None]


@pytest.mark.parametrize(("n", "size"), [(12, 4), (17, 4), (30, 7), (600, 4)])
def test_samples_drawn_ahead_are_those_drawn_one_by_one(n, size):
    rng = np.random.default_rng(3)
    one_by_one = [draw_samples(n, size, 1, rng=rng)[0].tolist() for _ in range(300)]
    ahead = islice(uniform_samples(n, size, np.random.default_rng(3)), 300)
    assert [sample.tolist() for sample in ahead] == one_by_one
