"""What is changed in the code of a lesson that holds, one place at a time: the file, what stands
there, what is put there, and what validating says of it (None: nothing; line N: any line).
"""

LESSON, DRAW, STATE, RUNS = "lesson.py", "draw.py", "state.py", "presets.py"

# the default run
RUN = [
    (
        LESSON,
        "    yield State(0, p, circle)\n",
        "    yield State(0, p, circle)\n    yield 1 / 0\n",
        "line N: ZeroDivisionError",
    ),
    (
        LESSON,
        "    rng = np",
        "    return\n    rng = np",
        "circle/lesson.py, line N: run ended without a step",
    ),
    (
        LESSON,
        "    rng = np",
        "    yield State(0, np.ones((2, 2)), np.ones(3))\n    return\n    rng = np",
        "has 1 step",
    ),
    (
        LESSON,
        "order=900",
        "order=900, first_step=70",
        "lesson circle opens at step 70, but its run has 5 steps",
    ),
    (
        LESSON,
        "default_rng(params.seed)",
        "default_rng()",
        "; take all chance from np.random.default_rng(params.seed)",
    ),
    (
        LESSON,
        "run=run,",
        "run=lambda params, **slots: [1],",
        "run returned a list; it is a generator",
    ),
    (
        LESSON,
        "run=run,",
        "run=lambda params, **slots: None,",
        "run returned None; it is a generator",
    ),
    (LESSON, "params: Params, *, fit", "params: Params, points, *, fit", "line N: run(params: "),
    (
        LESSON,
        "params: Params, *, fit",
        "params: Params, fit",
        "line N: run takes 'fit_circle'; beside params",
    ),
    (
        LESSON,
        "run=run,",
        "run=lambda p, fit_circle=fit_circle: run(p, fit_circle=fit_circle),",
        "calls its first argument 'p'",
    ),
    (LESSON, 'name="circle"', 'name="a circle"', "a lesson's name is letters, digits"),
    (LESSON, 'Path(__file__).with_name("page.md")', '"page.md"', "page is a Path, not 'page.md'"),
]

# what is drawn
DRAWN = [
    (
        DRAW,
        "    return {",
        "    return None\n    return {",
        "draw.py, line N: draw returned None; it returns a",
    ),
    (
        DRAW,
        "    return {",
        "    return [1]\n    return {",
        "draw.py, line N: draw returned a list",
    ),
    (
        DRAW,
        '"caption": Caption(',
        '"a/b": "text", "caption": Caption(',
        "the scene holds a str at 'a/b'",
    ),
    (
        DRAW,
        '"caption": Caption(',
        '"a/b": state.p, "caption": Caption(',
        "the scene holds a ndarray at 'a/b'",
    ),
    (DRAW, "Points(in_space(state.p)", "Points([[0, 0, 0]]", "Points.p is an array"),
    (
        DRAW,
        "Scalar(state.rms",
        "Scalar('0.5'",
        "draw.py, line N: ValueError: Scalar.value is one real number",
    ),
    (
        DRAW,
        '"points": Points(',
        '"points": Axes() if state.k == 2 else Points(',
        "step 2: 'points' is of the kind Axes now, and was of the kind Points",
    ),
    (
        DRAW,
        'Caption(f"{said};',
        "Caption('Short.') if state.k == 1 else Caption(f\"{said};",
        "step 1: the caption 'Short.' has 6",
    ),
    (
        DRAW,
        '"rms": Scalar(',
        '"c": Curve(np.arange(3.0), np.arange(4.0), "a", "b", "c"), "rms": Scalar(',
        "Curve.x and y",
    ),
    (
        DRAW,
        '"rms": Scalar(',
        '"t": Table("Map", ("a",), ((0.5,),)), "rms": Scalar(',
        "each cell of the Table 'Map' is a text",
    ),
    (
        DRAW,
        "    return {",
        '    return {"caption": Caption("A long caption")}\n    return {',
        "step 0 shows nothing in space",
    ),
    (
        DRAW,
        "    return {",
        '    return {"points": Points(in_space(state.p))}\n    return {',
        "needs a Caption",
    ),
    (
        DRAW,
        'Caption(f"{said};',
        'Caption("Something") or Caption(f"{said};',
        "every step has the caption 'Something'",
    ),
    (
        LESSON,
        "run=run,",
        (
            "run=lambda params, *, fit_circle=fit_circle: iter([State(k, np.eye(2), TRUE) for k in"
            " (0, 1)]),"
        ),
        "step 0 has no line to show",
    ),
]

