"""What one step of finding a scan in another looks like; pictures and outlines are in `flat`."""

import numpy as np

from lessons.features.captions import caption
from lessons.features.flat import lines_between, outlined, pictured
from lessons.features.state import Outlined, Pictured, Scanned, State
from workbench.data.thinning import every
from workbench.geometry.features.fpfh import BINS
from workbench.geometry.motions import apply, motion
from workbench.geometry.motions.alignment import rmse
from workbench.geometry.polylines import between
from workbench.scene import Chart, Color, Field, Label, Points, Primitive, Scene, Segments

# where the source is shown until a motion is found
T_BESIDE = motion(np.eye(3), np.array([1.0, 0.0, 0.0]))
MOST_NORMALS = 500
MOST_LINES = 400
NORMAL = 0.05
BARS = Chart("Descriptor of the picked point", "bar: 11 of θ, 11 of α, 11 of φ", "%")
SHARE = Chart("Right matches", unit="%")
TURN = Chart("Rotation error", unit="deg")
DISTANCE = Chart("Distance", unit="m")
PLACE = np.arange(3.0 * BINS)


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    match state.now:
        case Scanned() as step:
            scene = _scanned(step)
        case Pictured() as step:
            scene = pictured(step)
        case Outlined() as step:
            scene = outlined(state, step)
    share = {
        "right share": SHARE.scalar(100 * state.right_share, "right among the matches", "truth")
    }
    return {"caption": caption(state)} | scene | share


def _scanned(step: Scanned) -> dict[str, Primitive]:
    scans = step.scans
    T = T_BESIDE if step.T_target_source is None else step.T_target_source
    radius = float(np.clip(0.24 / np.sqrt(len(scans.p_target)), 0.003, 0.009))
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target, _target_color(step), radius, name="target"),
        "source": Points(scans.p_source, "source", radius, T, name="source"),
        "picked": Points(
            scans.p_source[[step.picked]], "highlight", 3 * radius, T, name="picked point"
        ),
    }
    if (
        step.phase in ("nearest", "kept")
        and step.asked is not None
        and len(step.asked) < len(scans.p_source)
    ):
        scene["keypoints"] = Points(
            scans.p_source[step.asked], "highlight", 2 * radius, T, name="keypoints"
        )
    if step.phase == "normals" and step.n_target is not None and step.n_source is not None:
        scene["target normals"] = _normals(scans.p_target, step.n_target, None)
        scene["source normals"] = _normals(scans.p_source, step.n_source, T)
    if step.phase == "pairs" and step.around is not None and step.n_source is not None:
        some = step.around[every(len(step.around), 60)]
        ends = between(scans.p_source[step.picked], scans.p_source[some])
        scene["pairs"] = Segments(ends, "correspondence", 2, T, name="pairs")
        scene["pair normals"] = _normals(
            scans.p_source[[step.picked, *some]], step.n_source[[step.picked, *some]], T
        )
    if step.phase in ("histogram", "similar"):
        known = scans.T_truth is not None
        name = "its true place" if known else "most alike"
        scene["there"] = Points(
            scans.p_target[[step.there]], "truth" if known else "highlight", 3 * radius, name=name
        )
    scene |= _bars(step) if step.phase in ("pairs", "histogram", "similar") else {}
    if step.pairs is not None and step.phase not in ("icp", "end"):
        scene |= _matches(step, T)
    scene |= _errors(step)
    if step.T_target_source is not None:
        scene["start"] = Points(
            scans.p_source, "neutral", radius, T_BESIDE, opacity=0.3, name="source, as it came"
        )
    else:
        top = float(apply(T, scans.p_source)[:, 2].max())
        scene["source name"] = Label("source", np.array([1.0, 0.0, top + 0.08]), "source")
    return scene


def _target_color(step: Scanned) -> Color:
    if step.phase != "similar" or step.f_source is None or step.f_target is None:
        return "target"
    off = np.linalg.norm(step.f_target - step.f_source[step.picked], axis=1)
    return Field.magnitude(off, "difference of descriptors")


def _normals(p: np.ndarray, n: np.ndarray, T: np.ndarray | None) -> Segments:
    some = every(len(p), MOST_NORMALS)
    return Segments(between(p[some], p[some] + NORMAL * n[some]), "neutral", 1.5, T, name="normals")


def _bars(step: Scanned) -> dict[str, Primitive]:
    if step.phase == "pairs" or step.f_source is None or step.f_target is None:
        return {}
    name = (
        "true place in the target" if step.scans.T_truth is not None else "most alike in the target"
    )
    return {
        "bars": BARS.curve(
            PLACE, step.f_source[step.picked], "picked point", "source", marks=(10.5, 21.5)
        ),
        "bars there": BARS.curve(PLACE, step.f_target[step.there], name, "truth"),
    }


def _matches(step: Scanned, T: np.ndarray) -> dict[str, Primitive]:
    assert step.pairs is not None
    some = every(len(step.pairs), MOST_LINES)
    pairs = step.pairs[some]
    ends = apply(T, step.scans.p_source[pairs[:, 0]]), step.scans.p_target[pairs[:, 1]]
    if step.right is None and step.inliers is not None:
        return lines_between(*ends, right=step.inliers[some], thin="disagrees")
    return lines_between(*ends, right=None if step.right is None else step.right[some])


def _errors(step: Scanned) -> dict[str, Primitive]:
    if step.scans.T_truth is None:
        return {}
    error, rms = step.error, np.nan
    if (
        step.T_target_source is not None
        and step.pairs is not None
        and step.inliers is not None
        and step.inliers.any()
    ):
        source, target = step.pairs[step.inliers].T
        rms = rmse(step.T_target_source, step.scans.p_target[target], step.scans.p_source[source])
    return {
        "rotation error": TURN.scalar(error.rotation, "rotation error", "truth"),
        "distance": DISTANCE.scalar(error.displacement, "RMS distance from the truth", "truth"),
        "residual": DISTANCE.scalar(rms, "RMS of the matches that agreed", "source"),
    }
