import base64
import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
import zstandard

from tests import fake
from tests.publish.conftest import TINY
from workbench.errors import InputError
from workbench.lesson import Sweep, View, catalog
from workbench.page.bundles import (
    BENCH_STYLES,
    BUNDLES,
    SITE_BENCH,
    SITE_STORY,
    STORY_STYLES,
    bundle,
)
from workbench.page.steps import Steps
from workbench.publish import runs, site, sizes
from workbench.publish.pages import lesson_page
from workbench.run.timeline import Timeline
from workbench.scene import Caption
from workbench.story import has_story
from workbench.wire.packing import run_text

SMALL = replace(fake.lesson, presets=fake.lesson.presets[:1])


@pytest.fixture(scope="module")
def published(tmp_path_factory):
    out = tmp_path_factory.mktemp("site")
    files = site.publish(out, [SMALL], base_url="https://example.org/course/", recordings="all")
    return out, dict(files)


def data_of(out, run: str) -> dict:
    text = (out / "fake" / "runs" / f"{run}.js").read_text()
    return json.loads("[" + text.removeprefix("replay(").rstrip().removesuffix(");") + "]")[1]


def test_every_run_has_its_replay_its_recording_and_a_page_of_its_own(published):
    out, files = published
    for name in ("default.js", "default.html", "fake.rrd", "half.js", "half.html", "fake-half.rrd"):
        assert files[f"fake/runs/{name}"] > 500
    for run, name in (("default", "fake.rrd"), ("half", "fake-half.rrd")):
        assert data_of(out, run)["recording"] == name
    assert files["fake/picture.webp"] > 5000
    assert files["fake/index.html"] < 300_000
    assert (
        '<link rel="canonical" href="https://example.org/course/fake/">'
        in (out / "fake" / "index.html").read_text()
    )


def test_the_licences_of_what_is_in_the_pages_come_along(published):
    out, files = published
    assert files["page/third-parties.txt"] > 15_000
    text = (out / "page" / "third-parties.txt").read_text(encoding="utf-8")
    for name in (
        "SIL OPEN FONT LICENSE Version 1.1",
        "Apache License",
        "MIT License",
        "STIX Fonts Project",
        "viser",
    ):
        assert name in text
    assert 'href="page/third-parties.txt"' in (out / "notices.html").read_text(encoding="utf-8")


def test_the_numbers_are_those_of_the_run(published):
    out, _ = published
    timeline = Timeline(SMALL, SMALL.params()).complete()
    data = data_of(out, "default")
    assert [step["caption"] for step in data["steps"]] == [
        step.caption.text for step in timeline.known()
    ]
    for series in data["series"]:
        values = timeline.series()[series["path"]].values
        assert series["values"] == [None if v != v else pytest.approx(v, rel=1e-5) for v in values]
    assert data["scene"]
    assert data["command"] == "workbench show fake.py"


def test_every_step_says_where_the_code_stood(published):
    out, _ = published
    data = data_of(out, "default")
    for step, known in zip(
        data["steps"], Timeline(SMALL, SMALL.params()).complete().known(), strict=True
    ):
        assert known.moment is not None
        _, first = known.moment.source
        assert first + step["code"]["line"] == known.moment.line
        assert "def approach" in re.sub(
            "<[^>]*>", "", data["things"][step["code"]["source"]]["html"]
        )


def test_the_page_tells_nobody_the_answers_who_reads_it(published):
    out, _ = published
    page = (out / "fake" / "index.html").read_text()
    for question in SMALL.questions:
        states = Timeline(SMALL, question.params).states()
        assert question.why(states) not in page
        kept = re.search(rf'"{question.name}":"([A-Za-z0-9+/=]+)"', page)
        assert kept is not None
        assert json.loads(base64.b64decode(kept[1]))["why"] == question.why(states)


SWEPT = replace(
    SMALL,
    questions=(),
    sweeps=(
        Sweep("angle", (0.0, 90.0, 180.0)),
        Sweep("place", ((0.5, 0.25, 0.0), (-1.0, 0.0, 0.0))),
    ),
)


