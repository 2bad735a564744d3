"""What one step in space looks like: two clouds, their matches, two arrows, and the dial of
starts.
"""

import numpy as np

from lessons.icp.captions import SpaceLook, caption, tries_of
from lessons.icp.inputs import Input
from lessons.icp.scans import Scans
from lessons.icp.space import ANGLES, SHARES, TURNS, Try, errors_by_share, landscapes
from workbench.algorithms.registration import icp
from workbench.data.thinning import every
from workbench.geometry.motions import apply, inverse
from workbench.geometry.motions.alignment import MotionError
from workbench.geometry.polylines import between
from workbench.numerals import angle, length
from workbench.scene import (
    Chart,
    Classes,
    Color,
    Curve,
    Label,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
)

# matches drawn, and how much of a refused one
MOST_LINES = 50
STUB = 0.25
TIP, DIAL = 0.62, 0.7  # metres of the picture from its middle: of the arrows, and of the dial
ARROW = np.array(
    [
        [[0.0, 0.0, 0.0], [TIP, 0.0, 0.0]],
        [[TIP, 0.0, 0.0], [0.54, 0.035, 0.0]],
        [[TIP, 0.0, 0.0], [0.54, -0.035, 0.0]],
    ]
)
MM = 1000.0
RMSE, OVERLAP = Chart("RMSE", unit="m"), Chart("Overlap", unit="%")
TURN, SHIFT = Chart("Rotation error", unit="deg"), Chart("Translation error", unit="m")
BASIN_TURNS = Chart("Final rotation error", "how far away it starts (°)", "error of the end (°)")
BASIN_METRES = Chart("Final RMSE and distance", "how far away it starts (°)", "m")
ENDS = Chart("Error of the turn", "share of the matches kept", "deg", x_range=(0.3, 1.0))
TURNS_COST = Chart(
    "Cost of turning it",
    "how far orange is turned",
    "mm",
    x_range=(-180.0, 180.0),
    x_unit="deg",
    y_range=(0.0, 120.0),
)
ROUND = Chart("Round")
HALF = np.radians(0.42 * (ANGLES[1] - ANGLES[0]))  # of a start's arc on the dial


def draw(look: SpaceLook) -> Scene:
    """Return the picture of one step."""
    scans, state = look.subject, look.now
    radius = _radius(len(scans.p_target))
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target_shown, "target", radius, opacity=0.6, name="target"),
        "caption": caption(look),
        "grid": Segments(scans.grid, "neutral", 1, opacity=0.2, name=f"grid {length(scans.cell)}"),
    }
    if scans.frame.scale != 1.0:
        size = f"a square of the grid is {length(scans.cell)} of the scans"
        scene["size"] = Label(size, np.array([0.0, 0.0, -0.75]))
    if scans.T_truth is not None:
        pose = _arrow_pose(scans, scans.T_truth)
        scene["true arrow"] = Segments(ARROW, "truth", 2.5, pose, 0.8, name="where it belongs")
    if isinstance(state, Try):
        return scene | _from_another_start(look, state)
    return scene | _of_the_run(look.params, scans, state)


def _of_the_run(params: Input, scans: Scans, state: icp.State) -> dict[str, Primitive]:
    T_target_source = state.T_target_source
    T_world_source = scans.frame.shown_motion(T_target_source)
    p = scans.p_source_shown
    radius = _radius(len(scans.p_source))
    error = scans.error(T_target_source) if scans.known else None
    return {
        "source": Points(p, _source_color(scans), radius, T_world_source, name="source"),
        **_arrow("source", scans, T_target_source, color="source", error=error),
        **_matches(scans, state, T_world_source),
        **_curves(params, scans, state),
        **_landscape(params, scans, state),
    }


def _from_another_start(look: SpaceLook, attempt: Try) -> dict[str, Primitive]:
    scans = look.subject
    assert scans.T_truth is not None
    T_target_source = attempt.T_target_truth @ scans.T_truth
    T_world_try = scans.frame.shown_motion(T_target_source)
    p = scans.p_source_shown
    radius = _radius(len(scans.p_source))
    color = _source_color(scans)
    name = f"end from {attempt.start_angle:.0f}° away"
    return {
        "source": Points(p, color, radius, T_world_try, name=name),
        **_arrow("source", scans, T_target_source, color="source", error=attempt.error),
        **_dial(scans, tries_of(look)),
        **_basin(look),
    }


def _arrow(
    path: str, scans: Scans, T_target_source: np.ndarray, *, color: Role, error: MotionError | None
) -> dict[str, Primitive]:
    """Return an arrow fixed to the source, along the picture's x axis at the truth, with its
    error.
    """
    pose = _arrow_pose(scans, T_target_source)
    scene: dict[str, Primitive] = {f"{path} arrow": Segments(ARROW, color, 4, pose)}
    if error is not None:
        at = np.array([TIP + 0.06, 0.0, 0.0])
        scene[f"{path} arrow name"] = Label(f"{angle(error.rotation)} off", at, color, pose)
    return scene


