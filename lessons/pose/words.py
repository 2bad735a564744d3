"""What a step says."""

import numpy as np

from lessons.pose.state import Repeated, State
from lessons.pose.trials import TRIPLES
from workbench.algorithms import ransac
from workbench.algorithms.camera_search import Searched
from workbench.geometry.alignment import degrees_between
from workbench.geometry.cameras import camera_center
from workbench.geometry.three_points import unit_rays
from workbench.numerals import angle, coordinates, counted, fixed, length, percent, pixels
from workbench.scene import Caption

COUNTS = ("none", "one", "two", "three", "four")
SEES_EXACTLY = 0.01  # px


def caption(state: State) -> Caption:
    """Return what just happened, with its numbers."""
    match state.now:
        case None:
            return _given(state)
        case Repeated():
            return _repeated(state, state.now)
        case Searched():
            return _searched(state, state.now)
        case _:
            return _sampled(state, state.now)


def _given(state: State) -> Caption:
    subject, params = state.subject, state.params
    n = len(subject.p_shown)
    if subject.T_true is None:
        return Caption(f"{n} points of your own and their pixels, f = {pixels(params.f)}. Where was the camera?")
    noise = f"with noise of σ = {pixels(params.noise)}" if params.noise > 0 else "without noise"
    wrong = int(subject.given.is_outlier.sum())
    also = f"; {wrong} of the points are seen somewhere else altogether" if wrong else ""
    return Caption(
        f"{n} known points (blue), and the picture where a camera saw them, {noise}{also}. Where was the camera? The"
        " green one is the truth, which no method knows."
    )


def _searched(state: State, now: Searched) -> Caption:
    return {
        "rays": _rays,
        "quartic": _quartic,
        "root": _root,
        "both": _both,
        "choose": _choose,
        "solved": _solved,
        "step": _step,
        "stop": _stop,
    }[now.phase](state, now)


def _rays(state: State, now: Searched) -> Caption:
    p = state.subject.given.p_world[:3]
    sides = [length(float(np.linalg.norm(p[i] - p[j]))) for i, j in ((1, 2), (0, 2), (0, 1))]
    cosines = unit_rays(state.subject.xy[:3])
    angles = [
        angle(float(np.degrees(np.arccos(min(1.0, cosines[i] @ cosines[j]))))) for i, j in ((1, 2), (0, 2), (0, 1))
    ]
    return Caption(
        f"Three points (purple), three rays. Known are the sides of the triangle, {', '.join(sides)}, and the angles"
        " between"
        f" the rays to their ends, {', '.join(angles)}; unknown is how long the three rays are."
    )


def _quartic(state: State, now: Searched) -> Caption:
    v = np.sort(now.lengths[:, 2] / now.lengths[:, 0])
    listed = f": v = {', '.join(fixed(value, 3) for value in v)}" if len(v) else ""
    return Caption(
        "Three laws of cosines in three lengths come down to one quartic in v, the third length over the first. Of"
        " its roots"
        f" {COUNTS[len(v)]} {'gives' if len(v) == 1 else 'give'} three positive lengths{listed}."
    )


def _root(state: State, now: Searched) -> Caption:
    k = len(now.candidates)
    if state.T is None:
        return Caption(f"Solution {k} of {len(now.lengths)}: its pose holds numbers that are not finite.", "wrong")
    miss = float(np.sqrt(np.square(state.subject.pixel_errors(state.T)[:3]).mean()))
    sees = "exactly where they were seen" if miss < SEES_EXACTLY else f"{_px(miss)} from where they were seen"
    where = coordinates(_shown_center(state, state.T), 2)
    return Caption(
        f"Solution {k} of {len(now.lengths)}: rays of {', '.join(length(s) for s in now.lengths[k - 1])} put the"
        " triangle's"
        f" corners as far apart as they are. The camera at {where} sees the three points {sees}."
    )


def _choose(state: State, now: Searched) -> Caption:
    plane, rows = state.params.method == "IPPE", slice(3, 4) if state.params.method == "P3P" else slice(None)
    errors = [np.sqrt(np.square(state.subject.pixel_errors(T)[rows]).mean()) for T in now.candidates]
    if plane:
        text = f"Both refined: they miss the points by {_each(errors)}, root mean square. The better one is taken"
    elif len(errors) == 1:
        text = f"The fourth point agrees with the only solution to {_px(errors[0])}"
    else:
        text = f"A fourth point chooses: the {COUNTS[len(errors)]} cameras see it {_each(errors)} from its pixel"
    return _perhaps_the_end(state, f"{text}.{_off(state)}")


def _both(state: State, now: Searched) -> Caption:
    errors = [float(np.sqrt(np.square(state.subject.pixel_errors(T)).mean())) for T in now.candidates]
    apart = degrees_between(now.candidates[0], now.candidates[1])
    return Caption(
        f"A plane, so there are two poses, {angle(apart)} apart, that give the same picture to first order about its"
        " middle."
        f" Perspective tells them apart: they miss the points by {_each(errors)}."
    )


