"""What the tests of Gradescope and PrairieLearn share: a Python as bare as a service has, and what
holds a document to its schema.
"""

import os
import sys
from pathlib import Path

import numpy
import PIL
import pytest
import scipy

WRONG = "def invert_rigid(T):\n    print('seen', T.shape)\n    return T.T\n"


def conforms(document: object, schema: dict) -> None:
    """Hold a document to its schema."""
    import jsonschema  # takes seconds, which every worker would spend

    jsonschema.validate(document, schema)


@pytest.fixture(scope="module", name="bare")
def bare_python(tmp_path_factory) -> str:
    """Return a Python that has what a service installs, numpy and scipy, and Pillow, and nothing
    else.
    """
    folder = tmp_path_factory.mktemp("bare")
    for package in (numpy, scipy, PIL):
        place = Path(package.__path__[0])
        for name in (place.name, f"{place.name.lower().replace('pil', 'pillow')}.libs"):
            if (place.parent / name).exists():
                (folder / name).symlink_to(place.parent / name)
    script = folder / "python"
    script.write_text(
        f'#!/bin/sh\nPYTHONPATH="$PYTHONPATH:{folder}" exec {os.path.realpath(sys.executable)} -S'
        ' "$@"\n'
    )
    script.chmod(0o755)
    return str(script)
