"""A number that lessons say of a run comes from a run at rest, or the sentence says after how many
steps it was read.

Lines of presets, explanations of questions and the page's sentences that open a preset are held to
it, in every lesson whose run ends with a `Stop`, and in those that train for a number of steps and
never come to rest.
"""

import dataclasses
import functools
import importlib
import pkgutil
import re
import sys
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Any

import pytest

import workbench.algorithms
from tests.runs import finished
from workbench.lesson import Lesson, Preset, Question, catalog

LIMITS = {"MAX_ITERATIONS", "MAX_STEPS", "MOST_STEPS", "MAX_SWEEPS", "SAMPLES_USED_UP"}
"""A run that ended so would go on if it were let."""
RESTS = {"CONVERGED", "CIRCLING", "ENOUGH", "ARRIVED", "SETTLED", "NOT_LOWER", "STUCK"}
FAILURES = {
    "TOO_FEW_MATCHES",
    "NOT_FINITE",
    "NO_MODEL",
    "SINGULAR",
    "DIVERGED",
    "BEHIND",
    "NO_POSE",
}

COUNTED = "steps?|updates?|iterations?|samples?|sweeps?|rounds?|layers?|times"
SAYS_WHEN = re.compile(
    rf"\b(after|in|for|of)( its| the| some)? [\d,]+ (more )?({COUNTED})\b"
    rf"|\b[\d,]+ (more )?({COUNTED})\b|\bafter [\d,]+\b|\bstopped\b|\bstill"
    r" (moves|moving|falls|falling)\b|\bat the start\b",
    re.IGNORECASE,
)
SAYS_REST = re.compile(r"\b(at rest|comes? to rest|settled?)\b", re.IGNORECASE)

STEPPED: dict[str, Callable[[Any], bool]] = {
    "learning": lambda params: True,
    "representations": lambda params: params.form == "neural",
    "graphs": lambda params: params.stage in ("heat", "smooth", "network", "training"),
}
"""Lessons without a `Stop` whose runs take as many steps as the params say, at these params."""

GIVEN = {
    ("chamfer_emd", "flip"): r"80 % of the points in one bunch|5 % larger",
    ("graphs", "blow-up"): r"dt = 2\.5 / λmax",
    ("learning", "periodic"): r"mind 360°",
    ("learning", "spikes"): r"642 vertices",
    ("representations", "clamp"): r"clamped at 10 cm",
}
"""Numbers of what is given to a run, not of what comes of it."""


def stops_in(value: Any, path: str = "") -> Iterator[tuple[str, Enum]]:
    """Yield every reason to stop that a state holds, with its place in it."""
    if isinstance(value, Enum):
        if type(value).__name__ == "Stop":
            yield path, value
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        for field in dataclasses.fields(value):
            yield from stops_in(getattr(value, field.name), f"{path}.{field.name}")


def ends_of(states: tuple[Any, ...]) -> set[str]:
    """Return why the parts of a run ended, each by what it said last."""
    last = {path: stop.name for state in states for path, stop in stops_in(state)}
    return set(last.values())


@functools.cache
def stopping_modules() -> dict[str, type[Enum]]:
    """Return the reasons to stop that algorithms have, by module."""
    kinds = {}
    for info in pkgutil.walk_packages(workbench.algorithms.__path__, "workbench.algorithms."):
        kind = getattr(importlib.import_module(info.name), "Stop", None)
        kinds |= {} if kind is None else {info.name: kind}
    return kinds


def may_stop(name: str) -> bool:
    """Whether a lesson runs an algorithm that says why it stopped, or takes a number of steps."""
    importlib.import_module(f"lessons.{name}.lesson")
    own = [module for path, module in sys.modules.items() if path.startswith(f"lessons.{name}.")]
    used = {
        getattr(value, "__module__", None) or value
        for module in own
        for value in vars(module).values()
        if isinstance(value, Callable | type | type(sys))
    }
    names = {owner if isinstance(owner, str) else owner.__name__ for owner in used}
    return name in STEPPED or bool(names & stopping_modules().keys())


def unsaid(text: str, ends: set[str], given: str = r"(?!)") -> bool:
    """Whether a text has a number of a run that a limit ended, and neither says so nor when it was
    read.
    """
    run = re.sub(r"\]\(run:[^)]*\)|\$[^$]*\$|`[^`]*`", "]", re.sub(given, "", text))
    admitted = SAYS_WHEN.search(run) or (SAYS_REST.search(run) and ends & RESTS)
    return bool(ends & LIMITS and re.search(r"\d", run) and not admitted)


def page_sentences(lesson: Lesson, preset: str) -> list[str]:
    """Return the sentences of a page that open a preset."""
    page = " ".join(re.sub(r"\n\s*\n|\n(?=- |\|)", ". ", lesson.text()).split())
    opens = re.compile(rf"\(run:{preset}(@[-\d]+)?\)")
    return [sentence for sentence in re.split(r"(?<=[.;!?]) ", page) if opens.search(sentence)]


def untold(lesson: Lesson) -> list[str]:
    """Return what a lesson says of runs that did not come to rest, without a word of that."""
    lines = []
    opened = Preset("default", "", "", lesson.params())
    for named in (opened, *lesson.presets, *lesson.questions):
        states = finished(lesson.name, named.params).states()
        stepped = lesson.name in STEPPED and STEPPED[lesson.name](named.params)
        ends = {"MAX_STEPS"} if stepped else ends_of(states)
        if not ends & LIMITS:
            continue
        given = GIVEN.get((lesson.name, named.name), r"(?!)")
        if isinstance(named, Question):
            told = named.why(states)
            texts = [f"{named.text} {told}" if stepped else told]
        else:
            texts = [named.line, *page_sentences(lesson, named.name)]
        lines += [
            f"{lesson.name}, {named.name}: {text}" for text in texts if unsaid(text, ends, given)
        ]
    return lines


@pytest.mark.parametrize("name", [name for name in catalog() if may_stop(name)])
def test_numbers_are_of_runs_at_rest_or_say_when_they_were_read(name):
    wrong = untold(catalog()[name])
    assert not wrong, "\n".join(wrong)


def test_every_reason_to_stop_is_a_rest_a_limit_or_a_failure():
    names = {name for kind in stopping_modules().values() for name in kind.__members__}
    assert names == LIMITS | RESTS | FAILURES


def test_what_is_called_given_is_said():
    for (lesson, name), given in GIVEN.items():
        preset = catalog()[lesson].preset(name)
        text = " ".join([preset.line, *page_sentences(catalog()[lesson], name)])
        assert all(re.search(part, text) for part in given.split("|")), name


@pytest.mark.parametrize(
    ("text", "ends", "wrong"),
    [
        ("f is off by 76.9 px.", {"MAX_ITERATIONS"}, True),
        ("f is off by 76.9 px after 30 iterations.", {"MAX_ITERATIONS"}, False),
        ("f comes to rest 43 px short.", {"MAX_ITERATIONS"}, True),
        ("f comes to rest 43 px short.", {"CONVERGED"}, False),
        ("The left one settles at 3 cm.", {"MAX_STEPS", "SETTLED"}, True),
        ("The left one settled at 3 cm.", {"MAX_STEPS", "SETTLED"}, False),
        ("Watch [the end](run:flat@12) with $n = 3$.", {"MAX_STEPS"}, False),
    ],
)
def test_how_a_text_is_judged(text, ends, wrong):
    assert unsaid(text, ends) is wrong
