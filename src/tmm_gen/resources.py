"""Where the files that come with tmm-gen lie, installed from a wheel or in a source checkout."""

from __future__ import annotations

from pathlib import Path

__all__ = ["scenes_dir", "templates_dir", "third_party_dir"]

_PACKAGE = Path(__file__).resolve().parent


def _shipped(name: str) -> Path:
    """Find a shipped folder: inside the package (wheel), else at the root of the checkout."""
    candidates = (_PACKAGE / name, _PACKAGE.parents[1] / name)
    for folder in candidates:
        if folder.is_dir():
            return folder
    looked = " nor ".join(str(folder) for folder in candidates)
    raise FileNotFoundError(f"tmm-gen is installed without its {name}: neither {looked} is a folder")


def templates_dir() -> Path:
    """Return the folder of Jinja2 templates.

    Raises
    ------
    FileNotFoundError
        If the installation has lost it.
    """
    return _shipped("templates")


def scenes_dir() -> Path:
    """Return the folder of example scenes.

    Raises
    ------
    FileNotFoundError
        If the installation has lost it.
    """
    return _shipped("scenes")


def third_party_dir() -> Path:
    """Return the folder of sources by others, each with its licence.

    Raises
    ------
    FileNotFoundError
        If the installation has lost it.
    """
    return _shipped("third_party")
