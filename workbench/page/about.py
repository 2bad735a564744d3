"""What a published course says of itself: the line under every page, the page of its licences, and
the page that stands where none is.
"""

import os
from collections.abc import Mapping
from html import escape
from importlib.metadata import PackageNotFoundError, metadata

from workbench.machinery.licence import CC_BY, CC_BY_TEXT, PACKAGE
from workbench.page.bundles import FRONT_STYLES, THIRD_PARTIES, WORDS_SCRIPTS
from workbench.page.document import COURSE, document_head, in_script, scripts_html

ADDRESS = "WORKBENCH_ADDRESS"
"""Of the environment: where the source is, when a distribution is built and a course published."""
NOTICES_PAGE = "notices.html"
MISSING_PAGE = "404.html"
_NOTICES = """\
<h2>Whose this is</h2>
<p>The geometry workbench and its course are the work of the geometry workbench authors.</p>
<ul>
<li><b>Texts and pictures</b> of the course are under <a rel="license" href="{cc_by}">Creative
Commons Attribution 4.0 International</a> (<a href="{cc_by_text}">legal code</a>): copy, change and
share them, also for money, where you say whose they are, link the licence, and say what you
changed. For example: <q>Iterative closest point, by the geometry workbench authors, CC BY 4.0</q>,
with the address of the page.</li>
<li><b>Code</b>, in the pages too, is under the MIT License; its text stands in
<a href="{others}">third-parties.txt</a>.</li>
<li><b>Work of others</b>, such as fonts, the program that draws the scenes, and some photographs,
keeps its own licence, and CC BY does not cover it: <a href="{others}">all of it, with the
licences</a>.</li>
<li>A lesson that is not of the course says so at its end.</li>
</ul>
<h2 id="install">Source, and how to install it</h2>
<p>The pages name commands such as <code>workbench show icp</code>, which opens the lesson live,
with every knob and with your own files. They come with a Python package, for Python 3.11 or newer,
which is the source of the workbench and of all its lessons.{where}</p>
<pre tabindex="0">pip install {package}
workbench</pre>
"""
STRANGERS = "This lesson is not part of it: its author says what may be done with it."
_AT_ITS_FOLDER = """(() => {
const names = FOLDERS, parts = location.pathname.split("/").slice(1);
const at = parts.findIndex((part) => names.includes(part));
if (!location.protocol.startsWith("http") || at < 0) return;
const base = document.createElement("base");
base.href = `${location.origin}/${parts.slice(0, at).concat("").join("/")}`;
document.head.append(base);
})();"""
"""Finds the site's folder in the address of a missing page: it lies before a folder of the site."""


def source_address() -> str | None:
    """Return where the source is, as `WORKBENCH_ADDRESS` of the environment says, else the package;
    None where neither names an https address.
    """
    address = os.environ.get(ADDRESS) or _packaged_address()
    return address if address.startswith("https://") else None


def _packaged_address() -> str:
    try:
        urls = metadata(PACKAGE).get_all("Project-URL") or []
    except PackageNotFoundError:
        return ""
    named = dict(url.split(", ", 1) for url in urls if ", " in url)
    return next((url for name, url in named.items() if name.lower() == "source"), "")


def footer_html(root: str, *, ours: bool = True) -> str:
    """Return the line under a page of a site: source, licences, how to install.

    Args:
        root: The relative address of the site's folder.
        ours: Whether what the page teaches is of the workbench's own course.
    """
    address = source_address()
    package = f"<code>{PACKAGE}</code>"
    source = f'<a href="{escape(address)}">{package}</a>' if address else f"the package {package}"
    theirs = "" if ours else f" {STRANGERS}"
    return (
        f'<footer class="about"><p>{COURSE}. Texts and pictures: <a rel="license"'
        f' href="{CC_BY}">CC BY 4.0</a>, code: MIT.{theirs} Source: {source}; <code>pip install'
        f" {PACKAGE}</code> brings the command <code>workbench</code>."
        f' <a href="{root}{NOTICES_PAGE}">Licences, work of others, accessibility</a></p></footer>'
    )


def short_notice(root: str) -> str:
    """Return what a run alone has of it: a link that says the licence; `root` as for the line."""
    return (
        f'<a class="licence" href="{root}{NOTICES_PAGE}" title="Licences, source, how to install"'
        ">CC BY 4.0</a>"
    )


def notices_document(root: str, statement: str = "", head: str = "") -> str:
    """Return the page of the licences.

    Args:
        root: The relative address of the folder with the page's own files.
        statement: What is said of accessibility, as HTML.
        head: More HTML for the head.
    """
    address = source_address()
    link = "" if address is None else f'<a href="{escape(address)}">{escape(address)}</a>'
    own = _NOTICES.format(
        cc_by=CC_BY,
        cc_by_text=CC_BY_TEXT,
        others=f"{root}{THIRD_PARTIES}",
        package=PACKAGE,
        where=link and f" It is developed at {link}.",
    )
    return about_document("Licences and accessibility", f"{own}{statement}", root=root, head=head)


def missing_document(root: str, lessons: Mapping[str, str], folder: str | None = None) -> str:
    """Return the page that a server shows where there is none.

    Args:
        root: The relative address, in the site, of the folder with the page's own files.
        lessons: Their titles by name, in course order.
        folder: The path of the site's folder on its server, with a slash at its end. Without it a
            script looks for it in the address that was asked for: it lies before a lesson's name.
    """
    names = in_script([*lessons, root.strip("/")])
    script = f"<script>{_AT_ITS_FOLDER.replace('FOLDERS', names)}</script>"
    base = script if folder is None else f'<base href="{escape(folder)}">'
    links = "".join(
        f'<li><a href="{escape(name)}/index.html">{escape(title)}</a></li>'
        for name, title in lessons.items()
    )
    words = (
        "<p>The address is mistyped, or what stood there has gone elsewhere.</p>"
        '<p class="begin"><a class="button" href="index.html">To the course</a></p>'
        f"<ul>{links}</ul>"
    )
    return about_document(
        "This page is not here",
        words,
        root=root,
        head='<meta name="robots" content="noindex">',
        first=base,
    )


def about_document(title: str, body: str, *, root: str, head: str = "", first: str = "") -> str:
    """Return a page of words alone, at the top of a site.

    Args:
        title: Its heading.
        body: Its words, as HTML.
        root: The relative address of the folder with the page's own files.
        head: More HTML for the head.
        first: What stands before every address of the head.
    """
    summary = f"{title}: {COURSE}."
    opened = document_head(title, summary, root, styles=FRONT_STYLES, more=head, first=first)
    return (
        f'{opened}<body class="front plain"><header class="hero"><p class="brand"><a'
        f' href="index.html">{COURSE}</a></p></header><main><h1>{escape(title)}</h1>{body}</main>'
        f"{footer_html('')}{scripts_html(root, WORDS_SCRIPTS)}</body></html>\n"
    )
