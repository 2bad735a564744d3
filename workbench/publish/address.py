"""The address that a site will have: checked, and written into pages only where it is known."""

import re
from collections.abc import Iterable
from html import escape
from urllib.parse import urlsplit

from workbench.errors import InputError
from workbench.page.document import COURSE
from workbench.page.thumbnail import CARD

LONGEST = 500
"""Signs of an address that is taken."""
SITEMAP = "sitemap.xml"
_PLAIN = re.compile(r"https?://[\w.\-\[\]:]+(/([\w.~!$&()*+,;=:@/-]|%[0-9A-Fa-f]{2})*)?", re.A)
"""An address of a folder, as a browser's line of addresses has it when it is copied."""


def base_of(given: str | None) -> str | None:
    """Return a site's address with one slash at its end; None where none is given.

    Raises:
        InputError: If it is no address of a folder on a server.
    """
    if given is None:
        return None
    shown = given if len(given) <= 80 else f"{given[:80]}…"
    if "?" in given or "#" in given:
        raise InputError(
            f"--base-url {shown!r}: the address of a folder has no query (?) and no fragment (#)"
        )
    if len(given) > LONGEST or not _PLAIN.fullmatch(given) or not _has_host(given):
        raise InputError(
            f"--base-url {shown!r}: an address such as https://example.org/course is needed"
        )
    return f"{given.rstrip('/')}/"


def _has_host(address: str) -> bool:
    try:
        parts = urlsplit(address)
        return bool(parts.hostname) and parts.port != 0 and ".." not in parts.path.split("/")
    except ValueError:  # such as brackets that hold no address, or a port of six digits
        return False


def folder_of(base: str | None) -> str | None:
    """Return the path of a site's folder on its server, None where its address is not known."""
    return None if base is None else re.sub("/+", "/", urlsplit(base).path)


def social_head(
    base: str | None, path: str, *, title: str, summary: str, picture: str | None = None
) -> str:
    """Return what tells other sites how a page is shown where somebody links it.

    Absolute addresses, of the page and of its picture, stand in it only where the site's is known.

    Args:
        base: The site's address, as `base_of` returns it.
        path: The page's address in the site; empty for the course.
        title, summary: What is told of it.
        picture: The address in the site of a picture of CARD's size; None where there is none.
    """
    tags = {
        "og:site_name": COURSE,
        "og:type": "article" if path else "website",
        "og:title": title,
        "og:description": summary,
        "twitter:card": "summary" if base is None or picture is None else "summary_large_image",
    }
    link = "" if base is None else f'<link rel="canonical" href="{escape(base + path)}">\n'
    if base is not None:
        tags["og:url"] = base + path
    if base is not None and picture is not None:
        tags |= {
            "og:image": base + picture,
            "og:image:type": "image/png",
            "og:image:width": str(CARD[0]),
            "og:image:height": str(CARD[1]),
            "og:image:alt": f"A picture of {title}",
        }
    return link + "".join(
        f'<meta {"name" if key.startswith("twitter") else "property"}="{key}"'
        f' content="{escape(value)}">'
        for key, value in tags.items()
    )


def sitemap(base: str, lessons: Iterable[str]) -> str:
    """Return the list of a site's pages for search engines: the course, and each lesson."""
    addresses = [base, *(f"{base}{name}/" for name in lessons)]
    rows = "".join(f"<url><loc>{escape(address)}</loc></url>\n" for address in addresses)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<urlset'
        f' xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">\n{rows}</urlset>\n'
    )
