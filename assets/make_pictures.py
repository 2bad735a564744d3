"""Makes the README's pictures from the running page: `python -m assets.make_pictures [lesson ...]`, with a Chromium."""

import sys
from pathlib import Path

from tests.browser.chrome import started
from workbench.lesson import catalog
from workbench.viewer.server import Server

HERE = Path(__file__).parent / "pictures"
MOMENTS = {
    "page": "?lesson=icp&step=60",
    "icp": "?lesson=icp&step=8",
    "ransac": "?lesson=ransac&step=46",
    "chamfer_emd": "?lesson=chamfer_emd&step=10",
    "disparity": "?lesson=disparity&step=44",
}


def main(names: list[str]) -> None:
    """Take a picture of one whole page, and of every lesson's scene at a step worth seeing."""
    HERE.mkdir(exist_ok=True)
    server = Server()
    with started() as browser:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        for name in names or ["page", *catalog()]:
            page.goto(server.address + "/" + MOMENTS.get(name, f"?lesson={name}"))
            page.frame_locator("#scene iframe").locator("canvas[data-engine]").wait_for()
            page.wait_for_function("page.step()")
            page.wait_for_timeout(6000)  # until software rendering has drawn the last frame
            seen = page if name == "page" else page.locator("#view")
            seen.screenshot(path=HERE / f"{name}.jpg", type="jpeg", quality=80)
            print(HERE / f"{name}.jpg")
    server.stop()


if __name__ == "__main__":
    main(sys.argv[1:])
