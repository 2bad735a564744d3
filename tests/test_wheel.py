"""What the wheel carries beside the packages."""

import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_documentation_and_sample_files_reach_an_installed_user():
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())
    wheel = declared["tool"]["hatch"]["build"]["targets"]["wheel"]
    carried = wheel.get("force-include", {})
    assert carried == {"docs": "workbench/docs", "assets/data": "workbench/data/samples"}
    assert all(any((ROOT / folder).iterdir()) for folder in carried)
