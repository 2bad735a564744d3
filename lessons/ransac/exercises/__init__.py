"""The exercises of this lesson: a plane through three points, the points near it, and how many
samples to draw.
"""

from workbench.exercise import HiddenSeed

STUDENTS, GRADERS = (
    53,
    HiddenSeed(7411),
)  # seeds of what a student sees run, and of what only a grader does
