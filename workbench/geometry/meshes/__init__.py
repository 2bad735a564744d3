"""Triangle meshes: corners and edges, curvature, ways along them, and what they enclose.

- `triangles`: triangle meshes as two arrays: what holds at faces, corners, edges, vertices and
  borders.
- `curvature`: curvature of a triangle mesh by angle defects and cotangents (Meyer, Desbrun,
  Schroeder and Barr 2003).
- `laplacian`: the cotangent Laplacian of a triangle mesh and the area that belongs to each
  vertex.
- `intrinsic`: A mesh as lengths only: its edges flipped within the surface until no cotangent
  weight inside is negative.
- `geodesics`: lengths of shortest ways: along the edges of a graph, over the faces of a mesh,
  round a wall.
- `simplification`: meshes with fewer or more faces: vertices of one cell made one, edges halved.
- `repair`: mends a triangle mesh without moving a point of its surface: repeats, turned faces,
  sheets that touch.
- `mesh_energies`: what a mesh is kept smooth by while it is fitted: energies of its vertices with
  their gradients.
- `quadric_fit`: curvature of a triangle mesh by a quadric fitted to the neighbourhood of each
  vertex.
- `measures`: how large a mesh is: its area, the volume inside, and where its middle is.
- `containment`: how often a mesh winds around a point, hence which points are inside: by vertical
  rays, or by solid angles.
- `invariants`: what a map leaves as it was, measured on a mesh: lengths, angles, area, volume,
  orientation, parallel edges.
"""

from workbench.geometry.meshes.triangles import (
    BLOCK,
    Corners,
    Faces,
    Points,
    adjacency,
    boundary_edges,
    check_mesh,
    corner_fans,
    corners,
    distinct_rows,
    edge_keys,
    edges,
    euler_characteristic,
    face_angles,
    face_areas,
    face_normals,
    half_edges,
    normals_at_vertices,
    on_boundary,
    one_ring,
    vertex_normals,
    vertices_within,
    welded,
)

__all__ = [
    "BLOCK",
    "Corners",
    "Faces",
    "Points",
    "adjacency",
    "boundary_edges",
    "check_mesh",
    "corner_fans",
    "corners",
    "distinct_rows",
    "edge_keys",
    "edges",
    "euler_characteristic",
    "face_angles",
    "face_areas",
    "face_normals",
    "half_edges",
    "normals_at_vertices",
    "on_boundary",
    "one_ring",
    "vertex_normals",
    "vertices_within",
    "welded",
]
