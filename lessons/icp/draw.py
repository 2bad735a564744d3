"""What one step of ICP looks like: two clouds, their matches, the curves, and what just happened in
words.
"""

import numpy as np

from lessons.icp.basin import ANGLES, POINTS
from lessons.icp.captions import caption
from lessons.icp.state import Scans, State
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

MOST_LINES = 750, 200  # of small clouds and of large ones, whose recordings the lines would fill
LARGE = 5000
TIP, DIAL = (
    0.62,
    0.7,
)  # metres of the picture from its middle: of the arrows, and of the dial of starts
ARROW = np.array(
    [
        [[0.0, 0.0, 0.0], [TIP, 0.0, 0.0]],
        [[TIP, 0.0, 0.0], [0.54, 0.035, 0.0]],
        [[TIP, 0.0, 0.0], [0.54, -0.035, 0.0]],
    ]
)
RMSE, OVERLAP = Chart("RMSE", unit="m"), Chart("Overlap", unit="%")
TURN, SHIFT = Chart("Rotation error", unit="deg"), Chart("Translation error", unit="m")
BASIN_TURNS = Chart("Basin: final rotation error", "start angle (deg)", "deg")
BASIN_METRES = Chart("Basin: final RMSE and final distance", "start angle (deg)", "m")
HALF = np.radians(0.42 * (ANGLES[1] - ANGLES[0]))  # of a start's arc on the dial


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    scans = state.scans
    scene: dict[str, Primitive] = {
        "target": Points(
            scans.p_target_shown, "target", _radius(len(scans.p_target)), name="target"
        ),
        "caption": caption(state),
        "grid": Segments(scans.grid, "neutral", 1, opacity=0.2, name=f"grid {length(scans.cell)}"),
    }
    if scans.frame.scale != 1.0:
        size = f"a square of the grid is {length(scans.cell)} of the scans"
        scene["size"] = Label(size, np.array([0.0, 0.0, -0.75]))
    if scans.T_truth is not None:
        scene["true arrow"] = Segments(ARROW, "truth", 2.5, _arrow_pose(scans, scans.T_truth), 0.8)
    return scene | (_from_another_start(state) if state.tries else _of_the_run(state))


def _of_the_run(state: State) -> dict[str, Primitive]:
    scans, T_target_source = state.scans, state.icp.T_target_source
    T_world_source = scans.frame.shown_motion(T_target_source)
    p, radius = scans.p_source_shown, _radius(len(scans.p_source))
    return {
        "source": Points(p, _source_color(scans), radius, T_world_source, name="source"),
        **_arrow("source", scans, T_target_source, "source", state.error if state.known else None),
        "matches": _matches(state, T_world_source),
        **_curves(state),
    }


def _from_another_start(state: State) -> dict[str, Primitive]:
    scans, last = state.scans, state.tries[-1]
    assert scans.T_truth is not None
    T_target_source = last.T_target_truth @ scans.T_truth
    T_world_try = scans.frame.shown_motion(T_target_source)
    p = scans.p_source_shown[every(len(scans.p_source), POINTS)]
    return {
        "try": Points(
            p, "highlight", 0.008, T_world_try, name=f"end from another start, {len(p)} points"
        ),
        **_arrow("try", scans, T_target_source, "highlight", last.error),
        **_dial(state),
        **_basin(state),
    }


def _arrow(
    path: str, scans: Scans, T_target_source: np.ndarray, color: Role, error: MotionError | None
):
    """Return an arrow fixed to the source, which points along the picture's x axis at the truth;
    its turn stands at it.
    """
    pose = _arrow_pose(scans, T_target_source)
    scene: dict[str, Primitive] = {f"{path} arrow": Segments(ARROW, color, 4, pose)}
    if error is not None:
        at = np.array([TIP + 0.06, 0.0, 0.0])
        scene[f"{path} arrow name"] = Label(f"{angle(error.rotation)} off", at, color, pose)
    return scene


