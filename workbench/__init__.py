"""A visual workbench for geometry estimation: watch, touch, record and grade the algorithms of 3D
vision.
"""

from typing import TYPE_CHECKING, Any

from workbench.machinery.version import __version__ as __version__

if TYPE_CHECKING:
    from workbench.notebook import replay as replay
    from workbench.recording.read import open_recording as open_recording
    from workbench.recording.write import record as record


def __getattr__(name: str) -> Any:
    """Import `record`, `open_recording` and `replay` when they are asked for: the rest starts
    without rerun and viser.
    """
    if name == "replay":
        from workbench import notebook

        return notebook.replay
    if name in ("record", "open_recording"):
        from workbench import recording

        return getattr(recording, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
