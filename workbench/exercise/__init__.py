"""Exercises: one function of a lesson, written by a student, watched live and graded on geometry.

`model` says what an exercise is and has the decorators that make one, `judging` what many checks
need, `finding` looks exercises up, `sandbox` runs a student's file in a child process, `grading`
judges it, the rest reports. A student's file is never imported into this process.
"""

from workbench.exercise.judging import (
    beside,
    degrees_between,
    left_alone,
    motion_verdict,
    refused,
    rotation_verdict,
    worst,
)
from workbench.exercise.model import (
    Check,
    Contract,
    Exercise,
    Function,
    Mistake,
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    fail,
    full,
    mistake,
    number,
    partial,
)
from workbench.exercise.seeds import HiddenSeed

__all__ = [
    "Check",
    "Contract",
    "Exercise",
    "Function",
    "HiddenSeed",
    "Mistake",
    "Verdict",
    "against",
    "alternative",
    "band",
    "beside",
    "check",
    "contract",
    "degrees_between",
    "fail",
    "full",
    "left_alone",
    "mistake",
    "motion_verdict",
    "number",
    "partial",
    "refused",
    "rotation_verdict",
    "worst",
]
