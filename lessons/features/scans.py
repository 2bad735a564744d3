"""Finding a scan in another: normals, descriptors, matches, RANSAC, ICP."""

import functools
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from lessons.features.state import INLIER, RIGHT, Params, Scanned
from workbench.algorithms.registration.icp import Gate, icp
from workbench.algorithms.robust.models import RIGID
from workbench.algorithms.robust.ransac import Judge, ransac
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.certain import sure
from workbench.data.files import stamp
from workbench.data.scan_pairs import Scans, read_scans
from workbench.data.shapes.clouds import pair
from workbench.errors import InputError
from workbench.geometry.features.fpfh import PairAngles, fpfh
from workbench.geometry.features.keypoints import iss_keypoints
from workbench.geometry.features.matching import NearestDescriptors, filtered, nearest_both_ways
from workbench.geometry.motions import apply, exp_so3, motion
from workbench.geometry.points.normals import point_normals
from workbench.knobs import called, only

Matcher = Callable[[np.ndarray, np.ndarray, float], np.ndarray]

AXIS = np.array([0.3, 0.5, 0.8]) / np.linalg.norm([0.3, 0.5, 0.8])
SHIFT = np.array([0.1, -0.05, 0.08])
WIDTH = 1.2  # of own scans in the picture, metres
MOST_SAMPLES = 4000
CONFIDENCE = 0.999
FEWEST_AGREE = 6  # three matches agree with the motion that was made of them, whatever they are
MOST_FITS, SHOWN_FITS = 60, 6
SALIENT = 0.5  # of the radius: the neighbourhood in which a keypoint is salient
# the tip of the built-in rabbit's upright ear, target frame: described unless one is picked
OURS = (0.17, 0.09, 0.68)


def scan_steps(
    params: Params, pair_angles: PairAngles, mutual_matches: Matcher
) -> Iterator[Scanned]:
    """Yield the steps from two scans to the motion between them."""
    scans = scans_of(params)
    step = Scanned(phase="scans", scans=scans, picked=picked_of(params, scans))
    yield step
    n_target, n_source = normals_of(params, scans)
    step = replace(step, phase="normals", n_target=n_target, n_source=n_source)
    yield step

    p, k = scans.p_source, step.picked
    distances = np.linalg.norm(p - p[k], axis=1)
    around = np.flatnonzero((distances <= params.radius) & (distances > 0))
    first = np.full(len(around), k)
    angles = np.asarray(pair_angles(p[first], n_source[first], p[around], n_source[around]), float)
    step = replace(step, phase="pairs", angles=angles, around=around)
    yield step

    f_source = compared(params, fpfh(p, n_source, params.radius, pair_angles=pair_angles))
    f_target = compared(
        params, fpfh(scans.p_target, n_target, params.radius, pair_angles=pair_angles)
    )
    alike = np.linalg.norm(f_target - f_source[k], axis=1)
    partner = int(alike.argmin())
    if scans.T_truth is not None:
        partner = int(np.linalg.norm(scans.p_target - apply(scans.T_truth, p[k]), axis=1).argmin())
    step = replace(step, phase="histogram", f_source=f_source, f_target=f_target, there=partner)
    yield step
    yield replace(step, phase="similar")

    asked = matched_points(params, p)
    offered = matched_points(params, scans.p_target)
    a, b = f_source[asked], f_target[offered]
    nearest = nearest_both_ways(a, b)
    step = replace(step, asked=asked)
    pairs = np.column_stack([asked, offered[nearest.index]])
    yield replace(step, phase="nearest", pairs=pairs, right=scans.right(pairs, RIGHT))
    rows = chosen(params, nearest, a, b=b, mutual_matches=mutual_matches)
    pairs = np.column_stack([asked[rows[:, 0]], offered[rows[:, 1]]])
    step = replace(step, phase="kept", pairs=pairs, right=scans.right(pairs, RIGHT))
    yield step
    yield from _moved(params, step)