def _dial(state: State) -> dict[str, Primitive]:
    """Return the starts around the target, each an arc where its arrow starts, green where ICP
    comes home from there.
    """
    home = np.array([state.scans.at_home(one.error) for one in state.tries])
    starts = np.radians([one.start_angle for one in state.tries])[:, None]
    height = float(state.scans.grid[0, 0, 2])

    def at(turn: np.ndarray, radius: float) -> np.ndarray:
        return np.stack(
            [radius * np.cos(turn), radius * np.sin(turn), np.full_like(turn, height)], axis=-1
        )

    arcs = np.stack(
        [
            at(starts + HALF * np.array([-1, -1 / 3, 1 / 3]), DIAL),
            at(starts + HALF * np.array([-1 / 3, 1 / 3, 1]), DIAL),
        ],
        axis=2,
    )
    color = Classes.marking(
        np.repeat(~home, 3),
        "neutral",
        "does not come home",
        others=("truth", "comes home from here"),
    )
    now = state.tries[-1].start_angle
    return {
        "dial": Segments(arcs.reshape(-1, 2, 3), color, 9),
        "dial now": Segments(between(at(starts[-1], 0.45), at(starts[-1], DIAL)), "highlight", 3),
        "dial name": Label(f"start {now:.0f}° away", at(starts[-1, 0], DIAL + 0.1), "highlight"),
    }


def _curves(state: State) -> dict[str, Primitive]:
    now, params = state.icp, state.params
    curves: dict[str, Primitive] = {"rmse": RMSE.scalar(now.rmse, "RMSE of kept matches")}
    if params.fit == "point-to-plane":
        curves["residual"] = RMSE.scalar(now.residual, "to tangent planes", "other")
    if state.known:  # the truth stands beside what is minimised
        curves["rotation error"] = TURN.scalar(state.error.rotation, "rotation error", "truth")
        curves["translation error"] = SHIFT.scalar(
            state.error.translation, "translation error", "truth"
        )
    curves["kept"] = OVERLAP.scalar(100 * now.overlap, "kept")
    if state.known:
        guessed = now.iteration == 1 and now.phase == "match"  # a question asks for it
        curves["right"] = OVERLAP.scalar(
            np.nan if guessed else 100 * state.right, "right among them", "truth"
        )
    return curves


def _basin(state: State) -> dict[str, Primitive]:
    angles = np.array([t.start_angle for t in state.tries], float)
    marks = (state.params.start_angle,) if state.params.target is None else ()

    def curve(chart: Chart, values: list[float], name: str, color: Role) -> Curve:
        return chart.curve(angles, np.array(values), name, color, marks=marks)

    turns, distances = (
        [getattr(t.error, name) for t in state.tries] for name in ("rotation", "displacement")
    )
    return {
        "basin": curve(BASIN_TURNS, turns, "final error", "truth"),
        "basin rmse": curve(BASIN_METRES, [t.rmse for t in state.tries], "final RMSE", "source"),
        "basin distance": curve(BASIN_METRES, distances, "RMS distance from the truth", "truth"),
    }


def _matches(state: State, T_world_source: np.ndarray) -> Segments:
    scans, now = state.scans, state.icp
    n = len(now.indices)
    rows = every(n, MOST_LINES[n > LARGE])
    ends = between(
        apply(T_world_source, scans.p_source_shown[rows]), scans.p_target_shown[now.indices[rows]]
    )
    color = Classes.marking(
        ~now.kept[rows], "wrong", "refused by the gate", others=("correspondence", "match")
    )
    return Segments(ends, color, 2, name="matches")


def _source_color(scans: Scans) -> Color:
    if not scans.is_outlier.any():
        return "source"
    return Classes.marking(scans.is_outlier, "wrong", "outlier", others=("source", "source"))


def _arrow_pose(scans: Scans, T_target_source: np.ndarray) -> np.ndarray:
    """Return the pose of an arrow fixed to the source, which points along the picture's x axis at
    the truth.
    """
    return scans.frame.shown_motion(
        T_target_source if scans.T_truth is None else T_target_source @ inverse(scans.T_truth)
    )


def _radius(n: int) -> float:
    return float(np.clip(0.24 / np.sqrt(n), 0.0015, 0.008))
