"""Reading scene files."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from os import PathLike
from pathlib import Path

from tmm_gen.reading import read_file
from tmm_gen.scene.change import plain, present
from tmm_gen.scene.check import check_data
from tmm_gen.scene.locate import locate
from tmm_gen.scene.problem import Path as KeyPath
from tmm_gen.scene.problem import Problem, SceneError, show_path
from tmm_gen.scene.scene import Scene
from tmm_gen.scene.source import Source
from tmm_gen.scene.syntax import syntax_problem
from tmm_gen.trusted import digest_of


def load_scene(path: str | PathLike[str]) -> Scene:
    """Read and check a scene file.

    Parameters
    ----------
    path : str or path-like
        A TOML file in UTF-8, with or without byte order mark.

    Returns
    -------
    Scene
        The scene.

    Raises
    ------
    SceneError
        If the file cannot be read or is not a valid scene; ``problems`` says where and what to do.
    """
    path = Path(path)
    origin = str(path)
    try:
        content = read_file(path)
    except FileNotFoundError:
        raise _unreadable(origin, "no such file", _missing_file_remedy(path)) from None
    except IsADirectoryError:
        raise _unreadable(origin, "is a directory", "Name a scene file in it.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise _unreadable(
            origin, f"cannot be read: {reason}", "Check the path and its permissions."
        ) from None
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        byte = f"byte 0x{content[error.start]:02X}"
        raise SceneError(
            [Problem(origin, line, "", None, f"is not UTF-8 text ({byte})", "Save the file as UTF-8.")]
        ) from None
    return _parsed(text, origin, digest_of(content))


def parse_scene(text: str, origin: str = "<string>") -> Scene:
    """Check the text of a scene file.

    Parameters
    ----------
    text : str
        TOML.
    origin : str
        Name used in errors.

    Returns
    -------
    Scene
        The scene.

    Raises
    ------
    SceneError
        If the text is not a valid scene.
    """
    return _parsed(text, origin)


def _parsed(text: str, origin: str, written: str = "") -> Scene:
    """Check the text of a scene file whose bytes have a digest."""
    try:
        data = tomllib.loads(text)
        source = Source(origin, data, locate(text), check_data, written)
    except RecursionError:
        problem = Problem(origin, 1, "", None, "is nested too deeply", "Remove superfluous brackets.")
        raise SceneError([problem]) from None
    except ValueError as error:  # syntax, or an integer of thousands of digits
        raise SceneError([syntax_problem(text, origin, error)]) from None
    return check_data(source)


def scene_from(tables: Mapping[str, object], origin: str | None = None) -> Scene:
    """Check what a scene file would hold, given as tables.

    Parameters
    ----------
    tables : mapping from str to object
        Values by key as TOML has them; NumPy's numbers and arrays, and tuples, are taken as numbers and lists. A key
        whose value is None counts as absent.
    origin : str, optional
        Name used in errors; by default that of the arm.

    Returns
    -------
    Scene
        The scene.

    Raises
    ------
    SceneError
        If the tables are not a valid scene.
    """
    name = tables.get("name")
    origin = origin or (f"arm '{name}'" if isinstance(name, str) else "arm")
    try:
        data = present(plain(tables))
        faults = [Problem(origin, 0, show_path(path), *told) for path, told in _unlike_toml(data, ())]
        if faults:
            raise SceneError(faults)
        return check_data(Source(origin, data, {(): 0}, check_data))  # no line of any file
    except RecursionError:
        remedy = "Give tables of numbers, texts and lists."
        raise SceneError([Problem(origin, 0, "", None, "is nested too deeply", remedy)]) from None


def _unlike_toml(value: object, path: KeyPath) -> Iterator[tuple[KeyPath, tuple[object, str, str]]]:
    """Yield value, fault and remedy of what no TOML file could say and the checks of tables would take."""
    if isinstance(value, dict):
        for key, item in value.items():
            if isinstance(key, str):
                yield from _unlike_toml(item, (*path, key))
            else:
                yield path, (key, "has a key that is no text", "Give keys as texts: {'length': 1.0}.")
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _unlike_toml(item, (*path, number))
    elif isinstance(value, bytes):
        yield path, (str(value), "must be text, not bytes", "Leave the b before the quotes out.")


def _unreadable(origin: str, message: str, remedy: str) -> SceneError:
    return SceneError([Problem(origin, 0, "", None, message, remedy)])


def _missing_file_remedy(path: Path) -> str:
    """Suggest a scene that exists, or how to make one."""
    near: list[str] = []
    if path.parent.is_dir():
        near = get_close_matches(path.name, [item.name for item in path.parent.glob("*.toml")], n=1)
    if near:
        return f"Did you mean '{path.parent / near[0]}'?"
    return f"Check the path, or make a scene by `tmm-gen new {path.stem or 'NAME'}`."
