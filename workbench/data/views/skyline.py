"""A city in a valley with mountains behind it: nothing in it is nearer than 180 m."""

import functools
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.data.shapes.solids import box
from workbench.data.views.street import LitMesh, chequered, lit
from workbench.geometry.cameras.raster import MeshItem, SegmentItem

VALLEY = -83.0  # metres, +Z up: its ground; the camera stands at about 0 and looks along +Y
# where the middle of the tallest tower's foot is, and its size
LANDMARK = (
    (84.0, 300.0),
    (24.0, 24.0, 125.0),
)
BLOCKS = (270.0, 330.0, 400.0, 490.0, 600.0, 740.0, 920.0)  # how far rows of towers are
STOREYS = 6.0  # metres from line to line on a wall
WALLS = ((216, 202, 178), (200, 198, 206), (232, 222, 204), (186, 196, 208), (206, 186, 176))
LINE_COLOR = (150, 150, 156)
GREENS = (202, 208, 200), (212, 218, 210)


@dataclass(frozen=True, eq=False)
class Skyline:
    """The scene, metres, +Z up: solids lit by the sun, the towers' outlines, and their storeys."""

    solids: tuple[LitMesh, ...]
    edges: Float[np.ndarray, "e 2 3"]
    storeys: Float[np.ndarray, "s 2 3"]


@functools.cache
def skyline() -> Skyline:
    """Return the city; it is the same each time."""
    rng = np.random.default_rng(0)
    towers = [LANDMARK]
    for y in BLOCKS:
        for x in np.arange(-0.7 * y, 0.75 * y, 0.13 * y):
            foot = x + rng.uniform(-12.0, 12.0), y + rng.uniform(-20.0, 20.0)
            size = *rng.uniform(14.0, 30.0, 2), 15.0 + 85.0 * rng.random() ** 2
            if np.hypot(foot[0] - LANDMARK[0][0], foot[1] - LANDMARK[0][1]) > 50.0:
                towers.append((foot, size))
    valley = chequered(np.arange(-14, 15), np.arange(1, 17), 100.0, height=VALLEY, colors=GREENS)
    solids = [valley, _mountains()]
    edges = []
    storeys = []
    block = box((1.0, 1.0, 1.0))  # every tower is this one, stretched
    for k, ((x, y), size) in enumerate(towers):
        foot = np.array([x, y, VALLEY])
        p_tower = block.p * size + foot
        solids.append(lit((p_tower, block.faces), WALLS[k % len(WALLS)]))
        edges.append(block.lines * size + foot)
        ring = np.stack([p_tower[:4], np.roll(p_tower[:4], -1, axis=0)], axis=1)
        storeys += [ring + np.array([0.0, 0.0, z]) for z in np.arange(STOREYS, size[2], STOREYS)]
    return Skyline(tuple(solids), np.concatenate(edges), np.concatenate(storeys))


@functools.cache
def skyline_items() -> tuple[MeshItem | SegmentItem, ...]:
    """Return what `cameras.raster.render` takes to make a photograph of the city."""
    scene = skyline()
    starts = np.cumsum([0, *[len(solid.p_world) for solid in scene.solids[:-1]]])
    whole = MeshItem(  # one mesh is drawn several times as fast as 82
        np.concatenate([solid.p_world for solid in scene.solids]),
        np.concatenate(
            [solid.faces + start for solid, start in zip(scene.solids, starts, strict=True)]
        ),
        np.concatenate([solid.colors for solid in scene.solids]),
    )
    return (
        whole,
        SegmentItem(
            scene.storeys, np.tile(np.array(LINE_COLOR, np.uint8), (len(scene.storeys), 1))
        ),
    )


def _mountains() -> LitMesh:
    x = np.linspace(-1400.0, 1500.0, 30)
    high = (
        130.0 + 60.0 * np.sin(x / 190.0) + 45.0 * np.sin(x / 83.0 + 1.0) + 25.0 * np.sin(x / 41.0)
    )
    foot = np.stack([x, 1300.0 + 60.0 * np.sin(x / 130.0), np.full(len(x), VALLEY)], axis=1)
    crest = np.stack([x, np.full(len(x), 1650.0), VALLEY + high], axis=1)
    k = np.arange(len(foot) - 1)[:, None]
    n = len(foot)
    faces = np.concatenate([k + np.array(corners) for corners in ((0, 1, n + 1), (0, n + 1, n))])
    return lit((np.concatenate([foot, crest]), faces), (186, 190, 202))
