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

T_BESIDE = motion(
    np.eye(3), np.array([1.0, 0.0, 0.0])
)  # where the source is shown until a motion is found
MOST_NORMALS, MOST_LINES, NORMAL = 500, 400, 0.05
BARS = Chart("Descriptor of the picked point", "bar: 11 of θ, 11 of α, 11 of φ", "%")
SHARE, TURN, DISTANCE = (
    Chart("Right matches", unit="%"),
    Chart("Rotation error", unit="deg"),
    Chart("Distance", unit="m"),
)
PLACE = np.arange(3.0 * BINS)


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    match state.now:
        case Scanned() as now:
            scene = _scanned(now)
        case Pictured() as now:
            scene = pictured(now)
        case Outlined() as now:
            scene = outlined(state, now)
    share = {
        "right share": SHARE.scalar(100 * state.right_share, "right among the matches", "truth")
    }
    return {"caption": caption(state)} | scene | share


def _scanned(now: Scanned) -> dict[str, Primitive]:
    scans = now.scans
    T = T_BESIDE if now.T_target_source is None else now.T_target_source
    radius = float(np.clip(0.24 / np.sqrt(len(scans.p_target)), 0.003, 0.009))
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target, _target_color(now), radius, name="target"),
        "source": Points(scans.p_source, "source", radius, T, name="source"),
        "picked": Points(
            scans.p_source[[now.picked]], "highlight", 3 * radius, T, name="picked point"
        ),
    }
    if (
        now.phase in ("nearest", "kept")
        and now.asked is not None
        and len(now.asked) < len(scans.p_source)
    ):
        scene["keypoints"] = Points(
            scans.p_source[now.asked], "highlight", 2 * radius, T, name="keypoints"
        )
    if now.phase == "normals" and now.n_target is not None and now.n_source is not None:
        scene["target normals"] = _normals(scans.p_target, now.n_target, None)
        scene["source normals"] = _normals(scans.p_source, now.n_source, T)
    if now.phase == "pairs" and now.around is not None and now.n_source is not None:
        some = now.around[every(len(now.around), 60)]
        ends = between(scans.p_source[now.picked], scans.p_source[some])
        scene["pairs"] = Segments(ends, "correspondence", 2, T, name="pairs")
        scene["pair normals"] = _normals(
            scans.p_source[[now.picked, *some]], now.n_source[[now.picked, *some]], T
        )
    if now.phase in ("histogram", "similar"):
        known = scans.T_truth is not None
        name = "its true place" if known else "most alike"
        scene["there"] = Points(
            scans.p_target[[now.there]], "truth" if known else "highlight", 3 * radius, name=name
        )
    scene |= _bars(now) if now.phase in ("pairs", "histogram", "similar") else {}
    if now.pairs is not None and now.phase not in ("icp", "end"):
        scene |= _matches(now, T)
    scene |= _errors(now)
    if now.T_target_source is not None:
        scene["start"] = Points(
            scans.p_source, "neutral", radius, T_BESIDE, opacity=0.3, name="source, as it came"
        )
    else:
        top = float(apply(T, scans.p_source)[:, 2].max())
        scene["source name"] = Label("source", np.array([1.0, 0.0, top + 0.08]), "source")
    return scene


def _target_color(now: Scanned) -> Color:
    if now.phase != "similar" or now.f_source is None or now.f_target is None:
        return "target"
    off = np.linalg.norm(now.f_target - now.f_source[now.picked], axis=1)
    return Field.magnitude(off, "difference of descriptors")


def _normals(p: np.ndarray, n: np.ndarray, T: np.ndarray | None) -> Segments:
    some = every(len(p), MOST_NORMALS)
    return Segments(between(p[some], p[some] + NORMAL * n[some]), "neutral", 1.5, T, name="normals")


def _bars(now: Scanned) -> dict[str, Primitive]:
    if now.phase == "pairs" or now.f_source is None or now.f_target is None:
        return {}
    there = (
        "true place in the target" if now.scans.T_truth is not None else "most alike in the target"
    )
    return {
        "bars": BARS.curve(
            PLACE, now.f_source[now.picked], "picked point", "source", marks=(10.5, 21.5)
        ),
        "bars there": BARS.curve(PLACE, now.f_target[now.there], there, "truth"),
    }


def _matches(now: Scanned, T: np.ndarray) -> dict[str, Primitive]:
    assert now.pairs is not None
    some = every(len(now.pairs), MOST_LINES)
    pairs = now.pairs[some]
    ends = apply(T, now.scans.p_source[pairs[:, 0]]), now.scans.p_target[pairs[:, 1]]
    if now.right is None and now.inliers is not None:
        return lines_between(*ends, now.inliers[some], thin="disagrees")
    return lines_between(*ends, None if now.right is None else now.right[some])


def _errors(now: Scanned) -> dict[str, Primitive]:
    if now.scans.T_truth is None:
        return {}
    error, rms = now.error, np.nan
    if (
        now.T_target_source is not None
        and now.pairs is not None
        and now.inliers is not None
        and now.inliers.any()
    ):
        source, target = now.pairs[now.inliers].T
        rms = rmse(now.T_target_source, now.scans.p_target[target], now.scans.p_source[source])
    return {
        "rotation error": TURN.scalar(error.rotation, "rotation error", "truth"),
        "distance": DISTANCE.scalar(error.displacement, "RMS distance from the truth", "truth"),
        "residual": DISTANCE.scalar(rms, "RMS of the matches that agreed", "source"),
    }
