"""Where modules move: package -> (docstring, {new stem: (old stem, one line)})."""

GEOMETRY = {
    "motions": ("Motions of space: rotations, rigid and affine ones, and the best of them between points.", {
        "rigid": "motions", "rotations": "rotations", "rotation_outputs": "rotation_outputs", "affine": "affine",
        "alignment": "alignment", "principal_axes": "principal_axes"}),
    "cameras": ("Cameras: what they see of the world, their lenses, and where they are.", {
        "pinhole": "cameras", "distortion": "distortion", "calibration": "calibration",
        "camera_motions": "camera_motions", "control_points": "control_points", "planar_motions": "planar_motions",
        "three_points": "three_points", "raster": "raster", "stereo": "stereo", "volume_rendering": "volume_rendering"}),
    "two_views": ("Two pictures of one scene: how they are related, and what follows for depth.", {
        "epipolar": "epipolar", "essential": "essential", "homography": "homography",
        "triangulation": "triangulation", "rectification": "rectification"}),
    "features": ("What is found again: keypoints, their descriptors in pictures and clouds, and matches.", {
        "keypoints": "keypoints", "sift": "sift", "fpfh": "fpfh", "shape_context": "shape_context",
        "matching": "matching"}),
    "meshes": ("Triangle meshes: corners and edges, curvature, ways along them, and what they enclose.", {
        "triangles": "meshes", "curvature": "curvature", "laplacian": "laplacian", "intrinsic": "intrinsic",
        "geodesics": "geodesics", "simplification": "simplification", "repair": "repair",
        "mesh_energies": "mesh_energies", "quadric_fit": "quadric_fit", "measures": "measures",
        "containment": "containment", "invariants": "invariants"}),
    "points": ("Clouds of points: normals, samples, and how far two of them are apart.", {
        "normals": "normals", "sampling": "sampling", "shape_distances": "shape_distances", "metrics": "metrics"}),
    "fields": ("Shapes as fields: voxels, and distances with a sign.", {
        "voxels": "voxels", "signed_distances": "signed_distances"}),
    "graphs": ("Graphs of points: adjacency, spectra and embeddings.", {
        "adjacency": "graphs", "spectra": "spectra", "embedding": "embedding"}),
    "shapes": ("Lines, circles, cylinders, curves, the globe: shapes of few numbers, and fits of them.", {
        "lines_planes": "lines_planes", "circles_spheres": "circles_spheres", "cylinders": "cylinders",
        "algebraic_fits": "algebraic_fits", "bezier": "bezier", "curvilinear": "curvilinear", "globe": "globe",
        "projective": "projective"}),
}
ALGORITHMS = {
    "registration": ("Registration: the motion between two clouds, and its parts.", {
        "icp": "icp", "procrustes": "procrustes", "jacobi": "jacobi"}),
    "robust": ("Robust estimation: models, samples, scores, and losses that bound what an outlier does.", {
        "estimators": "robust", "ransac": "ransac", "models": "models", "samplers": "samplers", "scores": "scores",
        "camera_model": "camera_model"}),
    "least_squares": ("Nonlinear least squares, step by step.", {
        "descent": "least_squares", "board_adjustment": "board_adjustment"}),
    "cameras": ("Cameras from what they saw: calibration, and the search for a pose.", {
        "calibration": "calibration", "camera_search": "camera_search"}),
    "stereo": ("Depth from a rectified pair: costs, and ways to choose by them.", {
        "cost_volume": "cost_volume", "disparity": "disparity", "disparity_map": "disparity_map",
        "semiglobal": "semiglobal"}),
    "surfaces": ("On surfaces: curvature, distances along them, area and volume.", {
        "curvature": "curvature", "heat_method": "heat_method", "fast_marching": "fast_marching",
        "measures": "measures", "monte_carlo": "monte_carlo"}),
    "transport": ("Optimal transport: exact, blurred, and flows along it.", {
        "exact": "transport", "sinkhorn": "sinkhorn", "flow": "flow"}),
    "learning": ("Small networks, and what they learn about shapes.", {
        "perceptron": "perceptron", "point_net": "point_net", "graph_network": "graph_network",
        "neural_field": "neural_field", "radiance_field": "radiance_field",
        "rotation_regression": "rotation_regression", "set_regression": "set_regression",
        "mesh_fitting": "mesh_fitting"}),
    "spatial": ("Trees over space.", {"kd_tree": "kd_tree", "octree": "octree"}),
    "graphs": ("On graphs: diffusion, and cuts by spectra.", {"diffusion": "diffusion", "spectral_cut": "spectral_cut"}),
}
DATA = {
    "files": ("Readers of people's files: each is read or refused in one clear line.", {
        "reading": "files", "formats": "formats", "arrays": "arrays", "intrinsics": "intrinsics",
        "matches": "matches", "edge_lists": "edge_lists", "rims": "rims"}),
    "shapes": ("Made shapes and scans of them: clouds, meshes, solids.", {
        "clouds": "clouds", "rabbit": "rabbit", "surfaces": "surfaces", "solids": "solids", "lidar": "lidar"}),
    "views": ("Scenes before cameras, made or people's own, and where pixels of them are known.", {
        "boards": "boards", "corners": "corners", "board_corners": "board_corners", "sightings": "sightings", "skyline": "skyline", "street": "street", "stereo": "stereo",
        "stereo_scenes": "stereo_scenes", "two_views": "two_views"}),
}
TOP = {
    "run": ("What a run is: its steps, a person's place in it, and the words that name it.", {
        "timeline": "timeline", "session": "session", "questions": "questions", "picking": "picking",
        "links": "links", "loading": "loading", "listing": "listing", "flags": "flags"}),
    "words": ("Words and numbers as a page shows them: typeset text and axes.", {"typeset": "typeset", "axis": "axis"}),
    "machinery": ("What knows no geometry: processes, threads, files written whole, hosts.", {
        "workers": "workers", "threads": "threads", "progress": "progress", "atomic": "atomic", "hosts": "hosts",
        "authors": "authors", "images": "images"}),
}
LESSONS = {
    "transforms": {"composition": "algorithms.composition"},
    "coordinates": {n: f"algorithms.{n}" for n in ("pan_tilt", "placing", "parallels", "voyages")},
    "fitting": {"fit_studies": "algorithms.fit_studies", "round_shapes": "algorithms.round_shapes",
                "fit_scenes": "data.fit_scenes"},
    "pinhole": {"following": "algorithms.pinhole"},
    "learning": {"flatland": "data.flatland", "labelled_shapes": "data.labelled_shapes"},
    "measures": {"measurables": "data.measurables"},
    "features": {"silhouettes": "data.silhouettes", "turned_pictures": "data.turned_pictures"},
    "ransac": {"robust_scenes": "data.robust"},
    "chamfer_emd": {"point_sets": "data.point_sets"},
    "distances": {"swiss_roll": "data.swiss_roll"},
}
# old names that the authors' guide has given out: they stay importable
KEPT = ("geometry.alignment", "geometry.homography", "geometry.epipolar", "geometry.raster")
