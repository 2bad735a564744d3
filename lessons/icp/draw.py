"""What one step of ICP looks like: two clouds, their matches, the curves, and what just happened in words."""

import numpy as np

from lessons.icp.basin import thin_rows
from lessons.icp.state import Scans, State
from lessons.icp.words import caption
from workbench.geometry.motions import apply, inverse
from workbench.numerals import length
from workbench.scene import Classes, Curve, Label, Points, Primitive, Role, Scalar, Scene, Segments

MOST_LINES = 750, 200  # of small clouds and of large ones, whose recordings the lines would fill
LARGE = 5000
ARROW = np.array([[[0.0, 0.0, 0.0], [0.62, 0.0, 0.0]], [[0.62, 0.0, 0.0], [0.54, 0.035, 0.0]],
                  [[0.62, 0.0, 0.0], [0.54, -0.035, 0.0]]])  # fmt: skip


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    scans, now = state.scans, state.icp
    T_world_source = scans.frame.shown_motion(now.T_target_source)
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target_shown, "target", _radius(len(scans.p_target)), name="target"),
        "source": Points(
            scans.p_source_shown, _source_color(scans), _radius(len(scans.p_source)), T_world_source, name="source"
        ),
        "source arrow": Segments(
            ARROW, "source", 4, _arrow_pose(scans, now.T_target_source), name="fixed to the source"
        ),
        "caption": caption(state),
        "grid": Segments(scans.grid, "neutral", 1, opacity=0.3, name=f"grid {length(scans.cell)}"),
    }
    if scans.frame.scale != 1.0:
        size = f"a square of the grid is {length(scans.cell)} of the scans"
        scene["size"] = Label(size, np.array([0.0, 0.0, -0.75]))
    if scans.T_truth is not None:
        scene["true arrow"] = Segments(
            ARROW, "truth", 2.5, _arrow_pose(scans, scans.T_truth), 0.8, name="where it belongs"
        )
    if state.tries:
        T_world_try = scans.frame.shown_motion(
            state.tries[-1].T_target_truth @ scans.T_truth
        )  # T_truth is T_target_source
        scene["try"] = Points(
            scans.p_source_shown[thin_rows(scans)], "highlight", 0.008, T_world_try, name="end from another start"
        )
        scene |= _basin(state)
    else:
        scene["matches"] = _matches(state, T_world_source)
        scene |= _curves(state)
    return scene


def _curves(state: State) -> dict[str, Primitive]:
    now, params = state.icp, state.params
    curves: dict[str, Primitive] = {"rmse": Scalar(now.rmse, "RMSE of kept matches", "RMSE", "m")}
    if params.fit == "point-to-plane":
        curves["residual"] = Scalar(now.residual, "to tangent planes", "RMSE", "m", "other")
    if state.known:  # the truth stands beside what is minimised
        curves["rotation error"] = Scalar(state.error.rotation, "rotation error", "Rotation error", "deg", "truth")
        curves["translation error"] = Scalar(
            state.error.translation, "translation error", "Translation error", "m", "truth"
        )
    curves["kept"] = Scalar(100 * now.overlap, "kept", "Overlap", "%")
    if state.known:
        guessed = now.iteration == 1 and now.phase == "match"  # a question asks for it
        curves["right"] = Scalar(np.nan if guessed else 100 * state.right, "right among them", "Overlap", "%", "truth")
    return curves


def _basin(state: State) -> dict[str, Primitive]:
    angles = np.array([t.start_angle for t in state.tries], float)
    marks = (state.params.start_angle,) if state.params.target is None else ()
    x_label, metres = "start angle (deg)", "Basin: final RMSE and final distance"

    def curve(values: list[float], name: str, chart: str, unit: str, color: Role) -> Curve:
        return Curve(
            angles, np.array(values), name, chart=chart, x_label=x_label, y_label=unit, color=color, marks=marks
        )

    turns, distances = ([getattr(t.error, name) for t in state.tries] for name in ("rotation", "displacement"))
    return {
        "basin": curve(turns, "final error", "Basin: final rotation error", "deg", "truth"),
        "basin rmse": curve([t.rmse for t in state.tries], "final RMSE", metres, "m", "source"),
        "basin distance": curve(distances, "RMS distance from the truth", metres, "m", "truth"),
    }


def _matches(state: State, T_world_source: np.ndarray) -> Segments:
    scans, now = state.scans, state.icp
    n = len(now.indices)
    rows = np.arange(0, n, -(-n // MOST_LINES[n > LARGE]))
    ends = np.stack(
        [apply(T_world_source, scans.p_source_shown[rows]), scans.p_target_shown[now.indices[rows]]], axis=1
    )
    refused = ~now.kept[rows]
    color = Classes(refused.astype(np.uint8), ("correspondence", "wrong"), ("match", "refused by the gate"))
    return Segments(ends, color, 1.6, name="matches")


def _source_color(scans: Scans):
    if not scans.is_outlier.any():
        return "source"
    return Classes(scans.is_outlier.astype(np.uint8), ("source", "wrong"), ("source", "outlier"))


def _arrow_pose(scans: Scans, T_target_source: np.ndarray) -> np.ndarray:
    """Return the pose of an arrow fixed to the source, which points along the picture's x axis at the truth."""
    return scans.frame.shown_motion(
        T_target_source if scans.T_truth is None else T_target_source @ inverse(scans.T_truth)
    )


def _radius(n: int) -> float:
    return float(np.clip(0.24 / np.sqrt(n), 0.0015, 0.008))
