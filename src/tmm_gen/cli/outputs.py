"""Files that commands write: checked before the work, and never over what somebody else keeps there."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import click

from tmm_gen.errors import UserError
from tmm_gen.files import require_target, write_tree_whole

__all__ = ["OutputFile", "OutputFolder", "OutputOf", "claim", "force_option", "require_new", "write_outputs"]

force_option = click.option("--force", is_flag=True, help="Replace what is there under that name.")
"""The option of commands that write scenes or sources; gives the argument ``force``."""


class OutputFile(click.Path):
    """A file to write, known to be none that must not be written before any work begins.

    Parameters
    ----------
    suffixes
        Endings that are allowed; any if empty.
    """

    def __init__(self, *suffixes: str) -> None:
        super().__init__(path_type=Path)
        self._suffixes = suffixes

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """Return the path, or say on one line why nothing can be written there."""
        path, option = Path(value), param.opts[-1] if param else "file"
        if not str(value) or "\0" in str(value):
            raise UserError(f"{option} {str(value)!r}: is no name of a file. Name one.")
        if self._suffixes and path.suffix.lower() not in self._suffixes:
            raise click.BadParameter(f"'{path}' must end in {', '.join(self._suffixes)}", param=param)
        try:
            target = require_target(path)
        except OSError as error:
            raise UserError(f"{option} {path}: {error.strerror}.") from None
        _require_place(target, f"{option} {path}")
        return path


class OutputFolder(click.Path):
    """A folder to write into, known to be none that cannot be before any work begins."""

    def __init__(self) -> None:
        super().__init__(file_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """Return the path, or say on one line why nothing can be written there."""
        folder = Path(os.fsdecode(super().convert(value, param, ctx)))
        _require_place(folder / "any", f"{param.opts[-1] if param else 'folder'} {folder}")
        return folder


class OutputOf(click.Path):
    """A folder to write into for some values of another option, which is read before it, and a file else.

    Parameters
    ----------
    option
        The other option's argument.
    folders
        Values that write a folder.
    """

    def __init__(self, option: str, folders: tuple[str, ...]) -> None:
        super().__init__(path_type=Path)
        self._option, self._folders = option, folders

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """Return the path, or say on one line why nothing can be written there."""
        folder = ctx is not None and ctx.params.get(self._option) in self._folders
        return (OutputFolder() if folder else OutputFile()).convert(value, param, ctx)


def _require_place(target: Path, where: str) -> None:
    """Refuse a file whose folder cannot take it; the innermost folder that exists decides."""
    folder = next((folder for folder in target.parents if folder.exists()), target.parent)
    if not folder.is_dir():
        raise UserError(f"{where}: {folder} is a file, not a folder. Name another place.")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise UserError(f"{where}: nothing can be written in {folder}. Name another place.")


def claim(outputs: Iterable[Path | None], inputs: Iterable[Path | None] = ()) -> None:
    """Refuse to write one file twice, or over one that is read.

    Raises
    ------
    UserError
        Naming the file.
    """
    read = {path.resolve() for path in inputs if path is not None and path.exists()}
    taken: set[Path] = set()
    for path in outputs:
        if path is None:
            continue
        target = require_target(path)
        if target in read:
            raise UserError(f"{path}: is read by this command and would be lost. Name another file.")
        if target in taken:
            raise UserError(f"{path}: is to be written twice. Name two files.")
        taken.add(target)


def require_new(path: Path | None, force: bool) -> None:
    """Refuse to replace a file before the work that would: what it holds may have taken long.

    Raises
    ------
    UserError
        If there is one, unless forced.
    """
    if path is not None and path.exists() and not force:
        raise UserError(f"{path}: exists already. Choose another name, or replace it with --force.")


def write_outputs(
    files: Mapping[Path, str | bytes], inputs: Iterable[Path | None] = (), *, force: bool | None = None
) -> list[Path]:
    """Write files, all or none, and say which folders had to be made.

    Parameters
    ----------
    files
        Content by path.
    inputs
        Files the command has read.
    force
        None where there is no such option: then a file that is there is replaced if it is of the kind of the new
        one, a former result. Otherwise, whether to replace any that differs.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    UserError
        If a file is in the way; nothing has changed then.
    OSError
        If one cannot be written; nothing has changed then.
    """
    claim(files, inputs)
    for path, content in files.items():
        if not force:
            _require_free(path, content.encode() if isinstance(content, str) else content, force)
    made = write_tree_whole(files)
    context = click.get_current_context(silent=True)
    if made and not (context and context.params.get("json_mode")):
        click.echo(f"made the folder {made[0]}")
    return list(files)


_HEAD = 4096


def _require_free(path: Path, content: bytes, force: bool | None) -> None:
    target = require_target(path)
    if not target.exists():
        return
    with target.open("rb") as file:
        head = file.read(_HEAD)
        same = (
            head == content[:_HEAD]
            and target.stat().st_size == len(content)
            and (head + file.read(len(content)) == content)
        )
    if same or (force is None and _alike(head, content[:_HEAD], path.suffix.lower())):
        return
    if force is None:
        raise UserError(f"{path}: is there and no {path.suffix} that tmm-gen wrote. Name another file.")
    raise UserError(f"{path}: exists already. Choose another name, or replace it with --force.")


def _alike(old: bytes, new: bytes, suffix: str) -> bool:
    """Whether a file begins as its successor does: an empty one, or a former result."""
    if not old:
        return True
    if suffix in (".png", ".gif", ".pdf", ".fmu"):
        return old[:4] == new[:4]
    if suffix in (".svg", ".html", ".xml"):
        return old[:64] == new[:64]
    return old.split(b"\n")[0].split(b",")[0].strip() == new.split(b"\n")[0].split(b",")[0].strip()
