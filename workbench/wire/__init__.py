"""A scene on its way to a page: what viser's client draws, as plain nodes and bytes, the same in
every home.

`primitives` and `stage` say what is drawn, by the words of viser's scene API, and `writer` makes
viser's messages of it; `nodes` keeps it; `packing` turns steps and runs into bytes; `client` is
viser's client. No viser server runs.
"""
