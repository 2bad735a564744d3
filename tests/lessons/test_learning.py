"""Every claim of the learning lesson in numbers: presets, questions, page and slots."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.learning.lesson import draw, lesson, run
from lessons.learning.presets import RABBIT
from lessons.learning.state import Params
from tests.runs import finished
from tests.truths.learning import farthest, folded, named, overlap, radii, wrong_by
from workbench.certain import as_a
from workbench.geometry.motions.rotation_outputs import rotation_from_six
from workbench.geometry.points.shape_distances import chamfer_gradient
from workbench.knobs import fields_of
from workbench.scene import Mesh, Points, caption_of


def states(params: Params) -> tuple[Any, ...]:
    return finished(lesson.name, params).states()


def end(name: str) -> Any:
    return states(lesson.preset(name).params)[-1]


def tone(state: Any) -> str:
    return caption_of(draw(state)).tone


def last_of(params: Params, **slots: Any) -> Any:
    *_, last = run(params, **slots)
    return last


# presets ------------------------------------------------------------------------------------------


def test_the_default_run_learns_every_angle():
    run_ = states(Params())
    assert wrong_by(run_[0]).mean() > 60
    assert wrong_by(run_[-1]).max() < 5
    assert tone(run_[-1]) == "good"


def test_one_number_is_cut_at_half_a_turn():
    state = end("cut")
    errors = wrong_by(state)
    assert errors.max() > 160
    assert abs(state.about.degrees[errors.argmax()]) > 175
    assert np.median(errors) < 5
    assert tone(state) == "wrong"
    assert wrong_by(end("short")).max() < 5  # up to quarter turns nothing is cut
    outputs = state.now.outputs[:, 0]
    assert np.abs(np.diff(outputs)).max() < 2.5  # steep, and yet no jump of 2 pi


def test_half_the_angle_is_cut_as_well_and_a_loss_that_knows_turns_only_moves_the_cut():
    assert wrong_by(end("half")).max() > 90
    errors = wrong_by(end("periodic"))
    assert errors.max() > 120
    assert np.median(errors) < 5


def test_more_updates_make_the_cut_narrower_not_lower():
    few = wrong_by(end("cut"))
    many = wrong_by(last_of(replace(lesson.preset("cut").params, updates=1200)))
    assert (many > 20).mean() < (few > 20).mean()
    assert many.max() > 150


def test_rotations_by_six_and_nine_numbers_have_no_cut():
    six, nine, four, three = (
        wrong_by(end(name)) for name in ("rotation", "nine", "quaternion", "euler")
    )
    assert six.mean() == pytest.approx(1.25, abs=0.005)
    assert six.max() == pytest.approx(3.6, abs=0.05)
    assert nine.mean() == pytest.approx(1.05, abs=0.005)
    assert nine.max() < 3.5
    assert 0.75 * six.mean() < nine.mean() < 0.95 * six.mean()
    assert four.max() > 30
    assert three.max() > 150
    assert three.mean() > 7 * six.mean()


def test_quaternions_are_cut_where_their_sign_is_asked_for():
    asked, free = end("quaternion"), end("quaternion-matrix")
    assert asked.about.degrees[wrong_by(asked) > 20].min() > 178
    assert (asked.now.outputs[:, 0] > -0.3).all()  # about half of the sphere of quaternions is used
    assert np.median(free.about.degrees[wrong_by(free) > 20]) < 165


def test_quaternions_are_not_worse_where_turns_stay_small():
    small = [
        wrong_by(
            last_of(
                Params(task="rotation", rotation=rotation, loss="matrix", largest=90.0, updates=400)
            )
        )
        for rotation in ("quaternion", "6D")
    ]
    assert small[0].max() < 1.5 * small[1].max()
    assert small[0].max() < 15


def test_means_of_two_losses():
    circle, smeared = radii(end("circle")), radii(end("smeared"))
    assert circle.mean() == pytest.approx(1.0, abs=0.05)
    assert circle.std() < 0.01
    assert smeared.std() > 0.1
    assert smeared.min() < 0.85
    assert smeared.max() > 1.1


def test_without_a_regulariser_a_mesh_is_nearer_to_the_data_and_farther_from_the_truth():
    spikes, smooth = end("spikes"), end("smooth")
    assert folded(spikes) > 0.4
    assert folded(smooth) < 0.02
    assert spikes.now.to_given < 0.8 * smooth.now.to_given
    assert spikes.now.to_truth > 1.5 * smooth.now.to_truth
    assert tone(spikes) == "wrong"
    assert tone(smooth) == "info"  # the ears are cut short
    assert farthest(smooth) > 0.05


def test_the_true_surface_stands_beside_the_fitted_mesh():
    scene = draw(end("smooth"))
    true, fitted = scene["true"], scene["mesh"]
    assert isinstance(true, Mesh)
    assert isinstance(fitted, Mesh)
    assert true.T_world_object is not None
    apart = true.p @ true.T_world_object[:3, :3].T + true.T_world_object[:3, 3]
    right = np.cross(np.subtract(RABBIT.target, RABBIT.eye), RABBIT.up)
    assert (apart @ right).min() > (fitted.p @ right).max()


def test_a_laplacian_of_a_hundred_is_too_much():
    assert (
        last_of(Params(task="mesh", laplacian=100.0)).now.to_truth
        > 1.3 * end("smooth").now.to_truth
    )


def test_a_pooled_network_does_not_know_the_order_of_points():
    state = end("pooled")
    plain, changed = (state.now.scores[name] for name in ("plain", "changed"))
    # a product's last rows are summed in another order
    rounding = 100 * np.finfo(np.float32).eps * np.abs(plain).max()
    np.testing.assert_allclose(changed, plain, rtol=0, atol=rounding)
    assert named(state, "plain") > 0.9
    listed = end("listed")
    assert named(listed, "plain") > 0.65
    assert named(listed, "changed") < 0.45


def test_critical_points_alone_give_the_same_answer():
    state = end("pooled")
    network = state.now.network
    for cloud, kept in zip(
        state.about.plain[:10], network.critical(state.about.plain[:10]), strict=True
    ):
        assert len(kept) < len(cloud)
        np.testing.assert_array_equal(
            network(cloud[kept][None]).argmax(), network(cloud[None]).argmax()
        )


def test_one_stray_point_ruins_the_maximum_and_hardly_the_mean():
    assert named(end("stray"), "changed") < 0.4
    mean = end("mean")
    assert named(mean, "plain") - named(mean, "changed") < 0.2
    assert named(mean, "plain") < named(end("stray"), "plain")


def test_invariance_to_order_is_none_to_rotation():
    assert named(end("turned"), "changed") < 0.5
    freely = last_of(replace(lesson.preset("turned").params, trained="freely"))
    assert named(freely, "changed") > named(end("turned"), "changed") + 0.2


def test_two_photographs_are_matched_better_than_many_and_show_less():
    two, many = end("two"), end("many")
    assert two.about.trained == pytest.approx(37, abs=0.5)
    assert two.about.trained > many.about.trained + 5
    assert two.about.unseen < 10
    assert many.about.unseen > 25
    assert overlap(two) < 0.4
    assert overlap(many) > 0.9
    assert (tone(two), tone(many)) == ("wrong", "good")


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("predict-cut", 175, 180),
        ("predict-radius", 0, 0),
        ("predict-stray", 15, 40),
        ("predict-views", 0, 0),
    ],
)
def test_answers(name, low, high):
    question = next(q for q in lesson.questions if q.name == name)
    assert low <= question.answer(states(question.params)) <= high


# slots --------------------------------------------------------------------------------------------


def test_a_mirrored_rotation_is_never_learned():
    def mirrored(y: np.ndarray) -> np.ndarray:
        return rotation_from_six(y) * [1.0, 1.0, -1.0]

    params = replace(lesson.preset("rotation").params, updates=20)
    assert last_of(params, rotation_from_six=mirrored).now.errors.min() > 30


def test_a_reversed_gradient_drives_the_points_away():
    params = replace(lesson.preset("smeared").params, updates=15)
    away = last_of(params, chamfer_gradient=lambda p, q: -chamfer_gradient(p, q))
    assert radii(away).mean() > radii(last_of(params)).mean() + 0.1
    mesh = replace(lesson.preset("spikes").params, updates=8)
    assert (
        last_of(mesh, chamfer_gradient=lambda p, q: -chamfer_gradient(p, q)).now.loss
        > last_of(mesh).now.loss
    )


def test_weights_that_hide_nothing_spoil_the_field():
    params = Params(task="field", updates=15)
    spoilt = last_of(params, ray_weights=lambda density, spacing: 1 - np.exp(-density * spacing))
    assert spoilt.about.unseen < last_of(params).about.unseen - 1


def test_whatever_is_clicked_on_is_looked_at():
    knob = next(field.knob for field in fields_of(Params) if field.name == "picked")
    counts = [
        len(as_a(Points, draw(next(run(Params(task=task))))["inputs"]).p)
        for task in ("angle", "rotation", "field")
    ]
    assert knob.high == max(counts) - 1
    for task, count in zip(("angle", "rotation"), counts, strict=False):
        scene = draw(next(run(Params(task=task, picked=count - 1))))
        np.testing.assert_allclose(scene["picked"].p[0][:2], scene["inputs"].p[-1][:2])  # type: ignore[union-attr]


def test_every_task_starts_at_once_and_ends_where_it_is_told():
    for task in ("angle", "rotation", "sets", "mesh", "classify", "field"):
        run_ = list(run(Params(task=task, updates=3)))
        assert (run_[0].now.updates, run_[-1].now.updates) == (0, 3)
        assert [state.last for state in run_].count(True) == 1
        assert run_[-1].last
