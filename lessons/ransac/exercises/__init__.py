"""The exercises of this lesson: a plane through three points, the points near it, and how many
samples to draw.
"""

from workbench.exercise import HiddenSeed

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 53
GRADERS = HiddenSeed(7411)
