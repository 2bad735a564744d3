"""What is compared of a run between this machine and Pyodide: also run there as a script, which
writes a line of JSON per run.
"""

import json
import math
import sys
import time
from typing import Any

from workbench.computed.runner import Runner, open_lesson


def summary(runner: Runner, name: str) -> dict[str, Any]:
    """Return captions and curves of a preset's run, or of the default's, as plain data."""
    from workbench.page.lessons import values_of

    begun = time.perf_counter()
    runner.run(values_of(runner.lesson.run_params(name)))
    while runner.more(1000):
        pass
    told = runner.told() or {}
    if not len(runner.timeline):
        raise RuntimeError(f"{told['stopped']} {runner.timeline.failure or ''}"[-1500:])
    head, scene = runner.step(-1)
    json.dumps([told, head], allow_nan=False)
    assert len(scene) > 8
    return {
        "run": f"{runner.lesson.name} {name}",
        "stopped": told["stopped"],
        "captions": [step.caption.text for step in runner.timeline.known()],
        "tones": [step.caption.tone for step in runner.timeline.known()],
        "curves": {
            path: [None if math.isnan(x) else float(x) for x in series.values]
            for path, series in runner.timeline.series().items()
        },
        "seconds": round(time.perf_counter() - begun, 2),
    }


def main(wanted: list[str]) -> None:
    """Write the summaries of runs, each named `lesson` or `lesson run` or `lesson *`."""
    for words in wanted:
        lesson, _, name = words.partition(" ")
        runner = open_lesson(lesson)
        names = ["default", *(preset.name for preset in runner.lesson.presets)]
        for run in names if name == "*" else [name or "default"]:
            try:
                made = summary(runner, run)
            except Exception as error:  # the others are told all the same
                made = {"run": f"{lesson} {run}", "error": f"{type(error).__name__}: {error}"}
            sys.stdout.write(f"{json.dumps(made)}\n")


if "given" in globals():
    main(list(globals()["given"]))
