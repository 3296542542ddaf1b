"""Arms in space far from the usual: each motion is right, or it is refused.

A beam of 1 m and 0.5 kg that bends in two planes and twists carries a payload beside its axis. It is clamped and let go
under a weight across both planes, which bends it by about a third of its length at most, or it spins about a motor at
its root. Right means: the payload goes where the equations in world axes have it, to the error that the run says;
beyond the reach of that reference (many cells), where a much finer run by another integrator has it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from extremes_of_arms.limit import OutOfTime, limit
from extremes_of_arms.shared_kernel import SharedKernel, kernel_of
from extremes_of_arms.verdict import Verdict, checkpoints, honest, off

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import CheckFailed, UserError
from tmm_gen.native import NativeKernel
from tmm_gen.program.space.layout import layout_of
from tmm_gen.program.sweeps import LEAST_TURN
from tmm_gen.reference.spatial_reference import spatial_response
from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.simulation import Simulation

MOST_CELLS = 5
"""Of the reference, whose cost goes with the cube of their joints, three a cell."""

_FINER = 8
"""How many times shorter the steps of the run that stands in for it are; of fourth order."""

_MASS, _LENGTH = 0.5, 1.0
_ROTOR = 1e-4
"""Inertia at the root of one that spins, as a share of the beam's: the beam leads."""

_CHECKPOINTS = 200
_SAG = 0.3
"""Largest static sag by a linear beam's formula, as a share of the length."""

_SCENE = """
name = "rod"
[model]
kind = "spatial"
iterations = "auto"
{gravity}
[integrator]
name = "{integrator}"
step = {step!r}
[base]
kind = "clamp"
{motor}
[[beam]]
name = "rod"
{on}
length = {length!r}
bending_stiffness = [{upright!r}, {across!r}]
torsional_stiffness = {twist!r}
mass_per_length = {mass!r}
polar_inertia_per_length = {polar!r}
links = {cells}
damping_time = {damping!r}
[[body]]
name = "payload"
on = "rod"
mass = {payload!r}
center = [0.0, {beside!r}, 0.0]
inertia = [{inertia!r}, {inertia!r}, {inertia!r}]
[[output]]
name = "tip"
at = "payload"
of = "position"
{initial}
"""
_MOTOR = """[[motor]]
name = "root"
axis = "z"
rotor_inertia = {rotor!r}"""


@dataclass(frozen=True)
class Rod:
    """A beam in space and a step.

    Parameters
    ----------
    cells : int
        Of the beam, two bending joints and a twisting one each.
    stiffness : float
        EI about its y axis, N m^2.
    across : float
        EI about its z axis over that.
    twist : float
        GJ over EI about its y axis.
    radius : float
        Radius of gyration about its own axis, as a share of its length.
    payload : float
        Its mass over that of the beam.
    step : float
        As a share of the first period.
    revolutions : float
        Per second; spins about a motor without weight if not zero.
    damping : float
        Damping of its springs over their stiffness, as a share of the first period.
    integrator : str
        Name.
    """

    cells: int = 3
    stiffness: float = 1.0
    across: float = 2.0
    twist: float = 0.8
    radius: float = 1e-2
    payload: float = 0.1
    step: float = 1e-3
    revolutions: float = 0.0
    damping: float = 2e-3
    integrator: str = "newmark"

    @property
    def period(self) -> float:
        """First period of the clamped beam with its payload, about, s."""
        softest = self.stiffness * min(1.0, self.across)
        return 2.0 * math.pi * math.sqrt((self.payload + 0.243) * _MASS * _LENGTH**3 / (3.0 * softest))

    @property
    def steps(self) -> int:
        """How many: half a period, where that is neither a handful nor more than patience."""
        return min(max(round(0.5 / self.step), 20), 5000 if self.cells <= MOST_CELLS else 500)

    def scene(self) -> Scene:
        """Return it as a scene."""
        softest = self.stiffness * min(1.0, self.across)
        # w L^4 / 8 EI and P L^3 / 3 EI, for weights of beam and payload
        sag = _MASS * (1.0 / 8.0 + self.payload / 3.0) * _LENGTH**3 / softest
        weight = _SAG * _LENGTH / sag / math.sqrt(2.0)
        spun = self.revolutions > 0.0
        return parse_scene(
            _SCENE.format(
                gravity="" if spun else f"gravity = [0.0, {-weight!r}, {-weight!r}]",
                integrator=self.integrator,
                step=self.step * self.period,
                motor=_MOTOR.format(rotor=_ROTOR * _MASS * _LENGTH**2) if spun else "",
                on='on = "root"' if spun else "",
                length=_LENGTH,
                upright=self.stiffness,
                across=self.stiffness * self.across,
                twist=self.stiffness * self.twist,
                mass=_MASS / _LENGTH,
                polar=_MASS / _LENGTH * (self.radius * _LENGTH) ** 2,
                cells=self.cells,
                damping=self.damping * self.period,
                payload=self.payload * _MASS,
                beside=0.1 * _LENGTH,
                inertia=1e-3 * self.payload * _MASS * _LENGTH**2,
                initial=f"[initial]\nrates = {{ root = {2.0 * math.pi * self.revolutions!r} }}"
                if spun
                else "",
            )
        )


