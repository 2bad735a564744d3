"""What lessons of before had is found where it is now: links, commands, recordings, calls; their
tables are of 39b9198.
"""

import pytest

from workbench.knobs import fields_of, make
from workbench.lesson import catalog
from workbench.moved import MOVES, moved, runs_led_on
from workbench.run import links

# the presets and questions of the lessons at 39b9198 that are split since
BEFORE = {
    "alignment": (
        (
            "home signs fresh box vase nearly cube density part stray far pairs mirrored wrong-flip"
            " negated flat scale scale-clean"
        ),
        "predict-rotations predict-frames predict-signs predict-negated predict-product",
    ),
    "transforms": (
        (
            "order gimbal conventions fixed-own mirror shear perspective transpose inverse"
            " hidden-scale xyzw direction minus-q one-axis wobble average entries screw"
        ),
        "which-order lost-direction sheared-volume mean-heading mean-matrix",
    ),
    "icp": (
        (
            "home far plane symmetric slide overlap-fixed overlap-adaptive overlap-tight outliers"
            " outliers-trimmed rings-chance rings-voxel rings-spread"
        ),
        "predict-matches predict-far predict-plane predict-vase",
    ),
}
PRESETS = [
    (lesson, preset) for lesson, (presets, _) in BEFORE.items() for preset in presets.split()
]
QUESTIONS = [
    (lesson, name) for lesson, (_, questions) in BEFORE.items() for name in questions.split()
]


@pytest.mark.parametrize(("lesson", "preset"), PRESETS)
def test_every_preset_of_before_is_opened_by_its_link(lesson, preset):
    place = links.read(f"?lesson={lesson}&preset={preset}")
    assert place is not None
    led = moved(lesson, preset, {})
    assert place.lesson.name == led.lesson
    assert place.params == place.lesson.preset(led.preset or "").params


@pytest.mark.parametrize(("lesson", "question"), QUESTIONS)
def test_every_question_of_before_is_asked_somewhere(lesson, question):
    places = {
        move.to: move.questions[question]
        for move in MOVES
        if move.lesson == lesson and question in move.questions
    }
    (to, name), *more = places.items() or {lesson: question}.items()
    assert not more
    assert name in {asked.name for asked in catalog()[to].questions}


def test_params_of_the_stage_of_pairs_open_the_lesson_of_pairs():
    place = links.read("?lesson=alignment&stage=pairs&scale=1.5&step=3")
    assert place is not None
    assert (place.lesson.name, place.step) == ("pairs", 3)
    assert (place.params.scale, place.params.noise) == (1.5, 0.0), "its noise was none by default"


@pytest.mark.parametrize(
    ("words", "stage"),
    [
        ("half=move%20between%20two%20poses&method=screw&steps=20", "poses"),
        ("compare=transpose&angles=0,0,40&scale=1,1,1", "readings"),
        ("compare=other%20triples&half=build%20a%20map", "readings"),
    ],
)
def test_params_about_rotations_open_the_lesson_of_rotations(words, stage):
    place = links.read(f"?lesson=transforms&{words}")
    assert place is not None
    assert (place.lesson.name, place.params.stage) == ("rotations", stage)


def test_params_of_a_map_stay_with_transforms():
    place = links.read("?lesson=transforms&half=build%20a%20map&steps=30&shear=0.5&step=2")
    assert place is not None
    assert (place.lesson.name, place.params.shear, place.step) == ("transforms", 0.5, 2)
    turned = links.read("?lesson=transforms&angles=40,20,60")
    assert turned is not None
    assert turned.params.angles == (40.0, 20.0, 60.0)


def test_a_move_between_poses_is_understood_as_a_command(capsys, tmp_path):
    from workbench.cli import main

    out = tmp_path / "a.rrd"
    half = ["--half", "move between two poses", "--method", "Euler angles", "--steps", "5"]
    assert main(["record", "transforms", *half, "-o", str(out)]) == 0, capsys.readouterr().err
    import workbench

    recording = workbench.open_recording(out)
    assert (recording.lesson, recording.params["method"]) == ("rotations", "Euler angles")


def test_params_of_the_axes_stay():
    place = links.read("?lesson=alignment&stage=axes&noise=0.05&scale=1")
    assert place is not None
    assert (place.lesson.name, place.params.noise) == ("axes", 0.05)


@pytest.mark.parametrize("move", MOVES, ids=lambda move: f"{move.lesson}-{move.to}")
def test_a_move_names_what_there_is(move):
    new = catalog()[move.to]
    assert set(move.presets.values()) <= {preset.name for preset in new.presets}
    fields = {field.name for field in fields_of(new.params)}
    assert set(move.base) <= fields
    assert make(new.params, dict(move.base))
    stays = any(other.lesson == other.to == move.lesson for other in MOVES)
    assert (move.lesson in catalog()) == stays
    led_on = runs_led_on(move.lesson)
    assert all(led_on[old] == (move.to, name) for old, name in move.presets.items())


def test_commands_of_before_are_understood(capsys, tmp_path):
    from workbench.cli import main

    out = tmp_path / "a.rrd"
    words = [
        "record",
        "alignment",
        "--stage",
        "pairs",
        "--points",
        "200",
        "--signs=none",
        "-o",
        str(out),
    ]
    assert main(words) == 0, capsys.readouterr().err
    import workbench

    recording = workbench.open_recording(out)
    assert (recording.lesson, recording.params["points"], recording.params["noise"]) == (
        "pairs",
        200,
        0,
    )


def test_calls_of_before_are_understood(tmp_path):
    import workbench

    path = workbench.record("alignment", tmp_path / "a.rrd", preset="mirrored", points=200)
    recording = workbench.open_recording(path)
    assert (recording.lesson, recording.params["mirrored"]) == ("pairs", True)
    shown = workbench.replay("alignment", stage="pairs", points=200, steps=1)
    assert shown.lesson.name == "pairs"


def test_a_recording_of_before_is_reopened(tmp_path, monkeypatch):
    import workbench
    from workbench.recording import read

    path = workbench.record("alignment", tmp_path / "a.rrd", points=200)
    old = workbench.open_recording(path)
    params = {
        **old.params,
        "stage": "pairs",
        "mirrored": True,
        "flip": "least",
        "scale": 1.0,
        "noise": 0.02,
    }
    monkeypatch.setattr(read, "open_recording", lambda path: _with(old, params))
    lesson, reopened, lines = read.reopening(path)
    assert lesson.name == "pairs"
    assert (reopened.mirrored, reopened.noise, reopened.points) == (True, 0.02, 200)
    assert any("is one of the lesson pairs now" in line for line in lines)


def _with(recording, params):
    from dataclasses import replace

    return replace(recording, lesson="alignment", params=params)
