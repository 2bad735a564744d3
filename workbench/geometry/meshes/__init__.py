"""Triangle meshes: corners and edges, curvature, ways along them, and what they enclose.

- `triangles`: two arrays: what holds at faces, corners, edges, vertices and borders.
- `curvature`: curvature by angle defects and cotangents.
- `laplacian`: the cotangent Laplacian and the area that belongs to each vertex.
- `intrinsic`: intrinsic Delaunay: edges flipped within the surface.
- `geodesics`: shortest ways along the edges of a graph, over faces, round a wall.
- `simplification`: meshes with fewer or more faces.
- `repair`: mends repeats, turned faces and sheets that touch.
- `mesh_energies`: what a mesh is kept smooth by while it is fitted, with gradients.
- `quadric_fit`: curvature by a quadric fitted to each vertex' neighbourhood.
- `measures`: area, volume inside, centroids.
- `containment`: winding numbers, hence which points are inside.
- `invariants`: what a map leaves as it was, measured on a mesh.
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
