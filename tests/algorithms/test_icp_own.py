"""What a fit of one's own may return."""

import numpy as np
import pytest

from workbench.algorithms.registration.icp import Stop, icp


@pytest.mark.parametrize(
    "entries", [[(0, 3)], [(0, 0), (2, 2)], [(i, j) for i in range(4) for j in range(4)]]
)
def test_a_fit_with_one_number_missing_ends_the_run(entries):
    def align(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
        T = np.eye(4)
        for at in entries:
            T[at] = np.nan
        return T

    p = np.random.default_rng(0).normal(size=(30, 3))
    *_, last = icp(p, p + 0.1, align=align)
    assert last.stop is Stop.NOT_FINITE
    assert np.isfinite(last.T_target_source).all()
