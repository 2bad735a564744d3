"""The exercises of this lesson: what the angles around a vertex miss, Gaussian curvature, the mean-curvature normal."""

import numpy as np
from jaxtyping import Float, Int

from lessons.curvature import answers
from workbench.data import surfaces
from workbench.data.surfaces import Surface
from workbench.exercise.judging import left_alone, worst
from workbench.exercise.model import Exercise, Function, Verdict, band, check, fail, full, partial
from workbench.geometry import curvature
from workbench.geometry.meshes import euler_characteristic, on_boundary
from workbench.geometry.motions import exp_so3

STUDENTS, GRADERS = 21, 8123  # seeds of what a student sees run, and of what only a grader does

Mesh = tuple[np.ndarray, np.ndarray]

# meshes ---------------------------------------------------------------------------------------------------------------


def box(seed: int) -> Mesh:
    """Return a box of edges from half a metre to two, two triangles per side."""
    p = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = np.array([face for a, b, c, d in sides for face in ((a, b, c), (a, c, d))])
    return p * np.random.default_rng(seed).uniform(0.5, 2.0, 3), faces


def irregular(name: str, seed: int, count: int = 150) -> Surface:
    """Return a built-in surface whose vertices were moved about on it, so that no two triangles are alike."""
    return surfaces.SURFACES[name](count, jitter=0.2, rng=np.random.default_rng(seed))


def renumbered(p: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> Mesh:
    """Return the same mesh with its vertices, its faces and their first corners in another order."""
    place = rng.permutation(len(p))
    moved = np.empty_like(p)
    moved[place] = p
    turned = np.array([np.roll(face, k) for face, k in zip(place[faces], rng.integers(0, 3, len(faces)), strict=True)])
    return moved, turned[rng.permutation(len(faces))]


def with_a_flat_face(p: np.ndarray, faces: np.ndarray) -> Mesh:
    """Return the mesh with a vertex in the middle of the first face's first edge, and there a face without area."""
    (a, b, c), middle = faces[0], len(p)
    new = np.array([[a, middle, c], [middle, b, c], [a, b, middle]])
    return np.concatenate([p, (p[[a]] + p[[b]]) / 2]), np.concatenate([faces[1:], new])


def some_rotation(seed: int) -> np.ndarray:
    """Return a rotation by about half a turn about some axis."""
    return exp_so3(np.random.default_rng(seed).normal(size=3) * 1.5)


# verdicts -------------------------------------------------------------------------------------------------------------


def defects_verdict(candidate: Function, mesh: Mesh, hint: str) -> Verdict:
    """Judge angle defects by the largest error in degrees, and say where it is."""
    p, faces = mesh
    off = np.degrees(np.abs(candidate(p, faces) - curvature.angle_defects(p, faces)))
    i, border = int(np.argmax(off)), on_boundary(faces, len(p))
    where = f"It is worst at vertex {i}, {'on the border' if border[i] else 'inside the mesh'}. {hint}"
    return band("Largest error", float(off[i]), "degrees", good=0.01, fair=1.0, hint=where)


def curvature_verdict(
    got: np.ndarray, right: np.ndarray, hint: str, *, good: float, fair: float, size: float = 0.0, what: str = ""
) -> Verdict:
    """Judge numbers or vectors at the vertices in per cent; where `right` is nan, nan is asked for.

    Args:
        got: The answer.
        right: The right one; nan on the border.
        hint: What to look at where it is wrong.
        good: Per cent of error up to which all points are earned.
        fair: The same for half of them.
        size: What the error is related to; the largest of `right` where it is not given.
        what: How the message begins: the mesh.
    """
    got, right = got.reshape(len(got), -1), right.reshape(len(right), -1)
    inside = ~np.isnan(right).any(axis=1)
    lost = int((~np.isfinite(got[inside])).any(axis=1).sum())
    if lost:
        return fail(f"{what}{lost} of {inside.sum()} vertices inside the border have no finite value. {hint}")
    off = np.linalg.norm(got[inside] - right[inside], axis=1).max()
    size = size or float(np.linalg.norm(right[inside], axis=1).max())
    verdict = band(
        f"{what}largest error" if what else "Largest error",
        100 * float(off) / size,
        "%",
        good=good,
        fair=fair,
        hint=hint,
    )
    stray = int((~np.isnan(got[~inside])).any(axis=1).sum())
    if stray and verdict.share > 0:
        said = (
            f"{what}{stray} of {(~inside).sum()} border vertices have a value; the contract asks for nan on the border."
        )
        return partial(0.5, f"{said} The others are right." if verdict.share == 1.0 else f"{said} {verdict.message}")
    return verdict


def without_border(surface: Surface, right: np.ndarray) -> np.ndarray:
    """Return values at the vertices with nan on the border."""
    right = right.copy()
    right[on_boundary(surface.faces, len(surface.p))] = np.nan
    return right


# angle_defects --------------------------------------------------------------------------------------------------------


def angle_defects(p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]) -> Float[np.ndarray, " v"]:
    """Return how much the angles around each vertex miss a flat turn, in radians.

    At a vertex inside the mesh that is 2 pi less the sum of the angles of its faces there, at a vertex on the border pi
    less that sum. The border are the vertices of those edges that only one face has; a closed mesh has none.

    Args:
        p: Vertices, metres, one row each.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside. No edge has more than two faces.

    Returns:
        One angle defect per vertex, radians: not divided by an area. Positive at the tip of a cone, negative at a saddle.
        A face whose three vertices lie on one line has the angles 0, 0 and pi. A vertex that no face names counts as inside
        the mesh: nothing adds up to 2 pi there. The inputs stay as they are.
    """
    return curvature.angle_defects(p, faces)


