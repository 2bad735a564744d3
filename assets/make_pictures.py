"""Makes the README's pictures from the running page: `python -m assets.make_pictures [lesson ...]`,
with a Chromium.
"""

import io
import sys
from pathlib import Path
from typing import Any

from PIL import Image

from tests.browser.chrome import started
from workbench.lesson import catalog
from workbench.viewer.server import Server

HERE = Path(__file__).parent / "pictures"
MOMENTS = {
    "page": "?lesson=icp#match",
    "icp": "?lesson=icp&step=60",
    "ransac": "?lesson=ransac&step=46",
    "chamfer_emd": "?lesson=chamfer_emd&step=10",
    "disparity": "?lesson=disparity&step=44",
    "features": "?lesson=features&step=6",
}
WIDTHS = {"page": 1280}
USUAL_WIDTH = 560
LOOKS = 100  # how often a picture is looked at before it is given up


def main(names: list[str]) -> None:
    """Take a picture of one whole page, and of every lesson's scene at a step worth seeing."""
    HERE.mkdir(exist_ok=True)
    server = Server()
    try:
        with started() as browser:
            for name in names or ["page", *catalog()]:
                page = browser.new_page(
                    viewport={"width": 1440, "height": 900}, reduced_motion="reduce"
                )
                page.goto(f"{server.address}/{MOMENTS.get(name, f'?lesson={name}')}")
                page.frame_locator("#scene iframe").locator("canvas[data-engine]").wait_for()
                page.wait_for_function(
                    "page.step() && page.run.finished && Number($('#step').value) === page.k"
                )
                if name != "page":
                    page.add_style_tag(content="#tools{visibility:hidden}")
                image = at_rest(page if name == "page" else page.locator("#view"), page)
                width = WIDTHS.get(name, USUAL_WIDTH)
                image = image.resize(
                    (width, round(image.height * width / image.width)), Image.Resampling.LANCZOS
                )
                file = HERE / f"{name}.webp"
                image.save(file, "WEBP", quality=82, method=6)
                page.context.close()
                print(f"{file.name}: {file.stat().st_size / 1e3:.0f} kB")
    finally:
        server.stop()


def at_rest(seen: Any, page: Any) -> Image.Image:
    """Return a picture that stays as it is: a scene is drawn coarsely at first."""
    before, alike = b"", 0
    for _ in range(LOOKS):
        now = seen.screenshot()
        alike = alike + 1 if now == before else 0
        if alike == 4:
            return Image.open(io.BytesIO(now)).convert("RGB")
        before = now
        page.evaluate("new Promise((later) => setTimeout(later, 300))")
    raise TimeoutError("the scene does not come to rest")


if __name__ == "__main__":
    main(sys.argv[1:])
