"""What the disparity lesson says of its runs, decided from the pictures' truth and the maps that a
run carries.

Here is when depths are right; beside it are what captions say, the values that they carry, and the
texts of presets and questions.
"""

import numpy as np

from lessons.disparity.matching import State
from tests.truths.disparity import depths_off, wrong
from tests.verdicts import Run
from tests.verdicts.disparity.captions import CAPTIONS, caption
from tests.verdicts.disparity.texts import LINES, WHYS
from tests.verdicts.disparity.values import VALUES

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]


def right(run: Run, k: int) -> bool | None:
    """The depths are right within 3 % in the median with few wrong pixels, wrong beyond 10 % or
    with many.
    """
    state = run.states[k]
    if not isinstance(state, State) or state.stage is not None:
        return None
    errors, true = depths_off(run, k)
    relative = float(np.median(errors / true))
    if relative > 0.1 or wrong(run, k) > 20.0:
        return False
    return True if relative <= 0.03 and wrong(run, k) <= 5.0 else None
