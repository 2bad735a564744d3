"""Experiments with the camera, its classic mistakes, and how the street is seen."""

from dataclasses import replace

import numpy as np

from lessons.pinhole.inputs import Input
from lessons.pinhole.shot import pinhole_of
from workbench.geometry.cameras import camera_center
from workbench.lesson import Preset, Sweep, View

CAMERA = 1
DIVIDE = 2
DISTORT = 3
PIXELS = 4
BACK = 5

PLAIN = Input(k1=0.0, k2=0.0)
LAMP = replace(PLAIN, z=8.0)
CRATE = replace(
    PLAIN,
    camera=(-0.6, 2.2, 1.3),
    target=(-1.4, 5.5, 0.5),
    f=200.0,
    point=1,
    pane=3.49,
    heights=True,
)
DOLLY = replace(CRATE, dolly=3.0)
ZOOM = replace(CRATE, f=400.0, pane=6.98)
RAILS = replace(PLAIN, camera=(0.0, -3.0, 1.7), target=(0.0, 30.0, 0.5), point=4)
ASIDE = replace(RAILS, aside=2.0)
BALL = replace(PLAIN, camera=(0.2, 2.8, 1.2), target=(0.2, 12.0, 1.0), f=110.0)
RADIAL = Input(k1=-0.3, k2=0.0)
FOLD = Input(camera=(0.5, 2.5, 1.2), k1=-0.6, k2=0.0, f=200.0)
FRAME = Input(camera=(2.0, -4.0, 2.5), target=(0.0, 8.0, 1.0))
BEHIND = Input(mistake="divides behind too", point=5)
ON_RAY = replace(LAMP, mistake="divides behind too")
CROP_RIGHT = Input(edit="cropped, then half size")


def through(params: Input, fov: float = 52.0) -> View:
    """Return the view of an eye at the camera's own centre, in which the pane faces us."""
    T = pinhole_of(params, 1.0).T_camera_world
    C = camera_center(T)
    eye = np.round(C, 4).tolist()
    ahead = np.round(C + 10.0 * T[2, :3], 4).tolist()
    return View(eye=tuple(eye), target=tuple(ahead), grid=None, fov_degrees=fov, axes=False)


