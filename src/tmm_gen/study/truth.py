"""Reference motions that errors are measured against, at any instants.

A chain's is exact (matrix exponential of its assembled matrices); an arm's has about ten digits (Radau IIA of order 19
on equations derived apart from the kernels'), and is integrated once, then evaluated anywhere.
"""

from __future__ import annotations

import io
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.collocation import Trajectory
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.planar_reference import dissipated, read
from tmm_gen.reference.reference import exact_response
from tmm_gen.reference.spatial_given import given
from tmm_gen.reference.spatial_motion import completed, trajectory
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.study.excitation import Excitation, columns

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Truth:
    """The motion of a scene as it is.

    Parameters
    ----------
    scene : Scene
        With its links; step and integrator do not matter.
    excitation : Excitation
        What it goes through.
    trajectory : Trajectory, optional
        Of a planar arm.
    unit : float, optional
        What errors are relative to; by default this motion's own travel.
    """

    scene: Scene
    excitation: Excitation
    trajectory: Trajectory | None
    unit: float | None = None

    def at(self, times: Array) -> Array:
        """Return the output that is looked at, (columns, k), at instants (k,), increasing from 0 on."""
        wanted = columns(self.scene, self.excitation.output)
        if self.trajectory is None:
            found = exact_response(self.scene, self.excitation.signals, times)
        elif self.scene.spatial is not None:
            found = self._in_space(self.scene.spatial, self.trajectory, times)
        else:
            output = next(item for item in self.scene.outputs if item.name == self.excitation.output)
            arm = Arm(self.scene, self.excitation.signals)
            if self.scene.quantity(output).accumulates:
                found = {output.name: dissipated(arm, self.trajectory, times)}
            else:
                found = read(arm, output, times, *self.trajectory.at(times))
        return np.array([found[name] for name in wanted])

    def _in_space(self, arm: SpatialArm, trajectory: Trajectory, times: Array) -> dict[str, Array]:
        """Return the output of an arm in space, by column."""
        looked_at = tuple(item for item in arm.outputs if item.name == self.excitation.output)
        signals = self.excitation.signals
        q, v, _ = trajectory.at(times)
        moved = completed(arm, signals, times, q, v)
        return outputs(replace(arm, outputs=looked_at), *moved, given(arm, signals, times))

    @cached_property
    def travel(self) -> float:
        """How far the output gets from where it starts: what relative errors are relative to."""
        if self.unit is not None:
            return self.unit
        values = self.at(np.linspace(0.0, self.excitation.until, 2001))
        return float(np.max(np.linalg.norm(values - values[:, :1], axis=0)))


def find_truth(scene: Scene, excitation: Excitation) -> Truth:
    """Integrate the reference motion of a scene.

    Raises
    ------
    ReferenceError
        If the equations cannot be integrated.
    """
    if scene.model.linear:
        return Truth(scene, excitation, None)
    # a little beyond the end: the last of many steps may lie behind it by rounding
    until = excitation.until * (1.0 + 1e-9)
    if scene.spatial is not None:
        return Truth(scene, excitation, trajectory(scene.spatial, excitation.signals, until))
    return Truth(scene, excitation, Arm(scene, excitation.signals).trajectory(until))


def packed(trajectory: Trajectory) -> bytes:
    """Return a trajectory as bytes, to be kept."""
    with io.BytesIO() as buffer:
        np.savez_compressed(
            buffer,
            ends=trajectory.ends,
            angle=trajectory.angle,
            rate=trajectory.rate,
            acceleration=trajectory.acceleration,
        )
        return buffer.getvalue()


def unpacked(content: bytes) -> Trajectory:
    """Return what :func:`packed` has kept."""
    with np.load(io.BytesIO(content), allow_pickle=False) as found:
        return Trajectory(found["ends"], found["angle"], found["rate"], found["acceleration"])
