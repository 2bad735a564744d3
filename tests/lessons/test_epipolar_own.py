"""Own matches in the epipolar lesson: the fountain's, matches without pictures or truth, and files
that are refused.
"""

from typing import Any

import numpy as np
import pytest

from lessons.epipolar.lesson import draw, run
from lessons.epipolar.state import Params
from tests.truths.epipolar import errors
from workbench.errors import InputError
from workbench.scene import Picture, caption_of


def fountain(folder, tmp_path, **left_out: bool):
    """The fountain's matches without the outliers, as a file; with pictures."""
    archive = np.load(folder / "ransac" / "fountain-P11" / "gt_and_matches.npz")
    good = np.abs(archive["gt_sampson"]) < 1
    arrays = {
        name: archive[name] for name in ("K1", "K2", "R_rel", "t_rel") if name not in left_out
    }
    np.savez(tmp_path / "fountain.npz", x1=archive["x1"][good], x2=archive["x2"][good], **arrays)
    first, second = (
        folder / "ransac" / "fountain-P11" / f"{n}_third.jpg" for n in ("0004", "0005")
    )
    return {"own_matches": tmp_path / "fountain.npz", "first_image": first, "second_image": second}


def test_the_fountain(shared_data, tmp_path):
    states: list[Any] = list(run(Params(**fountain(shared_data, tmp_path))))
    last = states[-1]
    turn, direction = errors(last) or (9, 9)
    assert turn < 0.05
    assert direction < 0.2
    assert np.sqrt(np.square(last.disparities[:, 1]).mean()) < 0.25
    assert last.now.rectification.second_is_left
    assert max(last.now.in_front) == 1365
    scene = draw(last)
    assert caption_of(scene).tone == "good"
    picture = scene["first/rectified"]
    assert isinstance(picture, Picture)
    assert picture.size[0] <= 720
    assert np.linalg.norm(last.length * last.now.p_first, axis=1).max() < 40
    routes = [
        errors(list(run(Params(**fountain(shared_data, tmp_path), route=route)))[-1])
        for route in ("eight-point", "refined F")
    ]  # type: ignore[arg-type]
    assert all(error is not None and error[1] > 2 * direction for error in routes)


def test_without_a_true_motion_nobody_is_judged(shared_data, tmp_path):
    arrays = fountain(shared_data, tmp_path, R_rel=True, t_rel=True, K1=True, K2=True)
    (tmp_path / "k.txt").write_text("919.8267 920.4869 506.5633 334.9421")
    with pytest.raises(InputError, match="has no K"):
        next(run(Params(**arrays)))
    states: list[Any] = list(run(Params(**arrays, intrinsics=tmp_path / "k.txt")))
    assert states[0].now.stage == "equations"
    assert {caption_of(draw(state)).tone for state in states} == {"info"}
    assert "made up" in caption_of(draw(next(s for s in states if s.now.stage == "points"))).text


def test_matches_alone_have_white_pictures(tmp_path):
    views = next(run(Params())).views
    np.savetxt(tmp_path / "m.txt", views.matches)
    (tmp_path / "k.txt").write_text("420 420 239.5 159.5")
    states: list[Any] = list(
        run(Params(own_matches=tmp_path / "m.txt", intrinsics=tmp_path / "k.txt"))
    )
    T = states[-1].now.T_second_first
    true = views.T_second_first
    assert true is not None
    np.testing.assert_allclose(T[:3, :3], true[:3, :3], atol=0.02)
    scene = draw(states[0])
    assert isinstance(scene["first/picture"], Picture)
    assert isinstance(draw(states[-1])["second/rectified"], Picture)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "four numbers"),
        ("1 2 3 4\n" * 7, "at least 8"),
        ("1 2 3 nan\n" * 9, "NaN"),
        ("a b c d\ne f g h", "numbers"),
    ],
)
def test_files_without_matches_are_refused(tmp_path, text, words):
    (tmp_path / "m.txt").write_text(text)
    (tmp_path / "k.txt").write_text("420 420 239.5 159.5")
    with pytest.raises(InputError, match=words):
        next(run(Params(own_matches=tmp_path / "m.txt", intrinsics=tmp_path / "k.txt")))


def test_matches_at_one_place_do_not_crash(tmp_path):
    (tmp_path / "m.txt").write_text("100 100 110 100\n" * 12)
    (tmp_path / "k.txt").write_text("420 420 239.5 159.5")
    for state in run(Params(own_matches=tmp_path / "m.txt", intrinsics=tmp_path / "k.txt")):
        assert caption_of(draw(state)).text
