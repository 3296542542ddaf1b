"""Words that names in a scene must not be: taken in some language, file system, or in the generated code."""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


TIME = "time"
"""The clock of a simulation: a column of every CSV file and a variable of every functional mock-up unit."""

MODULES_AND_HEADERS = _words(
    """
    numpy math scipy sympy matplotlib casadi pydantic click jinja2 tmm_gen main test assert complex ctype errno fenv
    inttypes iso646 limits locale setjmp signal stdarg stdbool stddef stdint stdio stdlib string tgmath
    time wchar wctype aux con nul prn
    """
)
"""Would hide a package or C header; or no file of that name can exist on some system."""
