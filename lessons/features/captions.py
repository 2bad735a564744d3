"""What each step says: what just happened, its numbers, and at the end whether it is right."""

import numpy as np
import scipy

from lessons.features.state import INLIER, PIXELS, Outlined, Pictured, Scanned, State
from workbench.certain import sure
from workbench.geometry.motions import apply
from workbench.numerals import angle, counted, fixed_row, length, percent
from workbench.scene import Caption

HALF = 0.5
SIFT = (
    "SIFT's keypoints are where the picture differs most from a smoother one, across places and"
    " sizes:"
)
FILTERS = {
    "nearest": "every nearest one",
    "ratio": "those much nearer than the second nearest",
    "mutual": "those nearest both ways",
    "both": "those nearest both ways and much nearer than the second",
}


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    match state.now:
        case Scanned() as step:
            return _scanned(state, step)
        case Pictured() as step:
            return _pictured(state, step)
        case Outlined() as step:
            return _outlined(state, step)


def _share(state: State) -> str:
    share = state.right_share
    return "" if np.isnan(share) else f" {percent(share, 0)} of them are right."


def _scanned(state: State, step: Scanned) -> Caption:
    params, scans = state.params, step.scans
    match step.phase:
        case "scans":
            text = f"Two scans, {len(scans.p_target):,} and {len(scans.p_source):,} points."
            text += " Nobody says how they lie to each other."
            if scans.own:
                text += " They count as 1.2 m wide."
            return Caption(text)
        case "normals":
            side = {
                "outwards": "they face away from the middle",
                "source flipped": "those of the source were turned inside out",
                "random in source": "each of the source faces either side by chance",
                "random in both": "each of both scans faces either side by chance",
            }[params.normals]
            return Caption(f"Each point gets a normal from its 16 nearest points; {side}.")
        case "pairs":
            return Caption(_pair_text(state, step))
        case "histogram":
            return Caption(_histogram_text(step))
        case "similar":
            return Caption(
                "The descriptor of the picked point against that of every target point: dark is"
                " alike. The nearest of all is its match."
            )
        case "nearest":
            which = (
                "source point takes the target point"
                if params.where == "every point"
                else "keypoint takes the one"
            )
            return Caption(f"Every {which} with the nearest descriptor.{_share(state)}")
        case "kept":
            kept = f"{len(sure(step.pairs)):,} of {len(sure(step.asked)):,}"
            return Caption(f"Keep {FILTERS[params.keep]}: {kept} stay.{_share(state)}")
        case "sample":
            return Caption(
                f"Sample {step.iteration:,} of three matches gives the best motion so far:"
                f" {_votes(step)}.{_off(step)}"
            )
        case "refit":
            return Caption(
                f"The motion is fitted again to all that agree: {_votes(step)}.{_off(step)}"
            )
        case "icp":
            return Caption(
                f"Fit {step.iteration} of ICP starts from there and needs no"
                f" descriptor.{_off(step)}"
            )
        case "end":
            return _end(step)


def _pair_text(state: State, step: Scanned) -> str:
    count = len(sure(step.around))
    if not count:
        return (
            f"No other point lies within {length(state.params.radius)} of the picked one: it has no"
            " pairs."
        )
    text = f"{counted(count, 'pair')} within {length(state.params.radius)} of the picked point."
    theta, alpha, phi = sure(step.angles)[0]
    return (
        f"{text} Of each three angles are kept: the first has (θ, α, φ) ="
        f" ({fixed_row((theta, alpha, phi), 2)})."
    )


def _histogram_text(step: Scanned) -> str:
    off = np.linalg.norm(sure(step.f_target) - sure(step.f_source)[step.picked], axis=1)
    text = "33 bars: three histograms of the point's own pairs, and its neighbours' mixed in."
    if step.scans.T_truth is None:
        return f"{text} Beside it the most alike of the target."
    nearer = int(np.count_nonzero(off < off[step.there]))
    return (
        f"{text} {counted(nearer, 'target point is', 'target points are')} more alike than the true"
        " one."
    )


def _votes(step: Scanned) -> str:
    inliers = sure(step.inliers)
    return f"{np.count_nonzero(inliers):,} of {len(inliers):,} matches agree"


def _off(step: Scanned) -> str:
    if step.scans.T_truth is None:
        return ""
    return (
        f" It is {angle(step.error.rotation)} and {length(step.error.displacement)} (RMS) from the"
        " truth."
    )


