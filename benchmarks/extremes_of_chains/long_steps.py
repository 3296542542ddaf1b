"""Chains with steps of all lengths: a run is as right as it says, or refused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from extremes_of_chains.extreme import ChainExtreme
from numpy.typing import NDArray

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_unchecked
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, SceneError
from tmm_gen.scene.integrator import METHODS
from tmm_gen.simulate.run import simulate

Array = NDArray[np.float64]

SAYS = 1.5
"""How many times larger than a run says its error may be: what it says is of some instants alone."""

LEAST = {"float64": 1e-7, "float32": 1e-5}
"""Share of the motion below which nothing is promised."""


@dataclass(frozen=True, eq=False)
class LongStep:
    """A chain, how long it is simulated, and what turns its tip.

    Parameters
    ----------
    chain : ChainExtreme
        With its step as a share of the first period.
    periods : float
        First periods simulated; a step at least.
    torque : Signal
        At the tip.
    """

    chain: ChainExtreme
    periods: float
    torque: Signal

    def scene(self) -> Scene:
        """Return it as a scene whose outputs are all angles."""
        chain = self.chain
        outputs = [{"name": f"q{k}", "at": k, "of": "angle"} for k in range(1, chain.links + 1)]
        angles = chain.deflection.tolist() if chain.start == "released" else [0.0] * chain.links
        return chain.scene().replace(output=outputs, initial={"angles": angles})

    @property
    def until(self) -> float:
        """Time simulated, s."""
        return max(self.periods, self.chain.step) * self.chain.period


@dataclass(frozen=True)
class Outcome:
    """What became of one.

    Parameters
    ----------
    status : str
        "right", "refused" or "wrong".
    error : float
        Largest error of an angle over the largest motion; zero where refused.
    said : float
        What the run says it is.
    why : str
        The refusal.
    """

    status: str
    error: float = 0.0
    said: float = 0.0
    why: str = ""


def long_steps(count: int, seed: int) -> Iterator[LongStep]:
    """Draw chains: steps from a thousandth of the first period to ten."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        method = METHODS[random.integers(len(METHODS))]
        chain = ChainExtreme(
            links=int(random.choice([1, 2, 3, 10])),
            stiffness_ratio=float(10.0 ** random.uniform(-3, 3)),
            inertia_ratio=float(10.0 ** random.uniform(-3, 3)),
            step=float(10.0 ** random.uniform(-3, 1)),
            damping=float(random.choice([0.0, 1e-3, 1e-1])),
            real="float32" if random.random() < 0.3 else "float64",
            unknown="increment" if random.random() < 0.5 and method.explicit_at != {} else "acceleration",
            integrator=method.name,
            start="released" if random.random() < 0.5 else "loaded",
            pattern=("halves", "alternating", "graded")[random.integers(3)],
        )
        yield LongStep(chain, float(10.0 ** random.uniform(-1, 1)), _torque(chain, random))


def _torque(chain: ChainExtreme, random: np.random.Generator) -> Signal:
    """Draw what turns the tip: nothing but the start, a step, a sine from slow to faster than the chain, or a table."""
    size = chain.torque
    which = random.integers(3)
    if which == 1:
        return Sine(
            size,
            2.0 * np.pi / chain.period * float(10.0 ** random.uniform(-1, 1.5)),
            float(random.uniform(0, 6)),
        )
    if which == 2:
        times = np.cumsum(random.uniform(0.01, 1.0, 8)) * chain.period
        return Table(times, size * random.uniform(-1.0, 1.0, 8))
    return Constant(0.0 if chain.start == "released" else size)


def judge(tried: LongStep) -> Outcome:
    """Simulate and compare with the matrix exponential."""
    chain = tried.chain
    try:
        scene = tried.scene()
        signals = {"tip_torque": tried.torque}
        kernel = _With(_kernel(replace(chain, **_SAME)), chain)
        run = simulate(scene, signals, tried.until, "c", kernel=kernel)
    except (UserError, SceneError) as refusal:
        return Outcome("refused", why=str(refusal))
    assert run.accuracy is not None
    exact = exact_response(scene, signals, run.time)
    off = max(float(np.max(np.abs(run.outputs[name] - exact[name]))) for name in exact)
    way = max(float(np.max(np.abs(exact[name] - exact[name][0]))) for name in exact)
    error = off / way if way > 0.0 else off
    right = error <= SAYS * run.accuracy.error + LEAST[chain.real]
    return Outcome("right" if right else "wrong", error, run.accuracy.error)


_SAME: dict[str, Any] = {
    **{"stiffness_ratio": 2.0, "inertia_ratio": 2.0, "pattern": "halves"},
    **{"start": "loaded", "step": 1e-3, "damping": 1.0},
}
"""What kernels of a kind share: their parameters are free."""


@cache
def _kernel(kind: ChainExtreme) -> NativeKernel:
    scene = LongStep(kind, 1.0, Constant(0.0)).scene()
    return compile_kernel(build_unchecked(scene, integrator(kind.integrator)), scene)


class _With:
    """A kernel that other chains share, with the parameters and the start of one."""

    def __init__(self, kernel: NativeKernel, chain: ChainExtreme) -> None:
        self._kernel = kernel
        self._values: dict[str, Any] = {
            "stiffness": chain.stiffness,
            "inertia": chain.inertia,
            "damping": chain.stiffness * (chain.damping * chain.period),
        }
        if chain.links == 1:
            self._values = {name: float(value[0]) for name, value in self._values.items()}
        self._start = chain.deflection if chain.start == "released" else np.zeros(chain.links)

    def prepare(self, parameters: Any, step: float) -> None:
        self._kernel.prepare({**self._values, **parameters}, step)

    def initialise(self, inputs: Any) -> None:
        self._kernel.initialise(inputs, initial_angle=self._start)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._kernel, name)
