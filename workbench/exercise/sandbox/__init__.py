"""Runs a student's function in a process of its own that the kernel shuts in; what comes back is
plain values or a reason.

`walls` says what shuts a process in on this machine, `bubblewrap` and `python` how, `pipe` carries
the messages, `student` is the function as the grader calls it. What runs on the other side is in
`workbench.exercise.child`.
"""

from workbench.exercise.sandbox.budget import CallBudget
from workbench.exercise.sandbox.function import SandboxedFunction
from workbench.exercise.sandbox.isolation import Wall, best, named
from workbench.exercise.student import StudentError

__all__ = ["CallBudget", "SandboxedFunction", "StudentError", "Wall", "best", "named"]
