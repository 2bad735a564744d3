"""What a finer mesh does to the sums over its faces."""

import functools

import numpy as np

from lessons.measures.state import Params, Study
from lessons.measures.subjects import built_in
from workbench.geometry.meshes.measures import signed_volume, surface_area

SURE = 1.96  # standard errors to either side that hold the truth in 95 of 100 runs
RUNS = 4000
SECTORS = (4, 6, 8, 11, 16)
POWERS = {"rings = sectors": 1, "rings = sectors²": 2, "rings = sectors³": 3}


def study_of(params: Params) -> Study | None:
    """Return the errors on ever finer meshes of a smooth shape; None where a shape has none, or was
    spoilt.
    """
    spoilt = params.method != "faces" or params.hole or params.flipped
    if spoilt or params.mesh is not None or params.voxels is not None:
        return None
    if params.shape == "lantern":
        return _lanterns()
    return _halved(params.shape) if params.shape in ("sphere", "torus") else None


@functools.lru_cache(maxsize=4)
def peeked(share: float, counts: tuple[int, ...]) -> tuple[float, float]:
    """Return for how many runs of random throws the 95 % interval misses the truth at the end, and
    ever, as shares.

    Args:
        share: Of the box that is inside.
        counts: How many points are thrown until each look.
    """
    rng = np.random.default_rng(0)
    n = np.array(counts)
    hits = np.cumsum(rng.binomial(np.diff(n, prepend=0), share, (RUNS, len(n))), axis=1) / n
    outside = np.abs(hits - share) > SURE * np.sqrt(hits * (1 - hits) / n)
    return float(outside[:, -1].mean()), float(outside.any(axis=1).mean())


@functools.lru_cache(maxsize=2)
def _halved(shape: str) -> Study:
    meshes = [built_in(shape, subdivisions, 4, rings=4) for subdivisions in range(6)]
    area = [abs(surface_area(mesh.p, mesh.faces) / mesh.area - 1) for mesh in meshes]
    volume = [abs(signed_volume(mesh.p, mesh.faces) / mesh.volume - 1) for mesh in meshes]
    counts = np.array([len(mesh.faces) for mesh in meshes], dtype=float)
    return Study(faces=counts, errors={"area": np.array(area), "volume": np.array(volume)})


@functools.cache
def _lanterns() -> Study:
    shares = {}
    for name, power in POWERS.items():
        made = [built_in("lantern", 0, sectors, rings=sectors**power) for sectors in SECTORS]
        shares[name] = np.array([surface_area(mesh.p, mesh.faces) / mesh.area for mesh in made])
    return Study(faces=np.array(SECTORS, dtype=float), errors=shares)
