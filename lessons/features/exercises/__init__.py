"""The exercises of this lesson: the angles of a pair of normals, matches that pass both filters,
the corner response.
"""

from workbench.exercise import HiddenSeed

STUDENTS, GRADERS = (
    41,
    HiddenSeed(5303),
)  # seeds of what a student sees run, and of what only a grader does
