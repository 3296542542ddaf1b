"""The text of a URDF file, expanded where it is written in xacro."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.extras import install
from tmm_gen.reading import read_file


def content_of(path: Path) -> tuple[bytes, str]:
    """Return the content of a URDF file, and what to call it in errors.

    Parameters
    ----------
    path : Path
        The file; ``.xacro`` at the end of its name says that it is to be expanded.

    Returns
    -------
    tuple of bytes and str
        XML; and the file's name, with a word that lines are those of the expanded text where they are.

    Raises
    ------
    UserError
        If it cannot be read or expanded.
    """
    try:
        content = read_file(path)
    except FileNotFoundError:
        raise UserError(f"{path}: no such file. Check the path.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UserError(f"{path}: {reason}. Name a URDF file that can be read.") from None
    if path.suffix.lower() != ".xacro":
        return content, str(path)
    return _expanded(path), f"{path} (expanded)"


def _expanded(path: Path) -> bytes:
    """Return what xacro makes of a file."""
    by_hand = f"`xacro {path} > {path.with_suffix('').with_suffix('.urdf').name}`"
    try:
        xacro = import_module("xacro")
    except ImportError:
        raise UserError(
            f"{path}: is xacro, and the package xacro is not installed: {install('xacro')}. Or expand it elsewhere by "
            f"{by_hand}, and import that."
        ) from None
    try:
        text: str = xacro.process_file(str(path)).toxml()
    except Exception as error:  # whatever macros do
        said = " ".join(str(error).split()) or type(error).__name__
        raise UserError(f"{path}: xacro cannot expand it: {said}. See what {by_hand} says.") from None
    return text.encode()
