"""A site holds what we wrote and what others put there: only our own files are ever replaced or
removed.
"""

import hashlib
import json
import os
import subprocess
import sys
from dataclasses import replace

import pytest

from tests.publish.conftest import TINY
from workbench.cli import main
from workbench.errors import InputError
from workbench.machinery import atomic
from workbench.page.bundles import SITE_STORY
from workbench.publish import site
from workbench.publish.manifest import KEPT

OTHER = replace(TINY, name="other", title="Another")


def contents(folder) -> dict[str, bytes]:
    return {
        str(file.relative_to(folder)): file.read_bytes()
        for file in folder.rglob("*")
        if file.is_file()
    }


def digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def told(out, **changes) -> None:
    """Write a manifest that says what somebody else wants it to say."""
    state = json.loads((out / KEPT).read_text())
    (out / KEPT).write_text(json.dumps(state | changes))


def test_a_site_whose_manifest_has_the_format_before_is_gone_on_with(out, rendered):
    """Format 2 had one digest for each file, and another list of those that were being written."""
    state = json.loads((out / KEPT).read_text())
    files = {name: digests[0] for name, digests in state["files"].items()}
    writing = {"lessons.js": files["lessons.js"]}
    told(out, format=2, files=files | {"lessons.js": digest(b"before")}, writing=writing)
    (out / "notes.txt").write_text("mine")
    site.publish(out, [TINY])
    assert rendered == []
    assert json.loads((out / KEPT).read_text()) == state
    assert (out / "notes.txt").read_text() == "mine"


HOSTILE = (
    "../x/keep",
    "../x",
    "ABSOLUTE",
    "link/keep",
    "a\0b/keep",
    "",
    ".",
    "..",
    "fake/../../x/keep",
    "fake/../x",
)


@pytest.mark.parametrize(
    "shape", ["as it was written before", "files", "a file behind a link", "lessons"]
)
def test_nothing_outside_of_a_site_is_removed_whatever_its_manifest_says(out, shape):
    outside = out.parent / "x"
    outside.mkdir()
    (outside / "keep").write_text("precious")
    (out / "link").symlink_to(outside)
    keys = [str(outside / "keep") if key == "ABSOLUTE" else key for key in HOSTILE]
    if shape == "a file behind a link":
        keys = ["link/keep"]
    if "file" in shape:
        told(
            out,
            files=dict.fromkeys(keys, digest(b"precious"))
            | json.loads((out / KEPT).read_text())["files"],
        )
    elif shape == "lessons":
        listed = {"title": "x", "summary": "x", "order": 1}
        told(
            out,
            lessons=dict.fromkeys(keys, listed),
            runs=dict.fromkeys([f"{key}/default" for key in keys], "1"),
        )
    else:
        (out / KEPT).write_text(
            json.dumps({f"{key}{end}": "1" for key in keys for end in ("", "/default")})
        )
    site.publish(out, [TINY], force=True, remove_others=True)
    assert (outside / "keep").read_text() == "precious"
    assert (out / "link").is_symlink()
    assert not [name for name in json.loads((out / KEPT).read_text())["files"] if name in keys]


@pytest.mark.parametrize(
    "text",
    [
        "[]",
        "null",
        "{",
        "[" * 100_000,
        '{"format": 2, "files": [1], "runs": 3, "lessons": {"fake": 7}, "writing": "x"}',
        (
            '{"format": 2, "files": {"index.html": {}}, "lessons": {"fake": {"title": [],'
            ' "summary": 1, "order": "x"}}}'
        ),
        '{"format": 2, "lessons": {"b": {"title": "<script>", "summary": "x", "order": 1e999}}}',
        "x" * 5_000_000,
        (
            '{"format": 3, "made_by": "", "lessons": {}, "runs": {"fake/default": 1}, "files":'
            ' {"index.html": ["1"]}}'
        ),
        '{"format": 3, "made_by": "", "lessons": {}, "runs": [["a", "b"]], "files": {}}',
        '{"format": ' + "9" * 5000 + "}",
    ],
)
def test_a_manifest_that_is_none_gives_no_rights(out, text):
    (out / KEPT).write_text(text)
    before = contents(out)
    with pytest.raises(InputError, match=r"was not written by publish.*--force"):
        site.publish(out, [TINY])
    assert contents(out) == before


