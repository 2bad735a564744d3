"""The exercises of this lesson: axes and their signs. Judged in degrees and signs."""

from workbench.exercise import HiddenSeed

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 53
GRADERS = HiddenSeed(7310)
