"""One integrator on a page: the module of its kernel, and how that is driven."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Mapping
from typing import Any

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.structs import Struct
from tmm_gen.emit.templates import render
from tmm_gen.playground.payload import FACTORS, parameter_values, payload_of, with_payload
from tmm_gen.playground.webassembly import compile_module
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import Scene

PLAIN = {
    "emit.backends": ["c"],
    "emit.real": "float64",
    "emit.parameters": "free",
    "emit.trigonometry": "own",
    "emit.compensated": False,
    "emit.sensitivities": False,
    "emit.box": None,
    "emit.budget": None,
    "emit.batch": None,
}
"""How a page's kernels are emitted whatever the scene asks for: it may have no C library, and sliders change all."""


_OF_BASE = (*(f"base_place_{axis}" for axis in "xyz"), *(f"base_quaternion_{part}" for part in "wxyz"))
"""Members of the state that say where a base is that floats."""


def plain(scene: Scene, name: str) -> Scene:
    """Return a scene with another integrator, emitted for a page."""
    data: Mapping[str, Any] = scene.source.data
    written = data.get("emit", {})
    changes = {
        key: value for key, value in PLAIN.items() if value is not None or key.partition(".")[2] in written
    }
    return scene.replace(**{"integrator.name": name}, **changes)


def method(scene: Scene, name: str) -> dict[str, Any]:
    """Build, emit and compile a scene with an integrator.

    Returns
    -------
    dict
        Ready for JSON: ``name`` and ``title``; ``wasm`` in base 64; ``operations`` of a step; ``stages``, by step from
        the first on, the last for all others: instants in steps at which inputs act; ``slots``, for how many stages an
        input has room; ``inputs``, names in order; ``angles``, ``count`` and ``base``: where in the state, in numbers,
        those of the links or joints begin, how many they are, and where the base's place is, in space its quaternion
        too; ``parameters``, all in order; ``payloads``, for each of `FACTORS` those numbers that differ, as pairs of
        index and value; ``stiff``: pairs of where a stiffness and its damping stand.
    """
    wanted = plain(scene, name)
    payload = payload_of(wanted)
    # Built with the heaviest payload: where all stations are alike, the last would have no number of its own.
    program = build_program(with_payload(wanted, payload, FACTORS[-1]) if payload else wanted)
    kernel = Kernel.of(program, wanted)
    sources = emit_kernel(program, wanted)
    glue = render(
        "playground/arm.c.jinja",
        name=scene.name,
        given=len(kernel.given),
        starts_from_step=kernel.starts_from_step,
    )
    module = compile_module(scene.name, {**sources, "arm.c": glue})
    chosen = integrator(name, **wanted.integrator.parameters)
    params = kernel.structs["params"]
    own = _flat(params, parameter_values(wanted, chosen))
    payloads = []
    for factor in FACTORS if payload else ():
        assert payload is not None
        other = _flat(params, parameter_values(with_payload(wanted, payload, factor), chosen))
        pairs = enumerate(zip(own, other, strict=True))
        payloads.append([(index, new) for index, (old, new) in pairs if new != old])
    places = _places(kernel.structs["state"])
    return {
        "name": name,
        "title": chosen.title,
        "wasm": base64.b64encode(module).decode(),
        "operations": count_routine(program.main).total,
        "stages": [list(instants) for instants in program.stage_instants],
        "slots": max(len(instants) for instants in program.stage_instants),
        "inputs": [variable.name for variable in program.inputs],
        "angles": places["angle"],
        "count": program.stations,
        "base": [places[key] for key in _OF_BASE if key in places],
        "parameters": own,
        "payloads": payloads,
        "stiff": _stiff(params),
    }


def _flat(struct: Struct, values: dict[str, tuple[float, ...]]) -> list[float]:
    """Return the numbers of a struct in order."""
    found: list[float] = []
    for field in struct.fields:
        own = values[field.name]
        found += own if len(own) == field.numbers else own[:1] * field.numbers
    return found


def _places(struct: Struct) -> dict[str, int]:
    """Return where the members of a struct begin, in numbers."""
    found, place = {}, 0
    for field in struct.fields:
        found[field.name] = place
        place += field.numbers
    return found


def _stiff(struct: Struct) -> list[tuple[int, int]]:
    """Return where stiffnesses and their dampings stand; -1 where there is none."""
    places, numbers = _places(struct), {field.name: field.numbers for field in struct.fields}
    if "stiffness" not in places:
        return []
    dampings: Iterable[int] = [-1] * numbers["stiffness"]
    if "damping" in places:
        dampings = (
            places["damping"] + (k if numbers["damping"] > 1 else 0) for k in range(numbers["stiffness"])
        )
    return [(places["stiffness"] + k, damping) for k, damping in enumerate(dampings)]
