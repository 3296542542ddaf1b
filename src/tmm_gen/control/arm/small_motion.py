"""Linear models of an arm about any angles, from the generated model itself.

A step of no length leaves angles and rates as they are and finds the accelerations that go with them: of Newmark's
formulas ``q + h v + ...`` nothing else is left. So the derivatives of such a step by its state and its inputs are those
of the equations of motion, of every kind of arm, and those of its outputs belong to them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.linear_model import LinearModel
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


@dataclass(frozen=True, eq=False)
class SmallMotion:
    """Linear models of a scene's arm; what they share is derived once.

    Parameters
    ----------
    scene : Scene
        With Newmark's method.
    program : Program
        Its kernel.
    module : module
        The same in CasADi.
    """

    scene: Scene
    program: Program
    module: Any

    @classmethod
    def of(cls, scene: Scene) -> SmallMotion:
        """Derive a scene's arm, of any kind, with any integrator and by any linearisation: all have one motion."""
        changes: dict[str, object] = {}
        if scene.integrator.name != _METHOD:
            changes["integrator.name"] = _METHOD
        # in a plane others follow a prediction, and keep more than the motion
        if scene.model.kind == "planar" and scene.model.linearisation != "newton":
            changes["model.linearisation"] = "newton"
        if changes:
            scene = scene.replace(**changes)
        program = build_program(scene)
        return cls(scene, program, casadi_module(scene, program))

    def about(
        self, angles: Array | None = None, inputs: Mapping[str, float] | None = None, *, still: bool = True
    ) -> LinearModel:
        """Return the model about some angles.

        Parameters
        ----------
        angles : array, (d,), optional
            Of what turns freely: of a planar arm those of its hub, where it has one, and of its links; in space those
            of the joints that no input prescribes. By default those of the scene's start.
        inputs : mapping from str to float, optional
            Constant inputs by name; those not given are zero.
        still : bool
            Whether nothing moves there; otherwise all moves as at the scene's start.

        Raises
        ------
        UserError
            If the equations of motion have no solution there.
        """
        acting = np.zeros(len(self.module.INPUT_NAMES))
        for item in self.scene.inputs:
            acting[self.module.INPUT_NAMES.index(kernel_names(item)[0])] = (inputs or {}).get(item.name, 0.0)
        state = self._start(acting)
        if angles is not None:  # of a base that floats the place stays as it starts
            state[list(self._free[: len(angles)])] = angles
        if still:
            state[list(self._rates)] = 0.0
        after, output, *slopes = (np.array(each, float) for each in self._slopes(state, acting))
        return self._model(acting, after.ravel(), output.ravel(), *slopes)

    def _model(
        self,
        acting: Array,
        after: Array,
        output: Array,
        by_state: Array,
        by_inputs: Array,
        read_state: Array,
        read_inputs: Array,
    ) -> LinearModel:
        """Return the model of a step of no length, its outputs, and the derivatives of both."""
        names, rates, spread = self.module.STATE_NAMES, list(self._rates), self._spread(after)
        accelerations, d = list(self._accelerations), len(self._rates)
        a, b = np.zeros((2 * d, 2 * d)), np.zeros((2 * d, len(acting)))
        a[:d, d:] = np.eye(d)
        # the way of a small turn s about axes that turn themselves: s' = omega + s x omega / 2
        if self._turn:
            a[d - 3 : d, d - 3 : d] = -0.5 * _crossing(after[rates[-3:]])
        a[d:] = by_state[accelerations] @ spread
        b[d:] = by_inputs[accelerations]
        shown = [k for k, name in enumerate(self.module.OUTPUT_NAMES) if name in self._read]
        turns = [f"{_TURN}_{axis}" for axis in "xyz"] if self._turn else []
        found = LinearModel(
            name=self.scene.name,
            A=a,
            B=b,
            C=read_state[shown] @ spread,
            D=read_inputs[shown],
            states=(*(names[k] for k in self._free), *turns, *(names[k] for k in rates)),
            inputs=tuple(self.module.INPUT_NAMES),
            outputs=tuple(self.module.OUTPUT_NAMES[k] for k in shown),
            x0=np.concatenate([after[list(self._free)], np.zeros(len(turns)), after[rates]]),
            u0=acting,
            y0=output[shown],
            drift=np.concatenate([after[rates], after[accelerations]]),
        )
        if not all(np.all(np.isfinite(each)) for each in (found.A, found.B, found.C, found.D, found.drift)):
            raise UserError(
                f"scene '{self.scene.name}': its equations of motion have no finite solution there. "
                "Look for numbers that are far too large or small."
            )
        return found

    @cached_property
    def _slopes(self) -> Any:
        """From state and inputs to a step of no length, its outputs, and the derivatives of both, in CasADi."""
        import casadi as ca

        module = self.module
        p = np.array(module.default_parameters(), float).ravel()
        still = p.copy()
        still[module.PARAMETER_NAMES.index(self.program.step.name)] = 0.0
        x, u = ca.SX.sym("x", len(module.STATE_NAMES)), ca.SX.sym("u", len(module.INPUT_NAMES))
        step = module.step_function()
        after = step(x, u, still)[0]
        output = step(after, u, p)[1]
        slopes = [ca.densify(ca.jacobian(of, by)) for of in (after, output) for by in (x, u)]
        return ca.Function("slopes", [x, u], [after, output, *slopes])

    # -- places in the kernel's state ---------------------------------------------------------------------------

    @cached_property
    def _free(self) -> tuple[int, ...]:
        """Coordinates that the equations of motion decide; a base that is prescribed follows its input."""
        names = self.module.STATE_NAMES
        joints = self.scene.spatial.joints if self.scene.spatial is not None else ()
        given = {f"angle_{number}" for number, joint in enumerate(joints, start=1) if joint.given}
        return tuple(
            k
            for k, name in enumerate(names)
            if name not in given and any(_renamed(name, words, 2) in names for words in _KINDS)
        )

    @cached_property
    def _rates(self) -> tuple[int, ...]:
        return self._derivatives(1) + self._called(_OMEGA)

    @cached_property
    def _accelerations(self) -> tuple[int, ...]:
        return self._derivatives(2) + self._called(_ALPHA)

    @cached_property
    def _turn(self) -> tuple[int, ...]:
        return self._called(_QUATERNION)

    def _called(self, which: str) -> tuple[int, ...]:
        return tuple(k for k, name in enumerate(self.module.STATE_NAMES) if name.startswith(which))

    def _derivatives(self, order: int) -> tuple[int, ...]:
        names: tuple[str, ...] = self.module.STATE_NAMES
        renamed = ((_renamed(names[k], words, order) for words in _KINDS) for k in self._free)
        return tuple(names.index(next(filter(names.__contains__, each))) for each in renamed)

    def _start(self, acting: Array) -> Array:
        """Return the kernel's state where the scene starts."""
        given = {variable.name: np.array(variable.default, float) for variable in self.program.given}
        found = self.module.initial_function()(**given, u=acting, p=self.module.default_parameters())["x"]
        return np.array(found, float).ravel()

    def _spread(self, state: Array) -> Array:
        """Return how the kernel's state follows coordinates and their rates, (kernel's states, s)."""
        d = len(self._rates)
        found = np.zeros((len(state), 2 * d))
        found[self._free, range(len(self._free))] = 1.0
        found[self._rates, range(d, 2 * d)] = 1.0
        if self._turn:
            w, *vector = state[list(self._turn)]
            columns = np.vstack([-np.array(vector), w * np.eye(3) + _crossing(np.array(vector))])
            found[np.ix_(self._turn, range(d - 3, d))] = 0.5 * columns
        return found

    @cached_property
    def _read(self) -> frozenset[str]:
        """Columns of outputs that answer in proportion: energies go with the square of the motion."""
        scene = self.scene
        outputs = [item for item in scene.outputs if not scene.quantity(item).of_arm]
        return frozenset(name for item in outputs for name in scene.quantity(item).columns(item.name))


def _renamed(name: str, words: tuple[str, ...], order: int) -> str:
    """Return the name of a coordinate's derivative; nothing where it is no coordinate of that kind."""
    parts = name.split("_")
    return "_".join(words[order] if part == words[0] else part for part in parts) if words[0] in parts else ""


def _crossing(vector: Array) -> Array:
    """Return the matrix of the cross product with a vector, (3, 3)."""
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
