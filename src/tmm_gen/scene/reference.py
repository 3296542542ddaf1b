"""Every key a scene may have, read off the tables themselves: what `tmm-gen keys` and the documentation list."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

from annotated_types import Ge, Gt, Le, Lt
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from tmm_gen.scene.document import Document
from tmm_gen.scene.each import OneOrEach
from tmm_gen.scene.integrator import INTEGRATOR_NAMES, METHODS
from tmm_gen.scene.parts.document import PARTS, ChainDocument, PartsDocument
from tmm_gen.scene.spatial.document import SPATIAL_PARTS, SpatialDocument
from tmm_gen.scene.spatial.settings import SpatialBase, SpatialModel
from tmm_gen.scene.table import Table, file_keys, hidden


@dataclass(frozen=True)
class Key:
    """One key of a scene file.

    Parameters
    ----------
    table : str
        Header it stands under, with its brackets; empty above the first table.
    key : str
        Its name.
    value : str
        What may be written, in words.
    default : str or None
        What its absence means; None if it must be there. Empty where absence means that nothing is modelled.
    meaning : str
        With its unit.
    example : str
        A value as written, where the declaration has one.
    """

    table: str
    key: str
    value: str
    default: str | None
    meaning: str
    example: str


def keys() -> Iterator[Key]:
    """Yield every key, in the order of a scene file."""
    yield from _keys_of(Document, "")
    for name in PARTS:
        table = _table_in(PartsDocument.model_fields[name].annotation)
        assert table is not None
        yield from _table_keys(table, f"[[{name}]] by name")
    for name in ("joint", "link"):
        table = _table_in(ChainDocument.model_fields[name].annotation)
        assert table is not None
        yield from _table_keys(table, f"[[{name}]] by name in a chain")
    yield from _table_keys(SpatialModel, "[model] in space")
    yield from _table_keys(SpatialBase, "[base] in space")
    for name in (*SPATIAL_PARTS, "input", "output"):
        table = _table_in(SpatialDocument.model_fields[name].annotation)
        assert table is not None
        yield from _table_keys(table, f"[[{name}]] in space")


def _table_keys(model: type[Table], header: str) -> Iterator[Key]:
    """Yield the keys of one table that are not tables themselves."""
    for name, field in file_keys(model).items():
        if _table_in(field.annotation) is None and not hidden(field):
            example = str(field.examples[0]) if field.examples else ""
            named = header == "[integrator]" and name == "name"
            yield Key(
                table=header,
                key=name,
                value=", ".join(f'"{n}"' for n in INTEGRATOR_NAMES) if named else _value(field, example),
                default=_default(field),
                meaning=field.description or "",
                example=example,
            )


def _keys_of(model: type[Table], path: str) -> Iterator[Key]:
    header = path and (f"[[{path}]]" if _repeated(path) else f"[{path}]")
    yield from _table_keys(model, header)
    if path == "integrator":
        yield from _integrator_keys(header)
    for name, field in model.model_fields.items():
        inner = _table_in(field.annotation)
        if inner is not None:
            yield from _keys_of(inner, f"{path}.{name}" if path else name)


def _integrator_keys(header: str) -> Iterator[Key]:
    """Yield the integrators' own parameters, which their names decide on."""
    for method in METHODS:
        for parameter in method.parameters:
            yield Key(
                table=header,
                key=parameter.name,
                value=f"number, {parameter.range}",
                default=f"{parameter.default:.4g}",
                meaning=f"parameter of {method.name}",
                example=f"{parameter.default:.4g}",
            )


def _repeated(path: str) -> bool:
    table: type[Table] = Document
    *outer, last = path.split(".")
    for name in outer:
        inner = _table_in(table.model_fields[name].annotation)
        assert inner is not None
        table = inner
    field = table.model_fields.get(last)
    return field is not None and field.default == ()


def _table_in(annotation: Any) -> type[Table] | None:
    if isinstance(annotation, type) and issubclass(annotation, Table):
        return annotation
    return next((found for a in get_args(annotation) if (found := _table_in(a)) is not None), None)


def _default(field: FieldInfo) -> str | None:
    if field.is_required():
        return None
    if isinstance(field.json_schema_extra, dict) and "absent" in field.json_schema_extra:
        return str(field.json_schema_extra["absent"])
    value = field.get_default(call_default_factory=False)
    positive = any(isinstance(item, Gt) for item in field.metadata)
    if value is None or value is PydanticUndefined or value in ((), "") or (positive and value == 0):
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return "[" + ", ".join(f'"{item}"' if isinstance(item, str) else f"{item:g}" for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"


def _value(field: FieldInfo, example: str) -> str:
    """Say what may be written, from the type and its bounds."""
    for item in (*field.metadata, *_metadata(field.annotation)):
        if isinstance(of := getattr(item, "func", None), OneOrEach):
            return f"{_value(FieldInfo.from_annotation(of.kind), example)}, or one by each name"
    words = [w for w in _leaves(field.annotation) if isinstance(w, str)]
    if words:
        choices = ", ".join(f'"{word}"' for word in words)
        numbered = any(leaf is int for leaf in _leaves(field.annotation))
        return choices + (", or a number" if numbered else "")
    if numbers := [n for n in _leaves(field.annotation) if isinstance(n, int) and not isinstance(n, bool)]:
        return ", ".join(map(str, numbers))
    kinds = [leaf for leaf in _leaves(field.annotation) if isinstance(leaf, type)]
    if bool in kinds:
        return "true, false"
    bounds = " and ".join(_bounds((*field.metadata, *_metadata(field.annotation))))
    if dict in kinds and not example:
        return "table"
    if tuple in kinds or list in kinds:
        return f"as `{example}`"
    if int in kinds:
        return f"whole number {bounds}".strip()
    if float in kinds:
        return f"number {bounds}".strip()
    return "text"


def _leaves(annotation: Any) -> Iterator[Any]:
    """Yield the types and the literal words and numbers an annotation is made of, outermost first."""
    origin = getattr(annotation, "__origin__", None)
    if isinstance(annotation, type | str | int):
        yield annotation
    elif isinstance(origin, type) and origin in (tuple, list, dict):
        yield origin
        return
    for argument in get_args(annotation):
        yield from _leaves(argument)


def _metadata(annotation: Any) -> tuple[Any, ...]:
    found: tuple[Any, ...] = ()
    for argument in get_args(annotation):
        for item in getattr(argument, "__metadata__", ()):
            found += tuple(getattr(item, "metadata", (item,)))
        found += _metadata(argument)
    return found


def _bounds(metadata: tuple[Any, ...]) -> Iterator[str]:
    for item in metadata:
        if isinstance(item, Gt):
            yield f"above {item.gt:g}"
        elif isinstance(item, Ge):
            yield f"from {item.ge:g}"
        elif isinstance(item, Lt):
            yield f"below {item.lt:g}"
        elif isinstance(item, Le):
            yield f"up to {item.le:g}"


def markdown() -> str:
    """Return all keys as the tables of a Markdown page, one for each table of a scene file."""
    lines: list[str] = []
    last = None
    for key in keys():
        if key.table != last:
            header, *words = key.table.split(" ", 1)
            heading = " ".join([f"`{header}`", *words]) if header else "Above the first table"
            lines += ["", f"### {heading}", "", "| key | value | if absent | meaning |", "|---|---|---|---|"]
            last = key.table
        absent = (
            "*must be there*"
            if key.default is None
            else f"`{key.default}`"
            if key.default
            else "not modelled"
        )
        lines.append(f"| `{key.key}` | {key.value} | {absent} | {key.meaning} |")
    return "\n".join(lines).strip() + "\n"
