"""Cameras: what they see of the world, their lenses, and where they are.

- `pinhole`: from world points to pixels and back to rays.
- `distortion`: where radial and tangential terms move a ray, and how to move it back.
- `calibration`: what pictures of a flat board say of a camera, after Zhang.
- `camera_motions`: the pose of a camera from known points: DLT, SQPnP, least squares.
- `control_points`: the pose from four points or more: EPnP.
- `planar_motions`: the two poses that fit points of one plane: IPPE.
- `three_points`: the pose from three points: P3P, for many samples at once.
- `raster`: a z-buffered picture of points, segments and meshes, through a lens.
- `stereo`: depth from a rectified pair of pictures, and its error.
- `volume_rendering`: a ray through a medium that emits and absorbs, and gradients.
"""

from workbench.geometry.cameras.pinhole import (
    OPENGL_FROM_OPENCV,
    back_project,
    camera_center,
    crop_intrinsics,
    depths,
    dolly,
    focal_from_field_of_view,
    in_front,
    intrinsics,
    look_at,
    normalize,
    pixel_rays,
    project,
    project_orthographic,
    ray_lengths,
    resize_intrinsics,
    sphere_outline,
    vanishing_points,
)

__all__ = [
    "OPENGL_FROM_OPENCV",
    "back_project",
    "camera_center",
    "crop_intrinsics",
    "depths",
    "dolly",
    "focal_from_field_of_view",
    "in_front",
    "intrinsics",
    "look_at",
    "normalize",
    "pixel_rays",
    "project",
    "project_orthographic",
    "ray_lengths",
    "resize_intrinsics",
    "sphere_outline",
    "vanishing_points",
]
