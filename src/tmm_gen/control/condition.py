"""Under what conditions controllers are tried: in what the arm differs from what they were told."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Condition:
    """How the arm differs from the scene.

    Parameters
    ----------
    name : str
        One word.
    title : str
        A few words.
    payload : float
        Factor of the tip's mass.
    stiffness : float
        Factor of stiffness and damping of all joints.
    friction : float
        Coulomb friction of the hub, N m.
    gravity : float
        m/s^2, added to the scene's; model-based controllers are told, since it is no secret.
    delay : float
        s, added to the scene's; model-based controllers are told, since it can be measured.
    noise : float
        Factor of all sensor noise.
    twist : float
        What a motor's largest torque twists its gear by, where that is rigid in the scene, rad; 0: it is rigid.
    """

    name: str
    title: str
    payload: float = 1.0
    stiffness: float = 1.0
    friction: float = 0.0
    gravity: float = 0.0
    delay: float = 0.0
    noise: float = 1.0
    twist: float = 0.0


STANDARD_GRAVITY = 9.80665
"""m/s^2."""
TWIST = 2e-3
"""Of good strain-wave gears, rad: 2 mrad at 210 N m with the stiffness of Harmonic Drive's worked example (engineering
data of CHA and LynxDrive: 67 kN m/rad below 29 N m, 110 below 108 N m, 120 above)."""

CONDITIONS: tuple[Condition, ...] = (
    Condition("nominal", "as the scene says"),
    Condition("payload", "payload +50 %", payload=1.5),
    Condition("gravity", "gravity 0.3 g", gravity=0.3 * STANDARD_GRAVITY),
    Condition("friction", "hub friction 0.05 N m", friction=0.05),
    Condition("delay", "delay 10 ms", delay=0.01),
    Condition("soft", "stiffness -20 %", stiffness=0.8),
    Condition("stiff", "stiffness +20 %", stiffness=1.2),
    Condition("gears", "rigid gears give way by 2 mrad", twist=TWIST),
)
