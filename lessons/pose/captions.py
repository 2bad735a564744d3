"""What a step says."""

from collections.abc import Sequence

import numpy as np

from lessons.pose.state import FAR_DEGREES, GUESSED_FOCAL, Repeated, State
from lessons.pose.trials import ANEW, TRIPLES
from workbench.algorithms.cameras.camera_search import Searched
from workbench.algorithms.robust import ransac
from workbench.geometry.cameras import camera_center
from workbench.geometry.cameras.planar_motions import is_flat
from workbench.geometry.cameras.three_points import unit_rays
from workbench.geometry.motions import angle_between
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.points.metrics import rms
from workbench.numerals import angle, coordinates, counted, fixed, length, percent, pixels
from workbench.scene import Caption

COUNTS = ("none", "one", "two", "three", "four")
SIDES = ((1, 2), (0, 2), (0, 1))  # of the triangle, opposite to its corners
SEES_EXACTLY = 0.01  # px


def caption(state: State) -> Caption:
    """Return what just happened, with its numbers."""
    match state.now:
        case None:
            return Caption(_given(state))
        case Repeated():
            return _repeated(state, state.now)
        case Searched(phase="stop") as search:
            assert search.stop is not None
            text = f"Stop after {counted(search.steps, 'step')}: {search.stop.message}."
            if state.T is None:
                return Caption(
                    f"{text} It is wrong: without a pose there is nothing to refine.", "wrong"
                )
            return _end(state, f"{text} RMS error in the picture {_px(state.rms)}.{_off(state)}")
        case Searched(phase="choose" | "solved" | "step") as search:
            text = {"choose": _choose, "solved": _solved, "step": _step}[search.phase](
                state, search
            ) + _off(state)
            return (
                Caption(text)
                if search.phase == "step" or state.params.refine
                else _end(state, text)
            )
        case Searched() as search:
            tone = "wrong" if search.phase == "root" and state.T is None else "info"
            return Caption(
                {"rays": _rays, "quartic": _quartic, "root": _root, "both": _both}[search.phase](
                    state, search
                ),
                tone,
            )
        case _:
            return _sampled(state, state.now)


def _end(state: State, text: str) -> Caption:
    if state.subject.T_true is not None:
        return Caption.verdict(text, right=state.right)
    guessed = state.params.focal == GUESSED_FOCAL
    return Caption(
        f"{text} f = {pixels(GUESSED_FOCAL)} is a guess: set your camera's." if guessed else text
    )


def _given(state: State) -> str:
    subject, params = state.subject, state.params
    if subject.T_true is None:
        n = len(subject.p_shown)
        u, v = params.principal
        given = f"{n} points of your own and their pixels."
        if params.focal == GUESSED_FOCAL:
            ask = (
                f"What is its focal length? Until you set it, {pixels(params.focal)} is taken as a"
                " guess"
            )
            return (
                f"{given} Where was your camera? {ask}, and ({u:g}, {v:g}) as the principal point."
            )
        return (
            f"{given} Where was your camera, with the focal length that you say,"
            f" {pixels(params.focal)}, and the principal point ({u:g}, {v:g})?"
        )
    noise = f"with noise of σ = {pixels(params.noise)}" if params.noise > 0 else "without noise"
    wrong = int(subject.given.is_outlier.sum())
    also = f"; {wrong} of the points are seen somewhere else altogether" if wrong else ""
    return (
        f"{len(subject.p_shown)} known points (blue), and in the picture where a camera saw them,"
        f" {noise}{also}. Where was the camera? The green one is the truth, which no method knows."
    )


def _rays(state: State, search: Searched) -> str:
    p = state.subject.given.p_world
    n = unit_rays(state.subject.xy[:3])
    sides = ", ".join(length(float(np.linalg.norm(p[i] - p[j]))) for i, j in SIDES)
    angles = ", ".join(angle(float(np.degrees(angle_between(n[i], n[j])))) for i, j in SIDES)
    return (
        f"Three points (purple), three rays. Known are the sides of the triangle, {sides}, and the"
        f" angles between the rays to their ends, {angles}; unknown is how long the three rays are."
    )


def _quartic(state: State, search: Searched) -> str:
    v = np.sort(search.lengths[:, 2] / search.lengths[:, 0])
    listed = f": v = {', '.join(fixed(value, 3) for value in v)}" if len(v) else ""
    return (
        "Three laws of cosines in three lengths come down to one quartic in v, the third length"
        f" over the first. Of its roots {COUNTS[len(v)]} {'gives' if len(v) == 1 else 'give'} three"
        f" positive lengths{listed}."
    )


def _root(state: State, search: Searched) -> str:
    k = len(search.candidates)
    subject = state.subject
    if state.T is None:
        return (
            f"Solution {k} of {len(search.lengths)}: its pose holds numbers that are not finite. It"
            " is wrong."
        )
    miss = rms(subject.pixel_errors(state.T)[:3])
    sees = (
        "exactly where they were seen"
        if miss < SEES_EXACTLY
        else f"{_px(miss)} from where they were seen"
    )
    rays = ", ".join(length(s) for s in search.lengths[k - 1])
    where = coordinates(subject.frame.shown(camera_center(state.T)), 2)
    return (
        f"Solution {k} of {len(search.lengths)}: rays of {rays} put the triangle's corners as far"
        f" apart as they are. The camera at {where} sees the three points {sees}."
    )


