"""A planar arm held still: the forces in it, and what is out of balance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.limbs import limbs_of
from tmm_gen.scene import Scene, station_of
from tmm_gen.scene.flat import require_flat

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Rest:
    """A configuration of a planar arm without motion.

    Parameters
    ----------
    angles : array, (n,)
        Of the links, rad.
    hub : float
        Angle of hub or prescribed base, rad.
    inner, outer : array, (n, 3)
        ``F_x, F_y, M`` at the ends of each link, by the inner side on the outer one; N, N, N m.
    unbalanced : array, (n + 1,) with a motor, else (n,)
        Torque that turns each free angle, N m; zero in equilibrium.
    """

    angles: Array
    hub: float
    inner: Array
    outer: Array
    unbalanced: Array

    @property
    def free_angles(self) -> Array:
        """Angles the equilibrium decides, the hub's first where it turns freely."""
        turning = len(self.unbalanced) > len(self.angles)
        return np.concatenate([[self.hub], self.angles]) if turning else self.angles


def straight(scene: Scene) -> Array:
    """Return the free angles of the scene's start: that of a motor's hub (0), then the links'."""
    links = np.array(scene.initial.angles, float)
    return np.concatenate([np.zeros(scene.hub), links])


def slack(scene: Scene) -> Array:
    """Return the free angles at which no spring is wound up; what turns freely stands as at the scene's start."""
    limbs, start = limbs_of(scene), np.array(scene.initial.angles, float)
    held = np.array([joint.stiffness > 0.0 for joint in scene.joints])
    rest = np.array([joint.rest for joint in scene.joints])
    return np.concatenate(
        [np.zeros(scene.hub), limbs.outward(np.where(held, rest, start - limbs.inner(start)))]
    )


def rest_at(
    scene: Scene, free_angles: Array, gravity: float | None = None, inputs: Mapping[str, float] | None = None
) -> Rest:
    """Return the forces that hold a planar arm still.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    free_angles : array
        As of :func:`straight`, rad.
    gravity : float, optional
        m/s^2; by default the scene's.
    inputs : mapping from str to float, optional
        Constant inputs by name; those not given are zero.
    """
    require_flat(scene, "angles of links at rest do not")
    given = inputs or {}
    turning = scene.hub
    n = scene.stations
    angles = np.asarray(free_angles, float)[turning:]
    prescribed = sum(given.get(item.name, 0.0) for item in scene.inputs if item.acts == "angle")
    hub = float(free_angles[0]) if turning else prescribed
    falling = (scene.model.gravity or 0.0) if gravity is None else gravity
    if scene.floats:  # it falls freely, and no joint feels it
        falling = 0.0
    loads = _loads(scene, given)
    link_balance, tip_balance = _balance("link"), _balance("tip")
    carried = np.zeros((n + 1, 3))  # at the base and each link's outer end
    if scene.tip:
        carried[n] = tip_balance(falling, 0.0, *carried[n], scene.tip.mass, scene.tip.inertia)
    inner, outer = np.zeros((n, 3)), np.zeros((n, 3))
    for i in reversed(range(n)):
        link = scene.links[i]
        outer[i] = carried[i + 1] - loads[i + 1]
        own = (link.length, link.mass, link.inertia, link.center)
        inner[i] = link_balance(falling, angles[i], *outer[i], *own)
        carried[scene.host(i + 1)] += inner[i]
    limbs = limbs_of(scene)
    before = np.concatenate([[hub], angles])[list(limbs.hosts)]
    slack = np.array([joint.rest for joint in scene.joints])
    springs = np.array([joint.stiffness for joint in scene.joints]) * (before - angles + slack)
    for item in scene.inputs:
        if item.acts == "drive" and isinstance(item.at, int):
            springs[item.at - 1] += scene.joints[item.at - 1].gear * given.get(item.name, 0.0)
    missing = springs - inner[:, 2]
    at_base, *at_links = limbs.carried(missing)
    turned = missing - at_links
    if turning:
        turned = np.concatenate([[loads[0][2] - carried[0, 2] - at_base], turned])
    return Rest(angles, hub, inner, outer, turned)


def _loads(scene: Scene, given: Mapping[str, float]) -> Array:
    """Return the external loads at hub and links, (n + 1, 3)."""
    found = np.zeros((scene.stations + 1, 3))
    for item in scene.inputs:
        if item.acts not in ("angle", "drive"):
            component = ("force_x", "force_y", "torque").index(item.acts)
            found[station_of(item.at, scene.stations), component] += given.get(item.name, 0.0)
    return found


@cache
def _balance(name: str) -> Any:
    import sympy as sp

    from tmm_gen.derive.elements.planar import LINK, TIP
    from tmm_gen.derive.small_motion import GRAVITY, REST_ANGLE, REST_FORCES, rest_balance

    element = LINK if name == "link" else TIP
    symbols = (GRAVITY, REST_ANGLE, *REST_FORCES["out"], *element.parameters)
    return sp.lambdify(symbols, list(rest_balance(element).inner), "numpy", cse=True)