def _end(step: Scanned) -> Caption:
    if step.T_target_source is None:
        some = 0 if step.inliers is None else int(step.inliers.sum())
        text = (
            f"{some or 'No'} matches agree on a motion, and any three agree on some: nothing is"
            " found."
        )
        return Caption(text, "info" if step.scans.T_truth is None else "wrong")
    text = f"ICP ends after {counted(step.iteration, 'fit', 'fits')}."
    if step.T_before is not None and step.scans.T_truth is not None:
        before = step.scans.error(step.T_before).rotation
        text = (
            f"ICP ends after {counted(step.iteration, 'fit', 'fits')}: {angle(before)} →"
            f" {angle(step.error.rotation)}."
        )
        text += f" Points are {length(step.error.displacement)} (RMS) from the truth."
    if step.scans.T_truth is None:
        distances = scipy.spatial.KDTree(step.scans.p_target).query(
            apply(step.T_target_source, step.scans.p_source)
        )[0]
        near = percent(float(np.mean(distances < INLIER)), 0)
        text += f" Now {near} of the source's points have a target point within {length(INLIER)}."
        return Caption(
            f"{text} Only their known pose could say whether it is right; none is given."
        )
    return Caption.verdict(text + (" It has come home." if step.home else ""), right=step.home)


def _pictured(state: State, step: Pictured) -> Caption:
    params = state.params
    match step.phase:
        case "pictures":
            h, w = step.first.shape
            turned = f", the right one turned by {angle(params.turn)}" if params.turn else ""
            return Caption(f"Two pictures of {w} × {h} pixels, taken from two places{turned}.")
        case "gradient":
            return Caption(
                "How steep the grey levels are: large along every edge, so a place on an edge can"
                " slide."
            )
        case "response":
            return Caption(
                "det(M) − 0.04 trace(M)² of the products of derivatives around each pixel: above"
                " zero only where two directions are steep."
            )
        case "corners":
            left, right = len(sure(step.uv_first)), len(sure(step.uv_second))
            count = f"{left} left and {right} right."
            text = f"The strongest local maxima are corners: {count}"
            if step.sifts:
                text = f"{SIFT} {count} A circle is its size, the line in it its main direction."
            if min(left, right) < 2:
                return Caption(f"{text} That is too few to match.")
            return Caption(text)
        case "patch":
            if step.sifts:
                return Caption(
                    "A keypoint is described by 128 numbers: how steep the grey levels are in 8"
                    " directions, in 4 × 4 cells, counted from its own direction. These two are the"
                    " clearest match, both turned to it."
                )
            return Caption(
                f"A corner is described by the {params.patch} × {params.patch} pixels around it,"
                " less their mean and of length 1. These two are the clearest match."
            )
        case "nearest":
            which = ("keypoint", "descriptor") if step.sifts else ("corner", "patch")
            return Caption(
                f"Every left {which[0]} takes the right one with the nearest"
                f" {which[1]}.{_known(state, step)}"
            )
        case "kept":
            return _kept_pictures(state, step)


def _known(state: State, step: Pictured) -> str:
    if step.known is None:
        return ""
    if not step.known.any():
        return " Of none is the truth known."
    return f" {percent(state.right_share, 0)} lie within {PIXELS:.0f} px of the truth."


def _kept_pictures(state: State, step: Pictured) -> Caption:
    kept = f"{len(sure(step.pairs))} of {len(sure(step.uv_first))}"
    text = f"Keep {FILTERS[state.params.keep]}: {kept} stay.{_known(state, step)}"
    if step.known is None or not step.known.any():
        return Caption(text)
    right = state.right_share > HALF
    return (
        Caption.verdict(text, right=True)
        if right
        else Caption(f"{text} Most of what is kept is wrong.", "wrong")
    )


def _outlined(state: State, step: Outlined) -> Caption:
    params = state.params
    match step.phase:
        case "outlines":
            return Caption(
                f"A horse's outline in {len(step.first)} points, and the same one larger and turned"
                f" by {angle(params.turn)}."
            )
        case "bins":
            return Caption(
                "Around the picked point, 5 rings and 12 sectors: how many other points lie in"
                f" each is its descriptor. Angles count {params.angles}."
            )
        case "histogram":
            return Caption(
                "The histogram of the picked point, and that of its true partner on the other"
                " outline."
            )
        case "costs":
            return Caption(
                "How different every two histograms are: rows are points of the first outline,"
                " columns of the second. The true partners cost"
                f" {np.diag(sure(step.costs)).mean():.2f} on average."
            )
        case "matched":
            text = f"One to one, at the least total cost.{_share(state)}"
            right = state.right_share > HALF
            return (
                Caption.verdict(text, right=True)
                if right
                else Caption(f"{text} Most are wrong.", "wrong")
            )