@pytest.mark.parametrize(
    "name", ["index.html", "lessons.js", ".nojekyll", "fake/index.html", "fake/runs/fake.rrd"]
)
def test_a_file_of_somebody_else_is_not_replaced(tmp_path, name, rendered):
    (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / name).write_text("mine")
    with pytest.raises(InputError, match=name) as caught:
        site.publish(tmp_path, [TINY])
    assert "--force" in str(caught.value)
    assert contents(tmp_path) == {name: b"mine"}
    assert rendered == []


def test_a_file_of_ours_that_somebody_changed_is_theirs(out):
    (out / "lessons.js").write_text("mine")
    before = contents(out)
    with pytest.raises(InputError, match=r"lessons\.js.*--force"):
        site.publish(out, [TINY])
    assert contents(out) == before
    site.publish(out, [TINY], force=True)
    assert b"mine" not in (out / "lessons.js").read_bytes()


def test_one_lesson_more_leaves_the_others_and_what_people_put_there(out):
    (out / "fake" / "notes.txt").write_text("mine")
    (out / "fake" / "runs" / "own.html").write_text("<a href=nowhere.html>mine</a>")
    before = contents(out / "fake")
    files = dict(site.publish(out, [OTHER]))
    assert contents(out / "fake") == before
    index = (out / "index.html").read_text()
    assert index.index('href="fake/index.html"') < index.index('href="other/index.html"')
    assert {"fake/runs/default.js", "other/runs/default.js"} <= set(files)
    assert "fake/notes.txt" not in files


def test_the_command_leaves_other_lessons_where_lessons_are_named_and_else_there_are_none(
    out, monkeypatch, capsys
):
    before = contents(out / "fake")
    monkeypatch.setattr(
        "workbench.commands.making.lesson_given", lambda name: {"other": OTHER}[name]
    )
    monkeypatch.setattr("workbench.commands.making.catalog", lambda: {"other": OTHER})
    assert main(["publish", str(out), "--lesson", "other"]) == 0, capsys.readouterr().err
    assert contents(out / "fake") == before
    assert (out / "other" / "index.html").exists()
    assert main(["publish", str(out)]) == 0, capsys.readouterr().err
    assert not (out / "fake").exists()
    assert (out / "other" / "index.html").exists()


def test_a_lesson_that_is_no_more_goes_and_what_others_put_there_stays(out):
    (out / "fake" / "notes.txt").write_text("mine")
    (out / "fake" / "index.html").write_text("my own words")
    site.publish(out, [OTHER], remove_others=True)
    assert contents(out / "fake") == {"notes.txt": b"mine", "index.html": b"my own words"}
    assert not (out / "fake" / "runs").exists()
    assert "fake" not in (out / "index.html").read_text()
    site.publish(out, [TINY], remove_others=True, force=True)
    mine = ["index.html", "notes.txt", "picture.webp", "runs", "stills"]
    assert sorted(os.listdir(out / "fake")) == mine
    assert not (out / "other").exists()


def test_a_run_that_is_no_more_goes(out):
    wanted = replace(TINY, presets=(replace_preset(),))
    site.publish(out, [wanted], recordings="all")
    assert (out / "fake" / "runs" / "fake-half.rrd").exists()
    site.publish(out, [TINY])
    assert sorted(os.listdir(out / "fake" / "runs")) == ["default.html", "default.js", "fake.rrd"]


def replace_preset():
    from tests import fake

    return fake.lesson.presets[0]


def test_a_folder_that_leads_out_of_the_site_is_not_written_into(tmp_path, rendered):
    outside, out = tmp_path / "outside", tmp_path / "site"
    outside.mkdir()
    out.mkdir()
    (out / "fake").symlink_to(outside)
    for force in (False, True):
        with pytest.raises(InputError, match=r"fake.*leads out of the site"):
            site.publish(out, [TINY], force=force)
    assert os.listdir(outside) == []
    assert rendered == []


