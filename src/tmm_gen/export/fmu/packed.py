"""A functional mock-up unit for co-simulation, whatever it holds: description, sources and binary in one file."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from tmm_gen.emit.templates import render
from tmm_gen.export.fmu.archive import archive
from tmm_gen.export.fmu.description2 import description2
from tmm_gen.export.fmu.description3 import build_description, description3
from tmm_gen.export.fmu.headers import fmi_headers, licence_of, require_fmpy
from tmm_gen.export.fmu.identity import FmiVersion, Identity
from tmm_gen.export.fmu.variables import FmuVariable
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.scratch import scratch_folder

_HIDDEN = "-fvisibility=hidden"
"""The unit's own functions are nobody's business, so that units can be loaded side by side."""


@dataclass(frozen=True, eq=False)
class UnitContent:
    """What is in a unit behind the functions of FMI.

    Parameters
    ----------
    name, title : str
        An identifier of C; one line.
    step : float
        Between internal steps, s.
    variables : tuple of FmuVariable
        In the order of their numbers from 1; in FMI 2.0 single numbers.
    sources : mapping of str to str
        C files by name, all in one folder.
    instance : callable
        Returns ``fmi-instance.h`` and ``fmi-instance.c``, which answer the functions of FMI, for a token.
    held : bool
        Whether communication steps may be shorter than internal ones, over which outputs are held, and not longer;
        else they are whole multiples.
    licences : mapping of str to str
        Of what others wrote, by file name, besides that of FMI's headers.
    """

    name: str
    title: str
    step: float
    variables: tuple[FmuVariable, ...]
    sources: Mapping[str, str]
    instance: Callable[[str], dict[str, str]]
    held: bool = False
    licences: Mapping[str, str] = field(default_factory=dict)

    def filled(self, version: FmiVersion) -> tuple[dict[str, str], Identity]:
        """Return all C files by name, and the identity they prove."""
        blank = self._with_token("", version)
        names = tuple(sorted(name for name in blank if name.endswith(".c")))
        told = _description(version)(self._identity("", names), self.variables)
        content = repr((sorted(blank.items()), told))
        token = "{" + _uuid(hashlib.sha256(content.encode()).hexdigest()) + "}"
        return self._with_token(token, version), self._identity(token, names)

    def _with_token(self, token: str, version: FmiVersion) -> dict[str, str]:
        functions = {"fmi-functions.c": render(f"fmu/fmi-{version}.c.jinja", name=self.name)}
        return {**self.sources, **self.instance(token), **functions}

    def _identity(self, token: str, names: tuple[str, ...]) -> Identity:
        return Identity(self.name, self.title, token, self.step, names, self.held)


def packed_unit(content: UnitContent, version: FmiVersion, cc: str) -> bytes:
    """Return a unit, validated.

    Parameters
    ----------
    content : UnitContent
        What is in it.
    version : {2, 3}
        Of FMI: 2.0 or 3.0.
    cc : str
        Compiler of the binary, which is for the machine this runs on.

    Returns
    -------
    bytes
        Content of the ``.fmu`` file; the same for the same content, compiler and version of tmm-gen.

    Raises
    ------
    UserError
        If FMPy or the compiler is missing.
    """
    require_fmpy()
    import fmpy

    headers = fmi_headers(version)
    sources, identity = content.filled(version)
    binary = compile_library({**headers, **sources}, cc, (*FLAGS, _HIDDEN)).read_bytes()
    platform = fmpy.platform if version == 2 else fmpy.platform_tuple
    licences = {"fmi-headers.txt": licence_of(headers), **content.licences}
    files: dict[str, str | bytes] = {
        "modelDescription.xml": _description(version)(identity, content.variables),
        f"binaries/{platform}/{content.name}{fmpy.sharedLibraryExtension}": binary,
        **{f"documentation/licenses/{name}": text for name, text in licences.items()},
        **{f"sources/{name}": text for name, text in (headers | sources).items()},
    }
    if version == 3:
        files["sources/buildDescription.xml"] = build_description(identity, FLAGS)
    packed = archive(files)
    _validate(packed, content.name)
    return packed


def _description(version: FmiVersion) -> Callable[[Identity, tuple[FmuVariable, ...]], str]:
    return description2 if version == 2 else description3


def _uuid(digest: str) -> str:
    """Write the first 32 digits in groups, as FMI importers are used to."""
    return "-".join((digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32]))


def _validate(packed: bytes, name: str) -> None:
    """Have FMPy judge the unit: schema, names, structure, units, start values."""
    from fmpy.validation import validate_fmu

    with scratch_folder() as folder:
        path = folder / f"{name}.fmu"
        path.write_bytes(packed)
        problems = validate_fmu(str(path))
    if problems:
        raise RuntimeError(f"the unit of {name} is not valid: {'; '.join(problems)}")
