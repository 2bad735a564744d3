"""The name that lessons of before import: see `workbench.geometry.two_views.epipolar`."""

from workbench.geometry.two_views.epipolar import *  # noqa: F403
