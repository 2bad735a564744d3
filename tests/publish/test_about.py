"""What a site tells of itself: what others show of a page, its map, licences, and the page that
stands where none is.
"""

import io
import re
import tomllib
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import urljoin
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from tests.publish.conftest import TINY
from workbench.lesson import catalog
from workbench.page import about
from workbench.page.thumbnail import CARD
from workbench.publish import site
from workbench.publish.address import base_of, folder_of
from workbench.publish.pages import lesson_page
from workbench.publish.runs import recorded, run_page, runs_of

BASE = "https://example.org/a%20course"
OTHER = replace(TINY, name="other", title="A <second> one", order=TINY.order + 1)
ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def named(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("named") / "site"
    site.publish(out, [TINY, OTHER], base_url=BASE)
    return out


def text_of(out: Path, name: str) -> str:
    return (out / name).read_text(encoding="utf-8")


def meta_of(page: str) -> dict[str, str]:
    pairs = re.findall(r'<meta (?:name|property)="([\w:]+)" content="([^"]*)"', page)
    return {key: unescape(value) for key, value in pairs}


@pytest.mark.parametrize(("path", "title"), [("", None), ("fake/", TINY.title)])
def test_a_page_tells_others_its_title_its_address_and_its_picture(named, path, title):
    text = text_of(named, f"{path}index.html")
    meta = meta_of(text)
    course = "Geometry workbench"
    assert f"<title>{title} · {course}</title>" in text or title is None
    assert meta["og:title"] == (title or course)
    assert meta["og:site_name"] == course
    assert meta["og:description"] == meta["description"]
    assert len(meta["description"]) > 10
    assert meta["og:url"] == f"{BASE}/{path}"
    assert f'<link rel="canonical" href="{BASE}/{path}">' in text
    assert meta["twitter:card"] == "summary_large_image"
    assert meta["og:image"] == f"{BASE}/{path}card.png"
    picture = Image.open(named / path / "card.png")
    assert (picture.format, picture.size) == ("PNG", CARD)
    assert CARD == (int(meta["og:image:width"]), int(meta["og:image:height"])) == (1200, 630)
    assert np.asarray(picture.convert("RGB")).std() > 5, "something is drawn on it"
    assert meta["og:image:alt"]


def test_without_an_address_nothing_absolute_is_said(out):
    for page in sorted(out.rglob("*.html")):
        meta = meta_of(page.read_text(encoding="utf-8"))
        assert not {"og:url", "og:image"} & meta.keys()
        assert "canonical" not in page.read_text(encoding="utf-8")
    assert meta_of(text_of(out, "fake/index.html"))["twitter:card"] == "summary"
    assert not [file for file in out.rglob("*") if file.name in ("card.png", "sitemap.xml")]


def test_the_map_names_the_course_and_every_lesson(named):
    root = ElementTree.parse(named / "sitemap.xml").getroot()
    places = [loc.text for loc in root.iter("{http://www.sitemaps.org/schemas/sitemap/0.9}loc")]
    assert places == [f"{BASE}/", f"{BASE}/fake/", f"{BASE}/other/"]


def test_an_address_that_goes_takes_its_map_and_its_pictures_along(tmp_path):
    site.publish(tmp_path, [TINY], base_url=BASE)
    assert (tmp_path / "sitemap.xml").exists()
    site.publish(tmp_path, [TINY])
    assert not (tmp_path / "sitemap.xml").exists()
    assert not (tmp_path / "fake" / "card.png").exists()


def test_an_address_is_one_with_a_slash_at_its_end():
    assert base_of(None) is None
    assert base_of("https://example.org") == "https://example.org/"
    assert base_of("http://[::1]:8000/a//") == "http://[::1]:8000/a/"
    assert folder_of("https://example.org/") == "/"
    assert folder_of("https://example.org//evil.example/") == "/evil.example/"
    assert folder_of(None) is None


class Links(HTMLParser):
    """The addresses of a document, each as a browser resolves it."""

    def __init__(self, address: str):
        super().__init__()
        self.base = address
        self.found = []

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if tag == "base":
            self.base = urljoin(self.base, given["href"])
        for key in ("href", "src"):
            if key in given and tag != "base":
                self.found.append(urljoin(self.base, given[key]))


@pytest.mark.parametrize("missing", ["nope", "fake/nope.html", "fake/runs/deep/er/nope"])
def test_what_is_missing_leads_home_from_any_depth(named, missing):
    links = Links(f"{BASE}/{missing}")
    links.feed(text_of(named, "404.html"))
    ours = [link for link in links.found if not link.startswith("https://creativecommons.org")]
    assert f"{BASE}/index.html" in ours
    assert f"{BASE}/other/index.html" in ours
    for address in ours:
        assert address.startswith(f"{BASE}/")
        assert (named / address.removeprefix(f"{BASE}/")).is_file(), address


def test_where_the_folder_is_not_known_the_page_that_is_missing_looks_for_it(out):
    page = text_of(out, "404.html")
    assert "<base" not in page
    assert 'const names = ["fake","page"]' in page
    assert page.index("createElement") < page.index("stylesheet")


def test_text_of_a_lesson_stays_text_where_it_is_missing(named):
    assert "A &lt;second&gt; one" in text_of(named, "404.html")
    assert "A <second>" not in text_of(named, "404.html")


@pytest.mark.parametrize(
    ("page", "root"),
    [("index.html", ""), ("404.html", ""), ("notices.html", ""), ("fake/index.html", "../")],
)
def test_every_page_says_its_licences_its_source_and_how_to_install_it(out, page, root):
    (footer,) = re.findall(r'<footer class="about">.*?</footer>', text_of(out, page))
    assert 'rel="license" href="https://creativecommons.org/licenses/by/4.0/"' in footer
    assert "code: MIT" in footer
    assert "pip install geometry-workbench" in footer
    assert "Source: " in footer
    assert f'href="{root}notices.html"' in footer


def test_a_lesson_of_somebody_else_is_not_said_to_be_ours(out):
    assert about.STRANGERS in text_of(out, "fake/index.html")
    assert about.STRANGERS not in text_of(out, "index.html")
    assert "CC BY" not in text_of(out, "fake/runs/default.html")
    ours = catalog()["fitting"]
    known = recorded(ours, runs_of(ours)[0], root="../", runs="runs/", answers={})
    page = lesson_page(ours, known)
    assert about.STRANGERS not in page
    assert '<footer class="about">' in page
    assert 'href="../../notices.html"' in run_page(ours, runs_of(ours)[0])


def test_the_page_of_licences_names_them_all_and_what_is_accessible(out):
    page = text_of(out, "notices.html")
    for text in (about.CC_BY, about.CC_BY_TEXT, "page/third-parties.txt", "pip install"):
        assert text in page
    assert ">Accessibility</h2>" in page
    assert ">What does not hold</h3>" in page
    assert "https://creativecommons.org/licenses/by/4.0/legalcode" in text_of(
        out, "page/third-parties.txt"
    )


def test_the_source_is_linked_where_the_package_says_where_it_is(monkeypatch):
    monkeypatch.delenv(about.ADDRESS, raising=False)
    all_urls = [
        ["Documentation, https://a.example", "Source, https://b.example/X"],
        ["Source, x"],
        [],
    ]
    for urls, address in zip(all_urls, ("https://b.example/X", None, None), strict=True):
        monkeypatch.setattr(
            about, "metadata", lambda _, urls=urls: type("M", (), {"get_all": lambda *_: urls})()
        )
        assert about.source_address() == address
        assert (f'href="{address}"' in about.footer_html("")) == (address is not None)


def test_who_publishes_may_say_where_the_source_is(monkeypatch, tmp_path):
    monkeypatch.setenv("WORKBENCH_ADDRESS", "https://c.example/Ours?a&b")
    site.publish(tmp_path, [TINY])
    for name in ("index.html", "notices.html", f"{TINY.name}/index.html"):
        assert 'href="https://c.example/Ours?a&amp;b"' in text_of(tmp_path, name), name
    monkeypatch.setenv("WORKBENCH_ADDRESS", "javascript:alert(1)")
    assert about.source_address() is None
    assert "javascript" not in about.footer_html("")


def test_the_project_names_both_licences():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["license"] == "MIT AND CC-BY-4.0"
    assert project["name"] == about.PACKAGE
    for name in ("LICENSE", "NOTICE"):
        assert name in project["license-files"]
        assert about.CC_BY in (ROOT / name).read_text(encoding="utf-8")
    assert about.CC_BY_TEXT in (ROOT / "LICENSE").read_text(encoding="utf-8")


def test_the_icon_is_a_picture_of_ours(out):
    icon = ElementTree.parse(out / "page" / "icon.svg").getroot()
    assert icon.tag.endswith("svg")
    assert 'rel="icon" href="../page/icon.svg"' in text_of(out, "fake/index.html")
    assert io.BytesIO((out / "page" / "icon.svg").read_bytes()).getbuffer().nbytes < 2000
