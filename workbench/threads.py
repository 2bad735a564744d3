"""How many threads a product of matrices may take.

numpy's libraries take as many as there are processors, and each waits for the others by spinning. The matrices of a lesson
are small, and beside a second process (another student, a test) half of the processor's time goes into the waiting.
"""

import os

ONE_EACH = {f"{library}_NUM_THREADS": "1" for library in ("OPENBLAS", "OMP", "MKL")}
"""Environment variables that let linear algebra take one thread; numpy reads them when it is imported."""


def one_each() -> None:
    """Let linear algebra take one thread in this process and those that it starts, unless the environment says otherwise.

    To be called before numpy is imported.
    """
    for name, count in ONE_EACH.items():
        os.environ.setdefault(name, count)
