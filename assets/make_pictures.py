"""Makes the pictures of the README and the front door by `workbench picture`, without a browser:
`python -m assets.make_pictures [name ...]`.
"""

import shlex
import sys
from pathlib import Path

from workbench.cli import main as command
from workbench.lesson import catalog

HERE = Path(__file__).parent / "pictures"
STATIC = Path(__file__).parents[1] / "workbench" / "page" / "static"
STEPS = {"icp": 60, "ransac": 46, "chamfer_emd": 10, "disparity": 44, "features": 6}
"""The step of a lesson's picture, where it is not the one that tells most."""
FRONT = "icp --preset from-45 --width 400 --no-chart --captions none"
LOOPS = {
    "loop.webp": "icp --preset from-45 --seconds 10 --width 640",
    "front-loop.webp": f"{FRONT} --to 24 --seconds 6",
    "front-still.webp": f"{FRONT} --step 8",
    "front-loop-dark.webp": f"{FRONT} --to 24 --seconds 6 --dark",
    "front-still-dark.webp": f"{FRONT} --step 8 --dark",
}
"""What `workbench picture` is told of the loops, but for the file."""


def main(names: list[str]) -> int:
    """Make the pictures of these names, or all of them."""
    HERE.mkdir(exist_ok=True)
    told = {name: shlex.split(words) for name, words in LOOPS.items()}
    for name in catalog():
        step = ["--step", str(STEPS[name])] if name in STEPS else []
        bare = ["--width", "560", "--no-chart", "--captions", "none"]
        told[f"{name}.webp"] = [name, *step, *bare]
    for name in names or told:
        file = name if name.endswith(".webp") else f"{name}.webp"
        place = (STATIC if file.startswith("front-") else HERE) / file
        code = command(["picture", *told[file], "--force", "-o", str(place)])
        if code:
            return code
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
