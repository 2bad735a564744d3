"""Every claim of the features lesson in numbers: presets, questions, slots, and what is refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.features.lesson import lesson, run
from lessons.features.presets import (
    FLIPPED,
    HOME,
    OUTLINE_X,
    ROOT,
    SMALL,
    TURNED,
    kept,
    kept_count,
    kept_share,
)
from tests.runs import finished
from tests.truths.features import home, share
from workbench.errors import InputError
from workbench.scene import caption_of


def states(params) -> Any:
    return finished("features", params).states()


def final(*args: Any, **functions: Any) -> Any:
    *_, last = run(*args, **functions)
    return last


def green(params) -> float:
    right_share = share(next(s.now for s in states(params) if s.now.phase in ("kept", "matched")))
    assert right_share is not None
    return right_share


def test_the_default_comes_home_with_a_quarter_of_its_matches_right():
    assert green(HOME) == pytest.approx(0.26, abs=0.05)
    last = states(HOME)[-1].now
    assert home(last)
    assert last.error.rotation < last.scans.error(last.T_before).rotation < 4
    assert caption_of(finished("features", HOME)[-1].scene).tone == "good"


def test_a_larger_radius_helps_until_it_leaves_the_overlap():
    assert green(SMALL) == pytest.approx(0.06, abs=0.02)
    assert green(HOME) < 0.4
    assert green(lesson.preset("wide").params) == pytest.approx(0.6, abs=0.05)


def test_square_roots_of_the_bars_help():
    assert green(ROOT) > green(HOME) + 0.08


def test_flipped_normals_leave_few_matches():
    assert kept_count(states(HOME)) > 120
    assert kept_count(states(FLIPPED)) < 50
    last = states(FLIPPED)[-1]
    assert last.now.T_target_source is None
    assert "nothing is found" in caption_of(finished("features", FLIPPED)[-1].scene).text


def test_random_signs_in_one_scan_are_worse_than_in_both():
    one_scan, both = lesson.preset("random-one").params, lesson.preset("random").params
    assert kept_count(states(one_scan)) < 20
    assert states(one_scan)[-1].now.T_target_source is None
    assert kept_count(states(both)) > 190
    assert 0.1 < green(both) < 0.2 < green(HOME)
    assert home(states(both)[-1].now)
    drawn = [
        max(s.now.iteration for s in states(params) if s.now.phase == "refit")
        for params in (HOME, both)
    ]
    assert drawn[1] > 3 * drawn[0]


def test_a_filter_raises_the_share_of_right_matches():
    nearest = share(next(s.now for s in states(HOME) if s.now.phase == "nearest"))
    assert nearest is not None
    assert green(HOME) > nearest + 0.04


def test_a_vase_does_not_come_home():
    assert green(lesson.preset("vase").params) < 0.06
    assert not home(states(lesson.preset("vase").params)[-1].now)


def test_noise_of_a_centimetre_still_comes_home():
    noisy = lesson.preset("noisy").params
    assert green(noisy) < green(HOME)
    assert home(states(noisy)[-1].now)


def test_patches_forgive_small_turns_only():
    patches = lesson.preset("patches").params
    shares = {turn: green(replace(patches, turn=float(turn))) for turn in (0, 10, 15, 20)}
    assert shares == {
        turn: pytest.approx(share, abs=0.01)
        for turn, share in {0: 0.9, 10: 0.87, 15: 0.75, 20: 0.33}.items()
    }
    assert green(TURNED) < 0.05
    question = next(q for q in lesson.questions if q.name == "thirty")
    assert all(question.reply(100 * share) for share in shares.values())
    assert kept_share(states(TURNED)) == pytest.approx(100 * green(TURNED))


def test_sift_forgives_the_turn_and_is_no_better_without_one():
    patches, turned = lesson.preset("patches").params, lesson.preset("sift").params
    assert replace(turned, describe="patches") == TURNED
    assert green(turned) == pytest.approx(0.82, abs=0.01)
    assert caption_of(finished("features", turned)[-1].scene).tone == "good"
    assert green(patches) == pytest.approx(0.90, abs=0.005)
    assert green(replace(patches, describe="SIFT")) == pytest.approx(0.84, abs=0.005)


def test_outlines_need_angles_along_them():
    assert green(lesson.preset("outline").params) > 0.95
    assert green(OUTLINE_X) < 0.1


def test_wrong_functions_show():
    small = replace(HOME, points=800)
    own: dict[str, Any] = {s.now.phase: s for s in run(small)}

    def no_swap(p_i, n_i, p_j, n_j):  # noqa: PLR0917
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
