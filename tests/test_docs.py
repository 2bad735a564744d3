"""What the documents promise can be found: tests, links, commands, modules, files."""

import ast
import re
import shlex
from functools import cache
from pathlib import Path

import pytest

import workbench
from workbench import cli
from workbench.lesson import catalog

ROOT = Path(__file__).resolve().parents[1]
PAGES = [
    *sorted((ROOT / "docs").rglob("*.md")),
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    ROOT / "CHANGELOG.md",
]


def read(name: str | Path) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def short(path: Path) -> str:
    return str(path.relative_to(ROOT))


# tests that are named -----------------------------------------------------------------------------


NAMED = re.findall(r"`(tests/[\w/]+\.py(?:::\w+)+)`", read("docs/security.md"))


def test_tests_are_named():
    assert len(NAMED) > 15
    assert len(set(NAMED)) == len(NAMED)


@pytest.mark.parametrize("named", NAMED)
def test_every_test_that_the_security_page_names_is_there(named):
    path, *names = named.split("::")
    inside: list[ast.stmt] = ast.parse(read(path)).body
    for name in names:
        definitions = [
            node
            for node in inside
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == name
        ]
        assert definitions, f"{path} has no {name}"
        inside = definitions[0].body


# links --------------------------------------------------------------------------------------------


def without_code(text: str) -> str:
    return re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)


@cache
def anchors(path: Path) -> set[str]:
    """The anchors of a page's headings, as GitHub and mkdocs make them."""
    headings = re.findall(r"^#+ (.+)$", without_code(read(path)), re.MULTILINE)
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings
    }


@pytest.mark.parametrize("page", PAGES, ids=short)
def test_links_between_documents_lead_somewhere(page):
    for target in re.findall(
        r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", without_code(read(page)))
    ):
        if target.startswith(("https://", "http://")):
            continue
        place, _, anchor = target.partition("#")
        path = (page.parent / place).resolve() if place else page
        assert path.exists(), f"{short(page)}: {target} leads nowhere"
        assert not anchor or anchor in anchors(path), (
            f"{short(page)}: {short(path)} has no heading {anchor!r}"
        )


def test_the_first_page_links_all_others():
    linked = {
        (ROOT / "docs" / target).resolve()
        for target in re.findall(r"\]\((.+?\.md)\)", read("docs/index.md"))
    }
    others = {page for page in PAGES if page.is_relative_to(ROOT / "docs")} - {
        ROOT / "docs" / "index.md"
    }
    assert others <= linked, [short(page) for page in others - linked]


# commands -----------------------------------------------------------------------------------------


def commands(page: Path) -> list[str]:
    """The command lines of the workbench in a page: in blocks of shell, and in the text between
    single backquotes.
    """
    text = read(page)
    lines = [
        line
        for block in re.findall(r"^```sh\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
        for line in block.splitlines()
    ]
    lines += re.findall(r"`(workbench[^`]*)`", without_code(text))
    return [
        line.partition("#")[0].partition(";")[0].strip()
        for line in lines
        if line.startswith("workbench ")
    ]


COMMANDS = [(page, line) for page in PAGES for line in commands(page)]


def test_commands_are_found():
    assert len(COMMANDS) > 20


@pytest.mark.parametrize(
    ("page", "line"), COMMANDS, ids=[f"{short(page)}: {line}" for page, line in COMMANDS]
)
def test_a_command_has_a_name_and_flags_that_exist(page, line, capsys):
    _, name, *words = shlex.split(line)
    if name.startswith("-"):
        return
    assert name in cli.COMMANDS, f"{short(page)}: there is no command {name!r}"
    given = [word for word in words if not word.startswith("-")]
    about = [word for word in given[:1] if word in catalog()]  # a lesson has flags of its own
    assert cli.main([name, *about, "--help"]) == 0
    known = capsys.readouterr().out
    # a lesson of the reader's, with fields of its own
    own = any(word.endswith(".py") or "/" in word for word in given[:1])
    for flag in (word.partition("=")[0] for word in words if word.startswith("-")):
        field = own and re.search(
            rf"^    {re.escape(flag[2:].replace('-', '_'))}: Annotated", read(page), re.MULTILINE
        )
        assert field or re.search(rf"{re.escape(flag)}\b", known), (
            f"{short(page)}: {name} has no flag {flag}"
        )


# modules and files --------------------------------------------------------------------------------


@pytest.mark.parametrize("page", PAGES, ids=short)
def test_modules_and_files_that_are_named_are_there(page):
    text = read(page)
    for module in set(re.findall(r"`((?:workbench|tests)(?:\.\w+)+)`", text)) | set(
        re.findall(r"^::: ([\w.]+)", text, re.MULTILINE)
    ):
        place = ROOT.joinpath(*module.split("."))
        assert place.is_dir() or place.with_suffix(".py").exists(), (
            f"{short(page)}: there is no {module}"
        )
    for file in re.findall(
        r"`((?:workbench|tests|lessons|assets|\.ci|\.github)/[\w/.-]*\w)`", text
    ):
        if "NAME" not in file and file not in (
            ".github/workflows/pages.yml",
        ):  # a placeholder, another repository's
            assert (ROOT / file).exists(), f"{short(page)}: there is no {file}"


def test_the_architecture_names_every_package():
    text = read("docs/architecture.md")
    packages = [path.parent.name for path in (ROOT / "workbench").glob("*/__init__.py")]
    assert [name for name in packages if f"`workbench.{name}`" not in text] == []


def test_every_module_of_the_maths_is_in_the_reference():
    for part in ("geometry", "algorithms", "data"):
        listed = re.findall(
            rf"^::: workbench\.{part}\.([\w.]+)$", read(f"docs/api/{part}.md"), re.MULTILINE
        )
        folder = ROOT / "workbench" / part
        paths = [
            path
            for path in folder.rglob("[!_]*.py")
            if "import *" not in path.read_text(encoding="utf-8")
        ]
        modules = [".".join(path.relative_to(folder).with_suffix("").parts) for path in paths]
        assert sorted(listed) == sorted(modules), part


PRIVATE = re.findall(r"^\| `([^`]+)` \| `([^`]+)`", read("docs/upgrading.md"), re.MULTILINE)


@pytest.mark.parametrize(
    ("file", "word"), PRIVATE, ids=[f"{file}: {word}" for file, word in PRIVATE]
)
def test_what_is_relied_on_of_viser_and_rerun_is_where_the_page_says(file, word):
    match = re.search(rf"(?<!\w){re.escape(word)}(?!\w)", read(file))
    assert match, f"{file} has no {word}: docs/upgrading.md is out of date"


def test_the_citation_names_this_version():
    assert f"version: {workbench.__version__}\n" in read("CITATION.cff")


def test_packages_that_are_pinned_are_pinned_as_said():
    for pin in ("viser>=", "rerun-sdk>="):
        match = re.search(rf"`({pin}[^`]+)`", read("docs/upgrading.md"))
        assert match
        assert f'"{match[1]}"' in read("pyproject.toml")
