"""What one step of ICP looks like: two clouds, their matches, the curves, and what just happened in words."""

from dataclasses import dataclass

import numpy as np

from lessons.icp.basin import HOME, Try, thin_rows
from lessons.icp.params import Params
from lessons.icp.scans import Scans
from workbench.algorithms import icp
from workbench.geometry.motions import apply, inverse
from workbench.scene import Caption, Classes, Curve, Label, Points, Primitive, Scalar, Scene, Segments

MOST_LINES = 750, 200  # of small clouds and of large ones, whose recordings the lines would fill
LARGE = 5000
ARROW = np.array([[[0.0, 0.0, 0.0], [0.62, 0.0, 0.0]], [[0.62, 0.0, 0.0], [0.54, 0.035, 0.0]],
                  [[0.62, 0.0, 0.0], [0.54, -0.035, 0.0]]])  # fmt: skip


@dataclass(frozen=True, eq=False)
class State:
    """One step of the lesson: a sub-step of ICP, or afterwards one more try from another start.

    Attributes:
        params: The inputs.
        scans: The clouds, the same for the whole run.
        icp: What ICP yielded (its last state, during the tries).
        rmse_before: RMSE of the kept matches one sub-step earlier, metres; NaN at first.
        turned: How far the last fit turned the source, degrees.
        rotation_error: To the truth, degrees; NaN where it is not known.
        translation_error: To the truth at the middle of the source, metres.
        right: Share of the kept matches that are right (within two point spacings).
        tries: Ends from other starts, so far.
    """

    params: Params
    scans: Scans
    icp: icp.State
    rmse_before: float
    turned: float
    rotation_error: float
    translation_error: float
    right: float
    tries: tuple[Try, ...] = ()


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    scans, now = state.scans, state.icp
    T_world_source = scans.shown(now.T_target_source)
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target_shown, "target", _radius(len(scans.p_target)), name="target"),
        "source": Points(
            scans.p_source_shown, _source_color(scans), _radius(len(scans.p_source)), T_world_source, name="source"
        ),
        "source arrow": Segments(
            ARROW, "source", 4, _arrow_pose(scans, now.T_target_source), name="fixed to the source"
        ),
        "caption": _caption(state),
    }
    if scans.scale != 1.0:
        size = f"a metre of this picture is {_length(1 / scans.scale)} of the scans"
        scene["size"] = Label(size, np.array([0.0, 0.0, -0.75]))
    if scans.T_truth is not None:
        scene["true arrow"] = Segments(
            ARROW, "truth", 2.5, _arrow_pose(scans, scans.T_truth), 0.8, name="where it belongs"
        )
    if state.tries:
        T_world_try = scans.shown(state.tries[-1].T_target_truth @ scans.T_truth)  # T_truth is T_target_source
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
    known = state.scans.T_truth is not None
    if known:  # the truth stands beside what is minimised
        curves["rotation error"] = Scalar(state.rotation_error, "rotation error", "Rotation error", "deg", "truth")
        curves["translation error"] = Scalar(
            state.translation_error, "translation error", "Translation error", "m", "truth"
        )
    curves["kept"] = Scalar(100 * now.overlap, "kept", "Overlap", "%")
    if known:
        curves["right"] = Scalar(100 * state.right, "right among them", "Overlap", "%", "truth")
    return curves


def _basin(state: State) -> dict[str, Primitive]:
    angles = np.array([t.start_angle for t in state.tries], float)
    marks = () if state.params.target else (state.params.start_angle,)
    errors, rmses = (np.array([getattr(t, name) for t in state.tries]) for name in ("rotation_error", "rmse"))
    x_label = "start angle (deg)"
    return {
        "basin": Curve(
            angles, errors, "final error", "Basin: final rotation error", x_label, "deg", "truth", marks=marks
        ),
        "basin rmse": Curve(angles, rmses, "final RMSE", "Basin: final RMSE", x_label, "m", "source", marks=marks),
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


def _caption(state: State) -> Caption:
    if state.tries:
        return _try_caption(state)
    now, rmse = state.icp, _length(state.icp.rmse)
    kept, n = int(np.count_nonzero(now.kept)), len(now.kept)
    if now.phase == "match":
        text = f"Match {now.iteration}: each source point takes its nearest target point. "
        text += f"{kept:,} of {n:,} are kept" + (f" (up to {_length(now.limit)} apart)" if kept < n else "")
        text += f"; RMSE {rmse}."
        if np.isfinite(state.right):
            text += f" {_share(state.right)} right."
    else:
        text = f"Fit {now.iteration}: {_FITS[state.params.fit]} turns the source by {state.turned:.3g}°; "
        text += f"RMSE {_length(state.rmse_before)} → {rmse}"
        if np.isfinite(state.rotation_error):
            text += f", {state.rotation_error:.3g}° and {_length(state.translation_error)} from the truth"
        text += "."
    if now.stop is None:
        return Caption(text)
    home = at_home(state)
    known = np.isfinite(state.rotation_error)
    verdict = "" if not known else " It has come home." if home else " It looks settled, and it is wrong."
    text += f" Stop: {now.stop.message}.{verdict}"
    return Caption(text, "info" if not known else "good" if home else "wrong")


def at_home(state: State) -> bool:
    """Tell whether the motion is the true one, but for sampling: 5 degrees, and a tenth of the picture's metre."""
    return state.rotation_error < HOME and state.translation_error * state.scans.scale < 0.1


def _try_caption(state: State) -> Caption:
    last = state.tries[-1]
    home = last.rotation_error < HOME
    text = f"Another start: from {last.start_angle:.0f}° away, ICP "
    text += (
        f"{'comes home' if home else 'ends'} {last.rotation_error:.3g}° from the truth, at RMSE {_length(last.rmse)}."
    )
    if last.start_angle == 180:
        edge = basin_edge(state.tries)
        text += (
            f" In this row, starts up to {edge:.0f}° come home." if edge >= 0 else " No start of this row comes home."
        )
    return Caption(text, "good" if home else "wrong")


def basin_edge(tries: tuple[Try, ...]) -> float:
    """Return the largest start angle up to which every try came home, degrees; NaN when not even the first did."""
    edge = float("nan")
    for attempt in tries:
        if attempt.rotation_error >= HOME:
            break
        edge = attempt.start_angle
    return edge


_FITS = {
    "point-to-point": "the rigid motion with the least squared distance to the partners",
    "point-to-plane": "the step with the least squared distance to the partners' tangent planes",
    "similarity": "the similarity with the least squared distance to the partners",
    "affine": "the affine map with the least squared distance to the partners",
}


def _source_color(scans: Scans):
    if not scans.is_outlier.any():
        return "source"
    return Classes(scans.is_outlier.astype(np.uint8), ("source", "wrong"), ("source", "outlier"))


def _arrow_pose(scans: Scans, T_target_source: np.ndarray) -> np.ndarray:
    """Return the pose of an arrow fixed to the source, which points along the picture's x axis at the truth."""
    return scans.shown(T_target_source if scans.T_truth is None else T_target_source @ inverse(scans.T_truth))


def _radius(n: int) -> float:
    return float(np.clip(0.24 / np.sqrt(n), 0.0015, 0.008))


def _share(right: float) -> str:
    if right < 0.005:
        return "Hardly any of them is"
    return f"{'Only ' if right < 0.5 else ''}{100 * right:.0f} % of them are"


def _length(metres: float) -> str:
    return f"{metres:.3g} m" if metres >= 0.1 or metres == 0 else f"{1000 * metres:.3g} mm"
