"""What a page's worker calls: a lesson's runner, with JSON for words and bytes for scenes."""

import json
from typing import Any

from workbench.computed.runner import Runner, open_lesson
from workbench.errors import InputError


class Calls:
    """A lesson's runner as a worker calls it.

    Args:
        lesson: Its name.

    Examples:
        >>> calls = Calls("rotations")
        >>> calls.call("use", '["none", "x = 1"]')
        '{"trouble": "lesson rotations has no exercise \'none\'"}'
    """

    def __init__(self, lesson: str):
        self.runner: Runner = open_lesson(lesson)

    def call(self, verb: str, given: str) -> str:
        """Return as JSON what a method of the runner returns, {"value": ...}, or why it does not,
        {"trouble": one line}.

        Args:
            verb: The method's name.
            given: What it is given, a JSON list.
        """
        try:
            return json.dumps({"value": getattr(self.runner, verb)(*json.loads(given))})
        except InputError as error:
            return json.dumps({"trouble": str(error)})
        except Exception as error:  # of a student's code, or of a lesson: the worker lives on
            return json.dumps({"trouble": f"{type(error).__name__}: {error}"})

    def step(self, index: int) -> tuple[str, Any]:
        """Return what the page lacks of a known step: JSON, and the bytes of its scene.

        Raises:
            IndexError: If the step is not known.
        """
        head, scene = self.runner.step(index)
        return json.dumps(head), scene
