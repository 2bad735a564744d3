"""Write what evaluates a bicubic Bézier patch. The lesson makes a torus of 16 patches with it,
polynomial or with weights: see the presets 'A torus of Bézier patches' and 'With weights'.
"""

import numpy as np
from jaxtyping import Float

from lessons.representations.exercises import STUDENTS, rows_verdict, written
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
)
from workbench.geometry.shapes import bezier

FLAT = "np.mgrid[0.0:4, 0.0:4, 0.0:1].reshape(3, 4, 4).transpose(1, 2, 0)"


@contract(
    slot="bezier_patch",
    preset="cubic",
    forbid=("scipy.interpolate",),
    examples=(
        (f"bezier_patch({FLAT}, np.array([[1.0, 0]]))", "[[3, 0, 0]]"),
        ("bezier_patch(np.ones((4, 4, 3)), np.array([[0.2, 0.7]]))", "[[1, 1, 1]]"),
    ),
)
def bezier_patch(
    control: Float[np.ndarray, "4 4 3"], uv: Float[np.ndarray, "n 2"]
) -> Float[np.ndarray, "n 3"]:
    """Return points of a bicubic patch: the sum over i and j of B_i(u) B_j(v) control[i, j].

    B_k(t) = binomial(3, k) t^k (1 - t)^(3 - k), so that the patch begins in control[0, 0] at u = v
    = 0, and ends in control[3, 0] along u and in control[0, 3] along v.

    Args:
        control: The control net, metres: the first index goes along u, the second along v.
        uv: One row (u, v) per point, each from 0 to 1.

    Returns:
        One point per row, metres. The inputs stay as they are.
    """
    return bezier.bezier_patch(control, uv)


HINT = (
    "Weights B_i(u) B_j(v) with B = (1−t)³, 3t(1−t)², 3t²(1−t), t³; they add up to 1. The first"
    " index goes along u."
)


def a_net(rng: np.random.Generator) -> np.ndarray:
    """Return a bent net without any symmetry."""
    i, j = np.meshgrid(np.arange(4.0), np.arange(4.0), indexing="ij")
    return np.stack([i, 1.5 * j, 0.3 * i * j - 0.2 * i**2], axis=-1) + rng.uniform(
        -0.4, 0.4, (4, 4, 3)
    )


def verdict(
    candidate: Function, control: np.ndarray, uv: np.ndarray, where: str, hint: str = HINT
) -> Verdict:
    """Judge points of one patch."""
    right = bezier.bezier_patch(control, uv)
    return rows_verdict(
        candidate(control, uv), right, lambda k: f"{where}, at u, v = {written(uv[k])}", hint
    )


@check(2)
def points_of_a_patch(candidate: Function) -> Verdict:
    """Points all over a bent patch without symmetry."""
    rng = np.random.default_rng(STUDENTS)
    return verdict(candidate, a_net(rng), rng.random((25, 2)), "On a bent patch")


@check(1)
def corners_of_a_patch(candidate: Function) -> Verdict:
    """At its corners the patch is at the corners of the net."""
    rng = np.random.default_rng(STUDENTS + 1)
    hint = "At u = 1, v = 0 the patch is at control[3, 0]; every other weight is 0 there."
    return verdict(
        candidate, a_net(rng), np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]]), "At a corner", hint
    )


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Net and places are not changed."""
    rng = np.random.default_rng(STUDENTS + 2)
    return left_alone(
        candidate, verdict(candidate, a_net(rng), rng.random((9, 2)), "On a bent patch")
    )


def summed(control: np.ndarray, bu: np.ndarray, bv: np.ndarray) -> np.ndarray:
    """Return the sum of the net with weights along u and v, one row of four each."""
    return np.einsum("ni,nj,ijx->nx", bu, bv, control)


@mistake("You swapped u and v: the first index of the net goes along u.")
def swapped(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Transposes the net."""
    return bezier.bezier_patch(control.transpose(1, 0, 2), uv)


@mistake(
    "You left out the binomials 1, 3, 3, 1: your weights do not add up to 1, and in the middle the"
    " patch sinks."
)
def without_binomials(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Only powers."""
    k = np.arange(4)
    bu, bv = (t[:, None] ** k * (1 - t[:, None]) ** (3 - k) for t in uv.T)
    return summed(control, bu, bv)


@mistake("You used the four corners of the net alone. All 16 control points pull.")
def corners_alone(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Bilinear."""
    bu, bv = (np.column_stack([1 - t, 0 * t, 0 * t, t]) for t in uv.T)
    return summed(control, bu, bv)


@mistake("You run backwards: t and 1 − t are swapped, so that u = 0 gives the end of the patch.")
def backwards(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Swaps the ends."""
    return bezier.bezier_patch(control, 1 - uv)


@mistake("You use u along both directions of the net. The second index goes along v.")
def one_parameter(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Forgets v."""
    return bezier.bezier_patch(control, uv[:, [0, 0]])


@mistake(
    "Your binomials are 1, 2, 2, 1. Those of degree 3 are 1, 3, 3, 1, so that the weights add up"
    " to 1."
)
def wrong_binomials(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Twice for three times."""
    k = np.arange(4)
    times = np.array([1, 2, 2, 1])
    bu, bv = (times * t[:, None] ** k * (1 - t[:, None]) ** (3 - k) for t in uv.T)
    return summed(control, bu, bv)


@mistake(
    "You pass through all control points. A Bézier patch passes through the corners, the others"
    " only pull."
)
def through_all(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Lagrange's interpolation."""
    at = np.arange(4) / 3
    bu, bv = (
        np.stack(
            [
                np.prod([(t - at[j]) / (at[i] - at[j]) for j in range(4) if j != i], axis=0)
                for i in range(4)
            ],
            axis=1,
        )
        for t in uv.T
    )
    return summed(control, bu, bv)


@alternative
def de_casteljau(control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Divides legs, first along u, then along v."""
    answer = np.empty((len(uv), 3))
    for k, (u, v) in enumerate(uv):
        net = np.array(control, float)
        while len(net) > 1:
            net = (1 - u) * net[:-1] + u * net[1:]
        row = net[0]
        while len(row) > 1:
            row = (1 - v) * row[:-1] + v * row[1:]
        answer[k] = row[0]
    return answer
