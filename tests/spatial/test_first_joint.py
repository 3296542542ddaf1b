"""Outputs on the first joint of an arm in space: a station that stands by itself, at which walks end as they begin."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene

PENDULUM = """
name = "pendulum"
model = { kind = "spatial", gravity = [0, 0, -9.81] }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }

[[joint]]
name = "hinge"
axis = "y"

[[link]]
name = "rod"
on = "hinge"
length = 0.5
mass = 0.5
inertia = [1e-3, 2e-3, 3e-3]
"""

SECOND = """
[[joint]]
name = "wrist"
on = "rod"
axis = "z"

[[body]]
name = "hand"
on = "wrist"
mass = 0.2
inertia = [1e-3, 2e-3, 3e-3]
"""

ANGLE, RATE = 0.3, 2.0
AT_THE_ROD = {
    "position": {"x": 0.5 * np.cos(ANGLE), "y": 0.0, "z": -0.5 * np.sin(ANGLE)},
    "velocity": {"x": -0.5 * RATE * np.sin(ANGLE), "y": 0.0, "z": -0.5 * RATE * np.cos(ANGLE)},
    "orientation": {"w": np.cos(ANGLE / 2), "x": 0.0, "y": np.sin(ANGLE / 2), "z": 0.0},
}
"""By hand: a turn about y takes x towards -z."""
OF_THE_HINGE = {"angle": ANGLE, "rate": RATE}


@pytest.mark.parametrize("more", ["", SECOND], ids=["alone", "first of two"])
@pytest.mark.parametrize("batch", [(), (3,)])
def test_outputs(more: str, batch: tuple[int, ...]) -> None:
    """Each has a number for each arm."""
    wanted = [*((of, "rod") for of in AT_THE_ROD), *((of, "hinge") for of in OF_THE_HINGE)]
    outputs = "".join(f'[[output]]\nname = "{of}"\nat = "{at}"\nof = "{of}"\n' for of, at in wanted)
    scene = parse_scene(PENDULUM + more + outputs)
    module = import_package(emit_numpy(build_program(scene), scene), "pendulum")
    count = module.STATIONS
    start = np.zeros((2, count, *batch))
    start[:, 0] = np.reshape([ANGLE, RATE], (2, *(1 for _ in batch)))
    read = module.output(module.prepare(), module.initialise(initial_angle=start[0], initial_rate=start[1]))
    columns = {f"{of}_{axis}": v for of, vector in AT_THE_ROD.items() for axis, v in vector.items()}
    for name, value in {**columns, **OF_THE_HINGE}.items():
        found = np.asarray(getattr(read, name))
        assert found.shape == batch, name
        assert np.max(np.abs(found - value)) < 1e-15, name
