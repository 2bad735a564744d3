"""Freed memory is kept for the next arrays, and given back when asked."""

import json
import os
import platform
import subprocess
import sys

import pytest

from workbench.machinery import memory

glibc = pytest.mark.skipif(
    platform.libc_ver()[0] != "glibc",
    reason="another C library decides by itself",
)
SCRIPT = """
import json, os, resource
import numpy as np
from workbench.machinery.memory import give_back, keep_freed

def faults():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt

def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

if {keep}:
    keep_freed()
for _ in range(3):
    sums = [np.ones(20_000) for _ in range(8)]
before = faults()
for _ in range(100):
    sums = [np.ones(20_000) for _ in range(8)]
repeated = faults() - before
held = [np.ones(100_000) for _ in range(60)]
del held, sums
kept = resident()
give_back()
print(json.dumps([repeated, kept - resident(), os.environ.get("MALLOC_TRIM_THRESHOLD_")]))
"""


def measured(*, keep: bool, **environment: str) -> tuple[int, int, str | None]:
    """Return the page faults of a hundred times eight arrays of 160 kB, how many bytes are given
    back after 48 MB were freed, and what is set for processes below.
    """
    clean = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    ran = subprocess.run(
        [sys.executable, "-c", SCRIPT.format(keep=keep)],
        env=clean | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return tuple(json.loads(ran.stdout))


@glibc
def test_small_arrays_ask_the_machine_for_memory_once():
    faults, given_back, below = measured(keep=True)
    assert faults < 100
    assert given_back > 40_000_000
    assert below == str(memory.KEPT)
    faults, given_back, below = measured(keep=False)
    assert faults > 1000
    assert given_back < 10_000_000
    assert below is None


@glibc
def test_what_the_environment_says_holds():
    faults, _, below = measured(
        keep=True, MALLOC_TRIM_THRESHOLD_="0", MALLOC_MMAP_THRESHOLD_="100000"
    )
    assert faults > 1000
    assert below == "0"
