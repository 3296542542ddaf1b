"""From what pydantic finds to what a user can act on."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from tmm_gen.scene.document import Document
from tmm_gen.scene.nonlinear import nonlinear
from tmm_gen.scene.problem import Finding, Path, show_path
from tmm_gen.scene.table import Table, closest, file_keys, hidden

_COMPARISONS = {
    "greater_than": ("gt", "greater than"),
    "greater_than_equal": ("ge", "at least"),
    "less_than": ("lt", "less than"),
    "less_than_equal": ("le", "at most"),
}


def findings(error: ValidationError, document: type[Document]) -> list[Finding]:
    """Return one finding per fault pydantic reports.

    Parameters
    ----------
    error : pydantic.ValidationError
        Raised by ``document.model_validate``.
    document : type
        How the file writes its arm.

    Returns
    -------
    list of Finding
        In pydantic's order.
    """
    return [_finding(details, document) for details in error.errors(include_url=False)]


def _finding(details: ErrorDetails, document: type[Document]) -> Finding:
    path, value, kind = details["loc"], details["input"], details["type"]
    context: dict[str, Any] = details.get("ctx", {})
    owner, field = _declared(path, document)
    if kind == "scene":
        return Finding(path, context["problem"], context["remedy"], value)
    if kind == "missing":
        return Finding(path, "is missing", _missing_remedy(path, field))
    if kind == "extra_forbidden":
        return Finding(path, *_unknown_key(path, owner, value, document), value)
    if kind == "literal_error":
        choices = [str(choice) for choice in _literals(field)]
        numbers = all(choice.isdecimal() for choice in choices)  # of which none is meant for another
        remedy = f"Choose one of {', '.join(choices)}." if numbers else closest(value, choices)
        return Finding(path, "is not one of the choices", remedy, value)
    if kind in _COMPARISONS:
        name, words = _COMPARISONS[kind]
        return Finding(path, f"must be {words} {context[name]:g}", _example(path, field), value)
    if kind in ("float_type", "int_type"):
        whole = kind == "int_type"
        message = "must be a whole number" if whole else "must be a number"
        remedy = "Remove the quotes." if _quoted_number(value, whole) else _example(path, field)
        return Finding(path, message, remedy, value)
    if kind == "finite_number":
        return Finding(path, "must be finite", _example(path, field), value)
    if kind == "string_type":
        return Finding(path, "must be text in quotes", _example(path, field), value)
    if kind == "tuple_type":
        return Finding(path, *_not_a_list(path, field), value)
    if kind in ("model_type", "dict_type"):
        return Finding(path, *_not_a_table(path, value), value)
    return Finding(path, details["msg"], _example(path, field), value)


def _declared(path: Path, document: type[Document]) -> tuple[type[Table], FieldInfo | None]:
    """Return the table model in which the last key of a path stands, and its declaration if there is one."""
    owner: type[Table] = document
    field: FieldInfo | None = None
    for part in path:
        if isinstance(part, int):
            continue
        if field is not None:
            owner = next(_tables_in(field.annotation), owner)
        field = file_keys(owner).get(part)
        if field is None:
            break
    return owner, field


def _tables_in(annotation: Any) -> Iterator[type[Table]]:
    """Yield the table models inside an annotation such as ``tuple[Link, ...]`` or ``Beam | None``."""
    if isinstance(annotation, type) and issubclass(annotation, Table):
        yield annotation
    for argument in get_args(annotation):
        yield from _tables_in(argument)


def _literals(field: FieldInfo | None) -> Iterator[object]:
    """Yield the words and numbers an annotation allows, however deep they stand."""

    def walk(annotation: Any) -> Iterator[object]:
        for argument in get_args(annotation):
            if isinstance(argument, str | int):
                yield argument
            else:
                yield from walk(argument)

    yield from walk(field.annotation if field else None)


def _is_array_of_tables(field: FieldInfo | None) -> bool:
    return field is not None and field.default == () and next(_tables_in(field.annotation), None) is not None


def _example(path: Path, field: FieldInfo | None) -> str:
    """Return a remedy which shows the key as it could be written."""
    if field is None or not field.examples:
        return "See the description of the scene file."
    key = next(part for part in reversed(path) if isinstance(part, str))
    return f"Write for example `{key} = {field.examples[0]}` ({field.description})."


def _missing_remedy(path: Path, field: FieldInfo | None) -> str:
    """Return a remedy which shows the missing key or table."""
    if field is None:
        return "Add it."
    example = field.examples[0] if field.examples else ""
    if next(_tables_in(field.annotation), None):
        return f"Add the table [{show_path(path)}] ({field.description}) with for example `{example}`."
    return f"Add for example `{path[-1]} = {example}` ({field.description})."


def _unknown_key(path: Path, owner: type[Table], value: object, document: type[Document]) -> tuple[str, str]:
    """Return message and remedy for a key which its table does not know."""
    key, known = str(path[-1]), [name for name, field in file_keys(owner).items() if not hidden(field)]
    where = _header(path[:-1])
    message = f"is not a key of {where}"
    if path[0] in ("joint", "gear", "motor") and (told := nonlinear(key)) is not None:
        return told
    if elsewhere := _tables_with(key, isinstance(value, dict | list), document):
        return message, f"It belongs {elsewhere}."
    if near := get_close_matches(key.replace("-", "_"), known, n=1, cutoff=0.6):
        return message, f"Did you mean '{near[0]}'?"
    return message, f"Keys of {where} are {', '.join(known)}."


def _header(path: Path) -> str:
    """Return the header of the table at a path as the file has it."""
    if not path:
        return "a scene"
    name = ".".join(part for part in path if isinstance(part, str))
    return f"[[{name}]]" if isinstance(path[-1], int) else f"[{name}]"


def _tables_with(key: str, nested: bool, document: type[Document]) -> str:
    """Say in which tables a misplaced key is known; empty where there is none."""
    if key in document.model_fields:
        field = document.model_fields[key]
        if next(_tables_in(field.annotation), None) is None:
            return "above the first table"
        if nested:
            return (
                f"at the top level, as {'[[' + key + ']]' if _is_array_of_tables(field) else '[' + key + ']'}"
            )
    headers = []
    for name, field in document.model_fields.items():
        table = next(_tables_in(field.annotation), None)
        if table is not None and key in file_keys(table):
            headers.append(f"[[{name}]]" if _is_array_of_tables(field) else f"[{name}]")
    return f"in {' or '.join(headers)}" if 0 < len(headers) <= 3 else ""


def _quoted_number(value: object, whole: bool) -> bool:
    if not isinstance(value, str):
        return False
    try:
        int(value) if whole else float(value)
    except ValueError:
        return False
    return True


def _not_a_list(path: Path, field: FieldInfo | None) -> tuple[str, str]:
    if _is_array_of_tables(field):
        return "must be an array of tables", f"Write {_header((*path, 0))} with double brackets."
    return "must be a list", _example(path, field)


def _not_a_table(path: Path, value: object) -> tuple[str, str]:
    header = _header(path)
    if isinstance(value, list):
        return "must be one table", f"Write {header} with single brackets, once."
    return "must be a table", f"Write the header {header} on a line of its own, and its keys below."
