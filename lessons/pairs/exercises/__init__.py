"""The exercise of this lesson: the scale of pairs, judged in per cent."""

from workbench.exercise import HiddenSeed

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 53
GRADERS = HiddenSeed(7310)