# knobs, presets, questions
DECLARED = [
    (
        STATE,
        'points: Annotated[int, Knob("How many points are measured", 5, 200)]',
        'points: Annotated[int, Knob("How many points are measured", 0, 200)]',
        "(at points = 0)",
    ),
    (
        STATE,
        "seed: Annotated",
        "step: Annotated[int, Knob('Steps', 0, 9)] = 1\n    seed: Annotated",
        "Params.step: commands use",
    ),
    (
        STATE,
        'Knob("Which noise is drawn", 0, 99)',
        'Knob("Which noise", 0, 99, by=Pick("cloud"))',
        "Params.seed is picked at 'cloud'",
    ),
    (
        STATE,
        'seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0',
        "seed: Annotated[tuple[int, int], Knob('A', 0, 9, by=Gizmo())] = (0, 0)",
        "Params.seed: a Gizmo sets 2 floats",
    ),
    (
        STATE,
        'seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0',
        (
            'seed: Annotated[int, Knob("Which", 0, 99, needs={"b": (True,)})] = 0\n    b:'
            ' Annotated[bool, Knob("B")] = True'
        ),
        "seed = 99 changes 'points' although its needs are not met, at {'b': 'False'}",
    ),
    (
        STATE,
        'Knob("Which noise is drawn", 0, 99)',
        'Knob("Which noise", 0, 99, needs={"mood": ("calm",)})',
        "seed needs 'mood', which is no choice or switch of this lesson",
    ),
    (
        RUNS,
        "Params(arc=60.0)",
        "Params(arc=400.0)",
        "preset 'arc': arc = 400: a number from 20 to 360 deg",
    ),
    (
        RUNS,
        "        Params(),\n",
        "        Params(),\n        step=99,\n",
        "preset 'whole' opens at step 99, but its run has 5 steps",
    ),
    (RUNS, '"exact"', '"no noise"', "preset 'no noise': a name is letters"),
    (
        RUNS,
        "Points all around: both fits agree to a few millimetres.",
        "Short.",
        "preset 'whole': its line has 6 characters",
    ),
    (
        LESSON,
        "view=View(",
        "view=View(eye=(90, 0, 0), target=(99, 0, 0)) if True else View(",
        "step 0: out of its frame are",
    ),
    (
        RUNS,
        "states[0].circle[2],",
        "states[99].circle[2],",
        "question 'radius': circle/presets.py, line N",
    ),
    (RUNS, "states[0].circle[2],", "float('nan'),", "its answer is nan"),
    (RUNS, "tolerance=0.05", "tolerance=0.0", "question 'radius': its tolerance is 0"),
    (
        RUNS,
        "tolerance=0.05",
        "tolerance=0.05, wrong=((2.0, 1.0, 'The other way round.'),)",
        "wants a lowest number",
    ),
    (
        RUNS,
        "tolerance=0.05",
        "tolerance=0.05, wrong=((0.0, 9.0, 'All of them.'),)",
        "meets the right one",
    ),
    (RUNS, "states[0].error else 2", "states[0].error else 3", None),
    (
        RUNS,
        "lambda states: 0 if",
        "lambda states: 7 if",
        "question 'refined': circle/presets.py, line N: its answer is 7",
    ),
]
