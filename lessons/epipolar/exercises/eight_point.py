"""x"""
from workbench.geometry.epipolar import fit_fundamental as eight_point  # noqa
