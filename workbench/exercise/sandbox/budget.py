"""How long a student's function is waited for: an endless loop costs its limit three times."""

REFUSED_AFTER = 3
CALLS = 20
"""How many times the limit of one call all calls of a function may take together."""


class CallBudget:
    """The time that calls of one function may take together, each `seconds` at most.

    After three that were late or ended their process, or when all of them took twenty times the
    limit, no call is made any more.
    """

    def __init__(self, seconds: float):
        self._seconds = seconds
        self._late = 0
        self._lost = 0
        self._spent = 0.0

    @property
    def seconds(self) -> float:
        """How long the next call may take."""
        return self._seconds

    @property
    def over(self) -> str:
        """Why no call is made any more; nothing where one is."""
        if self._late + self._lost >= REFUSED_AFTER:
            if not self._lost:
                trouble = "took too long"
            elif not self._late:
                trouble = "ended its process"
            else:
                trouble = "took too long or crashed"
            return f"{self._late + self._lost} calls already {trouble}"
        if self._spent > CALLS * self._seconds:
            return f"its calls together took more than {CALLS * self._seconds:g} s"
        return ""

    def took(self, seconds: float, how: str) -> None:
        """Count a call that ended as a `kind` of StudentError, or with an answer."""
        self._spent += seconds
        self._late += how == "timeout"
        self._lost += how == "died"

    @property
    def kind(self) -> str:
        """As what a call that is not made counts."""
        return "died" if self._lost > self._late else "timeout"
