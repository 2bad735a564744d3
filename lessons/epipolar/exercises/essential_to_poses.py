from workbench.geometry.essential import essential_to_poses  # noqa