def _both(state: State, search: Searched) -> str:
    return (
        f"A plane, so there are two poses, {angle(degrees_between(*search.candidates))} apart, that"
        " give the same picture to first order about its middle. Perspective tells them apart:"
        f" they miss the points by {_misses(state, search)}."
    )


def _choose(state: State, search: Searched) -> str:
    if state.params.method == "IPPE":
        return (
            f"Both refined: they miss the points by {_misses(state, search)}, root mean square. The"
            " better one is taken."
        )
    if len(search.candidates) == 1:
        return f"The fourth point agrees with the only solution to {_misses(state, search)}."
    cameras = f"{COUNTS[len(search.candidates)]} cameras"
    return f"A fourth point chooses: the {cameras} see it {_misses(state, search)} from its pixel."


def _solved(state: State, search: Searched) -> str:
    n = len(state.subject.p_shown)
    controls = "three" if is_flat(state.subject.given.p_world) else "four"
    text = {
        "DLT": (
            f"The linear transform: a 3×4 matrix from all {n} points at once, and the rotation"
            " nearest to its left"
        ),
        "EPnP": (
            f"EPnP: all {n} points are weighted sums of {controls} control points, which are put"
            " before the camera so that the points come near their rays and these are as far apart"
            " as they are"
        ),
        "SQPnP": (
            f"SQPnP: of all rotations the one that brings all {n} points nearest to their rays"
        ),
    }[state.params.method]
    return f"{text}. RMS error in the picture {_px(state.rms)}."


def _step(state: State, search: Searched) -> str:
    part = (
        f", of which {fixed(search.share, 4).rstrip('0')} is taken, as more would raise the error"
        * (search.share < 1.0)
    )
    return f"Gauss-Newton step {search.steps}{part}: RMS error in the picture {_px(state.rms)}."


def _sampled(state: State, step: ransac.State) -> Caption:
    known = state.subject.T_true is not None
    limit = pixels(state.params.inlier_pixels)
    fit = step.trial or step.best
    sample = f"Sample {step.iteration}"
    off = _off(state)
    within = f"{fit.count if fit else 0} of {len(state.subject.p_shown)} points"
    if step.phase == "stop":
        assert step.stop is not None
        text = f"Stop after {counted(step.iteration, 'sample')}: {step.stop.message}."
        return (
            _end(state, f"{text} {within} are within {limit}.{off}")
            if fit
            else Caption(f"{text} It is wrong.", "wrong")
        )
    wrong = int(state.subject.given.is_outlier[step.sample].sum())
    truth = (
        f" In truth {COUNTS[wrong]} of them {'is an outlier' if wrong == 1 else 'are outliers'}."
        * known
    )
    needed = counted(int(min(step.needed, 500)), "sample")
    return Caption(
        {
            "sample": f"{sample}: three points by chance.{truth}",
            "degenerate": f"{sample} has no solution: no camera sees its three points like this.",
            "model": (
                f"{sample} gives a camera. All points vote: yes if it sees them within"
                f" {limit}.{off}"
            ),
            "inliers": f"{sample}: its camera sees {within} within {limit}.{off}",
            "refit": (
                f"Refit on the inliers, by least squares: now {within} are within {limit}.{off}"
            ),
            "best": (
                f"New best after {counted(step.iteration, 'sample')}: {within} within {limit}. If"
                f" that is the share of inliers, {needed} give 99 % confidence.{off}"
            ),
        }[step.phase]
    )


def _repeated(state: State, trials: Repeated) -> Caption:
    n = trials.pictures
    right = int(np.count_nonzero(state.subject.near(trials.degrees, trials.metres)))
    if not len(trials.Ts):
        return Caption(
            f"In none of {n} other pictures, with other noise, is there a solution: all are wrong.",
            "wrong",
        )
    turn, centre = angle(float(np.median(trials.degrees))), length(float(np.median(trials.metres)))
    text = (
        f"The same in {n} other pictures, with other noise: half of the rotations are within"
        f" {turn}, half of the"
    )
    text += f" centres within {centre}."
    if trials.swapped:
        text += (
            f" In {percent(trials.swapped / n, 0)} the wrong one of the two poses fitted better."
        )
    if trials.counts is not None:
        shares = ", ".join(
            f"{percent(k / TRIPLES, 1)} {word}"
            for k, word in zip(trials.counts, COUNTS, strict=True)
            if k
        )
        text += f" Of {TRIPLES:,} random triples have so many solutions: {shares}."
    text += f" {right} of {n} are right." if right < n else f" All {n} are right."
    if trials.anew is not None:
        far = [percent(share, 0) for share in trials.far]
        text += (
            f" Apart from these, of {ANEW} random cameras with as many random points our EPnP is"
            " over"
        )
        text += f" {angle(FAR_DEGREES)} off in {far[0]}, SQPnP in {far[1]}."
    if right == n:
        return Caption(text, "good")
    return Caption(text, "wrong" if right < 0.9 * n else "info")


def _off(state: State) -> str:
    """Say how far the pose is from the truth; a sentence, or nothing."""
    if state.subject.T_true is None or state.T is None:
        return ""
    return f" The pose is {angle(state.off[0])} and {length(state.off[1])} from the truth."


def _px(error: float) -> str:
    return pixels(error) if np.isfinite(error) else "without bound, as a point is behind it"


def _misses(state: State, search: Searched) -> str:
    """Say how far each candidate sees the points that judge, or the fourth one, from their
    pixels.
    """
    errors: Sequence[float] = [state.judged(T) for T in search.candidates]
    words = [pixels(error) if np.isfinite(error) else "from behind" for error in errors]
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
