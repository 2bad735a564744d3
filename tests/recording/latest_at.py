"""What a viewer shows of a recording at a step: the latest value of every component, with Clear
taken into account.
"""

from pathlib import Path
from typing import Any

from workbench.recording.read import read_chunks

Shown = dict[str, dict[str, Any]]


def rows(path: Path) -> list[tuple[int, bytes, str, dict[str, Any]]]:
    """Return every logged row in the order in which it counts: step (-1 for static), row id,
    entity, components.
    """
    logged = []
    for chunk in read_chunks(path):
        columns = chunk.to_record_batch().to_pydict()
        ids = columns.pop("rerun.controls.RowId")
        steps = columns.pop("step", [-1] * len(ids))
        for i, (row_id, step) in enumerate(zip(ids, steps, strict=True)):
            components = {
                name: column[i] for name, column in columns.items() if column[i] is not None
            }
            logged.append((step, bytes(row_id), chunk.entity_path, components))
    return sorted(logged, key=lambda row: row[:3])


def shown_at(
    path: Path,
    step: int,
    below: tuple[str, ...] = ("/world", "/pictures", "/charts", "/tables", "/legend"),
):
    """Return what is shown at a step, by entity and component, class ids by their name and
    colour.
    """
    shown: Shown = {}
    table: dict[int, Any] = {}
    for at, _, entity, components in rows(path):
        if at > step or not entity.startswith(below):
            continue
        if "Clear:is_recursive" in components:
            assert components["Clear:is_recursive"] == [False]
            assert "EncodedImage:blob" not in shown.pop(entity, {}), "Rerun's viewer overlooks this"
            continue
        if "AnnotationContext:context" in components:
            infos = components["AnnotationContext:context"][0]
            table = {info["class_id"]: info["class_description"]["info"] for info in infos}
            continue
        if components.get("EncodedImage:blob") == []:
            shown.pop(entity, None)
            continue
        shown.setdefault(entity, {}).update(components)
    for components in shown.values():
        for name, values in components.items():
            if name.endswith("class_ids"):
                components[name] = [(table[i]["label"], table[i]["color"]) for i in values]
    return shown
