"""The same chunks and id for the same content; rerun gives ids of the moment, and cuts by time.

Rows are put together, one chunk per entity, ordered and numbered by step and then as they were
logged. The recording's id is made from the content. What is left to chance is the index that rerun
writes at a file's end, and the id of its layout.
"""

import tempfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any

import pyarrow as pa
from rerun.chunk import Chunk, RrdReader

ROW_ID = "rerun.controls.RowId"
_KINDS = {b"control": 0, b"index": 1, b"data": 2}


def tidied(data: bytes) -> list[pa.Table]:
    """Return a file's one recording or layout: a table per entity, static ones apart."""
    with _as_file(data) as file:
        reader = RrdReader(file)
        stores = [*reader.recordings(), *reader.blueprints()]
        return list(_tidied([chunk for store in stores for chunk in reader.stream(store=store)]))


def _tidied(chunks: Iterable[Any]) -> Iterator[pa.Table]:
    batches: dict[tuple[str, bool], list[pa.RecordBatch]] = {}
    for chunk in chunks:
        batches.setdefault((chunk.entity_path, chunk.is_static), []).append(chunk.to_record_batch())
    tables = [_joined(batches[key]) for key in sorted(batches)]
    rows = sorted((*row, i) for i, table in enumerate(tables) for row in _order(table))
    number = {(row_id, i): n.to_bytes(16, "big") for n, (_, row_id, i) in enumerate(rows, 1)}
    for i, table in enumerate(tables):
        field = table.schema.field(ROW_ID)
        ids = pa.array([number[row_id, i] for _, row_id in _order(table)], field.type)
        about = {**(table.schema.metadata or {}), b"rerun:id": f"chunk_{i + 1:032X}".encode()}
        table = table.set_column(
            table.column_names.index(ROW_ID), field, ids
        ).replace_schema_metadata(about)
        yield table.sort_by(ROW_ID).combine_chunks()


def _joined(batches: Sequence[pa.RecordBatch]) -> pa.Table:
    """Return the rows of chunks as one table, its columns in the order that rerun wants."""
    table = pa.concat_tables(
        [pa.Table.from_batches([batch]) for batch in batches], promote_options="default"
    )
    table = table.replace_schema_metadata(batches[0].schema.metadata)
    return table.select(
        sorted(table.column_names, key=lambda name: (_KINDS[_kind(table, name)], name))
    )


def _order(table: pa.Table) -> list[tuple[int, bytes]]:
    """Return what orders the rows: step, then moment of logging; Rerun takes both for sorted."""
    ids = table.column(ROW_ID).to_pylist()
    times = [name for name in table.column_names if _kind(table, name) == b"index"]
    return list(
        zip(table.column(times[0]).to_pylist() if times else [-1] * len(ids), ids, strict=True)
    )


def _kind(table: pa.Table, name: str) -> bytes:
    return (table.schema.field(name).metadata or {})[b"rerun:kind"]


def chunks_of(tables: Iterable[pa.Table]) -> list[Any]:
    """Return rerun's chunks of such tables."""
    return [chunk for table in tables for chunk in Chunk.from_record_batch(table.to_batches()[0])]


def id_of(tables: Sequence[pa.Table]) -> str:
    """Return an id made from the content of all tables."""
    told = sha256()
    for table in tables:
        told.update(repr(sorted((table.schema.metadata or {}).items())).encode())
        bare = pa.schema([pa.field(field.name, field.type) for field in table.schema])
        told.update(
            repr([sorted((field.metadata or {}).items()) for field in table.schema]).encode()
        )
        told.update(pa.table(table.columns, schema=bare).to_batches()[0].serialize())
        told.update(str(bare).encode())
    return told.hexdigest()[:32]


def equal_content(a: bytes, b: bytes) -> bool:
    """Return whether two recordings that we wrote have the same content."""
    return id_in(a) == id_in(b)


def id_in(data: bytes) -> str:
    """Return the id of a recording that we wrote."""
    with _as_file(data) as file:
        return RrdReader(file).recordings()[0].recording_id


@contextmanager
def _as_file(data: bytes) -> Iterator[Path]:
    """Yield a file with these bytes: rerun reads nothing else."""
    with tempfile.TemporaryDirectory(prefix="workbench-") as folder:
        file = Path(folder) / "stream.rrd"
        file.write_bytes(data)
        yield file
