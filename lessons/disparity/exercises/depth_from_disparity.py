"""Write what turns a disparity into a depth. The lesson builds the cloud of points with it, from
the map of every step; what is infinitely far or unknown must stay so, or the cloud shows points
that nobody saw.
"""

import numpy as np
from jaxtyping import Float

from lessons.disparity.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.cameras import stereo


@contract(
    slot="depth",
    examples=(
        ("depth_from_disparity(np.array([84.0, 16.8, 4.2]), 700.0, 0.12)", "[1, 5, 20]"),
        (
            "depth_from_disparity(np.array([[8.0, 0.0], [np.nan, -2.0]]), 100.0, 0.2)",
            "[[2.5, np.inf], [nan, nan]]",
        ),
    ),
)
def depth_from_disparity(
    d: Float[np.ndarray, "..."], f: float, baseline: float
) -> Float[np.ndarray, "..."]:
    """Return the depth that each disparity stands for, metres along the optical axis.

    Two cameras look along the same direction, the right one `baseline` to the right of the left
    one. A point at depth Z is d pixels further left in the right picture. Similar triangles give Z
    / baseline = f / d.

    Args:
        d: Disparities, x in the left picture less x in the right one, pixels; an array of any
            shape, fractions included. nan is unknown.
        f: Focal length of both cameras, pixels.
        baseline: Distance between the cameras, metres.

    Returns:
        Depths, metres, in a new array of the same shape. 0 gives inf: the rays are parallel, the
        point is infinitely far. nan gives nan. A negative disparity gives nan: nothing in front of
        both cameras causes one.
    """
    return stereo.depth_from_disparity(d, f, baseline)


DEPTH_HINT = "Z = f B / d: the nearer, the larger the shift."


def depth_verdict(got: np.ndarray, right: np.ndarray, label: str = "") -> Verdict:
    """Judge depths by the largest relative error, per cent, and say where it is."""
    off = np.abs(got - right) / right
    i = np.unravel_index(np.argmax(np.where(np.isfinite(off), off, np.inf)), off.shape)
    hint = f"Yours is {against(got[i], right[i], unit='m')}. {DEPTH_HINT}"
    return band(
        f"{label}largest error" if label else "Largest error",
        100 * float(off[i]),
        "%",
        good=0.01,
        fair=5,
        hint=hint,
    )


@check(2)
def near_and_far(candidate: Function) -> Verdict:
    """With f = 700 px and a baseline of 0.12 m, 84, 16.8 and 4.2 px are 1, 5 and 20 m."""
    return depth_verdict(
        candidate(np.array([84.0, 16.8, 4.2]), 700.0, 0.12), np.array([1.0, 5.0, 20.0])
    )


@check(2)
def half_the_shift(candidate: Function) -> Verdict:
    """Over a whole map, half the disparity is twice the depth."""
    d = np.random.default_rng(STUDENTS).uniform(2.0, 60.0, (6, 8))
    Z = candidate(d, 400.0, 0.2)
    return worst(
        (
            depth_verdict(Z, 80.0 / d),
            depth_verdict(candidate(d / 2, 400.0, 0.2), 160.0 / d, "Half: "),
        )
    )


@check(1)
def disparities_are_left_alone(candidate: Function) -> Verdict:
    """The disparities that come in are not changed."""
    d = np.random.default_rng(STUDENTS + 1).uniform(1.0, 30.0, 20)
    return left_alone(candidate, depth_verdict(candidate(d, 500.0, 0.1), 50.0 / d))


@mistake(
    "Your depth grows with the disparity. It is the other way round: near things jump further. Z ="
    " f B / d."
)
def proportional(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Depth grows with the disparity."""
    return baseline * d / f


@mistake("You returned 1 / Z. By similar triangles Z / B = f / d, so that Z = f B / d.")
def upside_down(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """One over the depth."""
    return d / (f * baseline)


@mistake(
    "You returned f / d: the depth in baselines. Multiply by the baseline, and it is in metres."
)
def baseline_forgotten(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Depth in baselines."""
    return np.where(d >= 0, f / np.abs(d), np.nan)


@mistake(
    "You returned B / d, metres per pixel. Multiply by the focal length, which is in pixels too: Z"
    " = f B / d."
)
def f_forgotten(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Metres over pixels."""
    return np.where(d >= 0, baseline / np.abs(d), np.nan)


@mistake(
    "You rounded the disparity to whole pixels. Far away that costs metres: at 20 m, 4.2 px instead"
    " of 4 is one metre."
)
def whole_pixels(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Drops what is between the pixels."""
    d = np.round(d)
    return np.where(d >= 0, f * baseline / np.abs(d), np.nan)


@mistake(
    "All is right but d = 0, for which you returned nan. Parallel rays are no missing measurement:"
    " the point is infinitely far, return inf."
)
def zero_is_unknown(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Takes 0 for missing."""
    return np.where(d > 0, f * baseline / d, np.nan)


@mistake(
    "Where d is not positive you returned a depth of 0, which is at the camera. d = 0 is infinitely"
    " far (inf); nan and negative disparities are unknown (nan)."
)
def zero_for_all_else(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Gives a depth of 0 to whatever is not positive."""
    return np.where(d > 0, f * baseline / d, 0.0)


@mistake(
    "You replaced small disparities by a tiny positive number: the depth is then a made-up one. Let"
    " d = 0 give inf, and negative ones nan."
)
def zero_made_small(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Keeps the division from its infinity."""
    return f * baseline / np.maximum(d, 1e-6)


@mistake(
    "All is right but negative disparities, which you turned into points behind the cameras."
    " Nothing that both see causes one: return nan."
)
def behind_the_cameras(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Divides whatever comes."""
    return f * baseline / d


@mistake(
    "All is right but negative disparities, whose sign you dropped. Nothing in front of both"
    " cameras causes one, it is a wrong match: return nan."
)
def sign_dropped(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Takes the disparity's size."""
    return f * baseline / np.abs(d)


@mistake(
    "All is right but unknown disparities (nan), which you took for 0, infinitely far. Unknown"
    " stays unknown: return nan."
)
def unknown_made_0(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Gives unknown disparities the value 0."""
    d = np.nan_to_num(d)
    return np.where(d >= 0, f * baseline / np.abs(d), np.nan)


@alternative
def depth_one_by_one(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """A case after the other, number by number."""
    depth = []
    for shift in d.ravel().tolist():
        if shift > 0:
            depth.append(f * baseline / shift)
        else:
            depth.append(float("inf") if shift == 0 else float("nan"))
    return np.array(depth).reshape(d.shape)


@alternative
def depth_by_masks(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """From the angle between the two rays, into an array of nan."""
    depth = np.full(d.shape, np.nan)
    depth[d == 0] = np.inf
    depth[d > 0] = baseline / (d[d > 0] / f)
    return depth
