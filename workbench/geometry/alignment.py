"""The name that lessons of before import: see `workbench.geometry.motions.alignment`."""

from workbench.geometry.motions.alignment import *  # noqa: F403
