"""Mass, damping and stiffness matrices of a chain, assembled as in a textbook.

Nothing here comes from `derive` or `program`: the reference solutions built on it are to be independent
of the derivation they check. Each joint adds its stiffness to four entries of the stiffness matrix,
each inertia one to the diagonal of the mass matrix.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.scene import Output, Scene, station_of

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Assembly:
    """``M q'' + C q' + K q = F u + G u'`` with outputs ``y = Q q + V q' + W q'' + D u + E u' + H u''``.

    The coordinates ``q`` are the angles that are free: of a motor's hub, then of the links from base to
    tip.

    Parameters
    ----------
    mass, damping, stiffness : array, (m, m)
        kg m^2, N m s/rad, N m/rad; the mass matrix is diagonal.
    load, load_rate : array, (m, inputs)
        What inputs and their rates contribute to the torques; the rates only where the base is prescribed.
    from_angle, from_rate, from_acceleration : array, (outputs, m)
        Shares of ``q, q', q''`` in the outputs.
    from_input, from_input_rate, from_input_acceleration : array, (outputs, inputs)
        Shares of inputs, their rates and accelerations in the outputs; of a prescribed base only.
    angle, rate : array, (m,)
        Initial values.
    free : bool
        Whether the chain can turn as a whole: no angle holds it.
    inputs, outputs : tuple of str
        Names, in the order of the scene.
    """

    mass: Array
    damping: Array
    stiffness: Array
    load: Array
    load_rate: Array
    from_angle: Array
    from_rate: Array
    from_acceleration: Array
    from_input: Array
    from_input_rate: Array
    from_input_acceleration: Array
    angle: Array
    rate: Array
    free: bool
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]

    def static(self, inputs: Array) -> Array:
        """Return the outputs at rest under constant inputs, ``(outputs,)``.

        Raises
        ------
        ValueError
            If the chain can turn as a whole: it need not come to rest.
        """
        if self.free:
            raise ValueError("a chain that turns freely has no static deflection")
        angle = np.linalg.solve(self.stiffness, self.load @ inputs)
        return self.from_angle @ angle + self.from_input @ inputs


def assemble(scene: Scene) -> Assembly:
    """Assemble a scene of kind "chain".

    Raises
    ------
    UserError
        If the scene is of another kind.
    """
    if not scene.model.linear:
        raise UserError(
            f'{scene.source.origin}: model.kind = "{scene.model.kind}" cannot be measured yet. '
            'Use a scene with kind = "chain".'
        )
    n, first = scene.stations, scene.hub
    m = n + first
    mass, damping, stiffness = np.zeros((m, m)), np.zeros((m, m)), np.zeros((m, m))
    if first:
        mass[0, 0] = scene.base.inertia
        damping[0, 0] = scene.base.damping
    for i, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True)):
        outer, inner = first + i, first + scene.host(i + 1) - 1
        mass[outer, outer] = link.inertia
        for matrix, value in ((stiffness, joint.stiffness), (damping, joint.damping)):
            matrix[outer, outer] += value
            if inner >= 0:  # which turns the ratio more than the outer side does
                matrix[inner, inner] += value / joint.ratio**2
                matrix[inner, outer] -= value / joint.ratio
                matrix[outer, inner] -= value / joint.ratio

    load, load_rate = np.zeros((m, len(scene.inputs))), np.zeros((m, len(scene.inputs)))
    for k, item in enumerate(scene.inputs):
        if item.acts == "angle":  # through springs and dampers on the base
            for i, joint in enumerate(scene.joints):
                if not scene.host(i + 1):
                    load[i, k] = joint.stiffness / joint.ratio
                    load_rate[i, k] = joint.damping / joint.ratio
        else:
            load[station_of(item.at, n) - 1 + first, k] = item.factor

    measured = _Measured(scene, m, first)
    for row, output in enumerate(scene.outputs):
        measured.add(row, output)
    return Assembly(
        mass,
        damping,
        stiffness,
        load,
        load_rate,
        measured.from_angle,
        measured.from_rate,
        measured.from_acceleration,
        measured.from_input,
        measured.from_input_rate,
        measured.from_input_acceleration,
        angle=np.array([0.0] * first + list(scene.initial.angles)),
        rate=np.array([0.0] * first + list(scene.initial.rates)),
        free=bool(first),
        inputs=tuple(item.name for item in scene.inputs),
        outputs=tuple(item.name for item in scene.outputs),
    )


def twists(scene: Scene) -> Array:
    """Return how the joints of a chain without gears twist by its angles, (n, m); a base that is none does not turn."""
    n, first = scene.stations, scene.hub
    found = np.eye(n, n + first, k=first)
    for i in range(n):
        if (inner := first + scene.host(i + 1) - 1) >= 0:
            found[i, inner] = -1.0
    return found


class _Measured:
    """Rows of the output matrices, filled one output at a time."""

    def __init__(self, scene: Scene, coordinates: int, first: int) -> None:
        rows = len(scene.outputs)
        self.scene, self.first = scene, first
        self.from_angle = np.zeros((rows, coordinates))
        self.from_rate = np.zeros((rows, coordinates))
        self.from_acceleration = np.zeros((rows, coordinates))
        self.from_input = np.zeros((rows, len(scene.inputs)))
        self.from_input_rate = np.zeros((rows, len(scene.inputs)))
        self.from_input_acceleration = np.zeros((rows, len(scene.inputs)))
        angles = [k for k, item in enumerate(scene.inputs) if item.acts == "angle"]
        self.base_input = angles[0] if angles else None

    def add(self, row: int, output: Output) -> None:
        station = station_of(output.at, self.scene.stations)
        quantity = self.scene.quantity(output)
        if quantity.in_joint:
            number = max(station, 1)  # the torque at the base is that of joint 1
            joint = self.scene.joints[number - 1]
            for turned, at in (
                (output.factor, number),
                (-output.factor / joint.ratio, self.scene.host(number)),
            ):
                self._angle(row, at, turned * joint.stiffness)
                self._rate(row, at, turned * joint.damping)
        elif quantity.order == 0:
            self._angle(row, station, output.factor)
        elif quantity.order == 1:
            self._rate(row, station, output.factor)
        elif self._moves(station):
            self.from_acceleration[row, self.first + station - 1] = output.factor
        elif self.base_input is not None:
            self.from_input_acceleration[row, self.base_input] = output.factor

    def _moves(self, station: int) -> bool:
        return self.first + station >= 1

    def _angle(self, row: int, station: int, factor: float) -> None:
        if self._moves(station):
            self.from_angle[row, self.first + station - 1] += factor
        elif self.base_input is not None:
            self.from_input[row, self.base_input] += factor

    def _rate(self, row: int, station: int, factor: float) -> None:
        if self._moves(station):
            self.from_rate[row, self.first + station - 1] += factor
        elif self.base_input is not None:
            self.from_input_rate[row, self.base_input] += factor
