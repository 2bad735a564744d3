"""Cameras: what they see of the world, their lenses, and where they are.

- `pinhole`: pinhole cameras: from world points to pixels and back to rays.
- `distortion`: lens distortion: where radial and tangential terms move a ray, and how to move it
  back.
- `calibration`: what pictures of a flat board say of a camera, in closed form: Zhang's
  constraints, poses, a first lens.
- `camera_motions`: where a camera was that saw many known points: by the direct linear transform,
  by SQPnP, and by least squares.
- `control_points`: where a camera was that saw four points or more: EPnP, which asks for four
  control points in place of the points.
- `planar_motions`: where a camera was that saw points of one plane: the two answers that fit
  nearly alike where perspective is weak.
- `three_points`: where a camera was that saw three known points: the P3P problem, solved for many
  samples at once.
- `raster`: our own picture of points, segments and meshes: z-buffered, through a camera with its
  lens.
- `stereo`: depth from a rectified pair of pictures: a disparity becomes a depth, a point, and an
  error bar.
- `volume_rendering`: what a ray sees of a medium that emits and absorbs, sampled along it, and
  the gradient back to density and colour.
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
