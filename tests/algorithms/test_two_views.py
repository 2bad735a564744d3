import numpy as np
import pytest

from tests.geometry.test_essential import K, L, pair
from workbench.algorithms.two_views import Related, follow_ray, relate, solve_linear
from workbench.errors import InputError
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.two_views.epipolar import (
    epipolar_lines,
    fit_fundamental,
    fundamental_from_cameras,
    sampson_distances,
)
from workbench.geometry.two_views.essential import essential_to_poses
from workbench.geometry.two_views.homography import homogeneous, normalising_similarity
from workbench.geometry.two_views.triangulation import triangulate


def steps(uv_first, uv_second, **changed) -> list[Related]:
    scales = normalising_similarity(np.stack([uv_first, uv_second]))
    known = {
        "linear": solve_linear(uv_first, uv_second, scales[0], T_second=scales[1]),
        "eight_point": fit_fundamental,
        "essential_to_poses": essential_to_poses,
        "triangulate": triangulate,
        "route": "refined pose",
    }
    return list(relate(uv_first, uv_second, K, K_second=L, **(known | changed)))


def test_a_ray_is_a_line_and_ends_where_infinity_is_seen():
    T, *_ = pair(0)
    uv = np.array([400.0, 300.0])
    depths = np.array([3.0, 6.0, 100.0, np.inf])
    states = list(follow_ray(uv, depths, T, K_first=K, K_second=L))
    assert [state.stage for state in states] == 4 * ["ray"] + ["plane", "pencil"]
    line = epipolar_lines(fundamental_from_cameras(K, L, T), uv[None])[0]
    np.testing.assert_allclose(homogeneous(states[-1].uv_second) @ line, 0, atol=1e-3)
    away = L @ T[:3, :3] @ np.linalg.inv(K) @ [*uv, 1]
    np.testing.assert_allclose(states[-1].uv_second[-1], away[:2] / away[2], atol=1e-2)
    turned = T.copy()
    turned[:3, 3] = 0
    states = list(follow_ray(uv, depths, turned, K_first=K, K_second=L))
    assert [state.stage for state in states] == 4 * ["ray"]
    assert np.ptp(states[-1].uv_second, axis=0).max() < 1e-9


def test_points_behind_the_second_camera_are_not_seen():
    T, *_ = pair(0)
    T = T.copy()
    T[:3, 3] -= [0, 0, 5]
    last = list(
        follow_ray(np.array([400.0, 300.0]), np.array([3.0, 20.0]), T, K_first=K, K_second=L)
    )[-1]
    assert np.isnan(last.uv_second[0]).all()
    assert np.isfinite(last.uv_second[1]).all()


def test_the_linear_answer_is_eight_points_before_its_rank():
    _, _, uv_first, uv_second = pair(1, 30, 1.0)
    scales = normalising_similarity(np.stack([uv_first, uv_second]))
    linear = solve_linear(uv_first, uv_second, scales[0], T_second=scales[1])
    ours = fit_fundamental(uv_first, uv_second)
    np.testing.assert_allclose(
        linear.F_rank_two * np.sign((linear.F_rank_two * ours).sum()), ours, atol=1e-12
    )
    assert linear.singular_values.shape == (9,)
    assert (np.diff(linear.singular_values) <= 0).all()
    few = solve_linear(uv_first[:8], uv_second[:8], scales[0], T_second=scales[1])
    assert few.singular_values[8] == 0
    assert np.abs(sampson_distances(few.F, uv_first[:8], uv_second[:8])).max() < 1e-6


@pytest.mark.parametrize("route", ["eight-point", "refined F", "refined pose"])
def test_every_route_ends_at_the_motion_without_noise(route):
    T, p, uv_first, uv_second = pair(2)
    states = steps(uv_first, uv_second, route=route)
    last = states[-1]
    assert last.stage == "rectified"
    assert len(states) < 30
    assert last.T_second_first is not None
    assert last.p_first is not None
    assert degrees_between(last.T_second_first, T) < 1e-4
    np.testing.assert_allclose(last.p_first * np.linalg.norm(T[:3, 3]), p, atol=1e-3)
    assert sum(state.stage == "pose" for state in states) == 4


def test_refinement_never_raises_the_distances():
    _, _, uv_first, uv_second = pair(3, 40, 1.0)
    for route, stage in (("refined F", "refined F"), ("refined pose", "refined")):
        rounds = [
            state.F for state in steps(uv_first, uv_second, route=route) if state.stage == stage
        ]
        costs = [np.square(sampson_distances(F, uv_first, uv_second)).sum() for F in rounds]
        assert (np.diff(costs) <= 1e-9).all()


def test_what_is_no_number_is_told_by_its_name():
    _, _, uv_first, uv_second = pair(4)
    with pytest.raises(InputError, match="eight_point"):
        steps(uv_first, uv_second, eight_point=lambda a, b: np.full((3, 3), np.nan))
    with pytest.raises(InputError, match="essential_to_poses"):
        steps(uv_first, uv_second, essential_to_poses=lambda E: np.full((4, 4, 4), np.nan))
