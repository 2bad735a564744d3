"""What the wheel carries beside the packages."""

import re
import tomllib
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]


def test_documentation_and_sample_files_reach_an_installed_user():
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())
    wheel = declared["tool"]["hatch"]["build"]["targets"]["wheel"]
    carried = wheel.get("force-include", {})
    assert carried == {"docs": "workbench/docs", "assets/data": "workbench/data/samples"}
    assert all(any((ROOT / folder).iterdir()) for folder in carried)


def hook():
    """The module that makes README what an index shows."""
    spec = spec_from_file_location("index_readme", ROOT / ".ci" / "index_readme.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def addresses(text: str) -> list[str]:
    """What pictures and links of a text lead to."""
    return re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'src="([^"]+)"', text)


def test_the_readme_of_an_index_has_no_address_within_the_checkout():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    relative = [at for at in addresses(readme) if not at.startswith("https:")]
    assert len(relative) >= 25
    made = hook().for_index(readme, "https://example.org/us/it", "v1.2")
    absolute = addresses(made)
    assert len(absolute) == len(addresses(readme))
    for at in relative:
        pictured = at.endswith((".webp", ".png", ".svg"))
        kind = "raw" if pictured else "blob"
        assert f"https://example.org/us/it/{kind}/v1.2/{at}" in absolute
    assert all(at.startswith("https:") for at in absolute)


def test_without_an_address_pictures_go_and_links_keep_their_words():
    made = hook().for_index(
        '![A](a.webp) [b c](d.md) [e](https://e.org) <img src="f.webp">', None, "v1"
    )
    assert made == " b c [e](https://e.org) "


def test_a_distribution_takes_its_readme_and_addresses_from_there(monkeypatch):
    monkeypatch.setenv("WORKBENCH_ADDRESS", "https://example.org/us/it")
    made = hook().IndexReadme(str(ROOT), {})
    metadata: dict[str, Any] = {"version": "9.1"}
    made.update(metadata)
    assert metadata["readme"]["content-type"] == "text/markdown"
    assert (
        "https://example.org/us/it/raw/v9.1/assets/pictures/icp.webp" in metadata["readme"]["text"]
    )
    assert metadata["urls"]["Source"] == "https://example.org/us/it"
