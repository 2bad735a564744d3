#!/bin/sh
# Runs when a student submits. ROOT is where PrairieLearn lays things out; another one is for trying this at home.
root="${1:-/grade}"
source="$root/serverFilesCourse/geometry-workbench"
python="${GRADER_PYTHON:-python3}"
mkdir -p "$root/results"
cp "$source/broken.json" "$root/results/results.json"  # what a student reads where nothing below comes to say more
chmod 700 "$root"  # the user that a submission runs as gets no further
cd "$root" || exit 0
PYTHONPATH="$source/packages" PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1 \
  timeout --kill-after=5 "${GRADER_SECONDS:-170}" "$python" -m workbench.handout.service "$root" "$root/tests/assignment.json"
exit 0