DEFECT_HINT = "Inside the mesh: 2 pi less the angles at the vertex; on the border: pi less them."
FLAT_HINT = "If a face without area gives nan: clip cosines to [-1, 1], or take arctan2(|a x b|, a . b)."


@check(2)
def corners_of_a_box(candidate: Function) -> Verdict:
    """Each corner of a box misses a quarter turn, however long its edges are and however its sides are cut."""
    return defects_verdict(candidate, box(STUDENTS), f"Three right angles are there, of four. {DEFECT_HINT}")


@check(2)
def flat_sheet(candidate: Function) -> Verdict:
    """A flat sheet has no defect inside nor along its straight border, and a quarter turn at its corners."""
    sheet = irregular("plane", STUDENTS, 60)
    return defects_verdict(candidate, (sheet.p @ some_rotation(STUDENTS).T, sheet.faces), DEFECT_HINT)


@check(1)
def mesh_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    return left_alone(candidate, defects_verdict(candidate, box(STUDENTS + 1), DEFECT_HINT))


@check(3, public=False)
def gauss_bonnet(candidate: Function) -> Verdict:
    """All defects add up to 2 pi (V - E + F): on a sphere, a torus, a tube, a sheet, whatever the mesh."""
    verdicts = []
    for k, name in enumerate(("sphere", "torus", "cylinder", "saddle")):
        mesh = irregular(name, GRADERS + k)
        p = surfaces.with_noise(mesh, 0.02, np.random.default_rng(GRADERS + k)).p
        chi = euler_characteristic(mesh.faces)
        total = float(np.degrees(candidate(p, mesh.faces).sum()))
        what = f"On a {name} with noise the sum is {total:.6g} degrees, not {360 * chi}: error"
        said = band(what, abs(total - 360 * chi), "degrees", good=0.01, fair=1.0, hint=DEFECT_HINT)
        verdicts.append(full("The four sums are 720, 0, 0 and 360 degrees.") if said.share == 1.0 else said)
    return worst(verdicts)


@check(2, public=False)
def defects_go_with_the_mesh(candidate: Function) -> Verdict:
    """Moved, enlarged, turned inside out or numbered anew, every vertex keeps its defect."""
    rng = np.random.default_rng(GRADERS)
    mesh = irregular("catenoid", GRADERS, 120)
    p = 3.0 * mesh.p @ some_rotation(GRADERS).T + rng.normal(size=3)
    cases = ((mesh.p, mesh.faces), (p, mesh.faces), (p, mesh.faces[:, ::-1].copy()), renumbered(p, mesh.faces, rng))
    return worst(defects_verdict(candidate, case, DEFECT_HINT) for case in cases)


