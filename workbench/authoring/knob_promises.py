"""What every lesson promises of its knobs: each does something, and what has no effect has none."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from workbench.authoring.promises import MOST_STEPS, Found, Subject, differs, promise
from workbench.knobs import ParamField, Pick, changed, fields_of, from_json, to_json
from workbench.lesson import Lesson
from workbench.run.flags import RESERVED
from workbench.run.timeline import Timeline
from workbench.scene import Scene, caption_of


@promise
def every_knob_goes_to_its_ends(subject: Subject) -> Found:
    """With each knob at each end of its range, or at each of its choices, the run begins, or says
    why not in one line.

    Where the default run does not meet what a knob needs, the run would be the same again. A knob
    that the default run reads changes something in it at one of these values.
    """
    base = subject.lesson.params()
    default = subject.default()
    read = default.read if subject.lesson.form.notes else frozenset()
    for field in fields_of(subject.lesson.params):
        if any(
            getattr(base, name, None) not in wanted for name, wanted in field.knob.needs.items()
        ):
            continue
        runs = {}
        for value in ends(field):
            where = f"{field.name} = {value}"
            run = runs[value] = subject.fresh(
                replace(base, **{field.name: value}), f"the run at {where}", MOST_STEPS
            )
            fine = run.failure is None or run.stopped == default.stopped  # which is told already
            yield None if fine else f"{run.stopped} (at {where})"
        picked = isinstance(field.knob.by, Pick)  # one row at all of its places is no choice yet
        if (
            runs
            and not picked
            and field.name in read
            and not any(_changes(subject, run) for run in runs.values())
        ):
            values = " or ".join(map(str, runs))
            unchanged = f"the default run reads {field.name}, and nothing in it changes at {values}"
            yield f"{subject.who}: {unchanged}; read it where it has an effect"


def _changes(subject: Subject, begun: Timeline) -> bool:
    """Whether a run, of which the first steps are known, differs from the default run."""
    default = subject.default()
    if any(
        differs(step.scene, other.scene)
        for step, other in zip(begun.known(), default.known(), strict=False)
    ):
        return True
    run = begun if begun.finished else subject.whole(begun.params, "the same to its end")
    return _effect(default, run) is not None


@promise
def a_knob_whose_needs_are_not_met_changes_nothing(subject: Subject) -> Found:
    """Where a knob says what it needs to have an effect, it has none while another knob is set
    otherwise.
    """
    fields = {field.name: field for field in fields_of(subject.lesson.params)}
    idle: dict[Any, list[ParamField]] = {}  # knobs without effect at some params
    for field in fields.values():
        for name, wanted in field.knob.needs.items():
            of_file = name in fields and fields[name].kind == "path" and wanted == (None,)
            if not of_file and (name not in fields or fields[name].kind not in ("choice", "bool")):
                needed = f"{field.name} needs {name!r}"
                yield f"{subject.who}: {needed}, which is no choice or switch of this lesson"
                continue
            met = {other: values[0] for other, values in field.knob.needs.items()}
            for other in [value for value in ends(fields[name]) if value not in wanted]:
                base = replace(subject.lesson.params(), **{**met, name: other})
                idle.setdefault(base, []).append(field)
    for base, turned in idle.items():
        plain = subject.fresh(base, "a run", MOST_STEPS)
        if _all_turned(subject, turned, base, plain=plain):
            for field in turned:
                yield from _has_no_effect(
                    subject, field, base, plain=plain, although="its needs are not met"
                )
        else:
            yield from [None] * len(turned)


def _all_turned(subject: Subject, fields: list[ParamField], base: Any, *, plain: Timeline) -> bool:
    """Whether knobs that are turned together, to each of their ends once, change a run."""
    values = {field.name: ends(field) for field in fields if field.kind != "path"}
    for k in range(max(map(len, values.values()), default=0)):
        all_at = {name: several[k % len(several)] for name, several in values.items()}
        if _effect(
            plain,
            subject.fresh(replace(base, **all_at), "a run with idle knobs turned", MOST_STEPS),
        ):
            return True
    return False


def _has_no_effect(
    subject: Subject, field: ParamField, base: Any, *, plain: Timeline, although: str
) -> Found:
    for value in [value for value in ends(field) if value != getattr(base, field.name)]:
        turned = subject.fresh(
            replace(base, **{field.name: value}), f"a run at {field.name} = {value}", MOST_STEPS
        )
        effect = _effect(plain, turned)
        where = f"{field.name} = {value} changes {effect!r} although {although}"
        yield f"{subject.who}: {where}, at {changed(base)}" if effect else None


def _effect(plain: Timeline, turned: Timeline) -> str | None:
    """Return what differs between two runs: the path of a thing, or that they end otherwise."""
    pairs = zip(plain.known(), turned.known(), strict=False)
    first = next(
        (path for step, other in pairs if (path := _differs(step.scene, other.scene))), None
    )
    whole = plain.finished and turned.finished  # of a longer run only its first steps are made
    same_end = not whole or (plain.stopped == turned.stopped and len(plain) == len(turned))
    return first or (None if same_end else "how the run ends")


def _differs(scene: Scene, other: Scene) -> str | None:
    """Return the path of a thing that differs; the tone of a caption is calm where a preset
    breaks.
    """
    calm = replace(caption_of(other), tone=caption_of(scene).tone)
    return differs(scene, {**other, "caption": calm} if "caption" in other else other)


@promise
def a_knob_that_a_run_does_not_read_changes_nothing(subject: Subject) -> Found:
    """What the default run or a preset's does not read has no effect on it, though it is turned;
    and some run reads it.
    """
    if not subject.lesson.form.notes:
        return
    fields = [field for field in fields_of(subject.lesson.params) if field.kind != "path"]
    runs = {"the default run": subject.lesson.params()}
    runs |= {f"preset {preset.name!r}": preset.params for preset in subject.lesson.presets}
    read: set[str] = set()
    for name, params in runs.items():
        run = subject.whole(params, name)
        read |= run.read
        idle = [field for field in fields if field.name in run.idle()]
        if idle and _all_turned(subject, idle, params, plain=run):
            for field in idle:
                yield from _has_no_effect(
                    subject, field, params, plain=run, although=f"{name} does not read it"
                )
        yield None
    for params in _choices(subject.lesson):
        if all(field.name in read for field in fields):
            break
        read |= subject.fresh(params, "a run at another choice", MOST_STEPS).read
    for field in fields:
        if field.knob.of_files:  # read with a file alone, which no preset has
            continue
        unread = (
            f"{subject.who}: no run reads {field.name}: not the default, no preset, at no choice"
        )
        yield None if field.name in read or field.knob.of_files else unread


def _choices(lesson: Lesson) -> Iterator[Any]:
    """Yield the default params at each choice of each knob."""
    for field in fields_of(lesson.params):
        if field.kind in ("choice", "bool"):
            yield from (replace(lesson.params(), **{field.name: value}) for value in ends(field))


@promise
def params_survive_the_way_through_text(subject: Subject) -> Found:
    """Params are the same after they were written to a link or recording, and no field has a name
    that commands use.
    """
    kind = subject.lesson.params
    for params in (kind(), *(preset.params for preset in subject.lesson.presets)):
        again = from_json(kind, to_json(params))
        if again == params and hash(again) == hash(params):
            yield None
        else:
            read = f"{kind.__name__} written as text and read again is {again}, not {params}"
            yield f"{subject.who}: {read}"
    for field in fields_of(kind):
        taken = field.name in RESERVED
        yield (
            f"{subject.who}: {kind.__name__}.{field.name}: commands use this name"
            if taken
            else None
        )


def ends(field: ParamField) -> list[Any]:
    """Return the values of a knob at each end of its range, or each of its choices."""
    low, high = field.knob.low, field.knob.high
    if field.kind in ("float", "int"):
        return [field.clean(low), field.clean(high)]
    if field.kind in ("floats", "ints"):
        return [field.clean([end] * field.length) for end in (low, high)]
    return [False, True] if field.kind == "bool" else list(field.choices)
