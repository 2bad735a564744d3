from workbench.geometry.triangulation import triangulate  # noqa
