"""The exercises of this lesson: project points, bend them by a lens, find the camera."""

from workbench.exercise import HiddenSeed

STUDENTS, GRADERS = (
    23,
    HiddenSeed(9140),
)  # seeds of what a student sees run, and of what only a grader does
