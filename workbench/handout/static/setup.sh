#!/usr/bin/env bash
# Runs once, when the image is built: the image's own Python is too old, so another one is installed, and numpy and scipy.
set -eu
source="${1:-/autograder/source}"
place="${2:-/opt/geometry-workbench}"
export DEBIAN_FRONTEND=noninteractive UV_PYTHON_INSTALL_DIR=/opt/python UV_LINK_MODE=copy
apt-get update
apt-get install -y --no-install-recommends python3-pip ca-certificates bubblewrap
if python3 -m pip install uv && python3 -m uv venv --managed-python --python @PYTHON@ "$place"; then
  python3 -m uv pip install --python "$place/bin/python" -r "$source/requirements.txt"
else  # where uv cannot get one, Ubuntu's archive of other Pythons has one
  apt-get install -y --no-install-recommends software-properties-common
  add-apt-repository -y ppa:deadsnakes/ppa
  apt-get install -y --no-install-recommends python@PYTHON@ python@PYTHON@-venv
  "python@PYTHON@" -m venv "$place"
  "$place/bin/python" -m pip install -r "$source/requirements.txt"
fi
chmod 755 "$source/run_autograder"
PYTHONPATH="$source/packages" "$place/bin/python" -m workbench.handout.service --wall
