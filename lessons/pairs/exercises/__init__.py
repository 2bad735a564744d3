"""The exercise of this lesson: the scale of pairs, judged in per cent."""

from workbench.exercise import HiddenSeed

STUDENTS, GRADERS = (
    53,
    HiddenSeed(7310),
)  # seeds of what a student sees run, and of what only a grader does