def test_a_file_in_the_place_of_a_folder_and_the_reverse_are_said(tmp_path, rendered):
    (tmp_path / "fake").write_text("mine")
    with pytest.raises(InputError, match=r"fake.*a folder is needed"):
        site.publish(tmp_path, [TINY], force=True)
    (tmp_path / "fake").unlink()
    (tmp_path / "index.html").mkdir()
    with pytest.raises(InputError, match=r"index\.html.*is a folder"):
        site.publish(tmp_path, [TINY], force=True)
    assert rendered == []


def test_a_link_to_a_file_elsewhere_is_replaced_not_followed(tmp_path):
    (tmp_path / "own.css").write_text("mine")
    out = tmp_path / "site"
    out.mkdir()
    (out / "lessons.js").symlink_to(tmp_path / "own.css")
    with pytest.raises(InputError, match=r"lessons\.js"):
        site.publish(out, [TINY])
    site.publish(out, [TINY], force=True)
    assert (tmp_path / "own.css").read_text() == "mine"
    assert not (out / "lessons.js").is_symlink()


@pytest.mark.parametrize("moment", ["before", "after"])
def test_who_is_stopped_in_the_middle_of_writing_goes_on(out, monkeypatch, rendered, *, moment):
    """Neither the old content of a file nor the new one is taken for somebody else's."""
    from workbench.publish import manifest

    (out / "fake" / "runs" / "default.js").unlink()
    written = []

    def stops(path, data):
        if path.name == "default.html" or written:
            if moment == "after" and not written:
                real(path, data)
            written.append(path)
            raise KeyboardInterrupt
        real(path, data)

    real = manifest.write_atomic
    monkeypatch.setattr(manifest, "write_atomic", stops)
    loud = replace(TINY, title="Loud")
    with pytest.raises(KeyboardInterrupt):
        site.publish(out, [loud])
    monkeypatch.setattr(manifest, "write_atomic", real)
    site.publish(out, [loud])
    assert "Loud" in (out / "fake" / "runs" / "default.html").read_text()


def test_a_name_that_fits_no_folder_is_refused(tmp_path):
    for name in ("../x", "a/b", "", "index.html", "x y"):
        with pytest.raises(InputError, match="name"):
            site.publish(tmp_path, [replace(TINY, name=name)])
    assert list(tmp_path.iterdir()) == []


def test_one_lesson_is_not_published_where_files_would_go_that_the_others_need(out, monkeypatch):
    before = contents(out)
    fewer = tuple(name for name in site.SITE_FILES if name != SITE_STORY)
    monkeypatch.setattr(site, "SITE_FILES", fewer)
    with pytest.raises(InputError, match=r"other lessons' pages need files.*publish all"):
        site.publish(out, [OTHER])
    assert contents(out) == before
    site.publish(out, [TINY])
    assert not (out / "page" / SITE_STORY).exists()


def test_part_of_a_site_of_another_version_is_not_published_alone(out):
    told(out, made_by="workbench 0.0")
    with pytest.raises(InputError, match=r"another version.*publish all"):
        site.publish(out, [OTHER])
    site.publish(out, [TINY, OTHER])


def test_a_full_disk_leaves_nothing_half_written(out, monkeypatch):
    def full(file):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("workbench.machinery.atomic.os.fsync", full)
    before = contents(out)
    with pytest.raises(InputError, match="No space left"):
        site.publish(out, [replace(TINY, title="Loud")])
    assert contents(out) == before


def test_what_a_killed_publish_left_is_removed_by_the_next(out):
    gone = subprocess.run(
        [sys.executable, "-c", "import os; print(os.getpid())"], capture_output=True, check=True
    )
    left = [
        f".{name}.{atomic._MACHINE}-{int(gone.stdout)}-0123abcd.part"
        for name in ("index.html", "default.js")
    ]
    (out / left[0]).touch()
    (out / "fake" / "runs" / left[1]).touch()
    site.publish(out, [TINY])
    assert not list(out.rglob("*.part"))
