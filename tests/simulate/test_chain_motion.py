"""The motion that runs of chains are held against is that of the matrix exponential of the assembled chain."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.reference import chain_linear
from tmm_gen.reference.chain_motion import exact_angles
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, load_scene, parse_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"
BASES = {"clamp": "", "motor": "inertia = 0.3\ndamping = 0.2", "prescribed": ""}


def chain(base: str, rng: np.random.Generator, n: int = 4) -> Scene:
    """Return unlike stations, damped unlike, with all angles as outputs, moving at the start."""
    stations = "\n".join(
        f"[[joint]]\nstiffness = {k!r}\ndamping = {c!r}\n[[link]]\ninertia = {i!r}"
        for k, c, i in (10.0 ** rng.uniform(-1, 1, (n, 3))).tolist()
    )
    outputs = "\n".join(f'[[output]]\nname = "q{k}"\nat = {k}\nof = "angle"' for k in range(1, n + 1))
    turned = '[[input]]\nname = "turn"\nat = "base"\nacts = "angle"' if base == "prescribed" else ""
    return parse_scene(
        f'name = "c"\n[model]\nkind = "chain"\n[integrator]\nname = "newmark"\nstep = 0.05\n[base]\nkind = "{base}"\n'
        f'{BASES[base]}\n{stations}\n{turned}\n[[input]]\nname = "tip"\nat = "tip"\nacts = "torque"\n{outputs}\n'
        f"[initial]\nangles = {rng.uniform(-1, 1, n).tolist()}\nrates = {rng.uniform(-1, 1, n).tolist()}\n"
    )


def loads(kind: str, rng: np.random.Generator) -> Signal:
    if kind == "constant":
        return Constant(0.7)
    if kind == "sine":
        return Sine(0.5, 3.0, 0.3)
    # kinks within steps, several in one of them, and a jump as near as a table has one
    times = np.array([0.01, 0.3, 0.31, 0.32, 0.320001, 1.23, 2.0])
    return Table(times, rng.uniform(-1, 1, len(times)))


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("kind", ["constant", "sine", "table"])
def test_every_base_and_load(base: str, kind: str) -> None:
    rng = np.random.default_rng(len(base) + len(kind))
    scene = chain(base, rng)
    # a base that jumps or kinks has no rate there to compare with
    turn = Sine(0.4, 2.0, 0.1) if kind != "constant" else Constant(0.3)
    signals = {"tip": loads(kind, rng), "turn": turn} if base == "prescribed" else {"tip": loads(kind, rng)}
    indices = np.arange(0.0, 49.0, 3.0)
    found = exact_angles(scene, signals, 0.05, indices)[:, int(base == "motor") :]
    exact = np.column_stack(list(exact_response(scene, signals, 0.05 * indices).values()))
    smooth = 1e-6 if kind != "constant" else 1e-11  # cubics over a step stand for a sine
    assert np.max(np.abs(found - exact)) < smooth * np.max(np.abs(exact))


def test_long_chains_are_looked_at_in_their_slowest_modes(monkeypatch: pytest.MonkeyPatch) -> None:
    """All of them, of a chain whose damping is in step with its stiffness: the same motion."""
    scene = load_scene(SCENES / "thesis10.toml")
    signals: dict[str, Signal] = {i.name: Sine(1.0, 2.0) for i in scene.inputs}
    indices = np.arange(0.0, 400.0, 20.0)
    whole = exact_angles(scene, signals, 0.01, indices)
    monkeypatch.setattr(chain_linear, "DENSE", 0)
    monkeypatch.setattr(chain_linear, "MODES", 10)
    np.testing.assert_allclose(
        exact_angles(scene, signals, 0.01, indices), whole, atol=1e-9 * np.abs(whole).max()
    )


def test_stiffness_costs_no_digits() -> None:
    """A joint a million million times stiffer than the other is as good as none."""

    def of(stiff: float) -> np.ndarray:
        scene = parse_scene(
            'name = "c"\n[model]\nkind = "chain"\n[integrator]\nname = "newmark"\nstep = 0.1\n[base]\nkind = "clamp"\n'
            f"[[joint]]\nstiffness = 1.0\n[[link]]\ninertia = 1.0\n[[joint]]\nstiffness = {stiff!r}\n"
            '[[link]]\ninertia = 1.0\n[[output]]\nname = "tip"\nat = "tip"\nof = "angle"\n[initial]\nangles = 1.0\n'
        )
        return exact_angles(scene, {}, 0.1, np.arange(0.0, 100.0))[:, -1]

    turn = np.cos(np.sqrt(0.5) * 0.1 * np.arange(100.0))
    np.testing.assert_allclose(of(1e12), turn, atol=1e-4)
