import numpy as np
import pytest

from workbench.data.files.matches import read_matches
from workbench.errors import InputError


@pytest.fixture
def p():
    return np.random.default_rng(0).uniform(0, 600, (12, 4))


def test_arrays_in_their_two_forms(tmp_path, p):
    np.savez(
        tmp_path / "two.npz",
        x1=p[:, :2].astype(np.float32),
        x2=p[:, 2:].astype(np.float32),
        F=2 * np.eye(3),
    )
    np.savez(tmp_path / "one.npz", matches=p, quality=np.arange(12), H=np.ones((3, 3)))
    two, joined = read_matches(tmp_path / "two.npz"), read_matches(tmp_path / "one.npz")
    np.testing.assert_allclose(two.p, p, rtol=1e-6)
    np.testing.assert_array_equal(joined.p, p)
    assert two.quality is None
    assert two.H is None
    assert two.F is not None
    assert np.linalg.norm(two.F) == pytest.approx(1)
    np.testing.assert_array_equal(joined.quality, np.arange(12.0))
    assert joined.H is not None


@pytest.mark.parametrize(
    ("separator", "head"), [(",", "u,v,u2,v2\n"), (" ", "# four numbers\n"), ("\t", "")]
)
def test_text_with_and_without_names_and_quality(tmp_path, p, separator, *, head):
    file = tmp_path / "m.csv"
    file.write_text(head + "\n".join(separator.join(map(repr, map(float, row))) for row in p))
    np.testing.assert_array_equal(read_matches(file).p, p)
    file.write_text(
        head + "\n".join(separator.join(map(repr, map(float, [*row, 0.5]))) for row in p)
    )
    matches = read_matches(file)
    np.testing.assert_array_equal(matches.p, p)
    np.testing.assert_array_equal(matches.quality, np.full(12, 0.5))


def test_bad_files_say_why(tmp_path, p):
    def refused(message, name="m.npz"):
        with pytest.raises(InputError, match=message) as caught:
            read_matches(tmp_path / name)
        assert "\n" not in str(caught.value)

    refused("no such file")
    (tmp_path / "m.npz").write_bytes(b"not an archive")
    refused("not readable")
    for arrays, message in (
        ({"a": p}, "no arrays x1 and x2"),
        ({"x1": p[:, :2], "x2": p[:5, 2:]}, "12 pixels in the first image and 5"),
        ({"x1": p, "x2": p}, "where \\(n, 2\\)"),
        ({"matches": p[:3]}, "3 matches; at least 4"),
        ({"matches": np.full((9, 4), np.nan)}, "all 9 matches are NaN"),
        ({"matches": p, "F": np.zeros((3, 3))}, "F is no 3 x 3"),
        ({"matches": p, "quality": np.ones(3)}, "quality"),
        ({"matches": p.astype(object)}, "not readable"),
    ):
        np.savez(tmp_path / "m.npz", allow_pickle=True, **arrays)
        refused(message)
    for text, message in (
        ("1 2 3\n4 5 6\n", "four numbers"),
        ("", "four numbers"),
        ("1 2 3 4\n1 2 x 4\n", "not all of it"),
    ):
        (tmp_path / "m.txt").write_text(text)
        refused(message, "m.txt")


def test_the_real_pair(shared_data):
    matches = read_matches(shared_data / "ransac" / "fountain-P11" / "gt_and_matches.npz")
    assert matches.p.shape == (1445, 4)
    assert matches.F is not None
