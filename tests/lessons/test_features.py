"""Every claim of the features lesson in numbers: presets, questions, slots, and what is refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.features.experiments import FLIPPED, HOME, OUTLINE_X, ROOT, SMALL, TURNED, kept, kept_count, kept_share
from lessons.features.lesson import lesson, run
from lessons.features.state import Params
from tests.runs import finished
from tests.truths.features import home, share
from workbench.data.clouds import pair
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.scene import caption_of


def states(params) -> Any:
    return finished("features", params).states()


def final(*args: Any, **functions: Any) -> Any:
    *_, last = run(*args, **functions)
    return last


def green(params) -> float:
    found = share(next(s.now for s in states(params) if s.now.phase in ("kept", "matched")))
    assert found is not None
    return found


def test_the_default_comes_home_with_a_quarter_of_its_matches_right():
    assert green(HOME) == pytest.approx(0.26, abs=0.05)
    last = states(HOME)[-1].now
    assert home(last)
    assert last.error.rotation < last.scans.error(last.T_before).rotation < 4
    assert caption_of(finished("features", HOME)[-1].scene).tone == "good"


def test_a_larger_radius_helps_until_it_leaves_the_overlap():
    assert green(SMALL) < 0.12 < green(HOME) < 0.4 < green(lesson.preset("wide").params)


def test_square_roots_of_the_bars_help():
    assert green(ROOT) > green(HOME) + 0.08


def test_flipped_normals_leave_few_matches():
    assert kept_count(states(HOME)) > 120
    assert kept_count(states(FLIPPED)) < 50


def test_a_vase_does_not_come_home():
    assert green(lesson.preset("vase").params) < 0.06
    assert not home(states(lesson.preset("vase").params)[-1].now)


def test_noise_of_a_centimetre_still_comes_home():
    noisy = lesson.preset("noisy").params
    assert green(noisy) < green(HOME)
    assert home(states(noisy)[-1].now)


def test_patches_forgive_small_turns_only():
    assert green(lesson.preset("patches").params) > 0.8
    assert green(lesson.preset("tilted").params) > 0.75
    assert green(TURNED) < 0.1
    assert kept_share(states(TURNED)) == pytest.approx(100 * green(TURNED))


def test_outlines_need_angles_along_them():
    assert green(lesson.preset("outline").params) > 0.95
    assert green(OUTLINE_X) < 0.25


def test_wrong_functions_show():
    small = replace(HOME, points=800)
    own: dict[str, Any] = {s.now.phase: s for s in run(small)}

    def no_swap(p_i, n_i, p_j, n_j):
        return np.zeros((len(p_i), 3))

    def none(a, b, ratio):
        return np.full(len(a), -1)

    blind: dict[str, Any] = {s.now.phase: s for s in run(small, pair_angles=no_swap)}
    assert not np.allclose(blind["histogram"].now.f_source, own["histogram"].now.f_source)
    last = final(small, mutual_matches=none)
    assert last.now.phase == "end"
    assert last.now.T_target_source is None
    last = final(lesson.preset("patches").params, harris_response=np.zeros_like)
    assert last.now.phase == "corners"
    with pytest.raises(InputError, match="harris_response returned"):
        list(run(lesson.preset("patches").params, harris_response=lambda image: image[:3]))
    with pytest.raises(InputError, match="one index"):
        list(run(small, mutual_matches=lambda a, b, ratio: np.full(len(a), 10**6)))


def test_keypoints_and_filters():
    few: Any = kept([*run(replace(HOME, where="ISS keypoints"))])
    assert 100 < len(few.now.asked) < 600
    nearest: Any = kept([*run(replace(HOME, points=600, keep="nearest"))])
    assert len(nearest.now.pairs) == 600


@pytest.fixture
def own(tmp_path) -> Params:
    T = motion(exp_so3(np.array([0.3, -2.0, 1.0])), np.array([300.0, -40.0, 20.0]))
    made = pair("rabbit", 12_000, T, np.random.default_rng(0), overlap=0.9, noise=0.001)
    scale = 1000.0  # a file in millimetres
    T = T.copy()
    T[:3, 3] *= scale
    np.savez(tmp_path / "target.npz", p=scale * made.p_target)
    np.savez(tmp_path / "source.npz", p=scale * made.p_source)
    np.savetxt(tmp_path / "truth.txt", T)
    return Params(target=tmp_path / "target.npz", source=tmp_path / "source.npz", truth=tmp_path / "truth.txt")


def test_own_scans_of_any_unit_and_start_come_home(own):
    last = final(own)
    assert home(last.now)
    assert last.now.error.rotation < 0.5
    blind = final(replace(own, truth=None))
    np.testing.assert_array_equal(blind.now.T_target_source, last.now.T_target_source)
    assert blind.now.right is None


def test_own_files_that_cannot_be_used_are_refused(own, tmp_path):
    np.savez(tmp_path / "point.npz", p=np.ones((50, 3)))
    for params, said in (
        (replace(own, source=None, truth=None), "pairs"),
        (replace(own, source=tmp_path / "point.npz", truth=None), "one place"),
        (Params(part="pictures", first_image=tmp_path / "a.png"), "pairs"),
    ):
        with pytest.raises(InputError, match=said):
            list(run(params))


def test_bunny_scans_come_home_from_any_start(shared_data, tmp_path):
    folder = shared_data / "icp"
    params = Params(
        target=folder / "bun000.ply", source=folder / "bun045.ply", truth=folder / "bun.conf", up="y", turn=0
    )
    last = final(params)
    assert last.now.scans.error(last.now.T_before).rotation < 0.5
    assert last.now.error.rotation < 0.11
