"""What the pinhole lesson promises beside its presets, in numbers: the default run on its page, the
pane and what lands on it, and the questions.
"""

import dataclasses

import numpy as np
import pytest

from lessons.pinhole import following as pinhole
from lessons.pinhole import presets
from lessons.pinhole.captions import back_error, depth
from lessons.pinhole.inputs import Input as Params
from lessons.pinhole.lesson import lesson
from lessons.pinhole.presets import BACK, DISTORT, DIVIDE, PIXELS
from lessons.pinhole.shot import setup as shot_of
from tests.lessons.pinhole_runs import look, orange, question, states, tone
from tests.runs import finished
from workbench.data.views.street import street
from workbench.errors import InputError
from workbench.geometry.cameras import camera_center, depths, project
from workbench.geometry.motions import apply
from workbench.knobs import fields_of
from workbench.run.picking import picked
from workbench.run.timeline import Timeline
from workbench.scene import Label, Picture, Points, Segments

# The default run


def test_the_default_run_is_right_at_every_stage():
    run_ = states(Params())
    assert [state.now.stage for state in run_] == [
        "world",
        "camera",
        "divide",
        "distort",
        "pixels",
        "back",
    ]
    for state in run_[DIVIDE:]:
        assert state.error < 1e-9
        assert state.missed == state.false == 0
    assert back_error(look(run_, BACK)) < 1e-9
    assert {tone(Params(), k) for k in range(6)} == {"info"}


def test_the_stages_are_what_the_page_says():
    params = Params(point=7)
    final_run = states(params)
    final = final_run[-1]
    T = final_run.subject.T_camera_world
    K = final_run.subject.K
    p = street().points[7]
    X, Y, Z = T[:3, :3] @ p + T[:3, 3]
    x = X / Z
    y = Y / Z
    r2 = x * x + y * y
    bent = np.array([x, y]) * (1 + params.k1 * r2 + params.k2 * r2**2)
    np.testing.assert_allclose(final.now.p_camera[7], [X, Y, Z])
    np.testing.assert_allclose(final.now.xy[7], [x, y])
    np.testing.assert_allclose(final.now.xy_bent[7], bent)
    np.testing.assert_allclose(final.now.uv[7], (K @ [*bent, 1.0])[:2])
    np.testing.assert_allclose(final.now.p_back[7], p, atol=1e-12)
    np.testing.assert_allclose(final.now.p_center, params.camera)


def test_the_lens_moves_points_up_to_12_px():
    state = states(Params())[DISTORT]
    moved = np.linalg.norm(state.now.xy_bent - state.now.xy, axis=1) * shot_of(Params()).K[0, 0]
    assert 11 < np.nanmax(moved) < 12


def test_the_calculated_outlines_lie_on_the_photograph():
    """The corners' true pixels are orange: photograph, lens and calculation agree."""
    run_ = states(Params())
    state = run_[PIXELS]
    shot = run_.subject
    u, v = np.rint(project(street().edges[:, 0], shot.T_camera_world, shot.K, shot.lens)).T.astype(
        int
    )
    hit = [
        orange(state.picture)[b - 1 : b + 2, a - 1 : a + 2].any() for a, b in zip(u, v, strict=True)
    ]
    assert np.mean(hit) > 0.95


@pytest.mark.parametrize("k", [DIVIDE, DISTORT])
def test_outlines_and_dots_agree_at_every_stage(k):
    """They were those of the whole calculation, 12 px from the dots, before the lens had bent
    anything.
    """
    timeline = finished(lesson.name, Params())
    shot = shot_of(Params())
    state = timeline[k].state
    scene = timeline[k].scene
    picture = scene["picture"]
    dots = scene["plane"]
    assert isinstance(picture, Picture)
    assert isinstance(dots, Points)
    eye = camera_center(shot.T_camera_world)
    pixels = [picked(picture, eye, place - eye) for place in dots.p]
    inside = [
        pixel
        for pixel in pixels
        if isinstance(pixel, tuple) and 3 < pixel[0] < 316 and 3 < pixel[1] < 236
    ]
    assert len(inside) > 60
    corners = [
        b for b in inside if orange(state.picture)[b[1] - 2 : b[1] + 3, b[0] - 2 : b[0] + 3].any()
    ]
    assert len(corners) > 0.6 * len(inside)  # those of the balls have no outline
    if k == DIVIDE:  # against the photograph, which the lens has bent, they are off
        true = shot.uv[np.isfinite(shot.uv).all(axis=1)]
        ideal = pinhole.onto_pixels(state.now.xy, shot.K)[np.isfinite(shot.uv).all(axis=1)]
        assert np.linalg.norm(true - ideal, axis=1).max() > 11