@check(1, public=False)
def flat_faces_and_lone_vertices(candidate: Function) -> Verdict:
    """A face without area has angles 0, 0 and pi, and a vertex without faces a defect of 2 pi."""
    ball = surfaces.sphere(42)
    verdicts = []
    for k in range(4):  # which cosines rounding takes beyond 1 depends on how the mesh is turned
        p, faces = with_a_flat_face(ball.p @ some_rotation(GRADERS + k).T, ball.faces)
        verdicts.append(defects_verdict(candidate, (np.concatenate([p, [[3.0, 0.0, 0.0]]]), faces), FLAT_HINT))
    return worst(verdicts)


# gaussian_curvature ---------------------------------------------------------------------------------------------------


def gaussian_curvature(p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]) -> Float[np.ndarray, " v"]:
    """Return Gaussian curvature K at each vertex: its angle defect over its mixed area, 1/m^2.

    The defect is 2 pi less the angles at the vertex. The mixed area is made of a part of each face around:

    - of a face without an obtuse angle, the points nearer to this vertex than to the other two (its Voronoi part):
      (|ij|^2 cot k + |ik|^2 cot j) / 8 for vertex i, j and k being the angles at the other two;
    - of an obtuse face, half where the obtuse angle is at this vertex, a quarter where it is at another one.

    Args:
        p: Vertices, metres, one row each. Every vertex belongs to a face.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside. No edge has more than two faces.

    Returns:
        K, 1/m^2: positive on a sphere, 0 on a cylinder, negative on a saddle, whichever side is called outside; nan on the
        border (the vertices of edges that only one face has), where it is not defined. A face whose three vertices lie on
        one line gives its angles 0, 0 and pi, and no area. The inputs stay as they are.
    """
    return curvature.gaussian_curvature(p, faces)


GAUSSIAN_HINT = "K = (2 pi less the angles) / mixed area."


@check(3)
def spheres(candidate: Function) -> Verdict:
    """A sphere of radius r has K = 1/r² everywhere."""
    verdicts = []
    for radius in (0.5, 3.0):
        ball = surfaces.sphere(162, radius)
        got, what = candidate(ball.p, ball.faces), f"Radius {radius:g} m: "
        verdicts.append(curvature_verdict(got, ball.gaussian, GAUSSIAN_HINT, good=3, fair=12, what=what))
    return worst(verdicts)


@check(2)
def tube(candidate: Function) -> Verdict:
    """A cylinder can be rolled out flat: K = 0 inside, nan on its border."""
    pipe = surfaces.cylinder(150)
    right = without_border(pipe, pipe.gaussian)
    return curvature_verdict(candidate(pipe.p, pipe.faces), right, GAUSSIAN_HINT, good=0.1, fair=2, size=4.0)


@check(1)
def mesh_of_K_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    ball = surfaces.sphere(42)
    right = curvature.gaussian_curvature(ball.p, ball.faces)
    return left_alone(
        candidate, curvature_verdict(candidate(ball.p, ball.faces), right, GAUSSIAN_HINT, good=0.1, fair=5)
    )


@check(2, public=False)
def obtuse_faces(candidate: Function) -> Verdict:
    """On irregular meshes with obtuse faces the mixed areas are right."""
    hint = "Half of an obtuse face belongs to its obtuse corner, a quarter to each of the others."
    verdicts = []
    for k, name in enumerate(("torus", "catenoid")):
        mesh = irregular(name, GRADERS + k)
        right = curvature.gaussian_curvature(mesh.p, mesh.faces)
        got = candidate(mesh.p, mesh.faces)
        verdicts.append(curvature_verdict(got, right, hint, good=0.1, fair=5, what=f"{name.capitalize()}: "))
    return worst(verdicts)


@check(2, public=False)
def size_and_side(candidate: Function) -> Verdict:
    """Twice the size gives a quarter of K; a motion and the choice of the outside change nothing."""
    mesh = irregular("saddle", GRADERS)
    right = curvature.gaussian_curvature(mesh.p, mesh.faces)
    p = mesh.p @ some_rotation(GRADERS).T + np.array([5.0, -2.0, 1.0])
    cases = (
        ("Moved: ", (p, mesh.faces), right),
        ("Twice as large: ", (2 * p, mesh.faces), right / 4),
        ("Inside out: ", (p, mesh.faces[:, ::-1].copy()), right),
    )
    return worst(
        curvature_verdict(candidate(*case), wanted, GAUSSIAN_HINT, good=0.1, fair=5, what=what)
        for what, case, wanted in cases
    )


