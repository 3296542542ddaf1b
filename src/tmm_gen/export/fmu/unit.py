"""A scene as a functional mock-up unit for co-simulation: description, sources and binary in one file."""

from __future__ import annotations

import hashlib

from tmm_gen.c_language.names import PREFIX, macros, signal
from tmm_gen.c_language.real import REALS
from tmm_gen.emit.c import emit_kernel, free_scene
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.export.fmu.archive import archive
from tmm_gen.export.fmu.description2 import description2
from tmm_gen.export.fmu.description3 import build_description, description3
from tmm_gen.export.fmu.headers import fmi_headers, licence_of, require_fmpy
from tmm_gen.export.fmu.identity import FmiVersion, Identity, number
from tmm_gen.export.fmu.variables import FmuVariable, fmu_variables
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.program.build import build_program
from tmm_gen.program.inputs import prescribed_names
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene
from tmm_gen.scratch import scratch_folder

_HIDDEN = "-fvisibility=hidden"
"""The kernel's own functions are nobody's business, so that units can be loaded side by side."""


def fmu(scene: Scene, version: FmiVersion = 2, cc: str = "gcc", program: Program | None = None) -> bytes:
    """Return a scene's functional mock-up unit, validated.

    Parameters
    ----------
    scene : Scene
        What to export; its integrator's step is the unit's internal step, ``scene.emit.real`` its number type.
    version : {2, 3}
        Of FMI: 2.0 or 3.0.
    cc : str
        Compiler of the binary, which is for the machine this runs on.
    program : Program, optional
        That of the scene, if it is built already.

    Returns
    -------
    bytes
        Content of the ``.fmu`` file; the same for the same scene, compiler and version of tmm-gen.

    Raises
    ------
    UserError
        If FMPy or the compiler is missing, or a number of the scene is out of the range of its number type.
    """
    require_fmpy()
    import fmpy

    scene = _importers(scene)
    program = program or build_program(scene)
    headers = fmi_headers(version)
    sources, identity, variables = _sources(program, scene, version)
    binary = compile_library({**headers, **sources}, cc, (*FLAGS, _HIDDEN)).read_bytes()
    description = description2 if version == 2 else description3
    platform = fmpy.platform if version == 2 else fmpy.platform_tuple
    licences = "documentation/licenses/fmi-headers.txt"
    files: dict[str, str | bytes] = {
        "modelDescription.xml": description(identity, variables),
        f"binaries/{platform}/{scene.name}{fmpy.sharedLibraryExtension}": binary,
        licences: licence_of(headers),
        **{f"sources/{name}": text for name, text in (headers | sources).items()},
    }
    if version == 3:
        files["sources/buildDescription.xml"] = build_description(identity, FLAGS)
    packed = archive(files)
    _validate(packed, scene.name)
    return packed


def _importers(scene: Scene) -> Scene:
    """Return a scene whose parameters are the importer's to choose: no constants, and no bounds that rest on them."""
    if scene.emit.compensated:
        raise UserError(
            f"scene '{scene.name}': emit.compensated = true: a functional mock-up unit holds its parameters as single "
            'numbers; write real = "float64" instead, which is as exact'
        )
    changes: dict[str, object] = {"emit.sensitivities": None} if scene.emit.sensitivities else {}
    if scene.emit.box is not None:
        changes["emit.box"] = None
    free = free_scene(scene)
    return free.replace(**changes) if changes else free


def _sources(
    program: Program, scene: Scene, version: FmiVersion
) -> tuple[dict[str, str], Identity, tuple[FmuVariable, ...]]:
    """Return the C files by name, the identity, and the variables in the order of their numbers."""
    kernel = Kernel.of(program, scene)
    followed = [name for names in prescribed_names(program.inputs) for name in names]
    whole = fmu_variables(program, REALS[scene.emit.real], followed)
    variables = tuple(element for v in whole for element in v.elements()) if version == 2 else whole
    described = [
        {"name": each, "member": signal(each, scene.name), "stem": PREFIX + each} for each in followed
    ]
    files = {path.removeprefix("c/"): text for path, text in emit_kernel(program, scene).items()}
    templates = {
        "fmi-instance.h": "fmi-instance.h.jinja",
        "fmi-instance.c": "fmi-instance.c.jinja",
        "fmi-functions.c": f"fmi-{version}.c.jinja",
    }

    def filled(token: str) -> dict[str, str]:
        return {
            name: render(
                f"fmu/{template}",
                kernel=kernel,
                name=scene.name,
                NAME=macros(scene.name),
                token=token,
                step=number(scene.integrator.step),
                variables=variables,
                followed=described,
                ways=[described[k : k + 3] for k in range(0, len(described), 3)],
                held=[signal(v.name, scene.name) for v in program.inputs if v.name not in followed],
                instants=_rows(program),
            )
            for name, template in templates.items()
        }

    blank = files | filled("")
    names = tuple(sorted(name for name in blank if name.endswith(".c")))
    told = description2 if version == 2 else description3
    content = repr((sorted(blank.items()), told(Identity.of(scene, "", names), variables)))
    token = "{" + _uuid(hashlib.sha256(content.encode()).hexdigest()) + "}"
    return files | filled(token), Identity.of(scene, token, names), variables


def _rows(program: Program) -> list[list[str]]:
    """Return the instants of each start-up step's stages and the main step's, in rows of the same length."""
    longest = max(map(len, program.stage_instants))
    return [[number(x) for x in (*row, *row[-1:] * (longest - len(row)))] for row in program.stage_instants]


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
