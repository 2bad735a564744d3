#!/bin/bash
# Run in a worktree of an old layout: moves modules, then mends order and form.
python3 /work/wt/scripts/move.py && .venv/bin/ruff check --select I --fix -q . ; .venv/bin/ruff format -q .
