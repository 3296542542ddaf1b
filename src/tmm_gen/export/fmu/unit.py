"""A scene as a functional mock-up unit for co-simulation."""

from __future__ import annotations

from tmm_gen.c_language.names import PREFIX, macros, signal
from tmm_gen.c_language.real import REALS
from tmm_gen.emit.c import emit_kernel, free_scene
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.export.fmu.headers import require_fmpy
from tmm_gen.export.fmu.identity import FmiVersion, number
from tmm_gen.export.fmu.packed import UnitContent, packed_unit
from tmm_gen.export.fmu.variables import fmu_variables
from tmm_gen.program.build import build_program
from tmm_gen.program.inputs import prescribed_names
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene


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
    scene = _importers(scene)
    return packed_unit(unit_content(program or build_program(scene), scene, version), version, cc)


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


def unit_content(program: Program, scene: Scene, version: FmiVersion) -> UnitContent:
    """Return the C files and the variables in the order of their numbers."""
    kernel = Kernel.of(program, scene)
    followed = [name for names in prescribed_names(program.inputs) for name in names]
    whole = fmu_variables(program, REALS[scene.emit.real], followed)
    variables = tuple(element for v in whole for element in v.elements()) if version == 2 else whole
    described = [
        {"name": each, "member": signal(each, scene.name), "stem": PREFIX + each} for each in followed
    ]
    files = {path.removeprefix("c/"): text for path, text in emit_kernel(program, scene).items()}

    def filled(token: str) -> dict[str, str]:
        return {
            f"fmi-instance.{end}": render(
                f"fmu/fmi-instance.{end}.jinja",
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
            for end in "ch"
        }

    return UnitContent(scene.name, scene.title, scene.integrator.step, variables, files, filled)


def _rows(program: Program) -> list[list[str]]:
    """Return the instants of each start-up step's stages and the main step's, in rows of the same length."""
    longest = max(map(len, program.stage_instants))
    return [[number(x) for x in (*row, *row[-1:] * (longest - len(row)))] for row in program.stage_instants]
