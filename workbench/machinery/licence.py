"""Whose the workbench is: the names and addresses of its two licences, as everything that it writes
says them.
"""

PACKAGE = "geometry-workbench"
CC_BY = "https://creativecommons.org/licenses/by/4.0/"
CC_BY_TEXT = "https://creativecommons.org/licenses/by/4.0/legalcode"
NOTICE = (
    f"Texts and pictures of the geometry workbench's course: CC BY 4.0, {CC_BY}. Code of the"
    " workbench: MIT License."
)
"""One line for what is handed on without a page of licences."""
