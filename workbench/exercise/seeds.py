"""Seeds of hidden checks: fixed ones, unless a teacher's own number says what they are drawn from.

A table of right answers learnt from the fixed seeds answers nothing that is drawn from another
number.
"""

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass

import numpy as np

MOST = 2**30
"""Below it are the seeds that are drawn, so that a check may add a number to one."""
_teachers: ContextVar[int | None] = ContextVar("teachers", default=None)


@dataclass(frozen=True)
class HiddenSeed:
    """The seed of a lesson's hidden checks: `usual`, where no teacher has said another.

    Args:
        usual: What it is where no teacher has said another.
    """

    usual: int

    def __call__(self) -> int:
        """Return the usual seed, or the one made of it and the teacher's."""
        seed = _teachers.get()
        return (
            self.usual
            if seed is None
            else int(np.random.SeedSequence([seed, self.usual]).generate_state(1)[0]) % MOST
        )


@contextlib.contextmanager
def drawn_from(seed: int | None) -> Iterator[None]:
    """Let hidden checks in this block be drawn from a teacher's number; None changes nothing."""
    before = _teachers.set(seed)
    try:
        yield
    finally:
        _teachers.reset(before)
