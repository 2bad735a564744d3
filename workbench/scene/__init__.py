"""What one step looks like, for any viewer: a mapping from path to frozen primitive.

In space: `Points`, `Segments`, `Mesh`, `Axes`, `Camera`, `Label`, `Picture`. Beside it: `Scalar`
(one number per step), `Curve` (y over x at this step), `Table`, `Picture` without a place in space,
and `Caption`.

What measures is drawn in place by `arc`, `dimension`, `arrows`, `dashed` and `circle`, which make
Segments and Labels; the large chart of a story by the verbs of `Chart`: `whole`, `mark`, `second`,
`band`.

A path such as `"source/points"` names a thing for the length of a run: a sink makes its world equal
to a scene by path. A thing that moves keeps its arrays (the same objects) and changes
`T_world_object`, so that sinks send a pose.
"""

from workbench.scene.colors import (
    PALETTE,
    UNKNOWN,
    Classes,
    Color,
    Field,
    Role,
    color_map,
    color_rows,
)
from workbench.scene.comparing import (
    PRIMITIVES,
    Primitive,
    Scene,
    arrays,
    caption_of,
    ghost,
    in_space,
    same,
    same_but_for_pose,
)
from workbench.scene.measures import arc, arrows, circle, dashed, dimension
from workbench.scene.side_panels import Caption, Chart, Curve, Scalar, Table
from workbench.scene.spatial import (
    Axes,
    Camera,
    Label,
    Mesh,
    Picture,
    Points,
    Segments,
    Spatial,
    is_rigid,
)

__all__ = [
    "PALETTE",
    "PRIMITIVES",
    "UNKNOWN",
    "Axes",
    "Camera",
    "Caption",
    "Chart",
    "Classes",
    "Color",
    "Curve",
    "Field",
    "Label",
    "Mesh",
    "Picture",
    "Points",
    "Primitive",
    "Role",
    "Scalar",
    "Scene",
    "Segments",
    "Spatial",
    "Table",
    "arc",
    "arrays",
    "arrows",
    "caption_of",
    "circle",
    "color_map",
    "color_rows",
    "dashed",
    "dimension",
    "ghost",
    "in_space",
    "is_rigid",
    "same",
    "same_but_for_pose",
]
