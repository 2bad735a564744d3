"""What the page's scripts are told of a story: plain data beside its HTML."""

import math
from typing import Any

from workbench.lesson import Lesson, View
from workbench.story.model import Story
from workbench.story.names import views_of


def story_data(lesson: Lesson, story: Story) -> dict[str, Any]:
    """Return a story as plain data: scenes and what the stage shows with them, cameras, and
    where questions start.
    """
    views = views_of(lesson)
    named = {place.view for scene in story.scenes for place in scene.beats} - {""}
    own = set(lesson.views)
    presets = {preset.name for preset in lesson.presets if preset.view is not None}
    return {
        "title": story.title,
        "chapter": lesson.chapter,
        "minutes": lesson.minutes,
        "scenes": [
            {
                "name": scene.name,
                "title": scene.title,
                "beats": [place.data() for place in scene.beats],
            }
            for scene in story.scenes
        ],
        "views": {
            name: view_data(views[name]) for name in sorted(named | own | presets | {"default"})
        },
        "starts": {
            name: place.data() | {"seen": seen.data()}
            for name, (place, seen) in story.starts.items()
        },
        "places": {},
    }


def view_data(view: View) -> dict[str, Any]:
    """Return a camera as the page sets it: where its eye is and what it looks at, metres, and
    its angle, radians.
    """
    return {
        "eye": [round(float(x), 6) for x in view.seen_from()],
        "target": list(view.target),
        "up": list(view.up),
        "fov": round(math.radians(view.fov_degrees), 6),
    }