VIEW = View(
    eye=(2.2, -5.3, 2.3), target=(0.15, 0.6, 1.75), grid=None, grid_height=-0.02, axes=False
)
FACING = through(PLAIN)
SIDE = View(eye=(-21.5, 3.3, 3.0), target=(-0.9, 5.7, 2.1), grid=None, axes=False)
OBLIQUE = View(eye=(8.0, -10.2, 4.9), target=(1.1, -1.0, 1.4), grid=None, axes=False)
ENDS = View(eye=(5.8, -5.9, 3.05), target=(1.315, -2.0, 1.15), grid=None, axes=False)
BEHIND_VIEW = View(eye=(5.0, -8.8, 3.2), target=(0.2, 0.5, 1.4), grid=None, axes=False)
RAILS_VIEW = View(eye=(1.0, -5.6, 2.2), target=(0.95, 2.0, 1.35), grid=None, axes=False)
FAR_VIEW = View(eye=(4.0, -21.0, 5.0), target=(0.3, -4.0, 2.4), grid=None, axes=False)
VIEWS = {
    "behind": VIEW,
    "facing": FACING,
    "side": SIDE,
    "frames": OBLIQUE,
    "ends": ENDS,
    "ball": through(BALL, 96.0),
    "rails": RAILS_VIEW,
    "far": FAR_VIEW,
    "fold": through(FOLD, 64.0),
    "back": BEHIND_VIEW,
}

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="lamp",
        title="A lamp on a ray",
        line="Move the lamp along its ray, or push the pane away, and watch its dot in the"
        " picture.",
        params=LAMP,
        step=0,
    ),
    Preset(
        name="lamp-1",
        title="The pane at 1 m",
        line="Half as far from the camera, the same picture is half as large.",
        params=replace(LAMP, pane=1.0),
        step=0,
    ),
    Preset(
        name="lamp-4",
        title="The pane at 4 m",
        line="Twice as far from the camera, the same picture is twice as large.",
        params=replace(LAMP, pane=4.0),
        step=0,
    ),
    Preset(
        name="crate",
        title="Two triangles",
        line="The rays to the crate and to the tower, from the side: the pane stands at the crate.",
        params=CRATE,
        step=PIXELS,
        view=SIDE,
    ),
    Preset(
        name="dolly",
        title="Dolly zoom",
        line="Three times as far, three times the focal length: the crate keeps its size, since"
        " size goes with f / Z. Step on to read what the tower behind it does.",
        params=DOLLY,
        step=DIVIDE,
        view=SIDE,
    ),
    Preset(
        name="zoom",
        title="Only f doubles",
        line="Every pixel moves to twice its distance from the principal point and nothing else"
        " changes: zooming is cropping and enlarging, not moving.",
        params=ZOOM,
        step=PIXELS,
        view=SIDE,
    ),
    Preset(
        name="orthographic",
        title="Orthographic: far away, long lens",
        line="At fifty times the distance the rays are nearly parallel and depth hardly shows; the"
        " gap shrinks as one over the distance.",
        params=replace(PLAIN, dolly=50.0, pane=10.79),
        step=PIXELS,
        view=FAR_VIEW,
    ),
    Preset(
        name="rails",
        title="The rails' vanishing point",
        line="The pictures of all lines of one direction d run towards one point, K R d. Look at"
        " what stands in that formula, and what does not.",
        params=RAILS,
        step=PIXELS,
        view=RAILS_VIEW,
    ),
    Preset(
        name="ball",
        title="A ball is an ellipse",
        line="Its rays form a cone, and the flat picture cuts that cone at a slant: away from the"
        " middle a ball's outline is longer than wide.",
        params=BALL,
        step=PIXELS,
        view=VIEWS["ball"],
    ),
    Preset(
        name="radial",
        title="One number bends the picture",
        line="A straight grid, and the same grid behind the lens. Turn k₁ through zero.",
        params=RADIAL,
        step=DISTORT,
        view=FACING,
    ),
    Preset(
        name="barrel",
        title="Barrel: k₁ < 0",
        line="Points move towards the middle, the further out the more; straight edges near the"
        " rim bow outwards like a barrel's staves.",
        params=Input(k1=-0.4, k2=0.1),
        step=DISTORT,
        view=FACING,
    ),
    Preset(
        name="pincushion",
        title="Pincushion: k₁ > 0",
        line="Points move away from the middle, the further out the more, and straight edges near"
        " the rim bow inwards.",
        params=Input(k1=0.4, k2=0.0),
        step=DISTORT,
        view=FACING,
    ),
    Preset(
        name="tangential",
        title="A lens off centre: p₁, p₂",
        line="Tangential terms push every point to within 30° of one direction, more so away from"
        " the middle: the shift is not along the radius.",
        params=Input(k1=0.0, k2=0.0, p1=0.06, p2=-0.05),
        step=DISTORT,
        view=FACING,
    ),
    Preset(
        name="fold",
        title="Where a lens model ends",
        line="k₁ = −0.6 turns round at radius 0.745. Beyond it the polynomial would fold points"
        " back into the picture, so they get no pixel.",
        params=FOLD,
        step=DISTORT,
        view=VIEWS["fold"],
        breaks=True,
    ),
    Preset(
        name="on-ray",
        title="Along the ray, and behind the camera",
        line="Somebody divides by Z whatever its sign. Move the lamp along its ray, through the"
        " camera and on.",
        params=ON_RAY,
        step=DIVIDE,
        view=BEHIND_VIEW,
        breaks=True,
    ),
    Preset(
        name="behind",
        title="A lamp behind the camera",
        line="The followed lamp hangs behind the camera. Step on: it is divided by its negative"
        " depth like all others. Mask before you divide.",
        params=BEHIND,
        step=CAMERA,
        view=BEHIND_VIEW,
        breaks=True,
    ),
    Preset(
        name="inverted",
        title="Camera-to-world for world-to-camera",
        line="Both are 4×4 and rigid, so nothing complains. Nearly every point is then behind the"
        " camera and loses its pixel.",
        params=Input(mistake="pose inverted"),
        step=CAMERA,
        view=OBLIQUE,
        breaks=True,
    ),
    Preset(
        name="opengl",
        title="OpenGL axes",
        line="A pose for y up and z backwards gives all that is in front a negative depth;"
        " dividing anyway gives a picture mirrored left to right.",
        params=Input(mistake="OpenGL axes"),
        step=PIXELS,
        view=FACING,
        breaks=True,
    ),
    Preset(
        name="rows",
        title="Row before column",
        line="(u, v) is (column, row), arrays are indexed [row, column]: mixed up, the picture is"
        " flipped about its diagonal.",
        params=Input(mistake="row before column"),
        step=PIXELS,
        view=FACING,
        breaks=True,
    ),
    Preset(
        name="lens-on-pixels",
        title="The lens after K",
        line="Distortion acts on normalised coordinates. Fed with pixels, its r² is f² times too"
        " large, and points fly 36 million pixels away (median).",
        params=Input(mistake="lens on pixels"),
        step=DISTORT,
        view=FACING,
        breaks=True,
    ),
    Preset(
        name="cut",
        title="Columns cut off, K forgotten",
        line="The pane loses columns at its left and rows at its top. K does not know, and the"
        " orange outlines slide to the right and down by as many pixels.",
        params=Input(edit="cropped", k_follows=False),
        step=PIXELS,
        view=FACING,
        breaks=True,
    ),
    Preset(
        name="crop-wrong",
        title="Cropped, halved, K forgotten",
        line="The picture lost its left and top and half its size, K knows of neither: the"
        " calculation is shifted and twice as large as it should be.",
        params=Input(edit="cropped, then half size", k_follows=False),
        step=PIXELS,
        view=FACING,
        breaks=True,
    ),
    Preset(
        name="crop-right",
        title="Cropped, halved, K too",
        line="A crop moves the principal point, away from the middle of the picture; halving"
        " halves f as well. Now all fits again.",
        params=CROP_RIGHT,
        step=PIXELS,
        view=FACING,
    ),
    Preset(
        name="centre",
        title="t is not the camera",
        line="t is the world's origin seen from the camera. Rays that start there miss every point"
        " by the distance from t to C = −Rᵀt.",
        params=Input(mistake="t for the centre"),
        step=BACK,
        view=BEHIND_VIEW,
        breaks=True,
    ),
    Preset(
        name="ray-length",
        title="Depth is not ray length",
        line="Points come back too far out, the more the further from the axis: flat walls come"
        " back curved.",
        params=Input(mistake="ray length for depth"),
        step=BACK,
        view=BEHIND_VIEW,
        breaks=True,
    ),
)

SWEEPS = (
    Sweep("z", (1.0, 2.0, 4.0, 8.0, 12.0, 16.0), run="lamp"),
    Sweep("dolly", (0.5, 1.0, 2.0, 3.0, 5.0, 10.0), run="dolly"),
    Sweep("turn", (-20.0, -10.0, 0.0, 10.0, 20.0)),
    Sweep("cut", (0, 30, 60, 90, 120), run="cut"),
    Sweep("k1", (-0.6, -0.45, -0.3, 0.0, 0.3, 0.6), run="radial"),
    Sweep("turn", (-20.0, -10.0, -5.0, 0.0, 5.0, 10.0, 20.0), run="rails"),
    Sweep("z", (-16.0, -8.0, -4.0, 4.0, 8.0, 16.0), run="on-ray"),
)
