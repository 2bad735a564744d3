"""A picture of the first step at which a student's run leaves ours, drawn without a browser."""

import base64
import io

from workbench.exercise.failing import failing_run
from workbench.exercise.marking import read_one
from workbench.exercise.model import Exercise
from workbench.exercise.sandbox import SandboxedFunction, Wall
from workbench.exercise.submissions import HandIn
from workbench.scene import caption_of

SIZE = 640, 400


def pictured(exercise: Exercise, handed: HandIn, file: str, *, wall: Wall) -> list[dict[str, str]]:
    """Return a picture of the failing case as a label and a data URL; none where the lesson's run
    shows none.

    Args:
        exercise: What the file is for.
        handed: What the student handed in.
        file: The file in it that was graded.
        wall: What shuts the student's process in.
    """
    try:
        from PIL import Image

        from workbench.page.thumbnail import drawn
    except ImportError:  # drawing is more than grading needs
        return []
    with SandboxedFunction(
        read_one(handed, file), exercise.name, seconds=exercise.contract.seconds, wall=wall
    ) as student:
        failing = failing_run(exercise, student)
        if failing is None:
            return []
        timeline, at = failing
        scene = timeline[at].scene
    picture = drawn(scene, timeline.lesson.view, SIZE)
    sheet = Image.new("RGB", SIZE, "white")
    sheet.paste(picture, mask=picture.getchannel("A"))
    out = io.BytesIO()
    sheet.save(out, "PNG", optimize=True)
    label = f"Step {at} of lesson {exercise.lesson}: {caption_of(scene).text}"
    return [
        {
            "label": label,
            "url": "data:image/png;base64," + base64.b64encode(out.getvalue()).decode(),
        }
    ]
