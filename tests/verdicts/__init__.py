"""Holds what lessons say of a run to the truth: per lesson, which sentences judge, and when each is
true.

A lesson's module in this folder has

- `caption(look)`: the caption of a step of a lesson with a `setup`, which takes what `draw` takes;
  other lessons' captions are taken from their `captions.caption(state)`;
- `until_the_end(params)`: a lesson's run up to its algorithm's end, where it goes on with costly
  tries (optional): what seeds other than a preset's own are held to in a quick audit;
- `right(run, k)`: whether the state is truly right (True), truly wrong (False), or neither is
  claimed (None): what the caption's tone says must agree;
- `CAPTIONS`, `LINES`, `WHYS`: the claims that captions, preset lines (with titles) and questions'
  explanations make;
- `VALUES`: of a lesson with a `setup`, for each value that its captions carry the function of run
  and step that finds it anew; every value has one.

Every claim is decided from the states alone, never by the function that wrote the sentence.
"""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.scene import Caption

JUDGING = re.compile(
    r"\b(right|wrong|wrongly|home|converge[sd]?|convergence|exact|exactly|better|best|worse|worst|correct|true|truly|perfect"
    r"|perfectly|fails?|failed|settled|finds?|found)\b",
    re.IGNORECASE,
)
"""A sentence with one of these words judges; no text may hold one outside the claims of its lesson.
"""


@dataclass(frozen=True)
class Run:
    """A finished run: what was asked for, what its setup made of that, and all that came of it."""

    params: Any
    states: Sequence[Any]
    subject: Any = None


@dataclass(frozen=True)
class Claim:
    """A sentence that judges.

    Attributes:
        words: A regular expression that finds it in the text.
        holds: Tells from the run, the step it is said at (of a line or an explanation: the last),
            and the match, whether it is true. None: the words judge nothing (a term such as "right
            camera").
    """

    words: str
    holds: Callable[[Run, int, re.Match[str]], bool] | None


Oracle = Callable[[Run, int], float]


def misvalued(caption: Caption, values: Mapping[str, Oracle], run: Run, *, k: int) -> list[str]:
    """Return which values of a caption are not what the run says, to six digits."""
    findings = []
    for name, value in caption.values.items():
        if name not in values:
            findings.append(f"nobody checks the value {name!r} of: {caption.text}")
        elif not math.isclose(value, true := values[name](run, k), rel_tol=1e-6, abs_tol=1e-6):
            findings.append(f"{name} is {value:g}, in truth {true:g}: {caption.text}")
    return findings


def untrue(text: str, claims: Sequence[Claim], run: Run, *, k: int) -> list[str]:
    """Return what a text says that does not hold, and what judges without a claim that could be
    checked.
    """
    findings = []
    rest = text
    for claim in claims:
        for match in re.finditer(claim.words, text):
            if claim.holds is not None and not claim.holds(run, k, match):
                findings.append(f"not true: {match[0]!r}")
        rest = re.sub(claim.words, " … ", rest)
    return findings + [f"nobody checks {word[0]!r} in: {rest}" for word in JUDGING.finditer(rest)]
