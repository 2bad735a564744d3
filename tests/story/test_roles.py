"""Every role of a scene has a colour in the large chart of a story."""

import re
from pathlib import Path

import pytest

from workbench.scene.colors import PALETTE

STATIC = Path(__file__).resolve().parents[2] / "workbench" / "page" / "static"


@pytest.mark.parametrize("role", PALETTE)
def test_a_curve_of_every_role_is_seen(role):
    """A curve of the role `other` had no stroke: its name stood beside nothing."""
    script = (STATIC / "storyplot.js").read_text(encoding="utf-8")
    table = re.search(r"const ROLE_COLORS = (\{.*?\});", script, re.DOTALL)
    assert table is not None
    variables = dict(re.findall(r'(\w+): "([\w-]+)"', table[1]))
    style = (STATIC / "story.css").read_text(encoding="utf-8")
    assert f"--{variables[role]}:#" in style
    ink = re.sub("-(ink|fill)$", "", variables[role])
    assert f"--{ink}-ink:#" in style
