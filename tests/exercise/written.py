"""Hands in a file `my_centroid.py` with a body that a test gives; points to call it with."""

import textwrap

import numpy as np

from workbench.exercise.sandbox import SandboxedFunction

POINTS = np.arange(12.0).reshape(4, 3)


def written(folder, body: str, head: str = "") -> SandboxedFunction:
    path = folder / "my_centroid.py"
    code = (
        f"import numpy as np\n{head}\ndef"
        f" centroid(p):\n{textwrap.indent(textwrap.dedent(body), '    ')}\n"
    )
    path.write_text(code, encoding="utf-8")
    return SandboxedFunction(path, "centroid", seconds=1.0)
