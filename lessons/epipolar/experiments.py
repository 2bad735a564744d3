"""Presets and questions: what to look for, and why it happens."""

from lessons.epipolar.state import Params, State
from workbench.lesson import Preset, Question

HOME = Params()
PRESETS: tuple[Preset[Params], ...] = (
    Preset("home", "One point, one line", "Watch where the followed pixel can be in the other picture, depth by depth.", HOME, 0),
)
QUESTIONS: tuple[Question[Params, State], ...] = ()
