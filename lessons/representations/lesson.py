"""One object, many forms: each answers one question at once and pays elsewhere, all on one scale of
errors over bytes.

What it teaches: how a cloud, a mesh, bits, distances, an octree, a k-d tree, patches and a network
store a shape, what comes back of it, and by which law the error falls with the bytes; where each
form fails without a word.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from lessons.representations.draw import draw
from lessons.representations.forms import FORMS, BezierPatch, Functions, others
from lessons.representations.presets import PRESETS, QUESTIONS, VIEW
from lessons.representations.state import Params, State
from lessons.representations.subjects import BoxSdf, subject_of
from workbench.geometry import level_sets
from workbench.geometry.fields import signed_distances
from workbench.geometry.level_sets import EdgeCrossings
from workbench.geometry.shapes import bezier
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    box_sdf: BoxSdf = signed_distances.box_sdf,
    bezier_patch: BezierPatch = bezier.bezier_patch,
    edge_crossings: EdgeCrossings = level_sets.edge_crossings,
) -> Iterator[State]:
    """Yield one form, finer at each step, and in the end beside other forms."""
    functions = Functions(bezier_patch=bezier_patch, edge_crossings=edge_crossings)
    if params.form == "k-d tree":
        own = subject_of(params, box_sdf) if params.cloud else None
        yield from FORMS[params.form](params, own, functions)
        return
    shaped = (
        replace(params, shape="torus", mesh=None, cloud=None)
        if params.form == "patches"
        else params
    )
    subject = subject_of(shaped, box_sdf)
    state = None
    for state in FORMS[params.form](params, subject, functions):
        yield state
    if state is not None and (beside := others(shaped, subject)):
        yield replace(state, others=beside)


lesson = Lesson(
    name="representations",
    title="One object, many forms",
    summary="Points, triangles, voxels, a network: each way to store an object answers some "
    "questions at once.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1400,
    chapter="Measure",
    minutes=25,
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=5,
    opening=0,
    sweeps=(Sweep("form", ("cloud", "mesh", "voxels", "distances", "octree", "patches")),),
    telling="Error for its bytes",
)
