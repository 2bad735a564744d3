"""What a cut knows at each phase, and nothing before."""

import numpy as np

from tests.algorithms.test_spectral_cut import KARATE, plain
from workbench.algorithms.graphs.spectral_cut import spectral_cut


def test_what_comes_later_is_empty():
    graph, fiedler, sign, *sweeps, best = spectral_cut(KARATE, plain(KARATE), shown=4)
    empty = [graph.eigenvalues, graph.fiedler, graph.side, graph.order, graph.conductances]
    assert [len(array) for array in empty] == [0] * 5
    for state in (graph, fiedler):
        assert (state.k, np.isnan(state.cut), np.isnan(state.conductance)) == (-1, True, True)
    assert (len(fiedler.eigenvalues), len(fiedler.fiedler)) == (3, 34)
    assert (sign.k, len(sign.order)) == (-1, 0)
    assert [state.side.sum() for state in (*sweeps, best)] == [
        state.k + 1 for state in (*sweeps, best)
    ]
    assert len(sweeps) == 4
    assert len(best.conductances) == 33
