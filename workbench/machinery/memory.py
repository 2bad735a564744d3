"""Memory that arrays have freed: kept for the next ones, or given back to the machine.

From the machine's hands, memory costs a page fault for every 4 kB. glibc hands every array above
128 kB back as soon as it is freed, until a larger one teaches it otherwise; sums over such arrays
then take up to three times as long.

Reference: mallopt(3).
"""

import contextlib
import ctypes
import os
import sys

KEPT = 2**26
"""Bytes of freed memory that a process keeps at most, beside what lies between used memory."""
LARGEST = KEPT // 2
"""Bytes of an array that is asked of the machine alone, and given back at once."""
M_TRIM_THRESHOLD = -1
M_MMAP_THRESHOLD = -3


def keep_freed() -> None:
    """Keep freed memory here and in the processes that this one starts, unless the environment says
    otherwise, and where the C library can.
    """
    if sys.platform != "linux":
        return
    with contextlib.suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for option, name, value in (
            (M_TRIM_THRESHOLD, "MALLOC_TRIM_THRESHOLD_", KEPT),
            (M_MMAP_THRESHOLD, "MALLOC_MMAP_THRESHOLD_", LARGEST),
        ):
            if name not in os.environ:
                mallopt(option, value)
                os.environ[name] = str(value)


def give_back() -> None:
    """Give freed memory back to the machine, where its C library can."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError, AttributeError):  # another C library
            ctypes.CDLL(None).malloc_trim(0)