def _dial(scans: Scans, tries: tuple[Try, ...]) -> dict[str, Primitive]:
    """Return the starts around the target, each an arc where its arrow starts, green where it
    led home.
    """
    home = np.array([scans.at_home(attempt.error) for attempt in tries])
    starts = -np.radians([attempt.start_angle for attempt in tries])[:, None]
    height = float(scans.grid[0, 0, 2])

    def at(turn: np.ndarray, radius: float) -> np.ndarray:
        x, y = radius * np.cos(turn), radius * np.sin(turn)
        return np.stack([x, y, np.full_like(turn, height)], axis=-1)

    thirds = HALF * np.array([-1, -1 / 3, 1 / 3])
    arcs = np.stack([at(starts + thirds, DIAL), at(starts + thirds + 2 / 3 * HALF, DIAL)], axis=2)
    color = Classes.marking(
        np.repeat(~home, 3),
        "neutral",
        "does not come home",
        others=("truth", "comes home from here"),
    )
    words = f"start {tries[-1].start_angle:.0f}° away"
    return {
        "dial": Segments(arcs.reshape(-1, 2, 3), color, 9),
        "dial now": Segments(between(at(starts[-1], 0.45), at(starts[-1], DIAL)), "source", 3),
        "dial name": Label(words, at(starts[-1, 0], DIAL + 0.1), "source"),
    }


def _curves(params: Input, scans: Scans, state: icp.State) -> dict[str, Primitive]:
    curves: dict[str, Primitive] = {
        "rmse": RMSE.scalar(state.rmse, "RMSE of kept matches"),
        "round": ROUND.scalar(state.iteration, "round"),
    }
    if params.fit == "point-to-plane":
        curves["residual"] = RMSE.scalar(state.residual, "to tangent planes", "other")
    if scans.known:  # the truth stands beside what is minimised
        error = scans.error(state.T_target_source)
        curves["rotation error"] = TURN.scalar(error.rotation, "rotation error", "truth")
        curves["translation error"] = SHIFT.scalar(error.translation, "translation error", "truth")
    curves["kept"] = OVERLAP.scalar(100 * state.overlap, "kept")
    if scans.known:
        right = 100 * scans.right_share(state.indices, state.kept)
        curves["right"] = OVERLAP.scalar(right, "right among them", "truth")
    return curves


def _landscape(params: Input, scans: Scans, state: icp.State) -> dict[str, Primitive]:
    """Return what is told of outliers at the end, and of a vase at every step: the whole curve."""
    if params.target is not None:
        return {}
    if params.shape == "vase":
        curves = landscapes(params)
        x = _about_vertical(scans, state.T_target_source)
        y = float(np.interp(x, TURNS, MM * curves["vase"]))
        return {
            "turning/vase": TURNS_COST.whole(TURNS, MM * curves["vase"], "vase"),
            "turning/rabbit": TURNS_COST.whole(TURNS, MM * curves["rabbit"], "rabbit", "neutral"),
            "turning/ball": TURNS_COST.mark(x, y, "here", knob="start_angle"),
        }
    if (
        params.outliers
        and params.gate == "trimmed"
        and params.fit == "point-to-point"
        and state.stop
    ):
        errors = errors_by_share(params)
        y = scans.error(state.T_target_source).rotation
        return {
            "share/curve": ENDS.whole(np.array(SHARES), errors, "final rotation error", "truth"),
            "share/here": ENDS.mark(params.keep, y, "here", "truth", knob="keep"),
        }
    return {}


def _about_vertical(scans: Scans, T_target_source: np.ndarray) -> float:
    """Return how far the source is turned back about the vertical from the truth, degrees."""
    assert scans.T_truth is not None
    R = (scans.T_truth @ inverse(T_target_source))[:3, :3]
    return float(np.degrees(np.arctan2(R[1, 0] - R[0, 1], R[0, 0] + R[1, 1])))


def _basin(look: SpaceLook) -> dict[str, Primitive]:
    tries = tries_of(look)
    angles = np.array([attempt.start_angle for attempt in tries], float)
    marks = (tries[-1].start_angle,)

    def curve(chart: Chart, values: list[float], name: str, *, color: Role) -> Curve:
        return chart.curve(angles, np.array(values), name, color, marks=marks)

    turns, distances = (
        [getattr(attempt.error, name) for attempt in tries] for name in ("rotation", "displacement")
    )
    return {
        "basin": curve(BASIN_TURNS, turns, "final error", color="truth"),
        "basin rmse": curve(
            BASIN_METRES, [attempt.rmse for attempt in tries], "final RMSE", color="source"
        ),
        "basin distance": curve(
            BASIN_METRES, distances, "RMS distance from the truth", color="truth"
        ),
    }


def _matches(scans: Scans, state: icp.State, T_world_source: np.ndarray) -> dict[str, Primitive]:
    """Return some of the matches, those of outliers and those that are refused (as stubs) apart."""
    rows = every(len(state.indices), MOST_LINES)
    p = apply(T_world_source, scans.p_source_shown[rows])
    q = scans.p_target_shown[state.indices[rows]]
    kept, out = state.kept[rows], scans.is_outlier[rows]
    reach = np.where(kept, 1.0, STUB)[:, None]
    color: Color = Classes(
        np.where(kept, np.where(out, 1, 0), 2).astype(np.uint8),
        ("correspondence", "wrong", "neutral"),
        ("match", "match of an outlier", "refused"),
    )
    return {"matches": Segments(between(p, p + reach * (q - p)), color, 2, name="matches")}


def _source_color(scans: Scans) -> Color:
    if not scans.is_outlier.any():
        return "source"
    return Classes.marking(scans.is_outlier, "wrong", "outlier", others=("source", "source"))


def _arrow_pose(scans: Scans, T_target_source: np.ndarray) -> np.ndarray:
    """Return the pose of an arrow fixed to the source, along the picture's x axis at the truth."""
    T = T_target_source if scans.T_truth is None else T_target_source @ inverse(scans.T_truth)
    return scans.frame.shown_motion(T)


def _radius(n: int) -> float:
    return float(np.clip(0.24 / np.sqrt(n), 0.0015, 0.008))
