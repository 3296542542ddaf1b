"""The quadratic programming solver that goes with emitted controllers: DAQP's core, with settings of its own."""

from __future__ import annotations

import re
from collections.abc import Iterable

from tmm_gen.emit.templates import render
from tmm_gen.resources import third_party_dir

CONFIG = "daqp_config.h"
"""Number type and names, read by all of the solver's sources."""
_GUARD = "# define DAQP_TYPES_H\n"
_FUNCTION = re.compile(r"\b(daqp_\w+|\w+_daqp_\w+|ldp2qp_\w+)\(")


def solver_files(name: str, single: bool) -> dict[str, str]:
    """Return the solver's files by path, all in ``daqp/``.

    Its sources stay as they are, but for one line that includes the settings: so they compile as they lie, in the
    right precision, and solvers of several controllers link in one program.

    Parameters
    ----------
    name : str
        Prefix of all its functions.
    single : bool
        Whether its numbers are ``float``.
    """
    folder = third_party_dir() / "daqp"
    files = {path.name: path.read_text() for part in ("src", "include") for path in (folder / part).iterdir()}
    types = files["types.h"]
    assert _GUARD in types, "daqp/include/types.h has no guard after which its settings could be included"
    files["types.h"] = types.replace(_GUARD, f'{_GUARD}\n#include "{CONFIG}"\n', 1)
    functions = _functions(text for path, text in files.items() if path.endswith(".h"))
    files[CONFIG] = render("control/daqp_config.h.jinja", name=name, single=single, functions=functions)
    files["LICENSE"] = (folder / "LICENSE").read_text()
    return {f"daqp/{path}": text for path, text in sorted(files.items())}


def _functions(headers: Iterable[str]) -> list[str]:
    """Return the names of all functions that headers declare."""
    return sorted({name for text in headers for name in _FUNCTION.findall(text)})
