"""The lesson on Chamfer and earth mover's driven by a student's functions, and with own clouds."""

from dataclasses import replace

import numpy as np
import pytest
import scipy

from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.exercises.earth_movers import earth_movers_of_copies, points_left_out
from lessons.chamfer_emd.inputs import Input, Lowers
from lessons.chamfer_emd.lesson import lesson
from tests.lessons.chamfer_emd_runs import flows, states, timeline
from workbench.algorithms.transport import earth_movers
from workbench.errors import InputError
from workbench.exercise.candidate import Candidate
from workbench.geometry.points.shape_distances import chamfer, one_sided


class TestSlots:
    """The student's functions drive the run: step lengths, ends, curves and tables."""

    def test_equal_functions_give_an_equal_run(self):
        params = Input(points=30, steps=15)
        slots = {
            "chamfer": Candidate(brute_chamfer, chamfer),
            "earth_movers": Candidate(plain_earth_movers, earth_movers),
            "one_sided": Candidate(brute_one_sided, one_sided),
        }
        ours = flows(params)
        theirs = flows(params, **slots)
        assert len(ours) == len(theirs)
        for expected, two in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(
                two.left.flow.p_moving, expected.left.flow.p_moving, atol=1e-9
            )
            np.testing.assert_allclose(
                two.right.flow.p_moving, expected.right.flow.p_moving, atol=1e-9
            )
            assert two.right.numbers.earth_movers == pytest.approx(
                expected.right.numbers.earth_movers, rel=1e-9
            )

    def test_a_wrong_chamfer_leads_the_left_flow_elsewhere(self):
        params = Input(points=20, steps=6)
        wrong = flows(params, chamfer=brute_one_sided)
        as_one_sided = flows(replace(params, lowers="source to target"))
        for wrong_step, two in zip(wrong, as_one_sided, strict=True):
            np.testing.assert_allclose(
                wrong_step.left.flow.p_moving, two.left.flow.p_moving, atol=1e-5
            )
        ours = flows(params)
        assert np.abs(wrong[-1].left.flow.p_moving - ours[-1].left.flow.p_moving).max() > 0.1
        assert wrong[-1].right.flow.value == pytest.approx(ours[-1].right.flow.value)

    def test_a_wrong_earth_movers_leads_the_right_flow_elsewhere(self):
        params = Input(points=20, steps=40)
        ours = flows(params)
        wrong = flows(params, earth_movers=by_index)
        assert np.abs(wrong[-1].right.flow.p_moving - ours[-1].right.flow.p_moving).max() > 0.5
        # every point to the one with its own index
        home = wrong[-1].right.flow.p_moving - wrong[-1].clouds.p_target
        assert np.linalg.norm(home, axis=1).max() < 0.3
        assert wrong[-1].right.flow.value < 0.1 < ours[-1].right.numbers.index_mse

    @pytest.mark.parametrize("lowers", ["source to target", "target to source"])
    def test_one_sided_drives_the_left_flow_where_it_lowers_one_side(self, lowers):
        params = Input(points=20, steps=5, lowers=lowers)
        ours = flows(params)
        right = flows(params, one_sided=brute_one_sided)
        wrong = flows(params, one_sided=lambda p_a, p_b: brute_one_sided(p_b, p_a))
        other = flows(replace(params, lowers=OTHER_SIDE[lowers]))
        for expected, two, three, four in zip(ours, right, wrong, other, strict=True):
            np.testing.assert_allclose(
                two.left.flow.p_moving, expected.left.flow.p_moving, atol=1e-9
            )
            np.testing.assert_allclose(three.left.flow.p_moving, four.left.flow.p_moving, atol=1e-5)
        assert np.abs(ours[-1].left.flow.p_moving - other[-1].left.flow.p_moving).max() > 0.05

    @pytest.mark.parametrize("name", ["unequal", "doubled"])
    def test_a_right_answer_flows_as_ours_does_where_counts_differ(self, name):
        params = replace(lesson.preset(name).params, steps=4)
        ours = flows(params)
        theirs = flows(params, earth_movers=earth_movers_of_copies)
        assert len(ours[0].clouds.p_source) != len(ours[0].clouds.p_target)
        for expected, two in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(
                two.right.flow.p_moving, expected.right.flow.p_moving, atol=1e-9
            )
        left_out = flows(params, earth_movers=points_left_out)
        assert left_out[0].right.flow.value < 0.9 * ours[0].right.flow.value


