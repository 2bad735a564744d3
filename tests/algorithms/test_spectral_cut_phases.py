"""What a cut knows at each phase, and nothing before."""

import numpy as np

from tests.algorithms.test_spectral_cut import KARATE, plain
from workbench.algorithms.graphs.spectral_cut import spectral_cut


def test_what_comes_later_is_empty():
    graph, fiedler, sign, *sweeps, best = spectral_cut(KARATE, plain(KARATE), shown=4)
    empty = [graph.eigenvalues, graph.fiedler, graph.side, graph.order, graph.conductances]
    assert [len(one) for one in empty] == [0] * 5
    for now in (graph, fiedler):
        assert (now.k, np.isnan(now.cut), np.isnan(now.conductance)) == (-1, True, True)
    assert (len(fiedler.eigenvalues), len(fiedler.fiedler)) == (3, 34)
    assert (sign.k, len(sign.order)) == (-1, 0)
    assert [now.side.sum() for now in (*sweeps, best)] == [now.k + 1 for now in (*sweeps, best)]
    assert len(sweeps) == 4
    assert len(best.conductances) == 33
