"""What drives and holds a base in space, by frequency: against the reference's equations, linear models and runs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from support.spatial.about_rest import stiffness
from support.spatial.moving import TABLE

import tmm_gen as tg
from tmm_gen.cli import main
from tmm_gen.inputs.signals import Sine
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.modal.space.sweep import inputs_of
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.signal import ACCELERATION, kernel_names
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.simulate.run import simulate

READ = ("drives", "holds_x", "holds_y", "holds_z")
PUSH = {"push_x": 0.3}
HELD = {"table": 0.4, **PUSH}
"""Constant inputs about which it swings: weight and a force lean on a turned base."""
S = np.array([0.3 + 2.0j, 40.0j, -1.0 + 300.0j])
TINY = 1e-40

DRIVEN = (
    TABLE.replace(
        "body = [",
        'body = [\n  { name = "top", on = "base", mass = 1.5, center = [0.2, -0.1, 0.05], '
        "inertia = [0.02, 0.03, 0.04, 0.002, -0.003, 0.001] },",
    )
    .replace("input = [", 'input = [{ name = "cart", at = "base", acts = "place_y" }, ')
    .replace(
        "output = [",
        'output = [\n  { name = "drives", at = "base", of = "torque" },\n'
        '  { name = "holds", at = "base", of = "force" },',
    )
)
"""A table with a body of its own beside its axis, which an input carries along too."""

DAMPED = (
    DRIVEN.replace("damping = 0.05", "damping = 1.0")
    .replace('axis = "x", stiffness = 20.0', 'axis = "x", stiffness = 20.0, damping = 1.0')
    .replace("step = 1e-2", "step = 1e-3")
)
"""Its slowest motion dies out by ``exp(-10.9 t)``."""


@pytest.fixture(scope="module")
def scene() -> Scene:
    return parse_scene(DRIVEN)


class Slopes:
    """What the reference's whole, nonlinear equations take by small motion about a position."""

    def __init__(self, arm: SpatialArm, q: np.ndarray) -> None:
        self.world, self.q, self.size = WorldArm(arm), q, len(q)
        spring, mass = stiffness(arm, q, PUSH), self.world.mass_matrix(q)
        self.dynamic = lambda s: spring + s * np.diag(self.world.damping) + s**2 * mass

    def taken(self, s: complex, moved: np.ndarray, acting: dict[str, complex]) -> np.ndarray:
        """Return what joints lack and the force of the base, (n + 3,): by steps of the real and the imaginary part."""
        found = []
        for part in (np.real, np.imag):
            small = [1j * TINY * part(s**order * moved) for order in range(3)]
            given = {name: PUSH.get(name, 0.0) + 1j * TINY * part(value) for name, value in acting.items()}
            motion = (self.q + small[0], small[1], small[2], {**PUSH, **given})
            whole = [self.world.inverse_dynamics(*motion), self.world.base_force(*motion)]
            found.append(np.concatenate(whole).imag / TINY)
        return np.asarray(found[0] + 1j * found[1])

    def answer(self, s: complex, column: str) -> np.ndarray:
        """Return torque and force for a unit of an input, (4,): the table turns as it says, all else follows."""
        moved = np.zeros(self.size, complex)
        moved[0] = column == "table"
        acting = {"cart": {f"cart{ACCELERATION}": s**2}, "table": {}}.get(column, {column: 1.0})
        lacking = self.taken(s, moved, acting)[: self.size]
        moved[1:] = np.linalg.solve(self.dynamic(s)[1:, 1:], -lacking[1:])
        whole = self.taken(s, moved, acting)
        return np.append(whole[0], whole[self.size :])


def test_it_is_what_the_references_equations_take(scene: Scene) -> None:
    still = resting_in_space(scene, HELD).still
    assert scene.spatial is not None
    slopes = Slopes(scene.spatial, np.array([HELD["table"], *still.angles]))
    read = space_response(still, S)
    for number, column in enumerate(inputs_of(still).columns):
        for k, s in enumerate(S):
            exact = slopes.answer(complex(s), column)
            found = np.array([read[name][k, number] for name in READ])
            assert np.max(np.abs(found - exact)) < 1e-11 * np.max(np.abs(exact)), column


def test_linear_models_of_kernels_have_the_same(scene: Scene) -> None:
    """Those are the derivatives of the kernel's own walks, in and out."""
    model, points = tg.parse(DRIVEN).linearise(**HELD), np.array([3.0j, 40.0j])
    read = space_response(resting_in_space(scene, HELD).still, points)
    rows = [model.outputs.index(name) for name in READ]
    for k, s in enumerate(points):
        inner = np.linalg.solve(s * np.eye(len(model.A)) - model.A, model.B)
        whole = (model.C @ inner + model.D)[rows]
        for number, item in enumerate(scene.inputs):
            exact = sum(
                s**order * whole[:, model.inputs.index(name)] for order, name in enumerate(kernel_names(item))
            )
            found = np.array([read[name][k, number] for name in READ])
            assert np.max(np.abs(found - exact)) < 1e-9 * np.max(np.abs(exact)), item.name


def test_a_run_that_has_settled_swings_by_it() -> None:
    """Amplitude and phase of the last swing, once what its start leaves has died out.

    What is not linear is found at even multiples of the slower frequency, where nothing is looked at, and at odd ones
    as the cube of the size.
    """
    damped = parse_scene(DAMPED)
    size, swings, until = 1e-3, {"table": 5.0 * np.pi, "cart": 15.0 * np.pi}, 1.6
    run = simulate(damped, {name: Sine(size, swing) for name, swing in swings.items()}, until, "numpy")
    still = resting_in_space(damped).still
    last = run.time > until - 2.0 * np.pi / swings["table"] + 1e-9
    for column, swing in swings.items():
        exact = space_response(still, [1j * swing])
        number = inputs_of(still).columns.index(column)
        wave = np.exp(-1j * swing * run.time[last])
        wanted = np.array([exact[name][0, number] for name in READ])
        found = np.array([2j * np.mean(run.outputs[name][last] * wave) for name in READ]) / size
        assert np.max(np.abs(found - wanted)) < 5e-4 * np.max(np.abs(wanted)), column


def test_commands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("table.toml").write_text(DRIVEN)
    band = ("--low", "0.3", "--high", "30", "--points", "5")
    assert main(["frequency", "table.toml", "--from", "table", "--to", "drives", *band, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["unit"] == "N m per rad"
    exact = space_response(
        resting_in_space(parse_scene(DRIVEN)).still, 2j * np.pi * np.array(told["frequency_hz"])
    )
    assert told["response"][0]["magnitude"] == pytest.approx(np.abs(exact["drives"][:, 1]).tolist())
    found = tg.load("table.toml").frequency("cart", "holds", low=0.3, high=30.0, points=5)
    assert found.unit == "N per m"
    assert found.response["holds_y"] == pytest.approx(exact["holds_y"][:, 0].tolist())