OTHER_SIDE: dict[Lowers, Lowers] = {
    "source to target": "target to source",
    "target to source": "source to target",
}


def brute_one_sided(p_a, p_b):
    return float(np.mean(np.min(np.sum((p_a[:, None] - p_b) ** 2, axis=2), axis=1)))


def brute_chamfer(p_a, p_b):
    return brute_one_sided(p_a, p_b) + brute_one_sided(p_b, p_a)


def plain_earth_movers(p_a, p_b):
    D = np.linalg.norm(p_a[:, None] - p_b, axis=2)
    return float(D[scipy.optimize.linear_sum_assignment(D)].mean())


def by_index(p_a, p_b):
    return float(np.linalg.norm(p_a - p_b, axis=1).mean()) if len(p_a) == len(p_b) else 1.0


class TestOwnClouds:
    def write(self, folder, name, p):
        np.savetxt(folder / name, p)
        return folder / name

    def test_two_files_are_scaled_together(self, tmp_path):
        rng = np.random.default_rng(0)
        p = 500.0 + 100.0 * rng.random((300, 3))
        target = self.write(tmp_path, "a.xyz", p)
        source = self.write(tmp_path, "b.xyz", p[:200] + np.array([30.0, 0, 0]))
        params = Input(target=target, source=source, points=50, source_points=40, steps=5)
        run = states(params)
        clouds = run[0].clouds
        assert clouds.p_target.shape == (50, 3)
        assert clouds.p_source.shape == (40, 3)
        assert np.abs(clouds.p_target).max() < 1.1
        assert clouds.scale == pytest.approx(2 / 96, rel=0.05)
        assert clouds.p_source[:, 0].mean() - clouds.p_target[:, 0].mean() == pytest.approx(
            30 * clouds.scale, abs=0.2
        )
        assert "b.xyz" in timeline(params)[0].caption.text
        assert "unit of your files" in timeline(params)[0].caption.text

    @pytest.mark.parametrize(
        "start", ["blob", "bunched", "part missing", "doubled points", "shuffled rows", "larger"]
    )
    def test_an_own_target_takes_the_built_in_changes(self, tmp_path, start):
        target = self.write(tmp_path, "a.xyz", np.random.default_rng(1).normal(size=(60, 3)))
        for source_points in (0, 25):
            params = Input(
                target=target,
                start=start,
                amount=0.5,
                points=40,
                source_points=source_points,
                steps=3,
            )
            assert len(states(params)) >= 1

    def test_equal_points_do_not_divide_by_zero(self, tmp_path):
        target = self.write(tmp_path, "a.xyz", np.ones((20, 3)))
        assert states(Input(target=target, start="larger", steps=2))[0].left.numbers.chamfer == 0.0

    def test_trouble_is_one_clear_line(self, tmp_path):
        with pytest.raises(InputError, match="needs an own target"):
            clouds_of(Input(source=tmp_path / "b.xyz"))
        with pytest.raises(InputError, match=r"a\.xyz"):
            clouds_of(Input(target=tmp_path / "a.xyz"))
        bad = self.write(tmp_path, "nan.xyz", np.full((5, 3), np.nan))
        with pytest.raises(InputError, match=r"nan\.xyz"):
            clouds_of(Input(target=bad))

    def test_two_real_scans(self, shared_data):
        folder = shared_data / "icp"
        params = Input(
            target=folder / "bun000.ply", source=folder / "bun045.ply", points=100, steps=20
        )
        first = states(params)[0]
        last = states(params)[-1]
        assert last.right.numbers.earth_movers < 0.3 * first.right.numbers.earth_movers
        assert last.left.numbers.chamfer < 0.3 * first.left.numbers.chamfer
