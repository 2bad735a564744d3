"""Where things of a lesson are that was split or renamed: one table for links, commands,
recordings, notebooks and sites.

What an address of before names still opens: its lesson, its preset and its params are looked up
here first.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, kw_only=True)
class Move:
    """A part of a lesson that is in another lesson now.

    Args:
        lesson: The lesson that it was in.
        to: The lesson that it is in.
        where: The param, and the value of it, that named the part.
        presets: Its presets, by their names of before.
        questions: Its questions, likewise.
        base: Params that were otherwise by default, as the part had them.
        gone: Params that the part does not have any more; they are left out.
        is_rest: Whether it is all of the lesson that no move before it names; `to` is the lesson
            itself where that stays.
    """

    lesson: str
    to: str
    where: tuple[str, str]
    presets: Mapping[str, str]
    questions: Mapping[str, str]
    base: Mapping[str, Any] = field(default_factory=dict)
    gone: frozenset[str] = frozenset()
    is_rest: bool = False

    def is_meant(self, preset: str | None, values: Mapping[str, Any]) -> bool:
        """Tell whether this part is meant by a preset and values of params."""
        name, value = self.where
        if name in values:
            return str(values[name]) == value or self.is_rest
        return preset in self.presets or self.is_rest


def _same(*names: str) -> dict[str, str]:
    return {name: name for name in names}


_BUILDING = frozenset({"half", "first", "scale", "shear", "perspective", "mirror"})
_MOVING = frozenset({"half", "angles_end", "method", "steps"})
_READINGS = {
    "other triples": ("gimbal",),
    "four conventions": ("conventions",),
    "fixed and own axes": ("fixed-own",),
    "transpose": ("transpose",),
    "xyzw for wxyz": ("xyzw",),
}
"""What the lesson on transforms compared that is about rotations, with the presets of each."""

MOVES = (
    Move(
        lesson="transforms",
        to="rotations",
        where=("half", "move between two poses"),
        presets=_same("minus-q", "one-axis", "wobble", "average", "entries", "screw"),
        questions=_same("lost-direction", "mean-heading", "mean-matrix"),
        gone=_BUILDING | {"compare"},
    ),
    *(
        Move(
            lesson="transforms",
            to="rotations",
            where=("compare", compare),
            presets=_same(*presets),
            questions={},
            base={"stage": "readings"},
            gone=_BUILDING,
        )
        for compare, presets in _READINGS.items()
    ),
    Move(
        lesson="transforms",
        to="transforms",
        where=("half", "build a map"),
        presets={},
        questions={},
        gone=_MOVING,
        is_rest=True,
    ),
    Move(
        lesson="alignment",
        to="pairs",
        where=("stage", "pairs"),
        presets=_same("pairs", "mirrored", "wrong-flip", "negated", "flat", "scale", "scale-clean"),
        questions=_same("predict-negated", "predict-product"),
        base={"noise": 0.0},
        gone=frozenset({"stage", "signs", "fresh", "density", "seen", "stray"}),
    ),
    Move(
        lesson="alignment",
        to="axes",
        where=("stage", "axes"),
        presets=_same(
            *("home", "signs", "fresh", "box", "vase", "nearly", "cube"),
            *("density", "part", "stray", "far"),
        ),
        questions=_same("predict-rotations", "predict-frames", "predict-signs"),
        gone=frozenset({"stage", "scale", "mirrored", "flip"}),
        is_rest=True,
    ),
)
"""What moved; of a lesson's parts the first that is meant counts."""


@dataclass(frozen=True)
class Moved:
    """Where something is now: the lesson's name, the preset's if one was named, and values of
    params.
    """

    lesson: str
    preset: str | None
    values: dict[str, Any]


def moved(lesson: str, preset: str | None, values: Mapping[str, Any]) -> Moved:
    """Return where a lesson's preset and params are now; what did not move is returned as it is."""
    move = next(
        (move for move in MOVES if move.lesson == lesson and move.is_meant(preset, values)), None
    )
    if move is None:
        return Moved(lesson, preset, dict(values))
    kept = {name: value for name, value in values.items() if name not in move.gone}
    if preset is None:
        return Moved(move.to, None, {**move.base, **kept})
    return Moved(move.to, move.presets.get(preset, preset), kept)


def runs_led_on(lesson: str) -> dict[str, tuple[str, str]]:
    """Return the runs of a lesson that are in another one now: (lesson, run) by the name of
    before.
    """
    moves = [move for move in MOVES if move.lesson == lesson]
    return {name: (move.to, to) for move in moves for name, to in move.presets.items()}


def lessons_led_on() -> dict[str, str]:
    """Return the lessons that are in others altogether, each with the one that has the rest of
    it.
    """
    return {move.lesson: move.to for move in MOVES if move.is_rest and move.to != move.lesson}


def asked_before(lesson: str) -> dict[str, tuple[str, str]]:
    """Return the questions of a lesson that another one asked: (lesson, question) of before by
    their names now.
    """
    moves = [move for move in MOVES if move.to == lesson]
    return {to: (move.lesson, name) for move in moves for name, to in move.questions.items()}
