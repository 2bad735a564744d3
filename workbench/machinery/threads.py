"""How numpy's libraries compute in this process and in those that it starts: threads, and the same
to the last bit.

They take as many threads as there are processors, and each waits for the others by spinning. The
matrices of a lesson are small, and beside a second process (another student, a test) half of the
processor's time goes into the waiting.
"""

import os

ONE_EACH = {f"{library}_NUM_THREADS": "1" for library in ("OPENBLAS", "OMP", "MKL")}
"""Environment variables that let linear algebra take one thread; numpy reads them when it is
imported.
"""
ROUNDING = (
    "OPENBLAS_CORETYPE",
    "MKL_CBWR",
    "MKL_ENABLE_INSTRUCTIONS",
    "NPY_DISABLE_CPU_FEATURES",
    "NPY_ENABLE_CPU_FEATURES",
)
"""Environment variables that choose instructions, and with them the last bit of a result."""


def one_each() -> None:
    """Let linear algebra take one thread in this process and those that it starts, unless the
    environment says otherwise.

    To be called before numpy is imported.
    """
    for name, count in ONE_EACH.items():
        os.environ.setdefault(name, count)


def as_here() -> dict[str, str]:
    """Return the environment variables with which another process, one thread each, rounds as this
    one does.

    Where a result hangs on the last bit, as the signs of singular vectors do, the two would else
    differ.
    """
    return ONE_EACH | {name: os.environ[name] for name in ROUNDING if name in os.environ}
