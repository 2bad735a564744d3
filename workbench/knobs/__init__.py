"""Knobs: what a Params field says of itself, from which panels, command flags and links are
generated.

A class of inputs is a subclass of `Params` whose fields are `name: type = knob(default, "hint",
...)`. Types: `float`, `int`, `bool`, `Literal[...]` of strings, `tuple` of a fixed number of floats
or ints, `Path | None`. Lessons of the first form have a frozen dataclass in its place, whose fields
are `Annotated[type, Knob(...)]`.
"""

from workbench.knobs.declaring import Gizmo, Knob, Params, Pick, knob
from workbench.knobs.fields import Kind, ParamField, fields_of
from workbench.knobs.naming import called, called_by_flags, in_words
from workbench.knobs.own_files import names_files, paths_of, showing, with_own_files
from workbench.knobs.values import changed, from_json, make, only, text_of, to_json, validated

__all__ = [
    "Gizmo",
    "Kind",
    "Knob",
    "ParamField",
    "Params",
    "Pick",
    "called",
    "called_by_flags",
    "changed",
    "fields_of",
    "from_json",
    "in_words",
    "knob",
    "make",
    "names_files",
    "only",
    "paths_of",
    "showing",
    "text_of",
    "to_json",
    "validated",
    "with_own_files",
]
