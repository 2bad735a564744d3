"""Makes the README's pictures from the running page: `python assets/make_pictures.py [lesson ...]`, with a Chromium."""

import sys
from pathlib import Path

from tests.browser.chrome import started
from workbench.lesson import catalog
from workbench.viewer.app import App

HERE = Path(__file__).parent / "pictures"
HIDE = ".mantine-Notifications-root{display:none!important}"
MOMENTS = {"icp": "?lesson=icp&step=60", "course": ""}


def main(names: list[str]) -> None:
    """Take a picture of the course and of every lesson at a step worth seeing."""
    HERE.mkdir(exist_ok=True)
    app = App(port=0)
    with started() as browser:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        for name in names or ["course", *catalog()]:
            page.goto(app.address + "/" + MOMENTS.get(name, f"?lesson={name}"))
            page.wait_for_selector("canvas[data-engine]")
            page.wait_for_selector(".wb-caption" if name != "course" else ".wb-card")
            page.add_style_tag(content=HIDE)
            page.wait_for_timeout(6000)  # until software rendering has drawn the last frame
            page.screenshot(path=HERE / f"{name}.jpg", type="jpeg", quality=82)
            print(HERE / f"{name}.jpg")
    app.stop()


if __name__ == "__main__":
    main(sys.argv[1:])
