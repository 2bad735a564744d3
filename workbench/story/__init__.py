"""The story of a lesson: what page.md tells, scene by scene, and what the stage shows beside the
words.
"""

from workbench.story.data import story_data
from workbench.story.model import StagePlace, StepName, Story, TextScene, Value
from workbench.story.reading import ASKED, bench_text, has_story, plain_text, story_of

__all__ = [
    "ASKED",
    "StagePlace",
    "StepName",
    "Story",
    "TextScene",
    "Value",
    "bench_text",
    "has_story",
    "plain_text",
    "story_data",
    "story_of",
]
