"""Own scans and pictures in the features lesson: real ones of known pose, any unit and start, and
files that are refused.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from lessons.features.lesson import run
from lessons.features.state import Params
from tests.truths.features import home, moved
from workbench.data.files import read_cloud, read_image, read_pose
from workbench.data.shapes.clouds import pair
from workbench.data.views.stereo import grey
from workbench.errors import InputError
from workbench.geometry.features.keypoints import harris_response, patches, strongest
from workbench.geometry.features.matching import filtered, nearest_both_ways
from workbench.geometry.features.sift import sift
from workbench.geometry.motions import exp_so3, inverse, motion


def final(params: Params) -> Any:
    *_, last = run(params)
    return last.now


@pytest.fixture
def own(tmp_path) -> Params:
    T = motion(exp_so3(np.array([0.3, -2.0, 1.0])), np.array([300.0, -40.0, 20.0]))
    made = pair("rabbit", 6000, T, rng=np.random.default_rng(0), overlap=0.9, noise=0.001)
    scale = 1000.0  # a file in millimetres
    T = T.copy()
    T[:3, 3] *= scale
    np.savez(tmp_path / "target.npz", p=scale * made.p_target)
    np.savez(tmp_path / "source.npz", p=scale * made.p_source)
    np.savetxt(tmp_path / "truth.txt", T)
    return Params(
        target=tmp_path / "target.npz", source=tmp_path / "source.npz", truth=tmp_path / "truth.txt"
    )


def test_own_scans_of_any_unit_and_start_come_home(own):
    last = final(own)
    assert home(last)
    assert last.error.rotation < 0.5
    blind = final(replace(own, truth=None))
    np.testing.assert_array_equal(blind.T_target_source, last.T_target_source)
    assert blind.right is None


def test_own_scans_that_cannot_be_used_are_refused(own, tmp_path):
    rng = np.random.default_rng(0)
    clouds = {
        "point": np.ones((50, 3)),
        "few": rng.normal(size=(12, 3)),
        "many": rng.uniform(size=(8000, 3)),
    }
    for name, p in clouds.items():
        np.savez(tmp_path / f"{name}.npz", p=p)
    (tmp_path / "text.xyz").write_text("these are no points")
    for name, message in (
        ("point.npz", "one place"),
        ("few.npz", "20 at least"),
        ("many.npz", "raise voxel"),
        ("text.xyz", r"text\.xyz"),
    ):
        with pytest.raises(InputError, match=message):
            final(
                replace(
                    own,
                    source=tmp_path / name,
                    truth=None,
                    voxel=10.0 if "many" not in name else 1.0,
                )
            )
    with pytest.raises(InputError, match="pairs"):
        final(replace(own, source=None, truth=None))


def test_own_pictures_are_matched_and_refused(tmp_path):
    levels = np.random.default_rng(1).integers(0, 255, (30, 40)).astype(np.uint8)
    picture = Image.fromarray(levels).resize((900, 300), Image.Resampling.BICUBIC)
    for name, shown in (
        ("a", picture),
        ("b", picture.crop((15, 6, 900, 300))),
        ("tiny", picture.resize((60, 60))),
    ):
        shown.save(tmp_path / f"{name}.png")
    pictures = Params(
        part="pictures", turn=0, first_image=tmp_path / "a.png", second_image=tmp_path / "b.png"
    )
    last = final(pictures)
    assert last.right is None
    assert last.first.shape == (100, 300)
    off = last.uv_first[last.pairs[:, 0]] - last.uv_second[last.pairs[:, 1]]
    assert np.mean(np.abs(off - [5, 2]).max(axis=1) <= 1) > 0.9
    last = final(replace(pictures, describe="SIFT"))
    off = last.uv_first[last.pairs[:, 0]] - last.uv_second[last.pairs[:, 1]]
    assert len(off) > 20
    assert np.mean(np.abs(off - [5, 2]).max(axis=1) <= 1) > 0.9
    Image.new("L", (200, 100)).save(tmp_path / "flat.png")
    assert (
        final(replace(pictures, second_image=tmp_path / "flat.png", describe="SIFT")).phase
        == "corners"
    )
    with pytest.raises(InputError, match="80 at least"):
        final(replace(pictures, second_image=tmp_path / "tiny.png"))
    with pytest.raises(InputError, match="pairs"):
        final(replace(pictures, second_image=None))


@pytest.mark.parametrize("start", range(2))
def test_bunny_scans_come_home_from_any_start(shared_data, tmp_path, start):
    """The benchmark tries twenty starts."""
    folder = shared_data / "icp"
    rng = np.random.default_rng(100 + start)
    files = folder / "bun000.ply", folder / "bun045.ply"
    T = motion(exp_so3(2 * rng.normal(size=3)), 0.1 * rng.normal(size=3))
    np.savez(tmp_path / "source.npz", p=moved(T, read_cloud(files[1])))
    np.savetxt(tmp_path / "truth.txt", read_pose(folder / "bun.conf", *files) @ inverse(T))
    last = final(
        Params(
            target=files[0],
            source=tmp_path / "source.npz",
            truth=tmp_path / "truth.txt",
            up="y",
            seed=start,
        )
    )
    assert last.scans.error(last.T_before).rotation < 0.5
    assert last.error.rotation < 0.1


def test_a_car_finds_its_lidar_scans(shared_data):
    folder = shared_data / "icp"
    last = final(
        Params(
            target=folder / "car_cloud400.csv",
            source=folder / "car_cloud401.csv",
            truth=folder / "carCloudList.csv",
            voxel=4,
            radius=0.2,
        )
    )
    assert last.scans.error(last.T_before).rotation < 1.0
    assert last.error.rotation < 0.2


def kept_near_lines(F, uv, descriptors, *, ratio):
    """How many matches each filter keeps of two pictures, and the share of them within 2 px of
    their true line.
    """
    near = nearest_both_ways(*descriptors)
    kept = {}
    for how in ("nearest", "ratio", "mutual", "both"):
        first, second = filtered(near, how, ratio).T
        a, b = (np.column_stack([at, np.ones(len(at))]) for at in (uv[0][first], uv[1][second]))
        n = a @ F.T
        kept[how] = (
            np.mean(np.abs((n * b).sum(axis=1)) < 2 * np.hypot(n[:, 0], n[:, 1])),
            len(first),
        )
    return kept


def test_corners_of_the_fountain_lie_on_each_others_lines_and_sift_is_no_better(shared_data):
    folder = shared_data / "ransac" / "fountain-P11"
    F = np.load(folder / "gt_and_matches.npz")["F"]
    images = [grey(read_image(folder / f"000{k}_third.jpg")) for k in (4, 5)]
    uv = [strongest(harris_response(image), 1000, border=16) for image in images]
    described = [patches(image, at, 15) for image, at in zip(images, uv, strict=True)]
    of = kept_near_lines(F, uv, described, ratio=0.9)
    assert of["both"][0] > 0.9 > of["ratio"][0] > of["nearest"][0] + 0.1
    assert of["both"][0] > of["mutual"][0] > of["nearest"][0] + 0.1
    patch_share, patch_count = kept_near_lines(F, uv, described, ratio=0.8)["both"]
    keypoints = [sift(image) for image in images]
    sift_share, sift_count = kept_near_lines(
        F, [s.uv for s in keypoints], [s.descriptors for s in keypoints], ratio=0.8
    )["both"]
    assert patch_share == pytest.approx(0.97, abs=0.005)
    assert sift_share == pytest.approx(0.96, abs=0.005)
    assert patch_count > 500 > 400 > sift_count > 300
