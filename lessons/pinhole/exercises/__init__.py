"""The exercises of this lesson: project points, bend them by a lens, find the camera."""

from workbench.exercise import HiddenSeed

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 23
GRADERS = HiddenSeed(9140)
