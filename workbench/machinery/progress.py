"""One line on a terminal that says how far something is; silent where the stream is no terminal."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TextIO

Progress = Callable[[str, int, int | None], object]
"""progress(what is done, how much is done, of how much or None)."""


@contextmanager
def bar(stream: TextIO | None, title: str) -> Iterator[Progress]:
    """Show a bar for the length of the block; the value takes what is done, how much, of what."""
    shown = stream if stream is not None and stream.isatty() else None

    def tell(label: str, done: int, of: int | None) -> None:
        if shown is None:
            return
        filled = "" if not of else "█" * round(24 * done / of) + "░" * (24 - round(24 * done / of))
        total = f"/{of}" if of else ""
        shown.write(f"\r\x1b[2K{title} {filled} {done}{total} {label[:40]}")
        shown.flush()

    try:
        yield tell
    finally:
        if shown is not None:
            shown.write("\r\x1b[2K")
            shown.flush()
