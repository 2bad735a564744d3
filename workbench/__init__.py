"""A visual workbench for geometry estimation: watch, touch, record and grade the algorithms of 3D vision."""

__version__ = "0.1.0"
