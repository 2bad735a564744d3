"""The name that lessons of before import: see `workbench.geometry.cameras.raster`."""

from workbench.geometry.cameras.raster import *  # noqa: F403
