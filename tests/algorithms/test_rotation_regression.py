"""Networks that tell turns: the gradient of both losses through every representation, and what is
learned.
"""

import numpy as np
import pytest

from tests.algorithms.gradients import assert_gradient, descended
from workbench.algorithms.learning import rotation_regression
from workbench.algorithms.learning.rotation_regression import regress
from workbench.geometry.motions.rotation_outputs import IN_PLANE, IN_SPACE, random_rotations

ALL = [(name, d) for d, table in ((2, IN_PLANE), (3, IN_SPACE)) for name in table]


@pytest.mark.parametrize("compared", ["numbers", "matrix"])
@pytest.mark.parametrize(("name", "d"), ALL)
def test_gradients_are_those_of_differences(monkeypatch, name, d, *, compared):
    rng = np.random.default_rng(1)
    R_test, _ = random_rotations(3, d, np.pi, rng=np.random.default_rng(2))
    values, gradient = descended(
        monkeypatch,
        rotation_regression,
        lambda: regress(
            (IN_PLANE if d == 2 else IN_SPACE)[name],
            R_test,
            largest=2.0,
            compared=compared,
            width=5,
            rate=4e-3,
            counts=(0, 1),
            rng=rng,
        ),
    )
    values += 0.05 * rng.normal(size=values.shape)  # away from corners, where a whole layer is 0
    assert_gradient(values, gradient, rng)


@pytest.mark.parametrize("compared", ["numbers", "matrix"])
def test_small_turns_are_learned_and_states_stay_as_they_were(compared):
    R_test, _ = random_rotations(100, 2, 1.0, rng=np.random.default_rng(3))
    states = list(
        regress(
            IN_PLANE["cosine and sine"],
            R_test,
            largest=1.0,
            compared=compared,
            width=16,
            rate=4e-3,
            counts=(0, 50, 200),
            rng=np.random.default_rng(4),
        )
    )
    assert [state.updates for state in states] == [0, 50, 200]
    assert states[0].errors.mean() > 10 > 4 > states[-1].errors.mean()
    assert states[-1].loss < 0.1 * states[0].loss
    np.testing.assert_allclose(IN_PLANE["cosine and sine"].decode(states[1].outputs), states[1].R)
