"""Hands exercises out: what a course system takes as it is, and what runs there when a student
hands in.

`assignment` says what is asked for, `samples` writes a file that earns everything, `parcel` is the
grader as files, `gradescope`, `prairielearn` and `plain` lay it out for a service, `writing` puts
it on the disk and tries it, `service` is what runs there. Grading there needs numpy and scipy, and
nothing of the page.
"""
