"""How long a process has waited for a processor, as Linux counts it."""

import os
from pathlib import Path


def waited(process: int) -> float:
    """Return how long a process, or what it started, was ready and not run, seconds, or 0.

    What its other threads ran meanwhile is its own doing and is taken off. Of several processes the
    longest counts: under bubblewrap the student's process is the last of three.

    Source: Linux, Documentation/scheduler/sched-stats.rst, "/proc/<pid>/schedstat": nanoseconds
    that the first thread ran and waited; proc(5), "/proc/<pid>/stat": ticks that all threads ran.
    """
    try:
        ran, longest = (
            int(part) / 1e9 for part in Path(f"/proc/{process}/schedstat").read_text().split()[:2]
        )
        times = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11:13]
        children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    except (OSError, ValueError, IndexError):  # it is gone, or this is no Linux
        return 0.0
    others = sum(map(int, times)) / os.sysconf("SC_CLK_TCK") - ran
    return max([0.0, longest - max(0.0, others), *(waited(int(child)) for child in children[:4])])
