"""Rerun's own programs: the viewer's binary, and the web viewer's files inside it."""

import importlib.metadata
import os
import re
import subprocess
import sys
import threading
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workbench.errors import InputError
from workbench.machinery.atomic import remove_leftovers, write_atomic
from workbench.words.typeset import cache_folder

NAMES = ("re_viewer.js", "re_viewer_bg.wasm")
PATIENCE = 60.0
"""Seconds until the binary must have told its address, or handed out a file."""


def rerun_version() -> str:
    """Return the version of the installed rerun-sdk, without importing it."""
    return importlib.metadata.version("rerun-sdk")


def binary() -> Path:
    """Return Rerun's binary itself: ending its Python wrapper would leave it behind."""
    import rerun_cli

    folder = Path(str(rerun_cli.__file__)).parent
    names = ("Rerun.app/Contents/MacOS/Rerun", "rerun.exe" if sys.platform == "win32" else "rerun")
    for place in (folder / name for name in names):
        if place.is_file():
            return place
    raise InputError(f"Rerun's viewer is not in {folder}: install rerun-sdk again")


def quiet_environment() -> dict[str, str]:
    """Return the environment for the binary: statistics only if RERUN_ANALYTICS is set."""
    environment = {**os.environ, "RUST_LOG": "info"}
    if "RERUN_ANALYTICS" not in environment:
        environment["CI"] = "1"
    return environment


def web_viewer() -> dict[str, Path]:
    """Return where the web viewer's files are, by name; at first use they are taken out of the
    binary (43 MB).

    Raises:
        InputError: If the binary does not hand them out.
    """
    folder = cache_folder() / f"rerun-{rerun_version()}"
    files = {name: folder / name for name in NAMES}
    missing = [name for name, file in files.items() if not file.is_file()]
    if missing:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            remove_leftovers(folder)
            with _serving() as address:
                for name in missing:
                    _fetch(f"{address}/{name}", files[name])
        except OSError as error:
            raise InputError(
                f"Rerun's web viewer could not be unpacked into {folder}: {error}"
            ) from error
    return files


def _fetch(address: str, file: Path) -> None:
    with urllib.request.urlopen(address, timeout=PATIENCE) as answer:
        write_atomic(file, answer.read())


@contextmanager
def _serving() -> Iterator[str]:
    """Run the binary as a web server without a recording, and yield its address."""
    command = [
        str(binary()),
        "--serve-web",
        "--bind",
        "127.0.0.1",
        "--port",
        "0",
        "--web-viewer-port",
        "0",
    ]
    process = subprocess.Popen(
        command,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env=quiet_environment(),
    )
    assert process.stderr is not None
    watchdog = threading.Timer(PATIENCE, process.kill)
    watchdog.start()
    try:
        for line in process.stderr:
            told = re.search(r"web-viewer at (http://[\w.:]+)", line)
            if told is not None:
                yield told[1]
                return
        raise OSError("the viewer ended without telling its address")
    finally:
        watchdog.cancel()
        process.kill()
        process.stderr.close()
        process.wait()