def test_a_sweep_is_a_knob_whose_runs_are_shared_with_presets_and_the_default():
    rows = [(run.name, run.file, run.recorded) for run in runs.runs_of(SWEPT, "all")]
    assert rows == [
        ("default", "default", True),
        ("half", "half", True),
        ("angle:0", "angle.0", False),
        ("place:0.5,0.25,0", "place.0_5_0_25_0", False),
        ("place:-1,0,0", "place.-1_0_0", False),
    ]
    angle, place = runs.sweep_data(SWEPT)
    assert (angle["label"], angle["unit"], angle["values"]) == ("Angle", "deg", ["0", "90", "180"])
    assert angle["runs"] == ["angle:0", "default", "half"]
    assert place["runs"][:2] == ["place:0.5,0.25,0", "place:-1,0,0"]
    assert place["runs"][2:] in ([], ["default"])
    known = runs.recorded(SWEPT, runs.runs_of(SWEPT)[0], root="", runs="runs/", answers={})
    assert known["aliases"]["angle:180"] == "half"


def test_every_run_of_a_page_has_a_place_on_a_dial():
    (dial,) = runs.sweep_data(replace(SWEPT, sweeps=(Sweep("angle", (0.0, 60.0)),)))
    assert (dial["values"], dial["runs"]) == (["0", "60", "90"], ["angle:0", "angle:60", "default"])
    assert dial["places"]["default"] == (2, "90")
    assert dial["places"]["half"] == (2, "180"), (
        "the nearest there is, with the run's own value beside it"
    )


def test_runs_of_a_sweep_are_published_without_a_recording(tmp_path):
    swept = replace(TINY, sweeps=(Sweep("colors", ("role", "field")),))
    files = dict(site.publish(tmp_path, [swept]))
    assert {name for name in files if name.startswith("fake/runs/")} == {
        *(
            f"fake/runs/{name}"
            for name in (
                "default.js",
                "default.html",
                "fake.rrd",
                "colors.role.js",
                "colors.role.html",
            )
        )
    }
    assert data_of(tmp_path, "colors.role")["recording"] is None
    assert data_of(tmp_path, "colors.role")["command"] == "workbench show fake.py --colors=role"


def test_a_sweep_of_another_run_has_the_params_of_that_run():
    other = replace(SMALL, sweeps=(Sweep("steps", (2, 3), run="half"),))
    by_name = {run.name: run for run in runs.runs_of(other)}
    half = other.preset("half").params
    assert by_name["half/steps:2"].params == replace(half, steps=2)
    assert by_name["half/steps:2"].file == "half_steps.2"
    (dial,) = runs.sweep_data(other)
    assert (dial["knob"], dial["run"], dial["runs"][-1]) == ("steps", "half", "half")


@pytest.mark.parametrize(
    ("recordings", "names"),
    [("all", {"default", "half", "far"}), ("linked", {"default", "far"}), ("none", set())],
)
def test_recordings_are_of_all_runs_of_those_that_the_text_names_or_of_none(
    tmp_path, recordings, names
):
    page = tmp_path / "page.md"
    page.write_text("# A\n\nThe [far](run:far@2) run.\n", encoding="utf-8")
    half = SMALL.presets[0]
    far = replace(half, name="far", params=replace(half.params, angle=31.0))
    lesson = replace(SMALL, page=page, presets=(half, far), questions=())
    assert {run.name for run in runs.runs_of(lesson, recordings) if run.recorded} == names


def test_two_runs_that_would_have_one_file_are_refused(tmp_path, rendered):
    shouted = replace(
        SMALL.presets[0],
        name=SMALL.presets[0].name.upper(),
        params=replace(SMALL.params(), angle=31.0),
    )
    with pytest.raises(InputError, match="two of its runs"):  # where capitals do not count
        site.publish(tmp_path, [replace(SMALL, presets=(*SMALL.presets, shouted))])
    assert rendered == []


