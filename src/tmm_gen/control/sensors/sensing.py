"""What accelerometers and strain gauges of an arm by parts show, as functions of its motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.sensors.accelerometers import PlanarAccelerometer, SpaceAccelerometer, accelerometer_of
from tmm_gen.control.sensors.gauges import Gauge, Site, site_of
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.scene import Scene

Array = NDArray[np.float64]
Accelerometer = PlanarAccelerometer | SpaceAccelerometer


@dataclass(frozen=True, eq=False)
class Sensing:
    """Accelerometers and gauges on an arm of d angles and m motors.

    Parameters
    ----------
    size : int
        d.
    accelerometers, gauges : tuple, length m
        One of each motor; None where it has none.
    """

    size: int
    accelerometers: tuple[Accelerometer | None, ...]
    gauges: tuple[Gauge | None, ...]

    @classmethod
    def of(
        cls, scene: Scene, motors: Motors, problem: ControlProblem, sites: tuple[Site | None, ...]
    ) -> Sensing:
        """Return those of an arm.

        Parameters
        ----------
        scene : Scene
            By parts, of any cells.
        motors : Motors
            Of the same.
        problem : ControlProblem
            Says which there are.
        sites : tuple of Site or None, length m
            Of the gauges; see :func:`sites_of`.
        """
        felt = ~np.isnan(problem.accelerometers)
        return cls(
            size=len(motors.lengths),
            accelerometers=tuple(
                accelerometer_of(scene, motors, k) if there else None for k, there in enumerate(felt)
            ),
            gauges=tuple(Gauge.of(scene, motors, k, site) if site else None for k, site in enumerate(sites)),
        )

    @property
    def count(self) -> int:
        """Number of motors, m."""
        return len(self.gauges)

    @property
    def none(self) -> bool:
        """Whether there is nothing but encoders."""
        return not any(self.accelerometers) and not any(self.gauges)

    def shown(self, angles: Any, rates: Any, growth: Any) -> Any:
        """Return what they show, 2 m rows, zero where there is none, by vectors of CasADi, d rows each."""
        import casadi as ca

        felt = [each.felt(angles, rates, growth) if each else 0.0 for each in self.accelerometers]
        bent = [
            ca.dot(ca.DM(each.angle), angles) + ca.dot(ca.DM(each.rate), rates) if each else 0.0
            for each in self.gauges
        ]
        return ca.vertcat(*felt, *bent)

    @cached_property
    def function(self) -> Any:
        """``q, q', q'' -> shown``, its derivatives by each of them, a CasADi function."""
        import casadi as ca

        motion = [ca.SX.sym(name, self.size) for name in ("q", "v", "a")]
        shown = ca.SX(self.shown(*motion))
        slopes = [ca.densify(ca.jacobian(shown, each)) for each in motion]
        return ca.Function("shown", motion, [ca.densify(shown), *slopes])

    def values(self, angles: Array, rates: Array, growth: Array) -> Array:
        """Return what they show, (2 m,), zero where there is none; arguments are (d,) each."""
        return np.array(self.function(angles, rates, growth)[0], float).ravel()

    def swept(self, angles: Array, turned: Array) -> Array:
        """Return what rates of hubs add to the accelerometers where nothing else moves, (m, m, m): by products of two.

        Parameters
        ----------
        angles : array, (d,)
            Where the arm is, rad.
        turned : array, (d, m)
            What angles grow by as hubs turn.
        """
        still = np.zeros(self.size)

        def at(rate: Array) -> Array:
            # of a motion without accelerations what is left beyond weight is of second order in the rates
            return self.values(angles, turned @ rate, still)[: self.count]

        none, units = at(np.zeros(self.count)), np.eye(self.count)
        alone = [at(unit) - none for unit in units]
        found = np.zeros((self.count,) * 3)
        for i, one in enumerate(units):
            for j, other in enumerate(units):
                found[:, i, j] = alone[i] if i == j else 0.5 * (at(one + other) - none - alone[i] - alone[j])
        return found


def sites_of(scene: Scene, motors: Motors, problem: ControlProblem) -> tuple[Site | None, ...]:
    """Return where gauges are, by the cells of the scene that tells of them; None where there is none."""
    there = ~np.isnan(problem.gauges)
    return tuple(site_of(scene, motors, k) if each else None for k, each in enumerate(there))
