"""Makes the README's pictures from the running page: `python -m assets.make_pictures [lesson ...]`, with a Chromium."""

import sys
from pathlib import Path

from tests.browser.chrome import started
from workbench.lesson import catalog

HERE = Path(__file__).parent / "pictures"
HIDE = ".mantine-Notifications-root{display:none!important}"
SCENE = {"x": 381, "y": 0, "width": 702, "height": 662}  # without the panels around it
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
    app = Server()
    with started() as browser:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        for name in names or ["page", *catalog()]:
            page.goto(app.address + "/" + MOMENTS.get(name, f"?lesson={name}"))
            page.wait_for_selector("canvas[data-engine]")
            page.wait_for_selector(".wb-caption")
            page.add_style_tag(content=HIDE)
            page.wait_for_timeout(6000)  # until software rendering has drawn the last frame
            page.screenshot(
                path=HERE / f"{name}.jpg",
                type="jpeg",
                quality=80,
                clip=None if name == "page" else SCENE,  # type: ignore
            )
            print(HERE / f"{name}.jpg")
    app.stop()


if __name__ == "__main__":
    main(sys.argv[1:])
