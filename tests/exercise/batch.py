"""A class's worth of submissions of the centroid exercise: right, wrong, hanging, crashing, and not
Python.
"""

from pathlib import Path

KINDS = {
    "right": "import numpy as np\ndef centroid(p):\n    return p.mean(axis=0)\n",
    "sum": "import numpy as np\ndef centroid(p):\n    return p.sum(axis=0)\n",
    "hang": "def centroid(p):\n    while True:\n        pass\n",
    "crash": "import os\ndef centroid(p):\n    os._exit(1)\n",
    "broken": "def centroid(p:\n",
}


def write_class(folder: Path, count: int) -> dict[str, str]:
    """Write `count` submissions, a tenth each hanging, crashing and broken; return the kind of each
    student's.
    """
    folder.mkdir(parents=True, exist_ok=True)
    cycle = ["right", "hang", "sum", "right", "crash", "sum", "broken", "right", "sum", "right"]
    kinds = {f"student{i:03d}": cycle[i % 10] for i in range(count)}
    for name, kind in kinds.items():
        (folder / f"{name}.py").write_text(KINDS[kind], encoding="utf-8")
    return kinds
