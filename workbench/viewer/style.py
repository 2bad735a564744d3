"""The style sheet of what the live page writes as HTML; widgets keep viser's own look."""

from pathlib import Path

STYLE = Path(__file__).with_name("style.css").read_text(encoding="utf-8")
