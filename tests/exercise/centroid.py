"""Write the centroid."""

import sys

import numpy as np

from workbench.exercise import band, check, contract, fail, full, mistake
from workbench.exercise.model import exercise_in


@contract(
    slot="turn",
    examples=(("centroid(np.array([[0, 0, 0], [2, 4, 6]]))", "array([1., 2., 3.])"),),
    seconds=1.0,
)
def centroid(p: np.ndarray) -> np.ndarray:
    """Return the mean of the rows of p, (n, 3), metres."""
    return p.mean(axis=0)


@check(2)
def is_the_mean(candidate):
    """The centroid of random points is right."""
    p = np.random.default_rng(1).normal(size=(50, 3))
    error = float(np.linalg.norm(candidate(p) - p.mean(0)))
    return band(
        "centroid off by",
        error,
        "m",
        good=1e-9,
        fair=1e-3,
        hint="Sum the rows and divide by their number.",
    )


@check(1)
def leaves_the_input_alone(candidate):
    """The input is not modified."""
    candidate(np.ones((4, 3)))
    return (
        fail("Your function changed its input: work on a copy.")
        if candidate.changed_inputs
        else full("Unchanged.")
    )


@check(1, public=False)
def moves_along(candidate):
    """Moving all points moves the centroid along."""
    p = np.random.default_rng(7).normal(size=(20, 3))
    off = float(np.abs(candidate(p + 5.0) - candidate(p) - 5.0).max())
    return band(
        "it moves along but for",
        off,
        "m",
        good=1e-9,
        fair=1e-3,
        hint="A mean moves with its points.",
    )


@mistake("You returned the median of each coordinate, not the mean.")
def median(p: np.ndarray) -> np.ndarray:
    return np.median(p, axis=0)


@mistake("You returned the sum: divide by the number of points.")
def total(p: np.ndarray) -> np.ndarray:
    return p.sum(axis=0)


@mistake("You averaged each row: the mean runs over axis 0.")
def columns(p: np.ndarray) -> np.ndarray:
    return p.mean(axis=1)


EXERCISE = exercise_in(sys.modules[__name__], "fake")
