"""What the RANSAC lesson says of its runs, decided from the rows and the truth that a run
carries.

Here is when a run's end is right; beside it are what captions say, the values that they carry, and
the texts of presets and questions.
"""

from tests.truths.ransac import is_right
from tests.verdicts import Run
from tests.verdicts.ransac.captions import CAPTIONS, caption
from tests.verdicts.ransac.texts import LINES, WHYS
from tests.verdicts.ransac.values import VALUES, flat

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    return None if flat(state) or state.phase != "stop" else is_right(run, k)
