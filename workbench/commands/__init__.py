"""The commands, by what they are for: `watching` opens and records runs, `course` is for exercises
and marks, `making` for lessons and sites. `workbench.cli` reads the words and calls them.
"""
