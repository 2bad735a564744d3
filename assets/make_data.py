"""Makes small files to try the flags for own data with: `python -m assets.make_data`.

Two scans of one rabbit with the pose between them, a cloud with a plane in it, a bent mesh, and a
stereo pair.
"""

from pathlib import Path

import numpy as np
import trimesh
from PIL import Image

from workbench.data.shapes.clouds import pair
from workbench.data.shapes.surfaces import torus
from workbench.data.views.stereo import synthetic_views
from workbench.geometry.cameras.stereo import StereoCamera
from workbench.geometry.motions import exp_se3

DATA = Path(__file__).parent / "data"


def main() -> None:
    """Write all files; the same every time."""
    DATA.mkdir(exist_ok=True)
    rng = np.random.default_rng(0)
    T_target_source = exp_se3(np.array([0.05, 0.0, 0.02, 0.1, 0.05, 0.5]))
    scans = pair("rabbit", 2500, T_target_source, rng=rng, overlap=0.8, noise=0.001)
    cloud("rabbit_target.ply", scans.p_target)
    cloud("rabbit_source.ply", scans.p_source)
    np.savetxt(DATA / "rabbit_pose.txt", T_target_source)
    floor = rng.uniform(-1, 1, (700, 3)) * [1, 1, 0] + rng.normal(0, 0.01, (700, 3))
    cloud(
        "floor_and_clutter.ply", np.vstack([floor, rng.uniform([-1, -1, 0], [1, 1, 1], (500, 3))])
    )
    surface = torus(2000)
    trimesh.Trimesh(surface.p, surface.faces, process=False).export(DATA / "torus.ply")
    camera = StereoCamera(150.0, 79.5, 59.5, 0.1)
    views = synthetic_views("spheres", camera, (160, 120), rng=rng).exposed(2.0)
    for name, picture in (("left", views.left), ("right", views.right)):
        Image.fromarray(picture).save(DATA / f"{name}.png", optimize=True)


def cloud(name: str, p: np.ndarray) -> None:
    """Write points as a binary PLY of 32-bit floats."""
    trimesh.PointCloud(p.astype(np.float32)).export(DATA / name)


if __name__ == "__main__":
    main()
