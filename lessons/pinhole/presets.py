"""Experiments with the camera, its classic mistakes, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lessons.pinhole.state import Params, State
from workbench.geometry.cameras import camera_center, project, vanishing_points
from workbench.geometry.motions import motion
from workbench.lesson import Choice, Preset, Question
from workbench.numerals import coordinates, fixed

DIVIDE, DISTORT, PIXELS, BACK = 2, 3, 4, 5

PLAIN = Params(k1=0.0, k2=0.0)
CRATE = replace(PLAIN, camera=(-0.6, 2.2, 1.3), target=(-1.4, 5.5, 0.5), f=200.0, point=1)
DOLLY = replace(CRATE, dolly=3.0)
ZOOM = replace(CRATE, f=400.0)
RAILS = replace(PLAIN, camera=(0.0, -3.0, 1.7), target=(0.0, 30.0, 0.5), point=4)
BALL = replace(PLAIN, camera=(0.2, 2.8, 1.2), target=(0.2, 12.0, 1.0), f=110.0)
BARREL = Params(k1=-0.4, k2=0.1)
PINCUSHION = Params(k1=0.4, k2=0.0)
BEHIND = Params(mistake="divides behind too", point=5)
INVERTED = Params(mistake="pose inverted")
LENS_ON_PIXELS = Params(mistake="lens on pixels")
RAY_LENGTH = Params(mistake="ray length for depth")
CROP_RIGHT = Params(edit="cropped, then half size")

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "dolly",
        "Dolly zoom",
        "Three times as far, three times the focal length: the crate keeps its size, since size"
        " goes with f / Z. Step on to read what the tower behind it does.",
        DOLLY,
        DIVIDE,
    ),
    Preset(
        "zoom",
        "Only f doubles",
        "Every pixel moves to twice its distance from the principal point and nothing else changes:"
        " zooming is cropping and enlarging, not moving.",
        ZOOM,
        PIXELS,
    ),
    Preset(
        "orthographic",
        "Orthographic: far away, long lens",
        "At fifty times the distance the rays are nearly parallel and depth hardly shows; the gap"
        " shrinks as one over the distance.",
        replace(PLAIN, dolly=50.0),
        PIXELS,
    ),
    Preset(
        "rails",
        "The rails' vanishing point",
        "The pictures of all lines of one direction d run towards one point, K R d. Look at what"
        " stands in that formula, and what does not.",
        RAILS,
        PIXELS,
    ),
    Preset(
        "ball",
        "A ball is an ellipse",
        "Its rays form a cone, and the flat picture cuts that cone at a slant: away from the middle"
        " a ball's outline is longer than wide.",
        BALL,
        PIXELS,
    ),
    Preset(
        "barrel",
        "Barrel: k₁ < 0",
        "Points move towards the middle, the further out the more; straight edges near the rim bow"
        " outwards like a barrel's staves.",
        BARREL,
        DISTORT,
    ),
    Preset(
        "pincushion",
        "Pincushion: k₁ > 0",
        "Points move away from the middle, the further out the more, and straight edges near the"
        " rim bow inwards.",
        PINCUSHION,
        DISTORT,
    ),
    Preset(
        "tangential",
        "A lens off centre: p₁, p₂",
        "Tangential terms push every point to within 30° of one direction, more so away from the"
        " middle: the shift is not along the radius.",
        Params(k1=0.0, k2=0.0, p1=0.06, p2=-0.05),
        DISTORT,
    ),
    Preset(
        "fold",
        "Where a lens model ends",
        "k₁ = −0.6 turns round at radius 0.745. Beyond it the polynomial would fold points back"
        " into the picture, so they get no pixel.",
        Params(camera=(0.5, 2.5, 1.2), k1=-0.6, k2=0.0, f=200.0),
        DISTORT,
    ),
    Preset(
        "behind",
        "A lamp behind the camera",
        "The followed lamp hangs behind the camera. Step on: it is divided by its negative depth"
        " like all others. Mask before you divide.",
        BEHIND,
        1,
    ),
    Preset(
        "inverted",
        "Camera-to-world for world-to-camera",
        "Both are 4×4 and rigid, so nothing complains. Nearly every point is then behind the camera"
        " and loses its pixel.",
        INVERTED,
        1,
    ),
    Preset(
        "opengl",
        "OpenGL axes",
        "A pose for y up and z backwards gives all that is in front a negative depth; dividing"
        " anyway gives a picture mirrored left to right.",
        Params(mistake="OpenGL axes"),
        PIXELS,
    ),
    Preset(
        "rows",
        "Row before column",
        "(u, v) is (column, row), arrays are indexed [row, column]: mixed up, the picture is"
        " flipped about its diagonal.",
        Params(mistake="row before column"),
        PIXELS,
    ),
    Preset(
        "lens-on-pixels",
        "The lens after K",
        "Distortion acts on normalised coordinates. Fed with pixels, its r² is f² times too large,"
        " and points fly 36 million pixels away (median).",
        LENS_ON_PIXELS,
        DISTORT,
    ),
    Preset(
        "crop-wrong",
        "Cropped, halved, K forgotten",
        "The picture lost its left and top and half its size, K knows of neither: the calculation"
        " is shifted and twice as large as it should be.",
        Params(edit="cropped, then half size", k_follows=False),
        PIXELS,
    ),
    Preset(
        "crop-right",
        "Cropped, halved, K too",
        "A crop moves the principal point, away from the middle of the picture; halving halves f as"
        " well. Now all fits again.",
        CROP_RIGHT,
        PIXELS,
    ),
    Preset(
        "centre",
        "t is not the camera",
        "t is the world's origin seen from the camera. Rays that start there miss every point by"
        " the distance from t to C = −Rᵀt.",
        Params(mistake="t for the centre"),
        BACK,
    ),
    Preset(
        "ray-length",
        "Depth is not ray length",
        "Points come back too far out, the more the further from the axis: flat walls come back"
        " curved.",
        RAY_LENGTH,
        BACK,
    ),
)


def tower_ratio(states: Sequence[State]) -> float:
    """Return how much taller the tower is in the picture than before the dolly."""
    return states[-1].shot.tower / states[-1].shot.tower_before


def _dolly_why(states: Sequence[State]) -> str:
    shot = states[-1].shot
    return (
        f"It grows from {shot.tower_before:.0f} to {shot.tower:.0f} px. Heights go with f / Z: f is"
        " three times as long, and the tower's Z, which was larger to begin with, did not grow"
        " three times."
    )


def _behind_answer(states: Sequence[State]) -> float:
    state = states[PIXELS]
    uv, (h, w) = state.now.uv[state.params.point], state.shot.picture.shape[:2]
    if not np.isfinite(uv).all():
        return 0.0
    return 2.0 if (uv > -0.5).all() and uv[0] < w - 0.5 and uv[1] < h - 0.5 else 1.0


def _behind_why(states: Sequence[State]) -> str:
    u, v = states[PIXELS].now.uv[states[0].params.point]
    z = states[1].now.p_camera[states[0].params.point, 2]
    return (
        f"At ({u:.0f}, {v:.0f}), well inside the picture. Z = {fixed(z, 2)} m turns both signs, and"
        " a lamp above the axis shows up below it. Only the sign of Z tells; the pixel does not."
    )


def _centre_answer(states: Sequence[State]) -> float:
    T = states[-1].shot.T_camera_world
    places = (T[:3, 3], -T[:3, 3])
    return next(
        (float(i) for i, p in enumerate(places) if np.linalg.norm(p - camera_center(T)) < 0.1), 2.0
    )


def _centre_why(states: Sequence[State]) -> str:
    T = states[-1].shot.T_camera_world
    C, t = camera_center(T), T[:3, 3]
    return (
        f"It is at C = −Rᵀt = {coordinates(C, 2)} m. t is where the camera sees the world's origin,"
        f" along its own axes. Both are {fixed(float(np.linalg.norm(t)), 2)} m long, since R only"
        " turns."
    )


def shift_of_vanishing(states: Sequence[State]) -> float:
    """Return how many pixels the rails' vanishing point moves when the camera steps 2 m to its
    right.
    """
    shot = states[-1].shot
    R, t = shot.T_camera_world[:3, :3], shot.T_camera_world[:3, 3]
    stepped = motion(R, t - np.array([2.0, 0.0, 0.0]))
    return float(
        (vanishing_points(np.array([[0.0, 1.0, 0.0]]), stepped, shot.K) - shot.vanishing)[0, 0]
    )


def _rails_why(states: Sequence[State]) -> str:
    state = states[-1]
    shot, near = state.shot, state.now.p_world[3:4]
    R, t = shot.T_camera_world[:3, :3], shot.T_camera_world[:3, 3]
    stepped = motion(R, t - np.array([2.0, 0.0, 0.0]))
    moved = (project(near, stepped, shot.K) - project(near, shot.T_camera_world, shot.K))[0, 0]
    return (
        f"It moves by {fixed(abs(shift_of_vanishing(states)), 0)} px, while a near point of the"
        f" rail moves by {fixed(abs(moved), 0)} px to the {'left' if moved < 0 else 'right'}. A"
        " direction has no place (w = 0), so t drops out of K [R | t] (d, 0) = K R d."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-dolly",
        "The camera backs off to three times its distance from the crate, and f becomes three times"
        " as long. The crate keeps its size. What does the tower behind it do in the picture?",
        answer=lambda states: (
            0.0 if tower_ratio(states) > 1.05 else 2.0 if tower_ratio(states) < 0.95 else 1.0
        ),
        why=_dolly_why,
        params=DOLLY,
        choices=(
            Choice("It grows"),
            Choice(
                "It keeps its size too",
                "It would if it stood at the crate's distance. Size goes with f / Z, and Z is"
                " another one for the tower.",
            ),
            Choice(
                "It shrinks",
                "It would if only the camera moved. The focal length has grown three times as"
                " well.",
            ),
        ),
        step=PIXELS,
    ),
    Question(
        "predict-behind",
        "A lamp hangs 2.25 m behind the camera, and somebody divides by Z without looking at its"
        " sign. Where is its pixel?",
        answer=_behind_answer,
        why=_behind_why,
        params=BEHIND,
        choices=(
            Choice(
                "Nowhere: the result is not a number",
                "Only Z = 0 gives no number. A negative Z divides like any other.",
            ),
            Choice(
                "Far outside the picture",
                "The size of x / Z does not depend on the sign of Z. Only the direction turns"
                " round.",
            ),
            Choice("In the picture, like any other"),
        ),
        step=PIXELS,
    ),
    Question(
        "predict-centre",
        "T_camera_world of another camera has t = (−1.32, 1.96, 4.55) m. Where in the world is that"
        " camera?",
        answer=_centre_answer,
        why=_centre_why,
        params=Params(camera=(2.0, -4.0, 2.5), target=(0.0, 8.0, 1.0)),
        choices=(
            Choice(
                "At t",
                "t is not a place in the world: it is the world's origin, given in the camera's"
                " frame.",
            ),
            Choice(
                "At −t",
                "It would be if the camera's axes were the world's. It is turned, so −t has to be"
                " turned back.",
            ),
            Choice("At neither of the two"),
        ),
        step=BACK,
    ),
    Question(
        "predict-rails",
        "The camera steps 2 m to its right without turning. Where does the point go in which the"
        " rails seem to meet?",
        answer=lambda states: (
            1.0 if abs(shift := shift_of_vanishing(states)) < 0.5 else 0.0 if shift < 0 else 2.0
        ),
        why=_rails_why,
        params=RAILS,
        choices=(
            Choice(
                "To the left in the picture",
                "Things nearby move to the left, by less the farther they are. This point is"
                " infinitely far away.",
            ),
            Choice("Nowhere: it stays"),
            Choice(
                "To the right in the picture",
                "That would be so if the camera turned to the left. It steps aside and keeps its"
                " direction.",
            ),
        ),
        step=PIXELS,
    ),
    Question(
        "predict-crop",
        "60 columns and 40 rows are cut off at the left and top, then the picture is halved. The"
        " principal point was at u = 159.5 px, where pixel centres are at integers. What is cx"
        " now?",
        answer=lambda states: float(states[-1].shot.K[0, 2]),
        why=lambda states: (
            f"{states[-1].shot.K[0, 2]:.2f} px: first 159.5 − 60 = 99.5, then (99.5 + 0.5) / 2 −"
            " 0.5, since pixel centres are at integers. The middle of the picture is"
            f" {(states[-1].shot.picture.shape[1] - 1) / 2} px."
        ),
        params=CROP_RIGHT,
        unit="px",
        tolerance=0.15,
        step=PIXELS,
        wrong=(
            (
                49.7,
                50.1,
                (
                    "Nearly. The picture begins at −0.5 px, the left edge of pixel 0. Halving keeps"
                    " this edge in place, and not the middle of pixel 0."
                ),
            ),
            (
                64.0,
                65.5,
                (
                    "That is the middle of the new picture. The crop has moved the principal point"
                    " away from the middle."
                ),
            ),
            (79.0, 80.5, "The picture was halved, but 60 columns are missing at the left too."),
            (
                99.0,
                100.5,
                "The crop is right. Then the picture was halved, and with it all its coordinates.",
            ),
            (159.0, 160.0, "K must follow what is done to the picture: this is the old one."),
        ),
    ),
)
