"""Decides what the measures lesson says: against closed forms, trimesh and sums of determinants.

Here is when a sum is right; beside it are what captions say and the texts of presets and questions.
"""

from lessons.measures.captions import caption
from tests.truths.measures import closed, sums, truth
from tests.verdicts import Run
from tests.verdicts.measures.captions import CAPTIONS
from tests.verdicts.measures.texts import LINES, WHYS
from workbench.algorithms.surfaces.measures import Sums

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]


def right(run: Run, k: int) -> bool | None:
    """A sum over all faces is right where it is that of a closed mesh, no larger than what the mesh
    stands for.
    """
    state = run.states[k]
    if not isinstance(state.now, Sums) or state.now.count < len(state.subject.faces):
        return None
    volume, true = sums(state)[1], truth(state)[1]
    return closed(state) and 0.97 < volume / true < 1 + 1e-9
