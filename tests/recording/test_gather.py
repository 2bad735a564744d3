"""A cloud whose points come and go is said once for the whole run, and shows at every step what it
showed before.
"""

from dataclasses import replace

import numpy as np
import pytest

from tests.recording.latest_at import rows, shown_at
from workbench.lesson import catalog
from workbench.recording import gather, record_bytes
from workbench.recording.gather import unions
from workbench.recording.sink import RerunSink
from workbench.recording.streams import stream_bytes
from workbench.run.timeline import Timeline
from workbench.scene import Field, Points

RNG = np.random.default_rng(0)
P = RNG.normal(size=(200, 3))
COLORS = RNG.integers(0, 256, (200, 3), dtype=np.uint8)


def scenes(steps: int = 8):
    """A cloud of which other points are there at each step, in another order; coloured by a field
    at the end.
    """
    clouds = []
    for k in range(steps):
        some = RNG.permutation(200)[: 100 + k]
        clouds.append({"cloud": Points(P[some], COLORS[some], 0.01 + 0.001 * k)})
    return [*clouds, {"cloud": Points(P, Field(P[:, 0], -1.0, 1.0, "x", "m"))}]


def recorded(shown, path, gathered):
    def fill(stream):
        sink = RerunSink(stream, unions=gathered)
        for k, scene in enumerate(shown):
            sink.show(k, scene)

    path.write_bytes(stream_bytes("workbench-test", fill))
    return path


def there(path, step):
    """Return what is visible of the cloud: its points with their colours, in one order."""
    shown = shown_at(path, step)["/world/cloud"]
    radii = np.broadcast_to(shown["Points3D:radii"], len(shown["Points3D:positions"]))
    both = zip(
        map(tuple, shown["Points3D:positions"]), shown["Points3D:colors"], radii, strict=True
    )
    return sorted(point for point in both if point[2] > 0)


def test_a_gathered_cloud_shows_what_it_showed(tmp_path):
    shown = scenes()
    gathered = unions(shown)
    assert gathered.keys() == {"cloud"}
    with_union = recorded(shown, tmp_path / "a.rrd", gathered)
    without = recorded(shown, tmp_path / "b.rrd", {})
    for k in range(len(shown)):
        assert there(with_union, k) == there(without, k)
    places = [
        components
        for _, _, entity, components in rows(with_union)
        if "Points3D:positions" in components
    ]
    assert len(places) == 2  # once for all, and once more by the field


def test_clouds_that_move_or_have_no_colours_of_their_own_are_not_gathered():
    moving = [{"cloud": Points(P + k, COLORS)} for k in range(8)]
    plain = [{"cloud": replace(scene["cloud"], color="source")} for scene in scenes()[:-1]]
    assert unions(moving) == unions(plain) == {}


def test_a_large_union_is_thinned_evenly_and_stays_the_same_from_step_to_step(monkeypatch):
    monkeypatch.setattr(gather, "MOST", 50)
    (union,) = unions(scenes()).values()
    assert len(union.p) == 50
    assert union.swell == pytest.approx(2.0, rel=0.01)
    assert {row.tobytes() for row in union.p} <= {row.tobytes() for row in P.astype(np.float32)}
    shares = [mask.mean() for mask in union.shown.values()]
    assert min(shares) > 0.25
    assert max(shares) < 0.8


def test_a_stereo_run_is_small():
    lesson = catalog()["disparity"]
    # it had 9 MB
    assert len(record_bytes(Timeline(lesson, lesson.params()).complete())) < 2_700_000
