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
    """

    name: str
    title: str
    payload: float = 1.0
    stiffness: float = 1.0
    friction: float = 0.0
    gravity: float = 0.0
    delay: float = 0.0
    noise: float = 1.0


STANDARD_GRAVITY = 9.80665
"""m/s^2."""

CONDITIONS: tuple[Condition, ...] = (
    Condition("nominal", "as the scene says"),
    Condition("payload", "payload +50 %", payload=1.5),
    Condition("gravity", "gravity 0.3 g", gravity=0.3 * STANDARD_GRAVITY),
    Condition("friction", "hub friction 0.05 N m", friction=0.05),
    Condition("delay", "delay 10 ms", delay=0.01),
    Condition("soft", "stiffness -20 %", stiffness=0.8),
    Condition("stiff", "stiffness +20 %", stiffness=1.2),
)