@check(1, public=False)
def face_without_area(candidate: Function) -> Verdict:
    """A face without area adds its angles and no area."""
    ball = surfaces.sphere(42)
    p, faces = with_a_flat_face(ball.p, ball.faces)
    right = curvature.gaussian_curvature(p, faces)
    hint = "It is obtuse: its parts are a half and two quarters of nothing. Clip cosines, or take arctan2."
    return curvature_verdict(candidate(p, faces), right, hint, good=0.1, fair=5)


# mean_curvature_normals -----------------------------------------------------------------------------------------------


def mean_curvature_normals(p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]) -> Float[np.ndarray, "v 3"]:
    """Return the mean-curvature normal 2 H n at each vertex, 1/m.

    For vertex i it is 1 / (2 A_i) times the sum over its edges ij of (cot a_ij + cot b_ij) (p_i - p_j). a_ij and b_ij are
    the angles opposite the edge, one in each of its two faces. A_i is the mixed area, made of a part of each face around:

    - of a face without an obtuse angle, the points nearer to this vertex than to the other two (its Voronoi part):
      (|ij|^2 cot k + |ik|^2 cot j) / 8 for vertex i, j and k being the angles at the other two;
    - of an obtuse face, half where the obtuse angle is at this vertex, a quarter where it is at another one.

    Args:
        p: Vertices, metres, one row each. Every vertex belongs to a face.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside. No edge has more than two faces, and
            no face is without area.

    Returns:
        One vector per vertex, 1/m: on a sphere of radius r it points outward and is 2/r long; on a plane it is 0. It does
        not depend on which side is called outside. nan (all three) on the border, the vertices of edges that only one face
        has: it is not defined there. The inputs stay as they are.
    """
    return curvature.mean_curvature_normals(p, faces)


NORMAL_HINT = "Add up (cot a + cot b) (p_i - p_j) over the edges and divide by 2 A_i."


def _pulled(candidate: Function, mesh: Surface, hint: str = NORMAL_HINT, what: str = "") -> Verdict:
    """Judge 2 H n against the right answer on the same mesh."""
    right = curvature.mean_curvature_normals(mesh.p, mesh.faces)
    return curvature_verdict(candidate(mesh.p, mesh.faces), right, hint, good=0.1, fair=5, what=what)


@check(3)
def outward_on_spheres(candidate: Function) -> Verdict:
    """On a sphere of radius r the vectors point outward and are 2/r long."""
    verdicts = []
    for radius in (0.5, 3.0):
        ball = surfaces.sphere(162, radius)
        got, right = candidate(ball.p, ball.faces), 2 / radius * ball.normals
        verdicts.append(curvature_verdict(got, right, NORMAL_HINT, good=3, fair=12, what=f"Radius {radius:g} m: "))
    return worst(verdicts)


@check(2)
def around_a_tube(candidate: Function) -> Verdict:
    """On a cylinder of radius r they are 1/r long, and nan on its border."""
    pipe = surfaces.cylinder(200)
    right = without_border(pipe, 2 * pipe.mean[:, None] * pipe.normals)
    return curvature_verdict(candidate(pipe.p, pipe.faces), right, NORMAL_HINT, good=1, fair=8)


@check(1)
def mesh_of_H_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    return left_alone(candidate, _pulled(candidate, surfaces.sphere(42)))


@check(2, public=False)
def irregular_faces(candidate: Function) -> Verdict:
    """On irregular meshes with obtuse faces the cotangents and areas are right."""
    return worst(
        _pulled(candidate, irregular(name, GRADERS + k), what=f"{name.capitalize()}: ")
        for k, name in enumerate(("torus", "saddle"))
    )


@check(2, public=False)
def plane_and_soap_film(candidate: Function) -> Verdict:
    """They vanish on a plane however it is cut, and on a catenoid, whose two curvatures cancel."""
    sheet, film = irregular("plane", GRADERS, 100), surfaces.catenoid(300)
    hint = f"Flat or balanced means 0. {NORMAL_HINT}"
    return worst(
        curvature_verdict(
            candidate(mesh.p, mesh.faces),
            without_border(mesh, np.zeros_like(mesh.p)),
            hint,
            good=good,
            fair=fair,
            size=2.0,
            what=what,
        )
        for what, mesh, good, fair in (("Plane: ", sheet, 0.1, 1), ("Catenoid: ", film, 2, 6))
    )


