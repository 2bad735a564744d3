"""Rounds of refining F go on until one moves it hardly, and no further."""

import itertools

import numpy as np
import pytest

from tests.algorithms.test_two_views import steps
from tests.geometry.test_essential import pair
from workbench.algorithms.two_views import MOST_ROUNDS, STILL


@pytest.mark.parametrize(("seed", "sigma"), [(0, 0.0), (1, 1.0), (2, 3.0)])
def test_the_last_round_alone_is_still(seed, sigma):
    _, _, uv_first, uv_second = pair(seed, 30, sigma)
    states = [
        s
        for s in steps(uv_first, uv_second, route="refined F")
        if s.stage in ("rank two", "refined F")
    ]
    rounds = [state for state in states if state.stage == "refined F"]
    assert [state.rounds for state in rounds] == list(range(1, len(rounds) + 1))
    still = []
    for before, after in itertools.pairwise(states):
        F = after.F * np.sign((after.F * before.F).sum())
        still.append(np.abs(F - before.F).max() < STILL * np.abs(after.F).max())
    assert not any(still[:-1])
    assert still[-1] or len(rounds) == MOST_ROUNDS
    if sigma == 0.0:
        assert len(rounds) < MOST_ROUNDS
