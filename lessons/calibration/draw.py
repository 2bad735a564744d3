"""What one step looks like: the camera and the boards before it, one view enlarged, and what is
known beside them.
"""

import functools

import numpy as np

from lessons.calibration.captions import caption, title
from lessons.calibration.charts import beside
from lessons.calibration.state import State, Subject
from lessons.calibration.views import photograph
from workbench.data.views.boards import board_mesh, board_points
from workbench.geometry.cameras import look_at
from workbench.geometry.motions import apply, inverse, motion
from workbench.geometry.polylines import at_height, between, rectangle, segments
from workbench.lesson import View
from workbench.scene import (
    Camera,
    Color,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Scene,
    Segments,
)

VIEW = View(
    eye=(0.62, -0.52, 0.42), target=(-0.02, 0.2, 0.1), fov_degrees=40.0, grid=None, axes=False
)
SCREEN = (VIEW.facing(-0.4, 0.1, -0.45), 0.66)
"""Where the enlarged picture stands, behind the boards, and its width in metres."""
LAYER = 0.004  # metres from the picture to what is drawn on it
LONGER = 20  # times, residuals
MOST = 90.0  # pixels that a lengthened residual is drawn at most
DEPTH = 0.1  # metres, of the frustum
T_WORLD_CAMERA = inverse(look_at(np.zeros(3), np.array([0.0, 1.0, 0.0])))


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return {"caption": caption(state)} | _boards(state) | _picture(state) | beside(state)


def _boards(state: State) -> dict[str, Primitive]:
    """Draw camera and boards as they are found, with the true ones in green."""
    subject, estimate = state.subject, state.now
    w, h = subject.size
    scale, outline = _scale(subject), _outline(subject)
    scene: dict[str, Primitive] = {}
    if subject.K is not None:
        scene["true camera"] = Camera(
            subject.K, w, h, T_WORLD_CAMERA, DEPTH, color="truth", name="true camera"
        )
        for view, T in zip(subject.views, subject.Ts_camera_board, strict=True):
            scene[f"true boards/{view}"] = Segments(
                outline, "truth", 2.5, _placed(T, scale), name="true boards"
            )
    if estimate.K is not None and estimate.K[0, 0] > 0 and estimate.K[1, 1] > 0:
        scene["camera"] = Camera(
            estimate.K, w, h, T_WORLD_CAMERA, DEPTH, color="source", name="camera as found"
        )
    for i, (view, T) in enumerate(zip(subject.views, estimate.Ts_camera_board, strict=False)):
        T_world_board = _placed(T, scale)
        scene[f"boards/{view}"] = Segments(
            outline, "source", 2.0, T_world_board, name="boards as found"
        )
        if subject.K is not None and i == state.shown:
            p, faces, colors = _squares()
            scene["squares"] = Mesh(p, faces, colors, T_world_board, flat=True)
    Ts = estimate.Ts_camera_board if len(estimate.Ts_camera_board) else subject.Ts_camera_board
    if len(Ts):
        middle = subject.p_board.mean(axis=0) * scale
        p = np.stack([apply(_placed(T, scale), middle) for T in Ts])
        color: Color = (
            Field.magnitude(state.per_view, "rms of a view", "px")
            if len(estimate.Ts_camera_board)
            else "target"
        )
        scene["middles"] = Points(p, color, 0.008, name="middles of the boards")
        scene["shown"] = Points(p[[state.shown]], "highlight", 0.014, name="the view that is shown")
        scene["shown/name"] = Label(
            f"view {subject.views[state.shown]}", p[state.shown] + [0, 0, 0.03], "highlight"
        )
    return scene


def _scale(subject: Subject) -> float:
    """Return by how much a scene is made larger, so that a board of any unit is as large as
    ours.
    """
    ours = np.ptp(board_points(), axis=0).max()
    return 1.0 if subject.K is not None else float(ours / np.ptp(subject.p_board, axis=0).max())


def _placed(T_camera_board: np.ndarray, scale: float) -> np.ndarray:
    return T_WORLD_CAMERA @ motion(T_camera_board[:3, :3], scale * T_camera_board[:3, 3])


def _outline(subject: Subject) -> np.ndarray:
    return _rim(subject.p_board.tobytes(), _scale(subject))


@functools.lru_cache(maxsize=16)
def _rim(p_board: bytes, scale: float) -> np.ndarray:
    """Return the rim of the board, a square's width around its corners, and the first corner's
    square.
    """
    p = scale * np.frombuffer(p_board).reshape(-1, 3)
    low, high = p[:, :2].min(axis=0), p[:, :2].max(axis=0)
    edge = (high - low).max() / 8
    return segments(at_height(rectangle(low - edge, high + edge)), closed=True)


@functools.cache
def _squares() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    p, faces, colors = board_mesh()
    return p, faces, np.repeat(colors[::2], 4, axis=0)


def _picture(state: State) -> dict[str, Primitive]:
    """Draw the view that is shown, with corners as measured and as the model has them."""
    subject, estimate = state.subject, state.now
    image = photograph(state.params, subject, state.shown)
    picture = Picture(image, title(subject, subject.views[state.shown]), SCREEN[1], SCREEN[0])
    factor = picture.size[0] / subject.size[0]
    uv, off = subject.uv[state.shown], estimate.residuals[state.shown]
    long = LONGER * off
    long = long * np.minimum(
        1.0, MOST / np.maximum(np.linalg.norm(long, axis=1, keepdims=True), 1e-12)
    )

    def on(pixels: np.ndarray, layer: float = LAYER) -> np.ndarray:
        return picture.places(factor * (pixels + 0.5) - 0.5, layer)

    return {
        "picture": picture,
        "picture/border": Segments(picture.border(LAYER), "highlight", 2.0),
        "corners": Points(on(uv), "target", 0.0045, name="corners as measured"),
        "residuals": Segments(
            between(on(uv, 1.5 * LAYER), on(uv + long, 1.5 * LAYER)),
            "wrong",
            2.5,
            name=f"residuals, {LONGER} times as long",
        ),
    }
