"""Planar arms for the tests of this folder, and their compiled kernels."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.inputs.signals import Sine
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.simulate.trace import Trace

FIRST_ROOT = 1.875104068711961
"""Of 1 + cos x cosh x: the first bending mode of a clamped beam."""

FALLING = """
name = "falling"
[model]
kind = "planar"
gravity = 4.903325
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = {stiffness!r}
mass_per_length = 0.5
links = {links}
springs = "half-clamp"
damping_time = 0.002
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


@pytest.fixture(scope="session")
def falling() -> Callable[..., Scene]:
    """Make an arm of 1 m whose first clamped frequency is 1 Hz, let go horizontally in half gravity."""

    def make(links: int, **changes: object) -> Scene:
        stiffness = 0.5 * (2.0 * np.pi / FIRST_ROOT**2) ** 2
        return parse_scene(FALLING.format(stiffness=stiffness, links=links)).replace(**changes)

    return make


@pytest.fixture(scope="session")
def unlike() -> Callable[..., Scene]:
    """Make an arm of links and joints that are all different, with every kind of load and output."""
    return unlike_arm


def unlike_arm(
    base: str = "clamp",
    links: int = 3,
    *,
    seed: int = 0,
    gravity: float | None = 9.81,
    tip: bool = True,
    loads: bool = True,
    damped: bool = True,
    integrator: str = "newmark",
    step: float = 1e-3,
    **model: Any,
) -> Scene:
    random = np.random.default_rng(seed)
    tables: list[tuple[str, dict[str, Any]]] = [
        ("model", {"kind": "planar", **({"gravity": gravity} if gravity else {}), **model}),
        ("integrator", {"name": integrator, "step": step}),
        ("base", {"kind": base, **({"inertia": 0.3} if base == "motor" else {})}),
    ]
    if base == "motor" and damped:
        tables[-1][1]["damping"] = 0.2
    for _ in range(links):
        damping = random.uniform(0.01, 0.5) if damped else 0.0
        tables.append(("[joint]", {"stiffness": random.uniform(20.0, 60.0), "damping": damping}))
    for _ in range(links):
        mass, length = random.uniform(0.3, 1.0), random.uniform(0.2, 0.5)
        inertia, center = random.uniform(0.05, 0.2) * mass * length**2, random.uniform()
        tables.append(("[link]", {"mass": mass, "length": length, "inertia": inertia, "center": center}))
    if tip:
        tables.append(("tip", {"mass": 0.4, "inertia": 0.01}))
    inner = max(links - 1, 1)
    if loads:
        for at, acts in (("tip", "force_x"), ("tip", "force_y"), ("tip", "torque"), (1, "force_x")):
            tables.append(("[input]", {"name": f"{acts}_{at}", "at": at, "acts": acts}))
        if inner > 1:
            for acts in ("force_y", "torque"):
                tables.append(("[input]", {"name": f"{acts}_{inner}", "at": inner, "acts": acts}))
        if base == "motor":
            tables.append(("[input]", {"name": "hub", "at": "base", "acts": "torque"}))
    if base == "prescribed":
        tables.append(("[input]", {"name": "hub", "at": "base", "acts": "angle"}))
    motions = ("position", "angle", "rate", "velocity", "acceleration", "torque", "force")
    for at in (1, inner, "tip") if inner > 1 else (1, "tip"):
        for of in motions if at != "tip" or tip else motions[:5]:
            tables.append(("[output]", {"name": f"{of}_of_{at}", "at": at, "of": of}))
    for of in ("torque", "force", *(["angle", "rate"] if base != "clamp" else [])):
        tables.append(("[output]", {"name": f"{of}_of_base", "at": "base", "of": of}))
    for energy in ("kinetic", "elastic", "gravitational", "dissipated"):
        tables.append(("[output]", {"name": energy, "at": "arm", "of": f"{energy}_energy"}))
    start = {name: random.uniform(-0.5, 0.5, links).tolist() for name in ("angles", "rates")}
    tables.append(("initial", start))
    lines = ['name = "unlike"']
    for name, entries in tables:
        lines += [f"[{name}]", *(f"{key} = {json.dumps(value)}" for key, value in entries.items())]
    return parse_scene("\n".join(lines) + "\n")


@pytest.fixture(scope="session")
def swinging() -> Callable[[Scene], dict[str, Sine]]:
    """Make a signal for each input, all of different frequencies; a prescribed base starts at rest."""

    def make(scene: Scene) -> dict[str, Sine]:
        return {
            item.name: Sine(0.5 + 0.2 * k, 3.0 + k, np.pi / 2.0 if item.acts == "angle" else 0.3)
            for k, item in enumerate(scene.inputs)
        }

    return make


@pytest.fixture(scope="session")
def compiled() -> Callable[[Scene], NativeKernel]:
    """Compile scenes, each once."""
    known: dict[Scene, NativeKernel] = {}

    def of(scene: Scene) -> NativeKernel:
        if scene not in known:
            known[scene] = compile_kernel(build_program(scene), scene, flags=("-O1",))
        return known[scene]

    return of


@pytest.fixture(scope="session")
def traced() -> Callable[..., tuple[np.ndarray, Trace]]:
    """Step a kernel at any step and keep the motion of all links: instants and trace."""

    def run(
        kernel: NativeKernel, scene: Scene, signals: Any, until: float, step: float
    ) -> tuple[np.ndarray, Trace]:
        signals = kernel_signals(scene, signals)
        kernel.prepare(step=step)
        kernel.initialise({name: float(signal.at(0.0)) for name, signal in signals.items()})
        steps = round(until / step)
        trace = Trace.empty(scene, steps + 1)
        trace.add(kernel.state)
        (instants,) = kernel.program.stage_instants
        for index in range(steps):
            times = step * (index + np.array(instants))
            values = {name: signal.at(times) for name, signal in signals.items()}
            kernel.step(values if len(instants) > 1 else {name: float(v[0]) for name, v in values.items()})
            trace.add(kernel.state)
        return step * np.arange(steps + 1), trace

    return run
