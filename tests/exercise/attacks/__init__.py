"""What submissions try: each is the body of a function that returns something true where it got
what it was after.

In the texts, `{secret}` is a file of the teacher's, `{results}` a student's result, `{folder}`
where both are, `{lessons}` the folder of the lessons, `{pid}` the grader's process, `{victim}`
another one of the same user, `{port}` where the teacher's machine listens.

`files` has what gets at files, `processes` what gets at other processes and at the kernel, or uses
up memory, time or disk.
"""

from tests.exercise.attacks.files import HARM, OPEN_TO_USERS, READING, SHARED, SOLUTIONS
from tests.exercise.attacks.processes import DOORS, PROCESSES, RESOURCES

__all__ = [
    "DOORS",
    "HARM",
    "OPEN_TO_USERS",
    "PROCESSES",
    "READING",
    "RESOURCES",
    "SHARED",
    "SOLUTIONS",
]
