import pytest

from workbench.errors import not_among

NAMES = ("icp", "ransac", "chamfer_emd", "align_rigid")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("ipc", "did you mean icp?"),
        ("alignrigid", "did you mean align_rigid?"),
        ("zzz", "there are: icp, ransac, chamfer_emd, align_rigid"),
        ("x" * 1_000_000, "there are: icp, ransac, chamfer_emd, align_rigid"),
    ],
)
def test_a_name_that_is_none_is_told_its_nearest_or_all(name, message):
    assert not_among(name, NAMES) == message


def test_where_there_are_none_that_is_said():
    assert not_among("icp", ()) == "there are: none"
