"""Readers of people's files: each is read or refused in one clear line.

- `reading`: files that people bring: clouds, meshes, images and known poses, each read or refused
  in one clear line.
- `formats`: points out of the bytes of ply, pcd, obj and text files, in the dialects that
  people's scanners write.
- `arrays`: arrays out of the bytes of npy and npz files: nothing in them is run, and nothing
  unpacks without bound.
- `intrinsics`: intrinsics that people bring, read or refused in one clear line.
- `matches`: matches between two images that people bring, read or refused in one clear line.
- `edge_lists`: graphs that people bring as lists of edges: two names per line, and a weight if
  they like.
- `rims`: the rim of something bright and round on a dark ground, such as a coin, found from a
  pixel inside.
"""

from workbench.data.files.reading import (
    IMAGES,
    MOST_OF_POSES,
    NO_VERTEX,
    finite,
    lost_rows,
    number_rows,
    opened_image,
    read_cloud,
    read_image,
    read_mesh,
    read_pose,
    read_voxels,
    shipped,
    shipped_image,
    stamp,
    text_rows,
    word_rows,
)

__all__ = [
    "IMAGES",
    "MOST_OF_POSES",
    "NO_VERTEX",
    "finite",
    "lost_rows",
    "number_rows",
    "opened_image",
    "read_cloud",
    "read_image",
    "read_mesh",
    "read_pose",
    "read_voxels",
    "shipped",
    "shipped_image",
    "stamp",
    "text_rows",
    "word_rows",
]
