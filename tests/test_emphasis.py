"""What is read of stands out, all else steps back, and nothing else changes."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from workbench.emphasis import lit
from workbench.scene import Caption, Label, Points, Segments

P = np.eye(3)
SCENE: dict[str, Any] = {
    "source/points": Points(P, "source"),
    "source/normals": Segments(np.zeros((1, 2, 3))),
    "sources": Points(P, "other"),
    "name": Label("here", np.zeros(3)),
    "caption": Caption("So it is."),
}


def test_what_is_meant_is_stronger_and_the_rest_is_fainter():
    seen: Mapping[str, Any] = lit(SCENE, "source")
    assert seen.keys() == SCENE.keys()
    assert seen["source/points"].radius > SCENE["source/points"].radius
    assert seen["source/normals"].width > SCENE["source/normals"].width
    assert seen["source/points"].p is P
    assert seen["sources"].opacity < 1  # begins alike, is another
    assert seen["sources"].radius == SCENE["sources"].radius
    assert [seen[path] is SCENE[path] for path in ("name", "caption")] == [True, True]


def test_a_name_of_nothing_changes_nothing():
    assert lit(SCENE, "sour") is SCENE
    assert lit(SCENE, "caption") is SCENE
