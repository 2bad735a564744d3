"""What a page requests for and has not got yet: of each kind the latest, so that a flood of
requests is one of each kind.
"""

import json
from collections.abc import Mapping
from typing import Any

LONGEST = 20_000
"""Characters of a message from a browser."""
MOST_BRACKETS = 100
"""Of an honest message, which opens one for itself, one for its values and one for each param that
is a place; thousands, one in the other, would hold up all other pages while they are read.
"""
MOST_ANSWERS = 8
"""Predictions that wait, of different questions; of everything else the latest waits."""
ANEW = frozenset({"open", "run", "reset"})
"""Requests after which it no longer matters where a page was."""
MOVES = frozenset({"seek", "change", "click"})


def read_request(text: str) -> dict[str, Any] | None:
    """Return the request that a message from a browser holds, None when it holds none.

    What can be none is not parsed: rubbish costs less than a request.
    """
    is_long = len(text) > LONGEST
    if is_long or not text.startswith("{") or text.count("[") + text.count("{") > MOST_BRACKETS:
        return None
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return message if isinstance(message, dict) and isinstance(message.get("verb"), str) else None


class Requests:
    """The requests of one page, in the order in which they came."""

    def __init__(self) -> None:
        self._waiting: dict[tuple[str, str], dict[str, Any]] = {}

    def add(self, request: Mapping[str, Any]) -> None:
        """Note a request; it takes the place of an earlier one of its kind."""
        verb = request["verb"]
        if verb in ANEW and (verb != "run" or request.get("run")):
            stale = (
                ANEW if verb == "open" else ANEW - {"open"}
            ) | MOVES  # a run is one of the lesson that was opened
            self._waiting = {
                kind: earlier for kind, earlier in self._waiting.items() if kind[0] not in stale
            }
        kind = verb, str(request.get("question", ""))[:100] if verb == "predict" else ""
        before = self._waiting.pop(kind, None)
        if verb == "change" and before is not None:
            values = before.get("values"), request.get("values")
            request = {
                **request,
                "values": {
                    k: v for part in values if isinstance(part, dict) for k, v in part.items()
                },
            }
        if verb != "predict" or sum(other == verb for other, _ in self._waiting) < MOST_ANSWERS:
            self._waiting[kind] = dict(request)

    def take(self) -> list[dict[str, Any]]:
        """Return what is wished for; then nothing is."""
        waiting = self._waiting
        self._waiting = {}
        return list(waiting.values())

    def __len__(self) -> int:
        """Return how many requests wait."""
        return len(self._waiting)
