"""Own scans and lidar scans in the ICP lesson: how they are read, thinned, shown and matched."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lessons.icp.inputs import Input as Params
from lessons.icp.lesson import lesson
from lessons.icp.space import ANGLES
from tests.lessons.icp_runs import (
    HOME,
    Seen,
    end,
    preset,
    scene,
    seen,
    states,
    true,
    two_scans,
    until_stop,
)
from workbench.algorithms.registration.icp import Stop
from workbench.data.shapes.lidar import Street, lidar_scan, street
from workbench.errors import InputError
from workbench.geometry.motions import apply, exp_so3, motion
from workbench.run.timeline import Timeline
from workbench.scene import caption_of


def fitted(params: Params) -> Seen:
    """The step after the first fit."""
    return next(step for step in seen(params) if step.icp.phase == "fit")


@pytest.fixture
def two_files(tmp_path) -> Params:
    return two_scans(tmp_path)


class TestOwnScans:
    def test_they_are_shown_a_metre_wide_about_the_middle_whatever_their_unit(self, two_files):
        p = scene(two_files, 0)["target"].p
        assert 1.0 < (p.max(axis=0) - p.min(axis=0)).max() < 1.5
        assert np.abs((p.max(axis=0) + p.min(axis=0)) / 2).max() < 0.1
        state = states(two_files)[-1]
        source = scene(two_files, -1)["source"]
        gap = np.linalg.norm(apply(source.T_world_object, source.p) - p[state.icp.indices], axis=1)
        np.testing.assert_allclose(gap, state.scans.frame.scale * state.icp.distances, atol=1e-9)

    @pytest.mark.parametrize(
        ("up", "axis"), [("z", [0, 0, 1]), ("y", [0, 1, 0]), ("-y", [0, -1, 0]), ("x", [1, 0, 0])]
    )
    def test_they_stand_upright(self, two_files, up, axis):
        params = replace(two_files, up=up)
        scans = states(params)[0].scans
        shown = scene(params, 0)
        middle = scans.p_target.mean(axis=0)
        above = int(np.argmax(scans.p_target @ axis))
        height = (scans.p_target[above] - middle) @ axis
        p = shown["target"].p
        assert p[above, 2] - p[:, 2].mean() == pytest.approx(scans.frame.scale * height)
        for k in (0, -1):
            state = states(params)[k]
            source = scene(params, k)["source"]
            gap = np.linalg.norm(
                apply(source.T_world_object, source.p) - p[state.icp.indices], axis=1
            )
            np.testing.assert_allclose(gap, scans.frame.scale * state.icp.distances, atol=1e-9)
        assert "of the scans" in shown["size"].text

    def test_the_handle_turns_about_the_middle_of_the_picture(self, two_files):
        guess = (0.1, 0.0, 0.0, 0.0, 0.0, 1.0)
        T = scene(replace(two_files, up="y", guess=guess), 0)["source"].T_world_object
        np.testing.assert_allclose(
            T, motion(exp_so3(np.array([0.0, 0.0, 1.0])), np.array([0.1, 0.0, 0.0])), atol=1e-9
        )

    def test_a_known_pose_is_the_truth(self, two_files, tmp_path):
        shift = np.eye(4)
        shift[:3, 3] = 5000
        T = (
            shift
            @ np.diag([1000, 1000, 1000, 1])
            @ true(states(HOME)[0])
            @ np.diag([0.001, 0.001, 0.001, 1])
        )
        T = T @ np.linalg.inv(shift)
        np.savetxt(tmp_path / "pose.txt", T)
        run = states(replace(two_files, truth=tmp_path / "pose.txt"))
        assert run[0].error.rotation == pytest.approx(35)
        assert end(run).home
        # started at the truth, so its end as seen from the truth is no motion at all
        first = run[-1].tries[0]
        np.testing.assert_allclose(first.T_target_truth[:3, :3], np.eye(3), atol=0.02)
        off = apply(first.T_target_truth, run[0].scans.frame.centre) - run[0].scans.frame.centre
        assert np.linalg.norm(off) < 10  # of about 1000

    def test_the_initial_guess_is_set_by_hand(self):
        guess = (0.0, 0.0, 0.0, 0.0, 0.0, np.radians(35))
        assert states(replace(HOME, guess=guess))[0].error.rotation < 1e-9
        run = states(replace(HOME, start_angle=120.0, guess=(0.0, 0.0, 0.0, 0.0, 0.0, 1.5)))
        assert end(run).home

    def test_bad_input_is_one_line(self, two_files, tmp_path):
        single = tmp_path / "one.xyz"
        single.write_text("1 2 3\n")
        for params, words in (
            (replace(two_files, source=None), "both"),
            (Params(truth=Path("pose.txt")), "both"),
            (replace(two_files, target=tmp_path / "no.ply"), "no such file"),
            (replace(two_files, source=single), "1 point"),
            (replace(two_files, truth=tmp_path / "no.txt"), "no such file"),
        ):
            with pytest.raises(InputError, match=words):
                next(seen(params))


class TestAwkwardScans:
    """Own files as people have them: in other units, far from the origin, doubled, tiny, or not
    overlapping at all.
    """

    def files(
        self, folder: Path, p_target: np.ndarray, p_source: np.ndarray, **values: Any
    ) -> Params:
        for name, p in (("t.npy", p_target), ("s.npy", p_source)):
            np.save(folder / name, p)
        return Params(target=folder / "t.npy", source=folder / "s.npy", **values)

    def rabbits(self) -> tuple[np.ndarray, np.ndarray]:
        scans = states(HOME)[0].scans
        return scans.p_target, scans.p_source

    @pytest.mark.parametrize(("unit", "per_metre"), [("mm", 1000.0), ("km", 0.001), ("m", 1000.0)])
    def test_any_unit_passes_the_gate_alike_and_is_told_in_metres(self, tmp_path, unit, per_metre):
        gate: Any = {"gate": "max-distance", "max_distance": 0.06, "thinning": "chance"}
        p_target, p_source = self.rabbits()
        metres = fitted(self.files(tmp_path, p_target, p_source, **gate))
        folder = tmp_path / unit
        folder.mkdir()
        first = fitted(
            self.files(folder, per_metre * p_target, per_metre * p_source, unit=unit, **gate)
        )
        assert 0.1 < metres.icp.overlap < 0.9
        assert first.icp.overlap == metres.icp.overlap
        factor = 1.0 if unit != "m" else 1000.0
        assert first.icp.rmse == pytest.approx(factor * metres.icp.rmse)
        assert (caption_of(first.scene).text == caption_of(metres.scene).text) is (unit != "m")

    def test_a_pose_is_in_the_unit_of_the_scans(self, tmp_path):
        p_target, p_source = self.rabbits()
        T = true(states(replace(HOME, start_shift=0.2))[0])
        np.savetxt(tmp_path / "T.txt", np.array([[1, 1, 1, 1000]] * 3 + [[1, 1, 1, 1]]) * T)
        params = self.files(
            tmp_path, 1000 * p_target, 1000 * p_source, unit="mm", truth=tmp_path / "T.txt"
        )
        np.testing.assert_allclose(true(next(seen(params))), T, atol=1e-9)

    def test_far_from_the_origin_nothing_changes(self, tmp_path):
        p_target, p_source = self.rabbits()
        far = np.array([512_000.0, 5_403_000.0, 310.0])
        folder = tmp_path / "utm"
        folder.mkdir()
        for fit in ("point-to-point", "point-to-plane"):
            here = until_stop(self.files(tmp_path, p_target, p_source, fit=fit))[-1]
            utm = until_stop(self.files(folder, p_target + far, p_source + far, fit=fit))[-1]
            assert utm.icp.stop is here.icp.stop
            back = motion(np.eye(3), -far) @ utm.icp.T_target_source @ motion(np.eye(3), far)
            np.testing.assert_allclose(back, here.icp.T_target_source, atol=1e-4)

    @pytest.mark.parametrize("thinning", ["voxel", "chance"])
    def test_doubled_points_do_no_harm(self, tmp_path, thinning):
        p_target, p_source = self.rabbits()
        np.savetxt(tmp_path / "T.txt", true(states(HOME)[0]))
        doubled = (np.concatenate([p, p]) for p in (p_target, p_source))
        values: Any = {"thinning": thinning, "truth": tmp_path / "T.txt"}
        last = until_stop(self.files(tmp_path, *doubled, **values))[-1]
        assert last.home
        assert last.right > 0.5

    def test_five_points_are_fitted_or_one_line_says_why_not(self, tmp_path):
        p = np.random.default_rng(0).uniform(0, 1, (5, 3))
        point = until_stop(self.files(tmp_path, p, p + 0.01))[-1]
        assert point.icp.stop is Stop.CONVERGED
        plane = until_stop(self.files(tmp_path, p, p + 0.01, fit="point-to-plane"))[-1]
        assert plane.icp.stop is Stop.TOO_FEW_MATCHES
        assert "too few matches" in caption_of(plane.scene).text

    def test_scans_that_start_apart_are_told_so(self, tmp_path):
        p_target, p_source = self.rabbits()
        first = next(seen(self.files(tmp_path, p_target, p_source + np.array([800.0, 0.0, 0.0]))))
        assert "The scans start 799 m apart, and the target is" in caption_of(first.scene).text
        none = next(
            seen(
                self.files(
                    tmp_path, p_target, p_source + np.array([800.0, 0.0, 0.0]), gate="max-distance"
                )
            )
        )
        assert "of 1,500 matches the closest 0 are kept" in caption_of(none.scene).text
        assert "nan" not in caption_of(none.scene).text
        near = next(seen(self.files(tmp_path, p_target, p_source)))
        assert "apart, and" not in caption_of(near.scene).text

    def test_a_target_in_one_place_is_one_line_and_nan_are_left_out_and_counted(self, tmp_path):
        p_target, p_source = self.rabbits()
        with pytest.raises(InputError, match="all its points lie at one place"):
            next(seen(self.files(tmp_path, np.ones((9, 3)), p_source)))
        holed = np.where(p_target > 0.4, np.nan, p_target)
        params = self.files(tmp_path, holed, p_source)
        timeline = Timeline(lesson, params)
        timeline.extend()
        missing = int(np.isnan(holed).any(axis=1).sum())
        assert (
            f"{missing} of {len(holed):,} points left out: NaN or infinite."
            in timeline[0].caption.text
        )

    def test_the_grid_is_in_metres_of_the_scans(self, tmp_path):
        p_target, p_source = self.rabbits()
        shown = next(seen(self.files(tmp_path, 100 * p_target, 100 * p_source))).scene
        grid: Any = shown["grid"]
        scale = states(self.files(tmp_path, 100 * p_target, 100 * p_source))[0].scans.frame.scale
        at = np.unique(grid.ends[:, 0, 0].round(9))
        np.testing.assert_allclose(np.diff(at), 20 * scale)  # 20 m
        assert grid.name == "grid 20 m"
        assert shown["size"].text == "a square of the grid is 20 m of the scans"  # type: ignore[union-attr]
        assert scene(HOME, 0)["grid"].name == "grid 0.5 m"

    def test_a_preset_says_what_own_scans_do_not_take_from_it(self, tmp_path):
        p_target, p_source = self.rabbits()
        params = self.files(tmp_path, p_target, p_source)
        words = "Your own scans are open: shape, start angle have no effect on them."
        assert (
            words
            in caption_of(next(seen(replace(params, shape="vase", start_angle=90.0))).scene).text
        )
        assert "no effect" not in caption_of(next(seen(params)).scene).text


def yard(rng: np.random.Generator) -> Street:
    """Four walls, crates and poles."""
    half = rng.uniform(15, 30, 2)
    walls = [[s * half[0], 0, 3, 0.5, half[1], 3, 0] for s in (-1, 1)]
    walls += [[0, s * half[1], 3, half[0], 0.5, 3, 0] for s in (-1, 1)]
    crates = [
        [
            *rng.uniform([-0.7, 0.2], [0.7, 0.7]) * half * [1, s],
            0.6,
            *rng.uniform(0.3, 1, 2),
            0.6,
            rng.uniform(-1, 1),
        ]
        for s in rng.choice([-1, 1], 8)
    ]
    poles = [
        [*rng.uniform([-0.8, 0.3], [0.8, 0.8]) * half * [1, s], 0.15]
        for s in rng.choice([-1, 1], 8)
    ]
    return Street(np.array(walls + crates, float), np.array(poles, float))


class TestRings:
    """Scans whose rings move with the scanner, through files, by the defaults."""

    def motion(self, rng: np.random.Generator) -> np.ndarray:
        axis, way = rng.normal(size=3) * [0.2, 0.2, 1.0], rng.normal(size=3) * [1.0, 1.0, 0.1]
        return motion(
            exp_so3(np.radians(0.7) * axis / np.linalg.norm(axis)), 0.5 * way / np.linalg.norm(way)
        )

    def pair(
        self, scene: Street, rng: np.random.Generator
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        T = self.motion(rng)
        sensor = motion(exp_so3(np.array([0, 0, 0.2])), np.array([0.0, 0.0, 1.73]))
        return lidar_scan(scene, sensor, rng), lidar_scan(scene, sensor @ T, rng), T

    @pytest.mark.parametrize(
        ("place", "kind"), [(street, "ply"), (yard, "csv"), (street, "pcd"), (yard, "npy")]
    )
    def test_two_scans_of_rings_meet(self, tmp_path, place, kind):
        rng = np.random.default_rng(["ply", "csv", "pcd", "npy"].index(kind))
        p_target, p_source, T = self.pair(place(rng), rng)
        assert 55_000 < len(p_source) < 75_000
        for name, p in (("t", p_target), ("s", p_source)):
            write(tmp_path / f"{name}.{kind}", p.astype(np.float32))
        np.savetxt(tmp_path / "T.txt", T)
        files = {name: tmp_path / f"{name[0]}.{kind}" for name in ("target", "source")}
        last = until_stop(Params(truth=tmp_path / "T.txt", fit="point-to-plane", **files))[-1]
        assert last.error.rotation < 0.3
        assert last.error.translation < 0.02
        assert np.linalg.norm(last.icp.T_target_source[:3, 3] - T[:3, 3]) < 0.02
        assert last.home

    def test_three_ways_to_thin(self):
        chance, voxel, spread = (
            end(preset(f"rings-{name}")) for name in ("chance", "voxel", "spread")
        )
        assert chance.error.translation > 0.4
        assert not chance.home
        assert voxel.error.displacement < 0.1
        assert spread.error.displacement < 0.02

    def test_where_the_scanner_drives_decides_what_the_tries_see(self):
        params = replace(lesson.preset("rings-spread").params, seed=1)
        last = states(params)[-1]
        assert last.scans.at_home(last.tries[0].error)
        assert len(last.tries) == len(ANGLES)


def write(path: Path, p: np.ndarray) -> None:
    """Write a cloud of 32-bit floats in the format that the name says."""
    head = (
        f"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(p)}\nHEIGHT"
        f" 1\nPOINTS {len(p)}\n"
    )
    ply = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(p)}\n"
    match path.suffix:
        case ".npy":
            np.save(path, p)
        case ".csv":
            path.write_text("\n".join(f"{x:.4f},{y:.4f},{z:.4f}" for x, y, z in p.tolist()))
        case ".pcd":
            path.write_bytes((head + "DATA binary\n").encode() + p.tobytes())
        case ".ply":
            path.write_bytes(
                (ply + "".join(f"property float {c}\n" for c in "xyz") + "end_header\n").encode()
                + p.tobytes()
            )


class TestRealScans:
    @pytest.mark.parametrize("fit", ["point-to-point", "point-to-plane"])
    @pytest.mark.parametrize(
        ("target", "source", "truth", "most_metres"),
        [
            ("bun000.ply", "bun045.ply", "bun.conf", 0.0005),
            ("car_cloud400.csv", "car_cloud401.csv", "carCloudList.csv", 0.03),
        ],
    )
    def test_the_defaults_come_home(self, shared_data, target, source, *, truth, most_metres, fit):
        folder = shared_data / "icp"
        params = Params(
            target=folder / target, source=folder / source, truth=folder / truth, fit=fit
        )
        state = end(seen(params))
        assert state.error.rotation < 0.3
        assert state.error.translation < most_metres
        off = np.linalg.norm(state.icp.T_target_source[:3, 3] - true(state)[:3, 3])
        assert off < most_metres