def _solved(state: State, now: Searched) -> Caption:
    error = _px(state.subject.K[0, 0] * now.error)
    n = len(state.subject.p_shown)
    if state.params.method == "DLT":
        text = f"The linear transform: a 3×4 matrix from all {n} points at once, and the rotation nearest to its left"
    else:
        text = f"SQPnP: of all rotations the one that brings all {n} points nearest to their rays"
    return _perhaps_the_end(state, f"{text}. RMS error in the picture {error}.{_off(state)}")


def _perhaps_the_end(state: State, text: str) -> Caption:
    if state.params.refine or state.subject.T_true is None:
        return Caption(text)
    return Caption.verdict(text, right=state.right)


def _step(state: State, now: Searched) -> Caption:
    part = (
        ""
        if now.share == 1.0
        else f", of which {fixed(now.share, 4).rstrip('0')} is taken, as more would raise the error"
    )
    error = _px(state.subject.K[0, 0] * now.error)
    return Caption(f"Gauss-Newton step {now.steps}{part}: RMS error in the picture {error}.{_off(state)}")


def _stop(state: State, now: Searched) -> Caption:
    assert now.stop is not None
    text = f"Stop after {counted(now.steps, 'step')}: {now.stop.message}."
    if state.T is None:
        return Caption(f"{text} It is wrong: without a pose there is nothing to refine.", "wrong")
    text += f" RMS error in the picture {_px(state.subject.K[0, 0] * now.error)}.{_off(state)}"
    return Caption(text) if state.subject.T_true is None else Caption.verdict(text, right=state.right)


def _sampled(state: State, now: ransac.State) -> Caption:
    n = len(state.subject.p_shown)
    limit = pixels(state.params.inlier_pixels)
    if now.phase == "sample":
        wrong = int(state.subject.given.is_outlier[now.sample].sum())
        truth = (
            ""
            if state.subject.T_true is None
            else f" In truth {COUNTS[wrong]} of them {'is an outlier' if wrong == 1 else 'are outliers'}."
        )
        return Caption(f"Sample {now.iteration}: three points by chance.{truth}")
    if now.phase == "degenerate":
        return Caption(f"Sample {now.iteration} has no solution: no camera sees its three points like this.")
    if now.phase == "model":
        return Caption(
            f"Sample {now.iteration} gives a camera. All {n} points vote: yes if seen within {limit}.{_off(state)}"
        )
    fit = now.trial or now.best
    if now.phase == "stop":
        assert now.stop is not None
        text = f"Stop after {counted(now.iteration, 'sample')}: {now.stop.message}."
        if now.best is None:
            return Caption(f"{text} There is no pose.", "wrong")
        text += f" {now.best.count} of {n} points are within {limit}.{_off(state)}"
        return Caption(text) if state.subject.T_true is None else Caption.verdict(text, right=state.right)
    assert fit is not None
    if now.phase == "inliers":
        return Caption(
            f"Sample {now.iteration}: its camera sees {fit.count} of {n} points within {limit}.{_off(state)}"
        )
    if now.phase == "refit":
        return Caption(
            f"Refit on the inliers, by least squares: now {fit.count} of {n} points are within {limit}.{_off(state)}"
        )
    return Caption(
        f"New best after {counted(now.iteration, 'sample')}: {fit.count} of {n} points within {limit}. If that is"
        " the share of"
        f" inliers, {counted(int(min(now.needed, 500)), 'sample')} give 99 % confidence.{_off(state)}"
    )


def _repeated(state: State, now: Repeated) -> Caption:
    n, right = now.pictures, int(np.count_nonzero(state.subject.near(now.degrees, now.metres)))
    if not len(now.Ts):
        return Caption(f"In none of {n} other pictures, with other noise, is there a solution: all are wrong.", "wrong")
    text = f"The same in {n} other pictures, with other noise: half of the rotations are within"
    text += (
        f" {angle(float(np.median(now.degrees)))}, half of the centres within {length(float(np.median(now.metres)))}."
    )
    if now.swapped:
        text += f" In {percent(now.swapped / n, 0)} the wrong one of the two poses fitted better."
    if now.counts is not None:
        shares = [
            f"{percent(count / TRIPLES, 1)} {word}" for count, word in zip(now.counts, COUNTS, strict=True) if count
        ]
        text += f" Of {TRIPLES:,} random triples have so many solutions: {', '.join(shares)}."
    text += f" {right} of {n} are right." if right < n else f" All {n} are right."
    return Caption(text, "good" if right == n else "wrong" if right < 0.9 * n else "info")


def _off(state: State) -> str:
    """Say how far the pose is from the truth; a sentence, or nothing."""
    if state.subject.T_true is None or state.T is None:
        return ""
    degrees, metres = state.off
    return f" The pose is {angle(degrees)} and {length(metres)} from the truth."


def _px(error: float) -> str:
    return pixels(error) if np.isfinite(error) else "without bound, as a point is behind it"


def _each(errors: list) -> str:
    words = [pixels(float(error)) if np.isfinite(error) else "from behind" for error in errors]
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _shown_center(state: State, T: np.ndarray) -> np.ndarray:
    return state.subject.frame.shown(camera_center(T))
