"""The exercises of this lesson: axes and their signs. Judged in degrees and signs."""

from workbench.exercise import HiddenSeed

STUDENTS, GRADERS = (
    53,
    HiddenSeed(7310),
)  # seeds of what a student sees run, and of what only a grader does