def test_a_run_is_seen_by_the_camera_of_its_preset():
    view = View(eye=(0.0, -3.0, 1.0), grid=None)
    own = replace(SMALL, presets=(replace(SMALL.presets[0], view=view),))
    heads = [
        head_of(run_text(Timeline(own, params).complete()))
        for params in (own.params(), own.presets[0].params)
    ]
    assert [head["stage"]["camera"]["eye"] for head in heads] == [
        list(own.view.eye),
        list(view.eye),
    ]


@pytest.mark.parametrize("up", [(0.0, 1.0, 0.0), (0.0, -1.0, 0.0)])
def test_what_is_up_in_a_lesson_is_up_in_its_published_runs(up):
    lesson = replace(SMALL, view=View(eye=(2.0, 1.0, 0.5), up=up, grid=0.5, grid_height=0.4))
    head = head_of(run_text(Timeline(lesson, lesson.params()).complete()))
    assert (head["stage"]["camera"]["up"], head["stage"]["camera"]["eye"]) == (
        list(up),
        [2.0, 1.0, 0.5],
    )
    (grid,) = (kind for kind in head["kinds"].values() if kind["type"] == "GridMessage")
    assert grid["props"]["plane"] == "xz"


def head_of(text: str) -> dict:
    """Return what a run's file says before its arrays."""
    packed = base64.b64decode(text)
    inner = zstandard.ZstdDecompressor().decompress(
        packed[8:], max_output_size=int.from_bytes(packed[:8], "little")
    )
    return json.loads(inner[4 : 4 + int.from_bytes(inner[:4], "little")])


def test_what_repeats_is_kept_once():
    data = Steps(Timeline(SMALL, SMALL.params()).complete()).whole()
    photos = [
        thing
        for thing in data["things"]
        if isinstance(thing, dict) and thing.get("title") == "Photo"
    ]
    assert len(photos) == 1


def test_nothing_is_rendered_twice_and_what_changed_is(published, rendered, monkeypatch):
    out, _ = published
    pages = []
    original = site.lesson_page
    monkeypatch.setattr(
        site,
        "lesson_page",
        lambda *args, **options: pages.append(args[2]) or original(*args, **options),
    )
    site.publish(out, [SMALL], recordings="all")
    site.publish(out, [SMALL], recordings="all")
    assert ["canonical" in head for head in pages] == [False]  # once without its address
    assert rendered == []
    other = replace(SMALL, presets=(replace(SMALL.presets[0], params=fake.Params(angle=170.0)),))
    site.publish(out, [other], recordings="all")
    assert rendered == ["fake/half"]


def test_a_recording_of_equal_content_is_left_alone(out, rendered, monkeypatch):
    before = (out / "fake" / "runs" / "fake.rrd").read_bytes()
    monkeypatch.setattr("workbench.publish.site.digest_of", lambda lesson, run, sources: "another")
    site.publish(out, [TINY])
    assert rendered == ["fake/default"]
    assert (out / "fake" / "runs" / "fake.rrd").read_bytes() == before


def test_text_of_a_lesson_stays_text(tmp_path):
    def shout(state):
        return {**fake.draw(state), "caption": Caption("<script>alert(1)</script> & </script>")}

    loud = replace(
        SMALL, draw=shout, title="<b>Bold</b>", summary='"quoted" <i>', presets=(), questions=()
    )
    site.publish(tmp_path, [loud])
    script = (tmp_path / "fake" / "runs" / "default.js").read_text()
    assert "<" not in script
    for page in (tmp_path / "index.html", tmp_path / "fake" / "index.html"):
        text = page.read_text()
        assert "<b>Bold" not in text
        assert "<i>" not in text
        assert "&lt;b&gt;Bold" in text


def test_a_run_that_fails_or_a_place_that_cannot_be_written_is_one_line(tmp_path):
    broken = replace(SMALL, params=replace_default(trouble="crash"), presets=(), questions=())
    with pytest.raises(InputError, match="RuntimeError"):
        site.publish(tmp_path, [broken])
    (tmp_path / "file").write_text("x")
    with pytest.raises(InputError, match="file"):
        site.publish(tmp_path / "file", [SMALL])


