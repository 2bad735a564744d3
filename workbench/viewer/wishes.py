"""What a page wishes for and has not got yet: of each kind the latest, so that a flood of wishes is one of each kind."""

import json
from collections.abc import Mapping
from typing import Any

LONGEST = 20_000
"""Characters of a message from a browser."""
MOST_ANSWERS = 8
"""Predictions that wait, of different questions; of everything else the latest waits."""
ANEW = frozenset({"open", "run", "reset"})
"""Wishes after which it no longer matters where a page was."""
MOVES = frozenset({"seek", "change", "click"})


def read_wish(text: str) -> dict[str, Any] | None:
    """Return the wish that a message from a browser holds, None when it holds none."""
    if len(text) > LONGEST:
        return None
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return message if isinstance(message, dict) and isinstance(message.get("verb"), str) else None


class Wishes:
    """The wishes of one page, in the order in which they came."""

    def __init__(self) -> None:
        self._waiting: dict[tuple[str, str], dict[str, Any]] = {}

    def add(self, wish: Mapping[str, Any]) -> None:
        """Note a wish; it takes the place of an earlier one of its kind."""
        verb = wish["verb"]
        if verb in ANEW and (verb != "run" or wish.get("run")):
            self._waiting = {kind: one for kind, one in self._waiting.items() if kind[0] not in ANEW | MOVES}
        kind = verb, str(wish.get("question", ""))[:100] if verb == "predict" else ""
        before = self._waiting.pop(kind, None)
        if verb == "change" and before is not None:
            values = before.get("values"), wish.get("values")
            wish = {**wish, "values": {k: v for part in values if isinstance(part, dict) for k, v in part.items()}}
        if verb != "predict" or sum(one == verb for one, _ in self._waiting) < MOST_ANSWERS:
            self._waiting[kind] = dict(wish)

    def take(self) -> list[dict[str, Any]]:
        """Return what is wished for; then nothing is."""
        waiting, self._waiting = self._waiting, {}
        return list(waiting.values())

    def __len__(self) -> int:
        """Return how many wishes wait."""
        return len(self._waiting)