@pytest.mark.parametrize("k", [0, 1])
def test_before_the_division_nothing_is_laid_over_the_photograph(k):
    assert not orange(finished(lesson.name, Params())[k].state.picture).any()


@pytest.mark.parametrize("name", ["inverted", "opengl"])
def test_the_scene_shows_where_the_calculation_says_the_point_is(name):
    """The label read Z = 16.03 m, of the true pose, under a caption with Z = −11.79 m."""
    step = finished(lesson.name, lesson.preset(name).params)[1]
    X, Y, Z = step.state.now.p_camera[2]
    for axis, value in zip("XYZ", (X, Y, Z), strict=True):
        label = step.scene[f"calculated/{axis}"]
        true = step.scene[f"ways/{axis}"]
        assert isinstance(label, Label)
        assert isinstance(true, Label)
        assert (label.color, true.color) == ("wrong", "truth")
        assert label.text == f"{axis} = {depth(value)}"
        assert label.text != true.text or np.isclose(
            value, apply(shot_of(Params()).T_camera_world, step.state.now.p_world[2])[0]
        )
    assert f"Z = {depth(Z)}" in step.caption.text
    assert "calculated" not in finished(lesson.name, Params())[1].scene


def test_the_point_knob_reaches_every_point():
    field = next(field for field in fields_of(Params) if field.name == "point")
    assert (field.knob.low, field.knob.high) == (0, len(street().points) - 1)


def test_four_points_on_one_ray_share_the_pixel():
    timeline = Timeline(lesson, Params()).complete()
    state = timeline[BACK].state
    scene = timeline[BACK].scene
    shot = shot_of(Params())
    candidates = scene["candidates"]
    assert isinstance(candidates, Points)
    marks = candidates.p
    assert len(marks) == 4
    uv = project(marks, shot.T_camera_world, shot.K, shot.lens)
    np.testing.assert_allclose(uv, np.tile(state.now.uv[2], (4, 1)), atol=1e-6)
    np.testing.assert_allclose(depths(marks, shot.T_camera_world), [2, 4, 8, 16])


def test_the_camera_may_not_stand_on_its_target():
    with pytest.raises(InputError, match="target"):
        states(Params(camera=(1.0, 2.0, 3.0), target=(1.0, 2.0, 3.0)))


# The pane


def test_the_pane_stands_on_the_rays_of_its_pixels():
    for params in (Params(), presets.CROP_RIGHT, presets.BEHIND, presets.DOLLY, presets.ASIDE):
        step = Timeline(lesson, params).complete()[PIXELS]
        shot = shot_of(params)
        picture = step.scene["picture"]
        assert isinstance(picture, Picture)
        uv = np.array([[0.0, 0.0], [33.0, 50.0], [90.0, 20.0]])
        seen = project(picture.places(uv), shot.T_camera_world, shot.K)
        np.testing.assert_allclose(seen, uv, atol=1e-6)
        away = depths(picture.places(uv), shot.T_camera_world)
        np.testing.assert_allclose(away, params.pane * params.dolly)


def test_what_lands_on_the_pane_lies_at_its_pixels():
    for params in (Params(), presets.CROP_RIGHT, presets.BEHIND):
        step = Timeline(lesson, params).complete()[PIXELS]
        shot = shot_of(params)
        dots = step.scene["plane"]
        landed = step.scene["landed"]
        assert isinstance(dots, Points)
        assert isinstance(landed, Points)
        uv = step.state.now.uv
        assert 70 <= len(dots.p) <= np.isfinite(uv).all(axis=1).sum()
        seen = project(landed.p, shot.T_camera_world, shot.K)[0]
        np.testing.assert_allclose(seen, uv[params.point], atol=2.5)


def test_the_dot_stays_while_the_lamp_goes_along_its_ray():
    dots = []
    for z in (2.0, 8.0, 16.0):
        timeline = Timeline(lesson, dataclasses.replace(presets.LAMP, z=z)).complete()
        landed = timeline[0].scene["landed"]
        lamp = timeline[0].scene["followed"]
        assert isinstance(landed, Points)
        assert isinstance(lamp, Points)
        assert depths(lamp.p, shot_of(presets.LAMP).T_camera_world)[0] == pytest.approx(z)
        dots.append(landed.p[0])
        ring = timeline[0].scene["landed/ring"]
        assert isinstance(ring, Segments)
        np.testing.assert_allclose(ring.ends[:, 0].mean(axis=0), landed.p[0], atol=1e-9)
    np.testing.assert_allclose(dots, [dots[0]] * 3, atol=1e-9)


