"""What one browser has done, kept in its own storage and read as untrusted input."""

import json
from typing import Any

KEY = "workbench-progress-1"


class Progress:
    """Lessons opened, questions answered, and the theme; as text it survives a reload.

    Args:
        text: What the browser kept, None or anything else it may hold.
    """

    def __init__(self, text: str | None = None):
        self._lessons: dict[str, dict[str, Any]] = {}
        self.dark = False
        try:
            kept = json.loads(text or "{}")
        except ValueError:
            kept = {}
        if isinstance(kept, dict):
            self.dark = kept.get("dark") is True
            lessons = kept.get("lessons")
            if isinstance(lessons, dict):
                for name, answers in list(lessons.items())[:500]:
                    if isinstance(answers, dict):
                        self._lessons[str(name)[:80]] = {
                            str(key)[:80]: value
                            for key, value in list(answers.items())[:100]
                            if isinstance(value, (str, int, float))
                        }

    def visit(self, lesson: str) -> None:
        """Note that a lesson was opened."""
        self._lessons.setdefault(lesson, {})

    def visited(self, lesson: str) -> bool:
        """Tell whether a lesson was opened."""
        return lesson in self._lessons

    def answer(self, lesson: str, question: str, given: Any) -> None:
        """Note what was answered."""
        self._lessons.setdefault(lesson, {})[question] = given

    def answers(self, lesson: str) -> dict[str, Any]:
        """Return what was answered in a lesson, by question name."""
        return dict(self._lessons.get(lesson, {}))

    def text(self) -> str:
        """Return what the browser keeps."""
        return json.dumps({"dark": self.dark, "lessons": self._lessons})
