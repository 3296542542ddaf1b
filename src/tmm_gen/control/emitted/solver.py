"""The quadratic programming solver that goes with emitted controllers: DAQP's core."""

from __future__ import annotations

from tmm_gen.resources import third_party_dir

SOURCES = ("daqp.c", "auxiliary.c", "factorization.c")


def solver_files() -> dict[str, str]:
    """Return the solver's files by path, all in ``daqp/``."""
    folder = third_party_dir() / "daqp"
    files = {path.name: path.read_text() for part in ("src", "include") for path in (folder / part).iterdir()}
    files["LICENSE"] = (folder / "LICENSE").read_text()
    return {f"daqp/{name}": text for name, text in sorted(files.items())}
