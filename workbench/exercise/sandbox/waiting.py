"""How long a process has waited for a processor, as Linux counts it; elsewhere that is not known."""

from pathlib import Path


def waited(process: int) -> float:
    """Return how long a process, or what it started, has been ready to run and not run, seconds; 0 where it is not known.

    Of several the longest counts: under bubblewrap the student's process is the last of three.

    Source: Linux, Documentation/scheduler/sched-stats.rst, "/proc/<pid>/schedstat": nanoseconds run, nanoseconds waited.
    """
    try:
        longest = int(Path(f"/proc/{process}/schedstat").read_text().split()[1]) / 1e9
        children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    except (OSError, ValueError, IndexError):  # it is gone, or this is no Linux
        return 0.0
    return max([longest, *(waited(int(child)) for child in children[:4])])
