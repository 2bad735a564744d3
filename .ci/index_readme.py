"""README as a package index shows it: no address in it is relative to the checkout."""

import os
import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

PICTURE = re.compile(r'!\[[^\]]*\]\((?!https?:)([^)\s]+)\)|<img src="(?!https?:)([^"]+)"[^>]*>')
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\((?!https?:|#)([^)\s]+)\)")


def for_index(readme: str, address: str | None, ref: str) -> str:
    """Make relative addresses absolute; where nobody says where the sources are, pictures go and
    links become their words.

    Args:
        readme: The text in Markdown.
        address: Where the sources are, such as `https://example.org/owner/repository`, or None.
        ref: The tag or branch that the addresses lead to.
    """
    if address is None:
        return LINK.sub(r"\1", PICTURE.sub("", readme))

    def picture(found: re.Match[str]) -> str:
        at = found[1] or found[2]
        return found[0].replace(at, f"{address}/raw/{ref}/{at}")

    return LINK.sub(rf"[\1]({address}/blob/{ref}/\2)", PICTURE.sub(picture, readme))


class IndexReadme(MetadataHookInterface):
    """Gives a distribution its README, and its addresses where `WORKBENCH_ADDRESS` says where the
    sources are.
    """

    PLUGIN_NAME = "custom"

    def update(self, metadata: dict[str, Any]) -> None:
        """Set `readme`, and `urls` where the address is known."""
        address = os.environ.get("WORKBENCH_ADDRESS") or None
        ref = f"v{metadata['version']}"
        readme = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {
            "content-type": "text/markdown",
            "text": for_index(readme, address, ref),
        }
        if address is not None:
            metadata["urls"] = {
                "Source": address,
                "Documentation": f"{address}/blob/{ref}/docs/index.md",
                "Changelog": f"{address}/blob/{ref}/CHANGELOG.md",
            }
