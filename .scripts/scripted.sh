#!/bin/bash
# scripted.sh COMMIT PARENT -> prints a commit whose tree is COMMIT's after move + format + rewrap
set -e
W=/work/wt/scratch2

cd $W; git checkout -q -f --detach $1; git clean -fdq -e .venv
python3 /work/wt/scripts/move.py >/tmp/move.log 2>&1
sed -i 's/^line-length = 120/line-length = 100/; s/^max-line-length = 125/max-line-length = 100/' pyproject.toml
/work/main/.venv/bin/ruff check --select I --fix -q . || true
/work/main/.venv/bin/ruff format -q .
/work/main/.venv/bin/python /work/wt/scripts/rewrap.py >/tmp/rewrap.log 2>&1 || echo "rewrap failed" >&2
/work/main/.venv/bin/ruff format -q .
git add -A -- . ":!.venv"; T=$(git write-tree)
git commit-tree $T -p $2 -m "scripted $1"
