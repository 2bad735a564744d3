"""What each preset of the pinhole lesson promises, in numbers: cameras, lenses and mistakes."""

import dataclasses

import numpy as np
import pytest

from lessons.pinhole import presets
from lessons.pinhole.captions import back_error, blame
from lessons.pinhole.charts import FARTHER, gaps
from lessons.pinhole.inputs import Input as Params
from lessons.pinhole.lesson import lesson
from lessons.pinhole.presets import BACK, DISTORT, DIVIDE, PIXELS
from lessons.pinhole.questions import moved_aside
from lessons.pinhole.shot import heights
from lessons.pinhole.shot import setup as shot_of
from tests.lessons.pinhole_runs import look, orange, preset, states, tone
from workbench.data.views.street import BALL_CENTER, street
from workbench.geometry.cameras import camera_center, depths, intrinsics, project, vanishing_points
from workbench.geometry.cameras.distortion import distort, invertible_radius
from workbench.geometry.motions import inverse
from workbench.run.timeline import Timeline
from workbench.scene import Picture


def test_dolly_keeps_the_crate_and_nearly_doubles_the_tower():
    after = preset("dolly").subject
    crate, tower = heights(presets.DOLLY, 1.0)
    assert after.crate == pytest.approx(crate, rel=0.01)
    assert round(after.crate) == 56
    assert (round(tower), round(after.tower)) == (97, 172)
    for by, expected in ((0.5, 59), (2.0, 145), (10.0, 235), (50.0, 269)):
        assert round(heights(presets.DOLLY, by)[1]) == expected
    # "towards five crates"
    assert heights(presets.DOLLY, 1e6)[1] == pytest.approx(5 * crate, rel=0.01)


def test_the_pane_keeps_its_place_and_its_size_while_the_camera_backs_off():
    panes = []
    for by in (1.0, 3.0):
        picture = (
            Timeline(lesson, dataclasses.replace(presets.CRATE, dolly=by))
            .complete()[PIXELS]
            .scene["picture"]
        )
        assert isinstance(picture, Picture)
        assert picture.T_world_object is not None
        panes.append((picture.width, picture.T_world_object[:3, 3]))
    assert panes[0][0] == pytest.approx(panes[1][0])
    np.testing.assert_allclose(panes[0][1], panes[1][1], atol=0.01)


def test_doubling_f_doubles_every_distance_from_the_principal_point():
    near = states(dataclasses.replace(presets.ZOOM, f=presets.ZOOM.f / 2))[-1]
    far = preset("zoom")[-1]
    c = preset("zoom").subject.K[:2, 2]
    np.testing.assert_allclose(far.now.uv - c, 2 * (near.now.uv - c), atol=1e-9)
    np.testing.assert_allclose(far.now.xy, near.now.xy, atol=1e-12)


def test_orthographic_gap_shrinks_as_one_over_the_distance():
    run_ = preset("orthographic")
    shot = run_.subject
    all_gaps = gaps(run_.params)
    assert shot.gap < 3
    assert all_gaps[0] > 50
    rate = np.diff(np.log(all_gaps[-6:])) / np.diff(np.log(FARTHER[-6:]))
    np.testing.assert_allclose(rate, -1.0, atol=0.05)
    n = street().edges.reshape(-1, 3) - camera_center(shot.T_camera_world)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    assert np.degrees(np.arccos((n @ n.T).min())) < 2  # the rays are nearly parallel


def test_rails_meet_where_the_formula_says_wherever_the_camera_stands():
    run_ = preset("rails")
    shot = run_.subject
    far = np.array([[x, 1e7, 0.06] for x in (-0.75, 0.75)])
    np.testing.assert_allclose(
        project(far, shot.T_camera_world, shot.K), [shot.vanishing] * 2, atol=1e-3
    )
    assert abs(moved_aside(states(presets.ASIDE))[0]) < 1e-9
    moved = shot.T_camera_world.copy()
    moved[:3, 3] = (7.0, -3.0, 2.0)
    np.testing.assert_allclose(
        vanishing_points(np.array([[0.0, 1, 0]]), moved, shot.K)[0], shot.vanishing
    )
    assert (shot.vanishing > 0).all()
    assert (shot.vanishing < [320, 240]).all()


