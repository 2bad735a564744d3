"""The exercises of this lesson: the angles of a pair of normals, matches that pass both filters,
the corner response.
"""

from workbench.exercise import HiddenSeed

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 41
GRADERS = HiddenSeed(5303)
