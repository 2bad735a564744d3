"""Scenes of one thing each, of every primitive and every way to draw it, all at the same path."""

import numpy as np

from tests.fake import PHOTO, K
from workbench.scene import (
    Axes,
    Camera,
    Classes,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
)

MOVED = np.array([[0.0, -1, 0, 0.3], [1, 0, 0, 0.2], [0, 0, 1, 0.1], [0, 0, 0, 1]])
SHEARED = np.array([[1.0, 0.5, 0, 0.3], [0, 1, 0, 0.2], [0, 0, 2, 0.1], [0, 0, 0, 1]])
FACE = np.array([[0, 1, 2]])
ENDS = np.array([[[0.0, 0, 0], [1, 0, 0]], [[0, 1, 0], [0, 1, 1]]])
GREEN = np.array([[0, 200, 0], [0, 100, 0], [9, 8, 7]], np.uint8)
SMALL = PHOTO[::8, ::8].copy()

KINDS: tuple[Scene, ...] = (
    {"x": Points(np.eye(3), "source", T_world_object=MOVED)},
    {"x": Points(np.eye(3), GREEN, opacity=0.5)},
    {"x": Points(np.eye(3)[:2], "target", T_world_object=SHEARED)},
    {"x": Segments(ENDS, "source", T_world_object=MOVED)},
    {
        "x": Segments(
            ENDS, Classes(np.array([0, 1]), ("truth", "wrong"), ("a", "b")), 3.0, opacity=0.4
        )
    },
    {"x": Segments(ENDS[:0])},
    {"x": Mesh(np.eye(3), FACE, "source", MOVED)},
    {"x": Mesh(np.eye(3), FACE, "target", opacity=0.4)},
    {"x": Mesh(np.eye(3), FACE, Field(np.arange(3.0), 0, 2, "h"))},
    {"x": Mesh(np.eye(3), FACE, Field(np.arange(3.0), 0, 2, "h"), MOVED, opacity=0.3)},
    {"x": Axes(MOVED)},
    {"x": Axes(length=0.5, opacity=0.5)},
    {"x": Camera(K, 64, 48, MOVED, image=SMALL)},
    {"x": Camera(K, 64, 48)},
    {"x": Camera(K, 64, 48, image=SMALL, opacity=0.5)},
    {"x": Label("a", np.ones(3), T_world_object=MOVED)},
    {"x": Label("b", np.zeros(3), opacity=0.5)},
    {"x": Picture(SMALL, width=0.5, T_world_object=MOVED)},
    {"x": Picture(SMALL, width=0.5, opacity=0.5)},
    {},
)
