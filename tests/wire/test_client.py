"""viser's client: one file, the same plain and compressed, with the page in the place of its
worker.
"""

import gzip
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import viser

from workbench.errors import InputError
from workbench.page.bundles import BUNDLES, LIVE_FILES, STATIC, bundle
from workbench.viewer.transfers import bundle_served, client_served, text_response
from workbench.wire import client
from workbench.wire.client import client_html


def test_the_client_is_one_file_whose_worker_is_the_page():
    html = client_html()
    served = client_served()
    assert served.plain.decode() == html
    assert gzip.decompress(served.compressed) == served.plain
    assert len(served.compressed) < len(served.plain)
    assert served.media_type == "text/html"
    assert served.etag[0] == served.etag[-1] == '"'
    own = (Path(str(viser.__file__)).parent / "client" / "build" / "index.html").read_text(
        encoding="utf-8"
    )
    before, inserted, after = html.partition(client._WORKER)
    assert inserted
    assert before + after == own
    assert html.index("window.Worker=") < html.index("<script", html.index("window.Worker="))


def test_who_has_the_client_is_sent_nothing_and_who_reads_gzip_the_compressed_one():
    def asked(**headers: str) -> Any:
        request: Any = SimpleNamespace(
            headers={name.replace("_", "-"): value for name, value in headers.items()}
        )
        return text_response(request, client_served())

    compressed, etag = client_served().compressed, client_served().etag
    assert (asked().body, asked().headers["etag"]) == (client_served().plain, etag)
    small = asked(accept_encoding="br, gzip")
    assert (small.body, small.headers["content-encoding"], small.headers["vary"]) == (
        compressed,
        "gzip",
        "accept-encoding",
    )
    for known in (etag, f"W/{etag}", f'"x", {etag}'):
        again = asked(if_none_match=known)
        assert (again.status_code, again.body, again.headers["etag"]) == (304, b"", etag)
    assert asked(if_none_match='"x"').status_code == 200


@pytest.mark.parametrize("name", LIVE_FILES)
def test_a_bundle_has_its_files_one_after_the_other(name):
    served = bundle_served(name)
    text = served.plain.decode()
    assert text == bundle(name)
    assert served.media_type == {"css": "text/css", "js": "text/javascript"}[name.split(".")[1]]
    at = -1
    for file in BUNDLES[name]:
        if file == "math.css":
            assert text.endswith("math{font-family:'Workbench Math',math}")
            continue
        source = (STATIC / file).read_text(encoding="utf-8").splitlines()
        lines = [line.strip() for line in source if line.strip()[:2] not in ("", "//")]
        begin = text.find("\n".join(lines) + "\n")
        assert begin > at, file
        at = begin
    assert bundle_served(name).etag != client_served().etag


@pytest.mark.parametrize("content", [None, "", "<body></body>"])
def test_a_viser_without_a_client_is_refused_in_one_line(monkeypatch, tmp_path, content):
    monkeypatch.setattr(client, "viser_folder", lambda: tmp_path)
    client_html.cache_clear()
    if content is not None:
        build = tmp_path / "client" / "build"
        build.mkdir(parents=True)
        (build / "index.html").write_text(content)
    try:
        with pytest.raises(
            InputError, match=f"viser {viser.__version__} has no client .*install viser 1.1.1"
        ) as raised:
            client_html()
        assert "\n" not in str(raised.value)
    finally:
        client_html.cache_clear()
