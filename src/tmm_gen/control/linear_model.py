"""An arm in small motion as ``x' = A x + B u, y = C x + D u``, about any angles: from the generated model itself.

A step of no length leaves angles and rates as they are and finds the accelerations that go with them: with Newmark's
formulas ``q + h v + ...`` nothing else is left of them. So the derivatives of such a step by its state and its inputs
are those of the equations of motion, of every kind of arm, and those of its outputs belong to them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.native.python_module import casadi_module
from tmm_gen.program.build import build_program
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import kernel_names

Array = NDArray[np.float64]

_METHOD = "newmark"
_KINDS = (("angle", "rate", "acceleration"), ("place", "velocity", "acceleration"))
"""How the state calls a coordinate and its derivatives."""
_QUATERNION, _OMEGA, _ALPHA, _TURN = "base_quaternion", "base_omega", "base_alpha", "base_turn"
"""The same of a base that floats in space; the last, a small turn about its own axes, stands for the first."""


@dataclass(frozen=True, eq=False, repr=False)
class LinearModel:
    """``x' = drift + A (x - x0) + B (u - u0)`` and ``y = y0 + C (x - x0) + D (u - u0)``.

    Parameters
    ----------
    name : str
        Of the scene.
    A : array, (s, s)
        By states.
    B : array, (s, m)
        By inputs.
    C : array, (k, s)
        Of outputs by states.
    D : array, (k, m)
        Of outputs by inputs.
    states : tuple of str
        Names as the generated kernel has them: coordinates, rad or m, then their rates. The turn of a base that floats
        in space is counted about its own axes, from where it stands.
    inputs : tuple of str
        Names as the kernel has them: a prescribed base has its angle, its rate and its acceleration.
    outputs : tuple of str
        Columns of the outputs but energies, which go with the square of the motion.
    x0 : array, (s,)
        Where the arm stands.
    u0 : array, (m,)
        What acts there.
    y0 : array, (k,)
        Outputs there.
    drift : array, (s,)
        ``x'`` there; zero but for rounding in an equilibrium.
    """

    name: str
    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x0: Array
    u0: Array
    y0: Array
    drift: Array

    @cached_property
    def poles(self) -> NDArray[np.complex128]:
        """Eigenvalues of ``A``, 1/s, (s,), the slowest first."""
        found = np.linalg.eigvals(self.A).astype(complex)
        order: NDArray[np.complex128] = found[np.argsort(np.abs(found), kind="stable")]
        return order

    def __repr__(self) -> str:
        """Say how large it is."""
        counts = {"state": self.states, "input": self.inputs, "output": self.outputs}
        said = (f"{len(names)} {what}{'s' * (len(names) != 1)}" for what, names in counts.items())
        return f"<LinearModel of {self.name}: {', '.join(said)}>"

    def state_space(self) -> Any:
        """Return it as a ``scipy.signal.StateSpace`` in continuous time."""
        from scipy.signal import StateSpace  # slow to import

        return StateSpace(self.A, self.B, self.C, self.D)


def linear_model(
    scene: Scene,
    angles: Array | None = None,
    inputs: Mapping[str, float] | None = None,
    *,
    still: bool = True,
) -> LinearModel:
    """Return a scene's arm in small motion.

    Parameters
    ----------
    scene : Scene
        Of any kind.
    angles : array, (d,), optional
        Of what turns freely: of a planar arm those of its hub, where it has one, and of its links; in space those of
        the joints that no input prescribes. By default those of the scene's start.
    inputs : mapping from str to float, optional
        Constant inputs by name; those not given are zero.
    still : bool
        Whether nothing moves there; otherwise all moves as at the scene's start.

    Raises
    ------
    UserError
        If the arm has no input or output to speak of, or the equations have no solution there.
    """
    if scene.integrator.name != _METHOD:
        scene = scene.replace(**{"integrator.name": _METHOD})
    program = build_program(scene)
    return _Point.of(scene, program, angles, inputs or {}, still).model()


@dataclass(frozen=True, eq=False)
class _Point:
    """Where a model is taken, in terms of the generated module.

    Parameters
    ----------
    scene : Scene
        With Newmark's method.
    module : module
        That of CasADi.
    state : array, (kernel's states,)
        With any accelerations.
    acting : array, (kernel's inputs,)
        Constant inputs.
    coordinates, rates, accelerations : tuple of int
        Places of what moves freely in the kernel's state; those of a quaternion are none of them.
    turn : tuple of int
        Places of the quaternion of a base that floats in space; empty elsewhere.
    """

    scene: Scene
    module: Any
    state: Array
    acting: Array
    coordinates: tuple[int, ...]
    rates: tuple[int, ...]
    accelerations: tuple[int, ...]
    turn: tuple[int, ...]

    @classmethod
    def of(
        cls,
        scene: Scene,
        program: Program,
        angles: Array | None,
        inputs: Mapping[str, float],
        still: bool,
    ) -> _Point:
        """Find the places of what moves, and put the arm where it is to be."""
        module = casadi_module(scene, program)
        names: tuple[str, ...] = module.STATE_NAMES
        acting = np.zeros(len(module.INPUT_NAMES))
        for item in scene.inputs:
            acting[module.INPUT_NAMES.index(kernel_names(item)[0])] = inputs.get(item.name, 0.0)
        free = _free(scene, names)
        state = _start(program, module, acting)
        if angles is not None:  # of a base that floats the place stays as it starts
            state[list(free[: len(angles)])] = angles
        turn = tuple(k for k, name in enumerate(names) if name.startswith(_QUATERNION))
        spin, spun = (
            tuple(k for k, name in enumerate(names) if name.startswith(which)) for which in (_OMEGA, _ALPHA)
        )
        rates = tuple(_partner(names, k, 1) for k in free) + spin
        if still:
            state[list(rates)] = 0.0
        accelerations = tuple(_partner(names, k, 2) for k in free) + spun
        return cls(scene, module, state, acting, free, rates, accelerations, turn)

    def model(self) -> LinearModel:
        """Return the model."""
        names, d = self.module.STATE_NAMES, len(self.rates)
        after, output, by_state, by_inputs, read_state, read_inputs = self._slopes()
        spread = self._spread()
        a, b = np.zeros((2 * d, 2 * d)), np.zeros((2 * d, len(self.acting)))
        a[:d, d:] = np.eye(d)
        if self.turn:  # the way of a small turn s about axes that turn themselves: s' = omega + s x omega / 2
            a[d - 3 : d, d - 3 : d] = -0.5 * _crossing(after[list(self.rates[-3:])])
        a[d:] = by_state[list(self.accelerations)] @ spread
        b[d:] = by_inputs[list(self.accelerations)]
        shown = [k for k, name in enumerate(self.module.OUTPUT_NAMES) if name in _read(self.scene)]
        moved = [names[k] for k in self.coordinates]
        turns = [f"{_TURN}_{axis}" for axis in "xyz"] if self.turn else []
        found = LinearModel(
            name=self.scene.name,
            A=a,
            B=b,
            C=read_state[shown] @ spread,
            D=read_inputs[shown],
            states=(*moved, *turns, *(names[k] for k in self.rates)),
            inputs=tuple(self.module.INPUT_NAMES),
            outputs=tuple(self.module.OUTPUT_NAMES[k] for k in shown),
            x0=np.concatenate([after[list(self.coordinates)], np.zeros(len(turns)), after[list(self.rates)]]),
            u0=self.acting,
            y0=output[shown],
            drift=np.concatenate([after[list(self.rates)], after[list(self.accelerations)]]),
        )
        if not all(np.all(np.isfinite(each)) for each in (found.A, found.B, found.C, found.D, found.drift)):
            raise UserError(
                f"scene '{self.scene.name}': its equations of motion have no finite solution there. "
                "Look for numbers that are far too large or small."
            )
        return found

    def _slopes(self) -> list[Array]:
        """Return state and outputs of a step of no length, and their derivatives by state and inputs."""
        import casadi as ca

        module = self.module
        p = np.array(module.default_parameters(), float).ravel()
        still = p.copy()
        still[module.PARAMETER_NAMES.index("step")] = 0.0
        x, u = ca.SX.sym("x", len(self.state)), ca.SX.sym("u", len(self.acting))
        step = module.step_function()
        after = step(x, u, still)[0]
        output = step(after, u, p)[1]
        results = [after, output]
        results += [ca.densify(ca.jacobian(of, by)) for of in (after, output) for by in (x, u)]
        found = ca.Function("slopes", [x, u], results)(self.state, self.acting)
        after, output, *slopes = (np.array(each, float) for each in found)
        return [after.ravel(), output.ravel(), *slopes]

    def _spread(self) -> Array:
        """Return how the kernel's state follows coordinates and their rates, (kernel's states, s)."""
        d = len(self.rates)
        found = np.zeros((len(self.state), 2 * d))
        found[self.coordinates, range(len(self.coordinates))] = 1.0
        found[self.rates, range(d, 2 * d)] = 1.0
        if self.turn:
            w, *vector = self.state[list(self.turn)]
            columns = np.vstack([-np.array(vector), w * np.eye(3) + _crossing(np.array(vector))])
            found[np.ix_(self.turn, range(d - 3, d))] = 0.5 * columns
        return found


def _free(scene: Scene, names: tuple[str, ...]) -> tuple[int, ...]:
    """Return the places of the coordinates that the equations of motion decide, in the order of the state.

    A base that is prescribed follows its input.
    """
    joints = scene.spatial.joints if scene.spatial is not None else ()
    given = {f"angle_{number}" for number, joint in enumerate(joints, start=1) if joint.given}
    return tuple(
        k
        for k, name in enumerate(names)
        if name not in given and any(_renamed(name, words, 2) in names for words in _KINDS)
    )


def _renamed(name: str, words: tuple[str, ...], order: int) -> str:
    """Return the name of a coordinate's derivative; nothing where it is no coordinate of that kind."""
    parts = name.split("_")
    return "_".join(words[order] if part == words[0] else part for part in parts) if words[0] in parts else ""


def _partner(names: tuple[str, ...], place: int, order: int) -> int:
    """Return the place of a coordinate's derivative."""
    return next(names.index(name) for words in _KINDS if (name := _renamed(names[place], words, order)))


def _start(program: Program, module: Any, acting: Array) -> Array:
    """Return the kernel's state where the scene starts."""
    given = {variable.name: np.array(variable.default, float) for variable in program.given}
    found = module.initial_function()(**given, u=acting, p=module.default_parameters())["x"]
    return np.array(found, float).ravel()


def _read(scene: Scene) -> frozenset[str]:
    """Return the columns of outputs that answer in proportion."""
    outputs = [item for item in scene.outputs if not scene.quantity(item).of_arm]
    return frozenset(name for item in outputs for name in scene.quantity(item).columns(item.name))


def _crossing(vector: Array) -> Array:
    """Return the matrix of the cross product with a vector, (3, 3)."""
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
