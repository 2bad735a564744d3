"""A student's process under bubblewrap: own namespaces, files of Python and nothing else."""

import functools
import os
import shutil
import subprocess

from workbench.exercise.sandbox.python import CHILD_FILES, DEVICES, FILES, Python

FOLDER = "/.student"
FOLDER_BYTES = 16 << 20
CHILD = "/.child"  # names that no folder of packages has
SECONDS = 10.0


def program() -> str | None:
    """Return where bubblewrap is, None where it is not installed."""
    return shutil.which("bwrap", path=os.environ.get("PATH", "") + ":/usr/bin:/usr/local/bin")


def arguments(python: Python) -> list[str]:
    """Return the command that shuts in what follows it; nothing of ours is in sight but `child`."""
    command = [
        program() or "bwrap",
        "--unshare-all",
        "--die-with-parent",
        "--new-session",
        "--cap-drop",
        "ALL",
    ]
    command += ["--uid", "65534", "--gid", "65534", "--hostname", "student"]
    for tree in python.trees:
        command += ["--ro-bind", tree, tree]
    for target, path in python.links:
        command += ["--symlink", target, path]
    sealed = ["/", *python.masked]
    for folder in python.masked:
        command += ["--tmpfs", folder]
    for path in (
        python.executable,
        *python.packages,
        *(file for file in FILES if os.path.exists(file)),
    ):
        command += ["--ro-bind", path, path]
    command += ["--ro-bind", str(CHILD_FILES), CHILD]
    for device in DEVICES:
        command += ["--dev-bind", device, device]
    if _knows_sizes():
        command += ["--perms", "0700", "--size", str(FOLDER_BYTES), "--tmpfs", FOLDER]
    else:
        command += ["--dir", FOLDER]
    for folder in sealed:
        command += ["--remount-ro", folder]
    return [*command, "--chdir", FOLDER, "--clearenv", "--"]


@functools.cache
def _knows_sizes() -> bool:
    """Whether a folder's size can be bounded; in an older bubblewrap nobody can write to it."""
    try:
        completed = subprocess.run(
            [program() or "bwrap", "--help"], capture_output=True, timeout=SECONDS, check=False
        )
    except (OSError, subprocess.SubprocessError):
        return False
    return b"--size" in completed.stdout
