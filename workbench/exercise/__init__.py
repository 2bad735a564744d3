"""Exercises: one function of a lesson, written by a student, watched live and graded on geometry.

`model` says what an exercise is, `sandbox` runs a student's file in a child process, `grading` judges it, the rest
reports. A student's file is never imported into this process.
"""

from workbench.exercise.model import Check, Exercise, Mistake, Verdict, band, check, fail, full, partial

__all__ = ["Check", "Exercise", "Mistake", "Verdict", "band", "check", "fail", "full", "partial"]
