"""An emitted controller as a functional mock-up unit: measurements and references in, torques and a status out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import PurePosixPath

from tmm_gen.c_language.real import REALS
from tmm_gen.control.arm.payload import payload_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.export.fmu import FmiVersion
from tmm_gen.export.fmu.headers import require_fmpy
from tmm_gen.export.fmu.identity import number
from tmm_gen.export.fmu.packed import UnitContent, packed_unit
from tmm_gen.export.fmu.variables import FmuVariable
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.folder import library_sources
from tmm_gen.onboard.sensor_words import sensor_words
from tmm_gen.onboard.text import macro_prefix

_SENSORS = (("encoder", "rad"), ("accelerometer", "m/s^2"), ("strain_gauge", "N m"))
"""Groups of inputs, and their units."""

_STATUS = "0 OK, 3 REDUCED, 4 RELAXED: the controller's own law; others: the safe law"
_ANSWER = "to what was told last of bounds, payload and reference: 0 taken; else what was there before stays"


@dataclass(frozen=True)
class _Telling:
    """Something that the controller may be told while it runs.

    Parameters
    ----------
    function : str
        End of the function's name.
    arguments : str
        Behind the controller, in C, from ``numbers``.
    variables : tuple of FmuVariable
        That say it, in the order of the numbers.
    """

    function: str
    arguments: str
    variables: tuple[FmuVariable, ...]


def controller_unit(bench: Bench, controller: str, version: FmiVersion = 2, cc: str = "gcc") -> bytes:
    """Return a controller's functional mock-up unit, validated.

    Its internal step is the sample time: what was set is read where a sample is due, torques are held until the next.

    Parameters
    ----------
    bench : Bench
        Of the scene; ``scene.emit.real`` is the number type.
    controller : str
        One that can be written in C and takes references while it runs.
    version : {2, 3}
        Of FMI: 2.0 or 3.0.
    cc : str
        Compiler of the binary, which is for the machine this runs on.

    Raises
    ------
    UserError
        If there is no such controller, it takes no reference, or FMPy or the compiler is missing.
    """
    require_fmpy()
    return packed_unit(controller_content(bench, controller), version, cc)


def controller_content(bench: Bench, controller: str) -> UnitContent:
    """Return what is in the unit, see :func:`controller_unit`."""
    real, problem = bench.scene.emit.real, bench.problem
    name, files = emit_controller(bench, controller, real)
    header = files[f"{name}.h"]
    if f"{name}_aim(" not in header:
        raise UserError(
            f"scene '{bench.scene.name}': --controller {controller} takes no reference while it runs, and is of no use "
            "as a unit. Those of motors by name ([[motor]] on a clamp, as in scenes/elbow.toml) do."
        )
    measured = tuple(_measured(bench, each) for each in present_sensors(problem))
    tellings = _tellings(bench, carries=f"{name}_carry(" in header)
    told = tuple(each for telling in tellings for each in telling.variables)
    variables = (*measured, *told, *_results(bench))
    first = 1 + len(measured)
    described: list[dict[str, object]] = []
    for telling in tellings:
        count = len(telling.variables)
        described.append(
            {
                "function": telling.function,
                "arguments": telling.arguments.format(motors=problem.count),
                "first": f"{first}u",
                "count": count,
            }
        )
        first += count
    context = {
        "name": name,
        "NAME": macro_prefix(name),
        "real": REALS[real],
        "step": number(problem.sample_time),
        "starts": [number(each.start[0] if each.start else 0.0) for each in variables],
        "names": [each.name for each in variables],
        "told": 1 + len(measured),
        "results": 1 + len(measured) + len(told),
        "largest": "DBL_MAX" if real == "float64" else "(double)FLT_MAX",
        "tellings": described,
    }

    def instance(token: str) -> dict[str, str]:
        return {
            f"fmi-instance.{end}": render(f"fmu/fmi-controller.{end}.jinja", token=token, **context)
            for end in "ch"
        }

    return UnitContent(
        name,
        f"{bench.scene.title}: {controller}",
        problem.sample_time,
        variables,
        _flat(files),
        instance,
        held=True,
        licences={"daqp.txt": files["daqp/LICENSE"]},
    )


def _flat(files: dict[str, str]) -> dict[str, str]:
    """Return a controller's sources all in one folder, as units have them, without its example."""
    taken = {*library_sources(files), *(path for path in files if path.endswith(".h"))}
    return {PurePosixPath(path).name: files[path].replace('"daqp/', '"') for path in sorted(taken)}


def _measured(bench: Bench, sensor: int) -> FmuVariable:
    motors = bench.problem.motors
    kind, motor = divmod(sensor, motors.count)
    group, unit = _SENSORS[kind]
    doc = f"{sensor_words(motors, sensor)[1].partition(' [')[0]}; NaN where the sensor fails"
    return FmuVariable(f"{group}.{motors.names[motor]}", "", "input", unit, doc, (0.0,))


def _tellings(bench: Bench, carries: bool) -> list[_Telling]:
    """Return bounds, payload and reference, in the order they are told: the arm must be held within the former."""
    problem = bench.problem
    names = problem.motors.names

    def each(group: str, unit: str, doc: str, starts: Iterable[float]) -> tuple[FmuVariable, ...]:
        return tuple(
            FmuVariable(f"{group}.{name}", "", "input", unit, doc.format(name), (float(start),))
            for name, start in zip(names, starts, strict=True)
        )

    low, high = problem.torque
    found = [
        _Telling(
            "limit",
            "numbers, numbers + {motors}",
            (
                *each("lower", "N m", "least torque of '{}'", low),
                *each("upper", "N m", "largest torque of '{}'", high),
            ),
        )
    ]
    if carries:
        mass = payload_of(bench.step.scene)
        assert mass is not None
        doc = bench.links.lift.words.replace("the tip", "the end of the arm")
        found.append(
            _Telling("carry", "numbers[0]", (FmuVariable("payload", "", "input", "kg", doc, (mass,)),))
        )
    aimed = each("reference", "rad", "joint angle to reach of '{}'", problem.reference)
    return [*found, _Telling("aim", "numbers", aimed)]


def _results(bench: Bench) -> tuple[FmuVariable, ...]:
    names = bench.problem.motors.names
    return (
        *(FmuVariable(f"torque.{name}", "", "output", "N m", f"torque of '{name}'") for name in names),
        FmuVariable("status", "", "output", "1", _STATUS),
        FmuVariable("answer", "", "output", "1", _ANSWER),
    )
