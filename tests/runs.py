"""Whole runs of the catalogue's lessons, made once in a worker: many tests look at the same
preset.
"""

import functools
from typing import Any

from workbench.lesson import catalog
from workbench.run.timeline import Timeline

MOST = 48  # runs; all of a lesson's at once, with room for a second lesson's


@functools.lru_cache(MOST)
def whole_run(name: str, params: Any) -> Timeline:
    """Return the finished run of a lesson at these params. It is shared: nothing may be added to
    it.
    """
    return Timeline(catalog()[name], params).complete()


def finished(name: str, params: Any) -> Timeline:
    """Return the finished run of a lesson that must come to its end by itself."""
    timeline = whole_run(name, params)
    assert timeline.stopped is None, timeline.failure or timeline.stopped
    return timeline