def _moved(params: Params, step: Scanned) -> Iterator[Scanned]:
    """Yield every best sample of RANSAC and its refits, then fits of ICP."""
    scans = step.scans
    pairs = sure(step.pairs)
    if len(pairs) < RIGID.sample_size:
        yield replace(step, phase="end")
        return
    rows = np.hstack([scans.p_source[pairs[:, 0]], scans.p_target[pairs[:, 1]]])
    tries = ransac(
        rows,
        RIGID,
        uniform_samples(len(rows), RIGID.sample_size, np.random.default_rng(params.seed)),
        judge=Judge(rows, RIGID, INLIER),
        confidence=CONFIDENCE,
        max_iterations=MOST_SAMPLES,
    )
    for tried in tries:
        if tried.phase in ("best", "refit") and tried.best is not None:
            phase = "refit" if tried.phase == "refit" else "sample"
            step = replace(
                step,
                phase=phase,
                T_target_source=tried.best.estimate,
                iteration=tried.iteration,
                inliers=tried.best.inliers,
            )
            yield step
    if step.T_target_source is None or step.inliers is None or step.inliers.sum() < FEWEST_AGREE:
        yield replace(step, phase="end", T_target_source=None)
        return
    T_before = step.T_target_source
    step = replace(step, phase="icp", T_before=T_before)
    fits = [
        fit
        for fit in icp(
            scans.fine_target,
            scans.fine_source,
            T_before,
            n_target=point_normals(scans.fine_target),
            gate=Gate(medians=3.0),
            max_iterations=MOST_FITS,
        )
        if fit.phase == "fit" or fit.stop
    ]
    for fit in fits[: SHOWN_FITS - 1]:
        yield replace(step, T_target_source=fit.T_target_source, iteration=fit.iteration)
    yield replace(
        step, phase="end", T_target_source=fits[-1].T_target_source, iteration=fits[-1].iteration
    )


def matched_points(params: Params, p: np.ndarray) -> np.ndarray:
    """Return the indices of the points that are matched.

    Raises:
        InputError: If fewer than three of them are salient.
    """
    if params.where == "every point":
        return np.arange(len(p))
    keypoints = iss_keypoints(p, SALIENT * params.radius, SALIENT * params.radius / 2)
    if len(keypoints) < RIGID.sample_size:
        raise InputError(
            f"{len(keypoints)} ISS keypoints in {len(p):,} points: match every point, or change the"
            " radius"
        )
    return keypoints


def chosen(
    params: Params,
    nearest: NearestDescriptors,
    a: np.ndarray,
    *,
    b: np.ndarray,
    mutual_matches: Matcher,
) -> np.ndarray:
    """Return the matches that the params keep; both filters together are the function that was
    given.

    Raises:
        InputError: If that function names what is not there.
    """
    mutual = mutual_matches(a, b, params.ratio) if params.keep == "both" else None
    try:
        return filtered(nearest, params.keep, params.ratio, mutual=mutual)
    except ValueError as error:
        raise InputError(str(error)) from error


def compared(params: Params, histograms: np.ndarray) -> np.ndarray:
    """Return the descriptors that are compared."""
    return np.sqrt(histograms) if params.compare == "square root" else histograms


def normals_of(params: Params, scans: Scans) -> tuple[np.ndarray, np.ndarray]:
    """Return unit normals of target and source, facing as the params say."""
    n_target, n_source = point_normals(scans.p_target), point_normals(scans.p_source)
    if params.normals == "source flipped":
        n_source = -n_source
    elif params.normals != "outwards":
        rng = np.random.default_rng(params.seed)
        n_source = n_source * rng.choice([-1.0, 1.0], (len(n_source), 1))
        if params.normals == "random in both":
            n_target = n_target * rng.choice([-1.0, 1.0], (len(n_target), 1))
    return n_target, n_source


def picked_of(params: Params, scans: Scans) -> int:
    """Return the source point whose descriptor is shown."""
    if params.picked >= 0:
        return min(params.picked, len(scans.p_source) - 1)
    place = scans.p_source if scans.T_truth is None else apply(scans.T_truth, scans.p_source)
    return int(np.linalg.norm(place - OURS, axis=1).argmin())


def scans_of(params: Params) -> Scans:
    """Return the two scans of a run.

    Raises:
        InputError: If own files are no pair of scans.
    """
    if params.target is None and params.source is None and params.truth is None:
        return _made(only(params, "shape", "turn", "overlap", "noise", "points", "seed"))
    if params.target is None or params.source is None:
        raise InputError(
            f"own scans come in pairs: give both {called('target')} and {called('source')}"
        )
    asked = only(params, "target", "source", "truth", "up", "voxel", "seed")
    return _own(
        asked, tuple(stamp(file) for file in (params.target, params.source, params.truth) if file)
    )


@functools.lru_cache(maxsize=8)
def _made(params: Params) -> Scans:
    T_truth = motion(exp_so3(np.radians(params.turn) * AXIS), SHIFT)
    rng = np.random.default_rng(params.seed)
    made = pair(
        params.shape, params.points, T_truth, rng=rng, overlap=params.overlap, noise=params.noise
    )
    p, q = made.p_source, made.p_target
    return Scans(p_target=q, p_source=p, fine_target=q, fine_source=p, T_truth=T_truth)


@functools.lru_cache(maxsize=4)
def _own(params: Params, _stamps: tuple) -> Scans:
    assert params.target is not None
    assert params.source is not None
    return read_scans(
        params.target,
        params.source,
        params.truth,
        width=WIDTH,
        up=params.up,
        voxel=params.voxel / 100.0,
        rng=np.random.default_rng(params.seed),
    )