@check(2, public=False)
def turns_with_the_mesh(candidate: Function) -> Verdict:
    """They turn with the mesh, halve on one of twice the size, and stay where its outside is called inside."""
    mesh = irregular("torus", GRADERS + 5, 100)
    right, R = curvature.mean_curvature_normals(mesh.p, mesh.faces), some_rotation(GRADERS + 5)
    p = mesh.p @ R.T + np.array([1.0, -4.0, 2.0])
    cases = (
        ("Turned: ", (p, mesh.faces), right @ R.T),
        ("Twice as large: ", (2 * p, mesh.faces), right @ R.T / 2),
        ("Inside out: ", (p, mesh.faces[:, ::-1].copy()), right @ R.T),
    )
    return worst(
        curvature_verdict(candidate(*case), wanted, NORMAL_HINT, good=0.1, fair=5, what=what)
        for what, case, wanted in cases
    )


TETRAHEDRON = "np.eye(4, 3), np.array([[0, 1, 2], [3, 1, 0], [3, 2, 1], [3, 0, 2]])"
TRIANGLE = "np.eye(3), np.array([[0, 1, 2]])"

EXERCISES = (
    Exercise(
        name="angle_defects",
        lesson="curvature",
        slot="angle_defects",
        reference=angle_defects,
        task="Write the angle defects of a triangle mesh: how much the angles around each vertex miss a full turn, or half "
        "a one on the border. The lesson lays a ring flat with the gap you return, and adds all of them up to 2 pi chi.",
        checks=(
            corners_of_a_box,
            flat_sheet,
            mesh_is_left_alone,
            gauss_bonnet,
            defects_go_with_the_mesh,
            flat_faces_and_lone_vertices,
        ),
        mistakes=answers.DEFECT_MISTAKES,
        alternatives=(answers.defects_by_cosines, answers.defects_in_loops),
        examples=(
            (f"angle_defects({TETRAHEDRON})", "[3.6652, 3.6652, 3.6652, 1.5708]"),
            (f"angle_defects({TRIANGLE})", "[2.0944, 2.0944, 2.0944]"),
        ),
    ),
    Exercise(
        name="gaussian_curvature",
        lesson="curvature",
        slot="gaussian_curvature",
        reference=gaussian_curvature,
        task="Write Gaussian curvature at the vertices of a mesh: what the angles miss, divided by the area that belongs to "
        "the vertex. The lesson colours the surface with it, and measures how wrong it is on ever finer meshes.",
        checks=(spheres, tube, mesh_of_K_is_left_alone, obtuse_faces, size_and_side, face_without_area),
        mistakes=answers.GAUSSIAN_MISTAKES,
        alternatives=(answers.gaussian_by_corners, answers.gaussian_by_circumcentres),
        examples=(
            (f"gaussian_curvature({TETRAHEDRON})", "[6.8041, 6.8041, 6.8041, 2.0944]"),
            (f"gaussian_curvature({TRIANGLE})", "[nan, nan, nan]"),
        ),
    ),
    Exercise(
        name="mean_curvature_normals",
        lesson="curvature",
        slot="mean_curvature_normals",
        reference=mean_curvature_normals,
        task="Write the mean-curvature normals of a mesh by the cotangent formula: at each vertex how its neighbours pull, "
        "divided by its area. The lesson draws them, and reads H off as half their length along the outward normal.",
        checks=(
            outward_on_spheres,
            around_a_tube,
            mesh_of_H_is_left_alone,
            irregular_faces,
            plane_and_soap_film,
            turns_with_the_mesh,
        ),
        mistakes=answers.NORMAL_MISTAKES,
        alternatives=(answers.gradient_of_area, answers.by_the_laplacian),
        examples=(
            (
                f"mean_curvature_normals({TETRAHEDRON})",
                "[[2.928, -0.536, -0.536], [-0.536, 2.928, -0.536], [-0.536, -0.536, 2.928], [-1.333, -1.333, -1.333]]",
            ),
            (f"mean_curvature_normals({TRIANGLE})", "np.full((3, 3), nan)"),
        ),
    ),
)
