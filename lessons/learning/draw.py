"""What one step looks like: what was learned, in space, and beside it its errors and its loss."""

import functools

import numpy as np

from lessons.learning import flatland
from lessons.learning.captions import caption, changes_of, said, shares_right
from lessons.learning.labelled_shapes import NAMES
from lessons.learning.state import Clouds, Looks, Params, State, Target, Turns
from lessons.learning.tasks import NEW_VIEW, PIXELS, RADII
from workbench.algorithms.learning.mesh_fitting import MeshFitted
from workbench.algorithms.learning.point_net import Classified
from workbench.algorithms.learning.radiance_field import Reconstructed
from workbench.algorithms.learning.rotation_regression import Regressed
from workbench.algorithms.learning.set_regression import SetLearned
from workbench.geometry.meshes.mesh_energies import face_pairs, fold_angles
from workbench.geometry.polylines import at_height, between, circle, segments, sphere_rings
from workbench.numerals import percent
from workbench.scene import (
    Chart,
    Classes,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Scene,
    Segments,
    Table,
)

LOSS = Chart("Loss")
ERROR = Chart("Error", unit="°")
SPREAD = Chart("Spread of the radii", unit="m")
OVER_TURN = Chart("Output over turn", "turn (°)", "output (°)")
BY_TURN = Chart("Error by turn", "turn (°)", "error (°)")
DISTANCE, FOLDS = Chart("Root of Chamfer", unit="m"), Chart("Folded edges", unit="%")
RIGHT, MATCH = Chart("Named rightly", unit="%"), Chart("Match of photographs", unit="dB")
ALONG = Chart("Weights along the ray", "distance from the camera (m)", "weight")
T_WORLD_FIELD = np.diag([1.0, -1.0, -1.0, 1.0])  # rows of the picture run along -y
GAP = 2.3
STRIP = 6
LIFT = np.array([0.0, 0.0, 0.02])
BESIDE = np.eye(4)
# m, to the right as the meshes are seen: where the true surface stands
BESIDE[:3, 3] = (1.0, 0.7, 0.0)
UNIT = at_height(circle())


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    fit, about, params = state.now, state.about, state.params
    scene: dict[str, Primitive] = {
        "caption": caption(state),
        "loss": LOSS.scalar(fit.loss, "training loss", log=True),
    }
    match fit, about:
        case Regressed(), Turns():
            return scene | (
                _angle(params, about, fit)
                if params.task == "angle"
                else _rotation(params, about, fit)
            )
        case SetLearned(), _:
            return scene | _set(fit)
        case MeshFitted(), Target():
            return scene | _mesh(fit, about)
        case Classified(), Clouds():
            return scene | _clouds(params, fit, about)
        case Reconstructed(), Looks():
            return scene | _field(fit, about)
    raise AssertionError


def _errors(fit: Regressed) -> dict[str, Primitive]:
    return {
        "mean": ERROR.scalar(float(fit.errors.mean()), "mean", "truth"),
        "worst": ERROR.scalar(float(fit.errors.max()), "worst", "wrong"),
    }


def _angle(params: Params, about: Turns, fit: Regressed) -> dict[str, Primitive]:
    a = np.arctan2(fit.R[:, 1, 0], fit.R[:, 0, 0])
    put = 1.12 * np.column_stack([np.cos(a), np.sin(a), 0 * a])
    k = params.picked % len(put)
    # of all angles that mean the same
    nearest = about.degrees + (np.degrees(a) - about.degrees + 180) % 360 - 180
    told = np.degrees(fit.outputs[:, 0]) if params.angle == "one number" else nearest
    return _errors(fit) | {
        "circle": Segments(segments(UNIT), "neutral", 1.0),
        "inputs": Points(
            about.places, Field(fit.errors, 0.0, 45.0, "error", "°"), 0.022, name="inputs"
        ),
        "outputs": Points(put, "source", 0.014, name="outputs"),
        "to": Segments(
            between(about.places, put),
            "correspondence",
            1.0,
            opacity=0.6,
            name="which belongs to which",
        ),
        "picked": Points(about.places[[k]] + LIFT, "highlight", 0.04, name="picked"),
        "picked/to": Segments(between(about.places[[k]], put[[k]]) + LIFT, "highlight", 4.0),
        "put": OVER_TURN.curve(about.degrees, told, "put out"),
        "asked": OVER_TURN.curve(about.degrees, about.degrees, "the turn itself", "truth"),
    }


def _rotation(params: Params, about: Turns, fit: Regressed) -> dict[str, Primitive]:
    k = params.picked % len(about.places)
    return _errors(fit) | {
        "ball": Segments(
            sphere_rings(np.zeros(3), params.largest / 180),
            "neutral",
            1.0,
            name="the largest turns",
        ),
        "inputs": Points(
            about.places, Field(fit.errors, 0.0, 45.0, "error", "°"), 0.025, name="rotation vectors"
        ),
        "picked": Points(about.places[[k]], "highlight", 0.045, name="picked"),
        "by turn": BY_TURN.dots(about.degrees, fit.errors, "test rotations", "truth"),
    }


def _set(learned: SetLearned) -> dict[str, Primitive]:
    radii = np.linalg.norm(learned.p, axis=1)
    shown = learned.targets if len(learned.targets) else np.zeros((1, 2, 3))
    lines = np.concatenate([segments(target, closed=True) for target in shown])
    return {
        "band": Segments(
            np.concatenate([segments(radius * UNIT) for radius in RADII]),
            "neutral",
            1.0,
            name="least, most",
        ),
        "targets": Segments(lines, "target", 1.5, opacity=0.7, name="targets of this update"),
        "mean": Segments(segments(UNIT), "truth", 2.0, name="circle of the mean radius"),
        "points": Points(learned.p, "source", 0.03, name="the set"),
        "spread": SPREAD.scalar(float(radii.std()), "standard deviation", "truth"),
    }