@pytest.mark.parametrize(
    "address",
    [
        *("javascript:x", "https://", "https://a/?b", "https://a/#", "http://[a", "https://a/<b"),
        *("https://a/\nb", "https://a\\b", "https://me:word@a/", "https://a:99999999/", "//a/"),
        *("https://a/../b", "https://ä/", f"https://a/{'b' * 600}", "https://a b/", "https://a/%0"),
    ],
)
def test_an_address_that_is_none_is_refused_before_anything_is_rendered(
    tmp_path, rendered, address
):
    with pytest.raises(InputError, match="base-url"):
        site.publish(tmp_path / "site", [SMALL], base_url=address)
    assert rendered == []
    assert not (tmp_path / "site").exists()


def replace_default(**values):
    from dataclasses import dataclass

    @dataclass(frozen=True)
    class Params(fake.Params):
        pass

    Params.__init__.__defaults__ = tuple(  # the same knobs with other defaults
        values.get(name, default)
        for name, default in zip(
            fake.Params.__dataclass_fields__, Params.__init__.__defaults__ or (), strict=True
        )
    )
    return Params


def test_a_dead_link_or_something_heavy_fails(tmp_path, monkeypatch):
    (tmp_path / "a.html").write_text('<a href="b.html">x</a>')
    with pytest.raises(InputError, match=r"a\.html: the link b\.html leads nowhere"):
        sizes.checked(tmp_path, ["a.html"])
    (tmp_path / "b.html").write_text("x" * 400_000)
    with pytest.raises(InputError, match=r"b\.html with its styles and scripts has 0\.40 MB"):
        sizes.checked(tmp_path, ["a.html", "b.html"])
    (tmp_path / "c.rrd").write_bytes(b"x" * 3_000_001)
    with pytest.raises(InputError, match=r"c\.rrd has 3\.00 MB, over the budget of 3\.00 MB"):
        sizes.checked(tmp_path, ["c.rrd"])


def test_the_summary_counts_runs_and_no_other_scripts(published):
    out, files = published
    told = sizes.sizes_told(out, list(files.items())).splitlines()
    assert [line.partition(",")[0] for line in told[:-1]] == ["6 pages", "2 runs", "2 recordings"]
    told = sizes.sizes_told(
        out, [("x/runs/a.js", 2_000_000), ("x/runs/angle-0.js", 1_500_000)], {"x/runs/angle-0.js"}
    )
    assert "\n1 of these runs are of sweeps, 1.5 MB, the largest 1.50 MB\n" in told


def test_every_page_of_every_lesson_is_small_and_its_runs_have_names_of_their_own():
    for lesson in catalog().values():
        names = [run.name for run in runs.runs_of(lesson)]
        assert len(set(names)) == len(names)
        assert all(re.fullmatch(r"[a-z0-9_-]+", name) for name in names if ":" not in name), names


@pytest.mark.parametrize("name", catalog())
def test_every_run_of_a_lesson_has_a_file_of_its_own(name):
    files = [run.file.casefold() for run in runs.runs_of(catalog()[name])]
    assert len(set(files)) == len(files)


@pytest.mark.parametrize("name", catalog())
def test_a_lesson_s_page_is_within_its_budget(name):
    """Without what answers say, some thousand bytes, which need runs."""
    lesson = catalog()[name]
    known = runs.recorded(lesson, runs.runs_of(lesson)[0], root="../", runs="runs/", answers={})
    page = lesson_page(lesson, known)
    files = {Path(link).name for link in sizes.links_in(page) if link.startswith("../page/")}
    told = has_story(lesson)
    assert files & BUNDLES.keys() == (
        {STORY_STYLES, SITE_STORY} if told else {BENCH_STYLES, SITE_BENCH}
    )
    shared = sum(len(bundle(file).encode()) for file in files & BUNDLES.keys())
    budget = sizes.TOLD_BUDGET if told else sizes.PAGE_BUDGET
    assert len(page.encode()) + shared < budget - 6_000
