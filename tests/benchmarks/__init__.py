"""Benchmarks, run as every command of the workbench does: with freed memory kept."""

from workbench.machinery.memory import keep_freed

keep_freed()
