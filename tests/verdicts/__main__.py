"""Holds what lessons say to the truth: `python -m tests.verdicts [--whole] [LESSON ...]`; prints
what does not hold.

A sentence that changes must not lose its judge unseen, so that a claim about a preset's line or an
explanation which finds its words no more is printed too.

The whole audit takes every step of every preset and question at 20 seeds. The quick one takes two,
and of other seeds than a preset's own only the steps up to the algorithm's end.
"""

import dataclasses
import importlib
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from tests.verdicts import Claim, Run, misvalued, untrue
from workbench.lesson import Lesson, Look, States, catalog
from workbench.scene import Caption

WHOLE, QUICK = range(20), range(2)
MOST = 5  # findings shown of a run

Text = tuple[str, Callable[[Run], str], Sequence[Claim]]
"""Whose text it is, how a run says it, and the claims it may make."""


def main() -> int:
    """Audit the lessons that are named, or all; return 1 where something is not true."""
    names = [word for word in sys.argv[1:] if word != "--whole"]
    findings = [
        line
        for name in names or catalog()
        for line in audit(catalog()[name], whole="--whole" in sys.argv)
    ]
    print("\n".join(findings))
    return 1 if findings else 0


def audit(
    lesson: Lesson, *, whole: bool, run: Callable[[Any], States] | None = None
) -> Iterator[str]:
    """Return what captions, preset lines and explanations of a lesson say that is not true.

    Args:
        lesson: Whose words are held to the truth.
        whole: Whether all steps are looked at from many seeds.
        run: Returns all states of the lesson's own runs, where somebody has them; they are run
            here otherwise.
    """
    judge = importlib.import_module(f"tests.verdicts.{lesson.name}")
    yield from nameless(lesson, judge)
    form = lesson.form
    short: Callable[[Any], Iterator[Any]] = getattr(judge, "until_the_end", form.states)
    for params, texts in experiments(lesson, judge):
        for reseeded in seeded(params, WHOLE if whole else QUICK):
            own = reseeded == params
            if own and run is not None:
                states = run(reseeded)
            else:
                states = tuple(form.states(reseeded) if whole or own else short(reseeded))
            where = (
                f"{lesson.name}, {texts[0][0] if texts else 'default'}, seed"
                f" {getattr(reseeded, 'seed', '-')}"
            )
            subject = form.setup(reseeded)
            seen = Run(reseeded, States.of(states, params=reseeded, subject=subject), subject)
            wrong = list(judged(lesson, judge, seen, texts=texts))
            if own:
                wrong += wordless(seen, texts)
            yield from (f"{where}, {line}" for line in wrong[:MOST])
            if len(wrong) > MOST:
                yield f"{where}: {len(wrong) - MOST} more"


def experiments(lesson: Lesson, judge: Any) -> Iterator[tuple[Any, list[Text]]]:
    """Return the params of the default, every preset and every question, equal ones once, with what
    is said of them.
    """
    texts: dict[Any, list[Text]] = {lesson.params(): []}
    for preset in lesson.presets:
        line = f"{preset.title}. {preset.line}"
        texts.setdefault(preset.params, []).append(
            (preset.name, lambda run, line=line: line, judge.LINES.get(preset.name, ()))
        )
    for question in lesson.questions:
        texts.setdefault(question.params, []).append(
            (
                question.name,
                lambda run, q=question: q.why(run.states),
                judge.WHYS.get(question.name, ()),
            )
        )
    yield from texts.items()


def seeded(params: Any, seeds: Sequence[int]) -> Iterator[Any]:
    """Return the params at their own seed and at others; alone where nothing is drawn by chance."""
    yield params
    if any(field.name == "seed" for field in dataclasses.fields(params)):
        yield from (dataclasses.replace(params, seed=seed) for seed in seeds if seed != params.seed)


def judged(lesson: Lesson, judge: Any, run: Run, *, texts: Sequence[Text]) -> Iterator[str]:
    """Return what is not true of one run: in its captions, in their tone, and in what is said of
    it.
    """
    caption = captioner(lesson, judge)
    for k, state in enumerate(run.states):
        look = Look(params=run.params, subject=run.subject, now=state, past=run.states[:k])
        given = state if lesson.setup is None else look
        shown = caption(given)
        yield from (
            f"step {k}: {finding}" for finding in untrue(shown.text, judge.CAPTIONS, run, k=k)
        )
        if lesson.setup is not None:
            yield from (
                f"step {k}: {finding}" for finding in misvalued(shown, judge.VALUES, run, k=k)
            )
        right = judge.right(run, k)
        if shown.tone != "info" and right is not None and right is not (shown.tone == "good"):
            yield f"step {k}: the tone is {shown.tone}, the truth {right}: {shown.text}"
    for name, text, claims in texts:
        yield from (
            f"{name}: {finding}"
            for finding in untrue(text(run), claims, run, k=len(run.states) - 1)
        )


def captioner(lesson: Lesson, judge: Any) -> Callable[[Any], Caption]:
    """Return what makes the caption of a state alone: the judge's function, or the lesson's."""
    if hasattr(judge, "caption"):
        return judge.caption
    return importlib.import_module(f"lessons.{lesson.name}.captions").caption


def wordless(run: Run, texts: Sequence[Text]) -> list[str]:
    """Return the claims about a line or an explanation whose words it does not have at its own
    params.
    """
    return [
        f"{name}: a claim is left without its words: {claim.words!r}"
        for name, text, claims in texts
        for claim in claims
        if not re.search(claim.words, text(run))
    ]


def nameless(lesson: Lesson, judge: Any) -> Iterator[str]:
    """Return the claims about presets and questions that the lesson does not have."""
    for claims, named in ((judge.LINES, lesson.presets), (judge.WHYS, lesson.questions)):
        for name in sorted(set(claims) - {entry.name for entry in named}):
            yield f"{lesson.name}: claims about {name!r}, which it does not have"


if __name__ == "__main__":
    sys.exit(main())