def test_captions_speak_of_what_this_camera_is_about():
    for name, step, text in (
        ("crate", PIXELS, "The crate is 56 px high, the tower 97 px."),
        ("rails", PIXELS, "The rails meet at (159.5, 110.0)."),
        ("cut", 0, "The picture now begins 60 columns further right."),
        ("lamp", PIXELS, "K puts the lamp at column u = 96.2, row v = 49.3."),
    ):
        shown = Timeline(lesson, lesson.preset(name).params).complete()[step]
        assert shown.caption.text == text


def test_behind_the_camera_the_lamp_keeps_its_dot_if_divided_anyway():
    ahead, behind = (states(dataclasses.replace(presets.ON_RAY, z=z)) for z in (8.0, -8.0))
    k = ahead.subject.k
    np.testing.assert_allclose(ahead[DIVIDE].now.xy[k], behind[DIVIDE].now.xy[k], atol=1e-12)
    assert np.isnan(behind.subject.uv[k]).all()
    assert behind[DIVIDE].false == 1


def test_a_turn_moves_t_and_leaves_the_camera_where_it_is():
    straight, turned = (shot_of(Params(turn=angle)) for angle in (0.0, 20.0))
    np.testing.assert_allclose(camera_center(turned.T_camera_world), Params().camera, atol=1e-12)
    assert np.linalg.norm(turned.T_camera_world[:3, 3] - straight.T_camera_world[:3, 3]) > 0.5
    ahead = turned.T_camera_world[2, :3]
    assert ahead[0] > straight.T_camera_world[2, 0]  # to the right


@pytest.mark.parametrize(("angle", "moved"), [(5.0, 22.8), (10.0, 45.9), (20.0, 94.7)])
def test_a_turn_moves_the_vanishing_point(angle, moved):
    first, turned = (
        shot_of(dataclasses.replace(presets.RAILS, turn=turn)).vanishing for turn in (0.0, angle)
    )
    assert np.linalg.norm(turned - first) == pytest.approx(moved, abs=0.06)


def test_a_cut_moves_cx_by_as_many_columns():
    for cut in (0, 30, 120):
        shot = shot_of(Params(edit="cropped", cut=cut))
        assert shot.K[0, 2] == 159.5 - cut
        assert shot.picture.shape == (200, 320 - cut, 3)


def test_a_lamp_behind_is_drawn_through_the_camera_to_the_plane_in_front():
    step = Timeline(lesson, presets.BEHIND).complete()[DIVIDE]
    ray = step.scene["ray"]
    shot = shot_of(presets.BEHIND)
    assert isinstance(ray, Segments)
    in_camera = apply(shot.T_camera_world, ray.ends[0])
    np.testing.assert_allclose(in_camera[0] / 2, [*step.state.now.xy[5], 1.0], atol=1e-9)
    assert in_camera[1, 2] < 0


# Questions


@pytest.mark.parametrize(
    ("name", "right"),
    [
        ("predict-dolly", 0),
        ("predict-behind", 2),
        ("predict-centre", 2),
        ("through-the-middle", 2),
        ("predict-rails", 1),
        ("predict-crop", pytest.approx(49.5)),
    ],
)
def test_questions_are_answered_by_their_runs(name, right):
    assert question(name).answer(states(question(name).params)) == right


def test_known_wrong_answers_are_answered_and_not_right():
    """Halving 99.5 px to 49.75 px forgets where a picture begins, and was within the tolerance."""
    crop = question("predict-crop")
    for given in (49.75, 50.0, 64.5, 79.5, 99.5, 159.5):
        assert crop.reply(given)
        assert abs(given - 49.5) > crop.tolerance
    for q in lesson.questions:
        right = q.answer(states(q.params))
        for i, choice in enumerate(q.choices):
            assert bool(q.reply(i)) == (i != right), choice


def test_the_text_of_the_centre_question_states_the_t_of_its_camera():
    asked = question("predict-centre")
    T = shot_of(asked.params).T_camera_world
    assert "(" + ", ".join(f"{x:.2f}" for x in T[:3, 3]).replace("-", "−") + ")" in asked.text
    assert asked.params.camera != Params().camera  # which stands on the knobs beside the question
    np.testing.assert_allclose(camera_center(T), asked.params.camera)
    assert "C = −Rᵀt = (2.00, −4.00, 2.50) m" in asked.why(states(asked.params))
    assert f"{np.linalg.norm(T[:3, 3]):.2f} m long" in asked.why(states(asked.params))
