"""The headers of the FMI standard, which come with FMPy under the 2-clause BSD licence."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.export.fmu.identity import FmiVersion
from tmm_gen.extras import extra

_NAMES: dict[FmiVersion, tuple[str, ...]] = {
    2: ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"),
    3: ("fmi3Functions.h", "fmi3FunctionTypes.h", "fmi3PlatformTypes.h"),
}


def require_fmpy() -> None:
    """Refuse to go on without FMPy.

    Raises
    ------
    UserError
        If it is not installed.
    """
    extra("fmu", "a functional mock-up unit, for the headers of FMI and to validate the result,")


def fmi_headers(version: FmiVersion) -> dict[str, str]:
    """Return the headers of a version of FMI, text by name.

    Raises
    ------
    UserError
        If FMPy is not installed, or lacks them.
    """
    require_fmpy()
    spec = find_spec("fmpy")
    assert spec is not None
    assert spec.origin is not None
    folder = Path(spec.origin).parent / "c-code"
    try:
        return {name: (folder / name).read_text(encoding="utf-8") for name in _NAMES[version]}
    except FileNotFoundError as error:
        raise UserError(
            f"FMPy lacks {error.filename}. Install another version: pip install --upgrade fmpy"
        ) from error


def licence_of(headers: dict[str, str]) -> str:
    """Return the licence that stands at the head of the headers, for the unit's documentation."""
    text = next(iter(headers.values()))
    start = text.index("Copyright (C)")
    end = text.index("*/", start)
    lines = [line.strip() for line in text[start:end].strip().splitlines()]
    return "The headers of FMI in sources/ come with this notice:\n\n" + "\n".join(lines) + "\n"
