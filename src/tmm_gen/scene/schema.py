"""A JSON schema of scene files, by which editors complete keys, show what they mean, and mark what is wrong."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import BaseModel
from pydantic.json_schema import models_json_schema

from tmm_gen.scene.document import Document
from tmm_gen.scene.integrator import INTEGRATOR_NAMES, METHODS
from tmm_gen.scene.parts.document import ChainDocument, PartsDocument
from tmm_gen.scene.spatial.document import SpatialDocument

SCHEMA_FILE = "tmm-gen.schema.json"
"""Its usual name; `tmm-gen new` points to it where it lies in the scene's folder."""

DIRECTIVE = f"#:schema {SCHEMA_FILE}\n"
"""The first line of a scene by which editors find it."""

DOCUMENTS: Sequence[type[BaseModel]] = (Document, ChainDocument, PartsDocument, SpatialDocument)
"""What a file may be: joints and links, a chain of parts by name, an arm of them, parts in space."""


def scene_schema() -> dict[str, Any]:
    """Return the schema, ready for JSON.

    It knows the keys of every table, their types and bounds. How tables must fit together it does not know; `tmm-gen
    explain` and all other commands say that.
    """
    places, rest = models_json_schema([(model, "validation") for model in DOCUMENTS])
    definitions = rest["$defs"]
    for table in _tables(definitions):
        _without_hidden(table)
    _with_methods(definitions["IntegratorTable"])
    plain, chain, parts, space = ({**places[model, "validation"]} for model in DOCUMENTS)
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A scene of tmm-gen",
        "type": "object",
        # one of these alone is asked, so that an editor marks the key at fault and not the whole file
        "if": _kind("spatial"),
        "then": space,
        "else": {
            "if": {"anyOf": _BY_PARTS},
            "then": {"if": _kind("chain"), "then": chain, "else": parts},
            "else": plain,
        },
        "$defs": definitions,
    }


def _kind(name: str) -> dict[str, Any]:
    """Return what holds for a file of a kind of model."""
    model = {"type": "object", "properties": {"kind": {"const": name}}, "required": ["kind"]}
    return {"properties": {"model": model}, "required": ["model"]}


_NAMED = {"type": "array", "contains": {"anyOf": [{"required": [key]} for key in ("name", "on")]}}

_BY_PARTS: list[dict[str, Any]] = [
    *({"required": [table]} for table in ("motor", "gear", "body")),
    {"properties": {"beam": {"type": "array"}}, "required": ["beam"]},
    *({"properties": {table: _NAMED}, "required": [table]} for table in ("joint", "link")),
]
"""What holds for files of parts by name, as :func:`~tmm_gen.scene.parts.document.by_parts` asks it."""


def _with_methods(table: dict[str, Any]) -> None:
    """Name the integrators and their parameters, which a table takes by the method it names."""
    properties = table["properties"]
    properties["name"] |= {"anyOf": [{"enum": [*INTEGRATOR_NAMES]}, {"type": "string"}]}
    for method in METHODS:
        for parameter in method.parameters:
            properties[parameter.name] = {
                "type": "number",
                "description": f"of {', '.join(_users(parameter.name))}",
            }
    table["additionalProperties"] = False


def _users(parameter: str) -> Iterator[str]:
    return (each.name for each in METHODS if parameter in (own.name for own in each.parameters))


def _tables(value: Any) -> Iterator[dict[str, Any]]:
    """Yield all objects of a schema that have properties."""
    if isinstance(value, dict):
        if isinstance(value.get("properties"), dict):
            yield value
        for each in value.values():
            yield from _tables(each)
    elif isinstance(value, list):
        for each in value:
            yield from _tables(each)


def _without_hidden(table: dict[str, Any]) -> None:
    """Remove keys that are declared only to be refused in words of their own, and what tells Python's readers."""
    known = {key: field for key, field in table["properties"].items() if not field.get("hidden")}
    for field in known.values():
        # examples are words of TOML, which are none of JSON
        field.pop("examples", None)
        field.pop("title", None)
    table["properties"] = known
    table.pop("title", None)
    table.pop("description", None)
