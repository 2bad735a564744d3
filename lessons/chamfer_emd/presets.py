"""Experiments, each the picture of one misconception, and cameras."""

from lessons.chamfer_emd import blurred, bunch
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.panels import step_at
from workbench.lesson import Preset, Sweep, View

CLUMP = Input()
FLIP = Input(start="bunched", amount=0.8, points=140)
MISSING = Input(start="part missing", amount=0.5)
ONE_WAY = Input(start="part missing", amount=0.5, lowers="source to target")
OUTLIER = Input(start="one outlier", amount=1.0)
TWELVE = Input(stage="twelve")
ROWS = Input(stage="twelve", shuffled=True)
BUNCH = Input(stage="bunch", points=140)
FAR_DOT = Input(stage="far dot")
BLUR = Input(stage="blur")

VIEW = View(eye=(0.0, -4.9, -0.4), target=(0.0, 0.0, -0.4), grid=None, axes=False)
LEFT = View(eye=(-1.25, -3.4, 0.1), target=(-1.25, 0.0, 0.1), grid=None, axes=False)
PAIR = View(eye=(0.0, -4.3, 0.12), target=(0.0, 0.0, 0.12), grid=None, axes=False)
ABOVE = View(eye=(1.35, 0.0, 4.3), target=(1.35, 0.0, 0.0), grid=None, axes=False)
RAY = View(eye=(1.1, -5.2, 0.9), target=(1.1, 0.0, 0.9), grid=None, axes=False)
VIEWS = {"left": LEFT, "pair": PAIR, "above": ABOVE, "ray": RAY}

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="clump",
        title="One blob, two flows",
        line=(
            "Both flows leave from one blob, each down its own distance. Where will the "
            "points be when their number has become small? See the bars, and the mass out of place."
        ),
        params=CLUMP,
    ),
    Preset(
        name="flip",
        title="Bunched against 5 % larger",
        line=(
            "80 % of the points in one bunch, some everywhere. The lowest table says what the"
            " ring 5 % larger costs: which cloud is closer, and by which number?"
        ),
        params=FLIP,
        step=6,
    ),
    Preset(
        name="larger",
        title="5 % larger",
        line=(
            "Every point is 5 cm off: 2 × 0.05² = 0.0050 m² by Chamfer, 0.05 m by EMD. "
            "Squares make small distances look tiny."
        ),
        params=Input(start="larger", amount=0.05, points=140),
        step=0,
    ),
    Preset(
        name="bump",
        title="Equal Chamfer, another shape",
        line=(
            "A bump of 14.7 cm on an eighth of the ring has the Chamfer distance of the ring "
            "5 % larger, 0.0050 m²; but EMD 0.019 against 0.05 m, Hausdorff 0.147 against "
            "0.05 m."
        ),
        params=Input(start="bump", amount=0.147, points=140),
        step=0,
    ),
    Preset(
        name="missing",
        title="A part is missing",
        line=(
            "The source has only the left half of the target, twice. The table has both sides"
            " of Chamfer: which of them sees what is missing?"
        ),
        params=MISSING,
        step=4,
    ),
    Preset(
        name="outlier",
        title="One far outlier",
        line=(
            "One point of 80 is 1 m off, the others are at home. Compare each number with "
            "what it says of the ring 5 % larger (lowest table)."
        ),
        params=OUTLIER,
        step=0,
    ),
    Preset(
        name="shuffled",
        title="Rows in another order",
        line=(
            "The same points, and only their rows are in another order. Compare all numbers of the "
            "table."
        ),
        params=Input(start="shuffled rows", amount=1.0),
        step=0,
    ),
    Preset(
        name="doubled",
        title="Chamfer 0, clouds different",
        line=(
            "The left half of the points counts twice. Chamfer and Hausdorff are 0, EMD is "
            "0.21 m: a distance that is 0 between different clouds is no metric."
        ),
        params=Input(start="doubled points", amount=0.5),
        step=0,
    ),
    Preset(
        name="idle",
        title="Nearest to no place",
        line=(
            "The left flow lowers only target to source. Where it comes to rest, 71 of 80 "
            "points (vermillion) are nearest to no target point, and nothing pulls them; the "
            "others serve all 80."
        ),
        params=Input(lowers="target to source"),
        step=-1,
    ),
    Preset(
        name="blurred",
        title="Fast EMD is not exact",
        line=(
            "At the start Sinkhorn with a blur of 0.5 m says 0.99 m where EMD is 0.81 m. Go on to "
            "the end: its zero is not zero."
        ),
        params=Input(blur=0.5),
        step=0,
    ),
    Preset(
        name="unequal",
        title="40 points against 80",
        line=(
            "Exact EMD splits masses: nearly every source point ends midway between the two "
            "target points it serves, 0.04 m from both. One-to-one pairs would leave 40 "
            "points out."
        ),
        params=Input(source_points=40),
        step=-1,
    ),
    Preset(
        name="sphere",
        title="The same on a sphere",
        line=(
            "On a surface too: compare the mass that each flow leaves out of place, and turn the "
            "spheres to see where it is missing."
        ),
        params=Input(shape="sphere", points=140),
        step=-1,
    ),
    Preset(
        name="twelve",
        title="Twelve dots",
        line=(
            "Twelve dots on twelve places, and ever more of them heaped on the first one: two"
            " rules, two numbers."
        ),
        params=TWELVE,
        step=4,
        view=ABOVE,
    ),
    Preset(
        name="bunch",
        title="Ever more in a bunch",
        line=(
            "The share of the points in one bunch grows from step to step. When is the ring 5"
            " % larger closer?"
        ),
        params=BUNCH,
        step=step_at(bunch.SHARES, 0.4),
        view=PAIR,
    ),
    Preset(
        name="far-dot",
        title="One dot leaves the ring",
        line=(
            "One dot of 80 goes ever farther away. Each bar is one number, in units of what "
            "it says of the ring 5 % larger."
        ),
        params=FAR_DOT,
        step=0,
        view=RAY,
    ),
    Preset(
        name="blur",
        title="Ever more blur",
        line=(
            "Sinkhorn's plan for a blob, and for a cloud that is almost at home. Watch the "
            "threads become felt."
        ),
        params=BLUR,
        step=step_at(blurred.BLURS, 0.05),
        view=PAIR,
    ),
    Preset(
        name="one-way",
        title="Only dots to places",
        line=(
            "Half of the ring has no dots, and only the side from source to target is lowered. "
            "See what the flow does."
        ),
        params=ONE_WAY,
        step=-1,
    ),
    Preset(
        name="back",
        title="Only places to dots",
        line=(
            "Half of the ring has no dots, and only the side from target to source is lowered: "
            "the missing half is filled."
        ),
        params=Input(start="part missing", amount=0.5, lowers="target to source"),
        step=-1,
    ),
)

SWEEPS = (Sweep("amount", (0.1, 0.3, 0.5, 1.0)),)