@functools.lru_cache(maxsize=4)
def _pairs(about: Target) -> tuple[np.ndarray, np.ndarray]:
    """Return pairs of faces and the two vertices that they share."""
    pairs = face_pairs(about.faces)
    first, other = about.faces[pairs[:, 0]], about.faces[pairs[:, 1]]
    return pairs, first[(first[:, :, None] == other[:, None]).any(axis=2)].reshape(-1, 2)


def _mesh(fitted: MeshFitted, about: Target) -> dict[str, Primitive]:
    pairs, shared = _pairs(about)
    folded = fold_angles(fitted.p, about.faces, pairs) > np.pi / 2
    return {
        "given": Points(about.given, "target", 0.01, name="given points"),
        "mesh": Mesh(fitted.p, about.faces, "source", flat=True, name="fitted mesh"),
        "folded": Segments(fitted.p[shared[folded]], "wrong", 3.0, name="edges folded by over 90°"),
        "true": Mesh(
            about.p_true,
            about.faces_true,
            "truth",
            flat=True,
            T_world_object=BESIDE,
            name="true surface",
        ),
        "to given": DISTANCE.scalar(
            float(np.sqrt(fitted.to_given)), "to the given points", log=True
        ),
        "to truth": DISTANCE.scalar(
            float(np.sqrt(fitted.to_truth)), "to the true surface", "truth", log=True
        ),
        "folds": FOLDS.scalar(100 * fitted.folded, "folded by over 90°", "wrong"),
    }


def _clouds(params: Params, classified: Classified, about: Clouds) -> dict[str, Primitive]:
    count = len(NAMES)
    plain, changed = shares_right(classified, about)
    scene: dict[str, Primitive] = {"plain": RIGHT.scalar(100 * plain, "as in training")}
    if changes_of(params):
        scene["changed"] = RIGHT.scalar(100 * changed, "changed", "wrong")
    critical = (
        classified.network.critical(about.changed[:count])
        if params.pool == "max"
        else [np.empty(0, int)] * count
    )
    for k, name in enumerate(NAMES):
        p = about.changed[k]
        x = GAP * (k - (count - 1) / 2)
        decides = np.isin(np.arange(len(p)), critical[k])
        color = Classes.marking(decides, "highlight", "critical", others=("target", "points"))
        right = said(classified, k) == name
        scene[f"clouds/{name}"] = Points(
            p + np.array([x, 0.0, 0.0]), color, 0.065, name="points" if k == 0 else ""
        )
        # in two rows: on a phone they would lie on each other
        at = np.array([x, 0.0, 1.5 + 0.65 * (k % 2)])
        scene[f"said/{name}"] = Label(
            name if right else f"{name} → {said(classified, k)}", at, "truth" if right else "wrong"
        )
    rows = []
    for k, name in enumerate(NAMES):
        of = about.of == k
        rows.append(
            (
                name,
                *(
                    percent(float((classified.scores[t][of].argmax(axis=1) == k).mean()), 0)
                    for t in classified.scores
                ),
            )
        )
    return scene | {
        "by class": Table(
            "Named rightly, by shape", ("shape", "as in training", "changed"), tuple(rows)
        )
    }


def _field(rebuilt: Reconstructed, about: Looks) -> dict[str, Primitive]:
    field = rebuilt.field
    cover = (1 - np.exp(-field.density / 15))[:, :, None]
    image = (255 * (cover * field.color + 1 - cover)).astype(np.uint8).swapaxes(0, 1)[::-1]
    places = np.column_stack(
        [flatland.DISTANCE * np.cos(about.angles), flatland.DISTANCE * np.sin(about.angles)]
    )
    d = flatland.rays_of(NEW_VIEW, PIXELS)[1]
    line = places[-1] + 0.5 * d
    discs = np.concatenate([segments(r * circle() + [x, y]) for x, y, r in flatland.DISCS])
    strips = np.repeat(
        np.stack([about.truth, np.ones_like(about.truth), about.image]), (STRIP, 1, STRIP), axis=0
    )
    return {
        "field": Picture(np.ascontiguousarray(image), "", 2.0, T_WORLD_FIELD),
        "discs": Segments(at_height(discs, 0.01), "truth", 2.0, name="true discs"),
        "cameras": Points(at_height(places[:-1]), "target", 0.05, name="cameras"),
        "new view": Points(at_height(places[-1:]), "source", 0.07, name="camera of the new view"),
        "inputs": Points(at_height(line), _bytes(about.image), 0.02, name="its pixels"),
        "ray": Segments(at_height(about.ray[None], 0.02), "highlight", 3.0, name="picked ray"),
        "ours": ALONG.curve(about.along, about.weights, "learned"),
        "true": ALONG.curve(about.along, about.true_weights, "true", "truth"),
        "view": Picture(_bytes(strips), "New view: true above, learned below"),
        "trained": MATCH.scalar(about.trained, "photographs"),
        "unseen": MATCH.scalar(about.unseen, "new views", "truth"),
    }


def _bytes(color: np.ndarray) -> np.ndarray:
    return np.rint(255 * np.clip(color, 0, 1)).astype(np.uint8)
