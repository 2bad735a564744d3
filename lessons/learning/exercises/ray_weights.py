"""Write how much each sample of a ray counts in the colour that its pixel sees. The radiance field
of the lesson learns through your weights; the gradient is ours.
"""

import numpy as np
from jaxtyping import Float

from lessons.learning.exercises import STUDENTS, entries_verdict
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.cameras import volume_rendering

HINT = (
    "w_i = T_i (1 − exp(−density_i · spacing)); T_i is what passes all samples before i, and not i"
    " itself."
)


@contract(
    slot="ray_weights",
    preset="two",
    examples=(
        ("ray_weights(array([[0., 1., 1.]]) * np.log(2), 1.0)", "[[0, 0.5, 0.25]]"),
        ("ray_weights(array([[1000., 1.]]), 0.5)", "[[1, 0]]"),
    ),
)
def ray_weights(density: Float[np.ndarray, "r s"], spacing: float) -> Float[np.ndarray, "r s"]:
    """Return how much each sample counts in what its ray sees.

    A sample stops the share 1 - exp(-density * spacing) of the light that reaches it; what reaches
    it is what all samples before it let through. The weight is the product: the share of the
    pixel's colour that comes from there.

    Args:
        density: One row for each of r rays, s samples from near to far, 1/m, not negative.
        spacing: Length of the way that a sample stands for, m.

    Returns:
        r rows of s weights. The input stays as it is.
    """
    return volume_rendering.ray_weights(density, spacing)


def media(seed: int, rays: int, samples: int) -> np.ndarray:
    """Return densities of rays with empty stretches and dense ones."""
    rng = np.random.default_rng(seed)
    return rng.exponential(3.0, (rays, samples)) * (rng.random((rays, samples)) < 0.7)


def found(candidate: Function, density: np.ndarray, spacing: float, case: str = "") -> Verdict:
    """Judge all weights by ours."""
    right = volume_rendering.ray_weights(density, spacing)
    return entries_verdict(candidate(density, spacing), right, HINT, case)


@check(2)
def one_ray(candidate: Function) -> Verdict:
    """Five samples, of which the first is empty and the third dense."""
    return found(candidate, np.array([[0.0, 0.5, 4.0, 4.0, 0.5]]), 0.25)


@check(2)
def weights_and_what_passes_are_one(candidate: Function) -> Verdict:
    """The weights of a ray add up to 1 minus the share that passes all of it."""
    density = media(STUDENTS, 6, 20)
    passed = np.exp(-0.1 * density.sum(axis=1))
    return entries_verdict(candidate(density, 0.1).sum(axis=1), 1 - passed, HINT, "Sums: ")


@check(1)
def densities_are_left_alone(candidate: Function) -> Verdict:
    """The densities that come in are not changed."""
    return left_alone(candidate, found(candidate, media(STUDENTS + 1, 3, 8), 0.2))


def _stopped(density: np.ndarray, spacing: float) -> np.ndarray:
    return 1 - np.exp(-density * spacing)


def _before(passed: np.ndarray) -> np.ndarray:
    """Return the running product of a row, without the entry itself."""
    return np.cumprod(np.concatenate([np.ones((len(passed), 1)), passed[:, :-1]], axis=1), axis=1)


@mistake(
    "Your T_i already has sample i in it. Light reaches sample i through those before it: begin"
    " with 1."
)
def own_sample_included(density: np.ndarray, spacing: float) -> np.ndarray:
    """Product up to i."""
    stopped = _stopped(density, spacing)
    return np.cumprod(1 - stopped, axis=1) * stopped


@mistake(
    "You left out the spacing: density is per metre, and a sample stands for `spacing` metres."
)
def no_spacing(density: np.ndarray, spacing: float) -> np.ndarray:
    """Takes 1 m."""
    return volume_rendering.ray_weights(density, 1.0)


@mistake(
    "You took density · spacing as the share that is stopped: that may exceed 1. It is 1 −"
    " exp(−density · spacing)."
)
def linear_share(density: np.ndarray, spacing: float) -> np.ndarray:
    """Linear alpha."""
    stopped = density * spacing
    return _before(1 - stopped) * stopped


@mistake(
    "T_i is exp(−…) in your function, but the share that is stopped is density · spacing: it is 1 −"
    " exp(−…) as well."
)
def linear_share_behind_exponentials(density: np.ndarray, spacing: float) -> np.ndarray:
    """Linear in one of the two factors."""
    return _before(np.exp(-density * spacing)) * density * spacing


@mistake(
    "You left out T_i: what stands behind a wall is not seen. Multiply by what all samples before"
    " let through."
)
def nothing_hides(density: np.ndarray, spacing: float) -> np.ndarray:
    """Only what is stopped."""
    return _stopped(density, spacing)


@mistake("Your ray runs from far to near: the first sample is the nearest, and hides the others.")
def far_to_near(density: np.ndarray, spacing: float) -> np.ndarray:
    """Backwards."""
    return volume_rendering.ray_weights(density[:, ::-1], spacing)[:, ::-1]


@mistake(
    "You divided by the sum. The weights of a ray need not add up to 1: the rest sees what lies"
    " behind."
)
def normalised(density: np.ndarray, spacing: float) -> np.ndarray:
    """Adds up to 1."""
    w = volume_rendering.ray_weights(density, spacing)
    return w / np.maximum(w.sum(axis=1, keepdims=True), 1e-12)


@mistake(
    "You return what reaches each sample. Its weight is the share of that which it stops: times 1 −"
    " exp(−…)."
)
def only_what_arrives(density: np.ndarray, spacing: float) -> np.ndarray:
    """T alone."""
    return _before(np.exp(-density * spacing))


@mistake("You accumulate over the rays, not along them: samples are in axis 1.")
def over_the_rays(density: np.ndarray, spacing: float) -> np.ndarray:
    """The other axis."""
    return volume_rendering.ray_weights(density.T, spacing).T


@alternative
def sample_by_sample(density: np.ndarray, spacing: float) -> np.ndarray:
    """Follows the light."""
    w = np.zeros(density.shape)
    for r in range(density.shape[0]):
        light = 1.0
        for s in range(density.shape[1]):
            stays = light * np.exp(-density[r, s] * spacing)
            w[r, s] = light - stays
            light = stays
    return w


@alternative
def with_products(density: np.ndarray, spacing: float) -> np.ndarray:
    """A running product of what passes."""
    stopped = _stopped(density, spacing)
    return _before(1 - stopped) * stopped


@alternative
def by_differences(density: np.ndarray, spacing: float) -> np.ndarray:
    """What passes up to a sample, minus what passes it."""
    passed = np.exp(
        -np.cumsum(np.concatenate([np.zeros((len(density), 1)), density], axis=1), axis=1) * spacing
    )
    return passed[:, :-1] - passed[:, 1:]
