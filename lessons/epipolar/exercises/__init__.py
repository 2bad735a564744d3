"""The exercises of this lesson: F from eight points, motions from E, and a point from two pixels."""

STUDENTS, GRADERS = 67, 9127  # seeds of what a student sees run, and of what only a grader does