def test_the_ball_is_an_ellipse_off_the_axis_and_round_on_it():
    shot = preset("ball").subject
    assert shot.ball_ratio > 1.35
    on_axis = dataclasses.replace(presets.BALL, target=tuple(float(x) for x in BALL_CENTER))
    assert shot_of(on_axis).ball_ratio == pytest.approx(1.0, abs=1e-9)


def radial_moves(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    state = preset(name)[DISTORT]
    xy = state.now.xy
    move = state.now.xy_bent - state.now.xy
    seen = np.isfinite(xy).all(axis=1)
    r = np.linalg.norm(xy[seen], axis=1)
    outwards = np.einsum("ni,ni->n", move[seen], xy[seen]) / r
    sideways = (move[seen, 0] * xy[seen, 1] - move[seen, 1] * xy[seen, 0]) / r
    return r, outwards, sideways


@pytest.mark.parametrize(("name", "sign"), [("barrel", -1), ("pincushion", 1)])
def test_radial_lenses_move_along_the_radius_and_more_further_out(name, sign):
    r, outwards, sideways = radial_moves(name)
    assert (sign * outwards > 0).all()
    np.testing.assert_allclose(sideways, 0.0, atol=1e-12)
    assert (np.diff((sign * outwards)[np.argsort(r)]) > -1e-12).all()
    assert np.abs(outwards).max() * 260 > 10


def test_barrel_bows_edges_outwards_and_pincushion_inwards():
    """The middle of a straight edge above the centre, against the line through its bent ends."""
    edge = np.column_stack([[-0.5, 0.0, 0.5], [-0.4, -0.4, -0.4]])
    for params, sign in (
        (lesson.preset("barrel").params, 1),
        (lesson.preset("pincushion").params, -1),
    ):
        ends = distort(edge, params.k1, params.k2)
        bow = ends[[0, 2], 1].mean() - ends[1, 1]  # y points down: positive is outwards here
        assert sign * bow > 0.005


def test_tangential_shifts_are_not_along_the_radius_and_all_go_one_way():
    r, outwards, sideways = radial_moves("tangential")
    assert np.abs(sideways).max() > 0.3 * np.abs(outwards).max()
    state = preset("tangential")[DISTORT]
    move = state.now.xy_bent - state.now.xy
    params = preset("tangential").params
    along = move[np.isfinite(move).all(axis=1)] @ np.array([params.p2, params.p1])
    assert (along > 0).all()
    order = np.argsort(r)
    size = np.hypot(outwards, sideways)[order]
    assert size[-10:].mean() > 5 * size[:10].mean()


def test_beyond_the_fold_there_is_no_pixel():
    run_ = preset("fold")
    fold = invertible_radius(run_.subject.lens)
    assert fold == pytest.approx(0.745, abs=5e-4)
    assert run_[DISTORT].found < run_[DIVIDE].found - 10
    r = np.linalg.norm(run_[DIVIDE].now.xy, axis=1)
    np.testing.assert_array_equal(np.isfinite(run_[PIXELS].now.uv).all(axis=1), r < fold)
    folded = distort(run_[DIVIDE].now.xy, *run_.subject.lens)[r > fold]
    # it would have landed in the picture
    assert (np.abs(folded * 200) < [160, 120]).all(axis=1).any()


def test_a_lamp_behind_gets_a_pixel_well_inside_only_if_divided_anyway():
    state = preset("behind")[PIXELS]
    u, v = state.now.uv[5]
    assert 40 < u < 280
    assert 40 < v < 200
    assert state.false == 1
    assert round(state.now.p_camera[5, 2]) == -2
    assert np.isnan(states(Params(point=5))[PIXELS].now.uv[5]).all()
    assert tone(presets.BEHIND, PIXELS) == "info"  # it was asked for


def test_the_inverted_pose_loses_nearly_every_point():
    state = preset("inverted")[PIXELS]
    assert state.missed == 83
    assert (state.now.p_camera[:, 2] < 0).sum() >= 83
    np.testing.assert_allclose(
        state.now.p_camera[2],
        (inverse(shot_of(Params()).T_camera_world) @ [*street().points[2], 1])[:3],
    )
    assert tone(lesson.preset("inverted").params, 1) == "info"


def test_opengl_axes_make_depths_negative_and_mirror_the_picture():
    state = preset("opengl")[PIXELS]
    shot = shot_of(Params())
    seen = np.isfinite(shot.uv).all(axis=1)
    assert (state.now.p_camera[seen, 2] < 0).all()
    mirrored = shot.uv * [-1, 1] + [2 * shot.K[0, 2], 0]
    np.testing.assert_allclose(state.now.uv[seen], mirrored[seen], atol=1e-9)


def test_row_before_column_flips_about_the_diagonal_and_its_round_trip_closes():
    run_ = preset("rows")
    np.testing.assert_allclose(run_[PIXELS].now.uv, run_.subject.uv[:, ::-1], atol=1e-9)
    assert run_[PIXELS].error > 50
    assert run_[DISTORT].error < 1e-9
    assert back_error(look(run_, BACK)) < 1e-6


def test_a_lens_fed_with_pixels_is_off_by_millions():
    run_ = preset("lens-on-pixels")
    assert run_[DIVIDE].error < 1e-9
    assert run_[DISTORT].error == pytest.approx(36.1e6, rel=0.01)
    assert (
        Timeline(lesson, lesson.preset("lens-on-pixels").params)
        .complete()[PIXELS]
        .caption.text.startswith("K puts the tower's top at column u = ")
    )
    assert not orange(run_[PIXELS].picture).any()


def test_a_forgotten_k_is_shifted_and_twice_too_large():
    wrong = preset("crop-wrong")
    right = preset("crop-right")
    assert wrong[DISTORT].error < 1e-9
    assert wrong[PIXELS].error > 100
    assert right[PIXELS].error < 1e-9
    both = np.isfinite(right[PIXELS].now.uv).all(axis=1)
    a = wrong[PIXELS].now.uv[both]
    b = right[PIXELS].now.uv[both]
    np.testing.assert_allclose(np.ptp(a, axis=0), 2 * np.ptp(b, axis=0))
    shot = right.subject
    assert shot.picture.shape == (100, 130, 3)
    np.testing.assert_allclose(shot.K, intrinsics(130.0, 49.5, 39.5))
    assert abs(shot.K[0, 2] - 64.5) > 10


def test_the_edited_photograph_is_the_one_its_k_describes():
    """Corners of the outline, drawn by the edited K, lie where the halved photograph has its own
    edges.
    """
    full = shot_of(Params())
    half = shot_of(presets.CROP_RIGHT)
    np.testing.assert_allclose((half.uv + 0.5) * 2 - 0.5 + [60, 40], full.uv)
    blocks = full.picture[40:, 60:].reshape(100, 2, 130, 2, 3).mean(axis=(1, 3))
    assert np.abs(half.picture - blocks).max() <= 0.5


def test_rays_from_t_miss_every_point_by_the_distance_to_the_camera():
    state = preset("centre")[BACK]
    T = shot_of(Params()).T_camera_world
    off = np.linalg.norm(T[:3, 3] - camera_center(T))
    miss = np.linalg.norm(state.now.p_back - state.now.p_world, axis=1)
    np.testing.assert_allclose(miss[np.isfinite(miss)], off)
    assert off > 4
    assert state.error < 1e-9  # all pixels are right


def test_ray_length_for_depth_pushes_points_out_more_off_the_axis():
    state = preset("ray-length")[BACK]
    r2 = (state.now.xy**2).sum(axis=1)
    z = depths(state.now.p_world, shot_of(Params()).T_camera_world)
    beyond = depths(state.now.p_back, shot_of(Params()).T_camera_world) / z
    seen = np.isfinite(r2)
    np.testing.assert_allclose(beyond[seen], np.sqrt(1 + r2[seen]))
    assert beyond[seen].max() > 1.05
    assert state.error < 1e-9


@pytest.mark.parametrize("name", [p.name for p in lesson.presets])
def test_a_preset_tells_its_mistake_where_it_shows_and_only_then_and_calmly(name):
    params = lesson.preset(name).params
    timeline = Timeline(lesson, params).complete()
    run_ = states(params)
    assert {step.caption.tone for step in timeline.known()} == {"info"}
    told = [bool(blame(look(run_, k))[0]) for k in range(len(run_))]
    broken = (params.mistake != "none" or not params.k_follows) and params != presets.ON_RAY
    assert any(told) == broken
    step = lesson.preset(name).step
    assert told[step or 0] == (broken and name != "behind")  # asked about: it shows a step later
    assert max(len(step.caption.text) for step in timeline.known()) <= 250