def judge(rod: Rod, seconds: float = math.inf) -> Verdict:
    """Simulate a rod in compiled C, as `run` does, and compare.

    Parameters
    ----------
    rod : Rod
        What to simulate.
    seconds : float
        For the run, and once more for the reference; without one, a finer run is what counts.
    """
    try:
        with limit(seconds):
            run = _run(rod)
    except OutOfTime:
        return Verdict("out of time")
    except (UserError, SceneError, CheckFailed) as refusal:
        return Verdict("refused", said=str(refusal))
    assert run.accuracy is not None
    right, said, wanted = "right", "follows the reference", _in_time(run, rod, seconds)
    if wanted is None:
        right, said = "right by a finer run", "agrees with finer steps of fourth order"
        try:
            with limit(4.0 * seconds):
                wanted = _finer(rod, run)
        except (OutOfTime, UserError, CheckFailed):
            return Verdict("out of time", accuracy=run.accuracy.error)
    error = off(run, wanted, checkpoints(run, _CHECKPOINTS))
    return Verdict(
        right if honest(error, run) else "wrong",
        error,
        accuracy=run.accuracy.error,
        sensitivity=run.accuracy.sensitivity or 0.0,
        sweeps=run.sweeps_per_step or 0.0,
        substeps=run.substeps.count,
        said=said,
    )


def _run(rod: Rod, *, refuse: bool = True, steps: int | None = None) -> Simulation:
    scene = rod.scene()
    kind = replace(rod, **_SAME, revolutions=float(rod.revolutions > 0.0))
    kernel: Any = _shared(_kernel(kind), scene)
    until = (steps or rod.steps) * scene.integrator.step
    return simulate(scene, {}, until, "c", kernel=kernel, refuse=refuse, judge=refuse, substeps=refuse)


_SAME: dict[str, Any] = {
    "stiffness": 1.0,
    "across": 2.0,
    "twist": 0.8,
    "radius": 1e-2,
    "payload": 0.1,
    "step": 1e-3,
    "damping": 2e-3,
}
"""What kernels of a kind share: their parameters are free."""


@cache
def _kernel(kind: Rod) -> NativeKernel:
    return kernel_of(kind.scene())


def _shared(kernel: NativeKernel, scene: Scene) -> SharedKernel:
    """Return a kernel with the parameters and the start of one rod."""
    arm, rule = scene.spatial, integrator(scene.integrator.name)
    assert arm is not None
    own = layout_of(arm, scene.name, "", rule, scene.integrator.step).parameters
    kind = {v.name: v.length for v in kernel.program.parameters}
    lengths = {name: length for name, length in kind.items() if name != LEAST_TURN.name}
    values: dict[str, Any] = {}
    for name, length in lengths.items():
        value = np.array(own[name].default if name in own else 0.0, float)
        values[name] = value if length is None else np.broadcast_to(value, length).copy()
    lacking = set(own) - set(lengths)
    assert not lacking, f"the shared kernel has no {lacking}"
    start = {
        "initial_angle": np.array([joint.angle for joint in arm.joints]),
        "initial_rate": np.array([joint.rate for joint in arm.joints]),
    }
    return SharedKernel(kernel, values, start)


def _in_time(run: Simulation, rod: Rod, seconds: float) -> dict[str, np.ndarray] | None:
    """Return where the reference has the payload; None if it takes longer."""
    if rod.cells > MOST_CELLS:
        return None
    arm = run.scene.spatial
    assert arm is not None
    try:
        with limit(seconds):
            return spatial_response(arm, {}, run.time[checkpoints(run, _CHECKPOINTS)], 1e-10)
    except OutOfTime:
        return None


def _finer(rod: Rod, run: Simulation) -> dict[str, np.ndarray]:
    """Return where far shorter steps of fourth order have it."""
    count = run.substeps.count * _FINER
    fine = _run(
        replace(rod, step=rod.step / count, integrator="sdirk4"), refuse=False, steps=run.steps * count
    )
    return {name: values[::count][checkpoints(run, _CHECKPOINTS)] for name, values in fine.outputs.items()}
