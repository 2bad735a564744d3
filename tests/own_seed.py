"""Claims about the run of a preset itself, where a line says the number that is seen there."""

import re
from collections.abc import Callable

from tests.verdicts import Run

Holds = Callable[[Run, int, re.Match[str]], bool]


def of_preset(holds: Holds, seed: int = 0) -> Holds:
    """Return a claim on the preset's own seed: of other seeds, which audits try too, the line says
    nothing.
    """
    return lambda run, k, m: run.params.seed != seed or holds(run, k, m)
