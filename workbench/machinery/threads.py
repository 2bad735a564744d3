"""How numpy's libraries compute here and in started processes: threads, and the same last bit.

They take as many threads as there are processors, and each waits for the others by spinning. The
matrices of a lesson are small, and beside a second process half of the time goes into the waiting.
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
    """Let linear algebra take one thread here and below, unless the environment says otherwise.

    To be called before numpy is imported.
    """
    for name, count in ONE_EACH.items():
        os.environ.setdefault(name, count)


def as_here() -> dict[str, str]:
    """Return environment variables with which another process, one thread each, rounds as this one.

    Results that hang on the last bit, as the signs of singular vectors do, would else differ.
    """
    return ONE_EACH | {name: os.environ[name] for name in ROUNDING if name in os.environ}
