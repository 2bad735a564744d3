"""Runs to begin with."""

from dataclasses import replace

from lessons.distances.state import Params
from workbench.lesson import Preset, View

VIEW = View(eye=(0.0, 0.0, 1.5), target=(0.0, 0.0, 0.0), grid=None, axes=False)
PLANE = View(eye=(0.0, 0.0, 3.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
AHEAD = View(eye=(0.0, 0.0, 4.5), target=(0.0, 0.0, 0.0), grid=None, axes=False)
CLOUD = View(eye=(0.0, 0.0, 9.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
BALL = View(eye=(1.1, -2.4, 1.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
RABBIT = View(eye=(0.82, -1.5, 0.75), target=(0.0, 0.0, 0.15), grid=None, axes=False)
ROLL = View(eye=(0.9, -2.4, 2.4), target=(0.0, 0.0, 0.0), grid=None, axes=False)

TOLD = 4  # the step of a scatter that tells who lies far out
ERRORS = 11  # the step of ways along edges that holds them against the truth
HALF = Params(stage="axioms", metric="p")
WHITEN = Params(stage="whiten", points=400)
MASKING = Params(stage="whiten", points=200, outliers=40)
SPHERE = Params(stage="surface", points=1000)
HEAT = Params(stage="surface", shape="rabbit", method="heat")
LATE = Params(stage="surface", shape="rabbit", method="heat", time=2.0)
WRUNG = Params(stage="surface", shape="wrung sphere", points=1000, method="heat")
SHORTCUT = Params(stage="roll", points=2000, k=20)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "taxi",
        "Along streets only",
        "Manhattan's ball is a square on its corner. It touches point 10 first, Euclid's disc point"
        " 18. At the end 13 % of the queries are red: theirs is another too.",
        Params(stage="balls", metric="manhattan", source=28),
        4,
        PLANE,
    ),
    Preset(
        "units",
        "x in metres, y in millimetres",
        "Euclid's distance adds what has different units: now y alone decides. At the end 80 % of"
        " the queries are red, with another nearest point.",
        Params(stage="balls", stretch=1000),
        4,
        PLANE,
    ),
    Preset(
        "cosine-axioms",
        "One minus the cosine",
        "Points on one ray are at distance 0, and in 32 % of the triples the way over b is shorter"
        " than the straight one.",
        Params(stage="axioms", metric="cosine"),
        -1,
        PLANE,
        breaks=True,
    ),
    Preset(
        "half",
        "An exponent below one",
        "With p = ½ a detour is shorter in 15 % of the triples: the ball is a star, not convex.",
        HALF,
        -1,
        PLANE,
        breaks=True,
    ),
    Preset(
        "whiten",
        "A scatter made round",
        "Centre, turn, scale: Mahalanobis' distance is Euclid's after that. Step on and watch the"
        " ellipse.",
        WHITEN,
        0,
        CLOUD,
    ),
    Preset(
        "masking",
        "Outliers hide themselves",
        "Forty points lie off to one side. They are part of the covariance that should tell them,"
        " and are only 2.15 standard deviations away.",
        MASKING,
        TOLD,
        CLOUD,
        breaks=True,
    ),
    Preset(
        "robust",
        "The half that lies closest",
        "The covariance of the half with the smallest determinant: the second cluster lies 9.2"
        " standard deviations out.",
        replace(MASKING, estimate="robust"),
        TOLD,
        CLOUD,
    ),
    Preset(
        "stereo",
        "Which landmark was it?",
        "A stereo camera, 4 to 6 m away, measures depth far worse than what lies across: Euclid's"
        " nearest is right for 54 %, Mahalanobis' for 94 %.",
        Params(stage="stereo"),
        -1,
        AHEAD,
    ),
    Preset(
        "staircase",
        "Up and across only",
        "Four neighbours: every way is as long as along streets, up to 41 % too long, and the front"
        " is a square on its corner.",
        Params(neighbours="4", grid=31),
        6,
        breaks=True,
    ),
    Preset(
        "marching",
        "Fast marching",
        "Each node takes its distance from two neighbours at once, as if a straight front came by."
        " On this grid that is 10 % off at worst, on one twice as fine 6 %.",
        Params(neighbours="march"),
        6,
    ),
    Preset(
        "disc",
        "Exact near the source",
        "The front is most curved at the source. Exact distances in a small disc mend the rest"
        " too.",
        Params(neighbours="march", wall=0.0, disc=0.1),
        6,
    ),
    Preset(
        "sphere",
        "Along the edges of a sphere",
        "The purple way zigzags, the green one is a great circle. Ways along edges are 6.2 % too"
        " long on average, 16 % at worst.",
        SPHERE,
        ERRORS,
        BALL,
        breaks=True,
    ),
    Preset(
        "jitter",
        "A less regular mesh",
        "Every vertex of the sphere is moved a little, edges point everywhere. The worst way is"
        " still 14 % too long, where it was 16 %.",
        replace(SPHERE, jitter=0.2),
        -1,
        BALL,
        breaks=True,
    ),
    Preset(
        "points",
        "Points on the edges",
        "With three points on every edge ways may cross the faces: 0.9 % off at worst. Look at the"
        " end: on finer spheres that does not fall.",
        Params(stage="surface", points=1000, extra=3),
        ERRORS,
        BALL,
    ),
    Preset(
        "heat",
        "Distance by heat",
        "Heat flows for a moment. Its size falls by many powers of ten, but its direction is all"
        " that is kept.",
        HEAT,
        1,
        RABBIT,
    ),
    Preset(
        "no-metric",
        "There and back by heat",
        "A distance by heat is no metric: there and back differ by 1.4 % in the median and 17 % at"
        " most, and 1.5 % of the detours are shorter.",
        HEAT,
        -1,
        RABBIT,
        breaks=True,
    ),
    Preset(
        "early",
        "Heat for too short a time",
        "A hundredth of the time: heat counts edges instead of lengths, and distances come out 26 %"
        " too short.",
        Params(stage="surface", shape="rabbit", method="heat", time=-2.0),
        3,
        RABBIT,
        breaks=True,
    ),
    Preset(
        "flattered",
        "A sphere flatters",
        "Heat for a hundred times as long, on a sphere: here it is no worse, 1.2 % off in place of"
        " 1.4 %. Never choose the time on a sphere.",
        Params(stage="surface", method="heat", time=2.0),
        -1,
        BALL,
    ),
    Preset(
        "wrung",
        "Obtuse triangles",
        "A sphere wrung about its axis: 848 of its 3,000 edges have negative weights, and distances"
        " by heat are 20 % off.",
        WRUNG,
        3,
        BALL,
        breaks=True,
    ),
    Preset(
        "delaunay",
        "The same sphere, edges flipped",
        "Edges are flipped within the surface until no weight is negative. No vertex moves, and"
        " heat is 1.5 % off.",
        replace(WRUNG, delaunay=True),
        3,
        BALL,
    ),
    Preset(
        "roll",
        "Along a roll",
        "Joined to its 15 nearest, a point has its neighbours on the sheet. The way round is 6.4 m,"
        " straight through it would be 1.9 m.",
        Params(stage="roll", points=2000),
        ERRORS,
        ROLL,
    ),
)
