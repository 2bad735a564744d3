"""The name that lessons of before import: see `workbench.geometry.two_views.homography`."""

from workbench.geometry.two_views.homography import *  # noqa: F403
