"""Readers of people's files: each is read or refused in one clear line.

- `reading`: clouds, meshes, voxels and images.
- `poses`: known poses, of one scan or of many.
- `formats`: points of ply, pcd, obj and text files.
- `arrays`: npy and npz files; nothing in them is run or unpacks without bound.
- `intrinsics`, `matches`, `edge_lists`: numbers in text files.
- `samples`: the sample pictures of the course.
- `rims`: the rim of something bright and round, found from a pixel inside.
"""

from workbench.data.files.poses import MOST_OF_POSES, read_pose
from workbench.data.files.reading import (
    IMAGES,
    NO_VERTEX,
    finite,
    lost_rows,
    number_rows,
    opened_image,
    read_cloud,
    read_image,
    read_mesh,
    read_voxels,
    stamp,
    text_rows,
    word_rows,
)
from workbench.data.files.samples import shipped_array, shipped_image

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
    "shipped_array",
    "shipped_image",
    "stamp",
    "text_rows",
    "word_rows",
]
