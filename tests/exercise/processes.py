"""Which processes of this machine belong to one of them."""

from pathlib import Path


def family(first: int) -> set[int]:
    """Return the processes that are there of one: itself, those of its session, and all that one of
    them started.
    """
    parents = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            parts = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if parts[0] != "Z":
            parents[int(entry.name)] = int(parts[1]), int(parts[3])
    pids = {pid for pid, (_, session) in parents.items() if first in (pid, session)}
    while more := {pid for pid, (parent, _) in parents.items() if parent in pids} - pids:
        pids |= more
    return pids
