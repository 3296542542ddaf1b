"""How many samples a loop may have."""

from __future__ import annotations

from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

MOST = 1_000_000
"""What is kept of each is held in memory, and a sample takes a tenth of a millisecond at best."""


def require_countable(scene: Scene, duration: float, sample_time: float) -> None:
    """Refuse a loop of very many samples.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    duration, sample_time : float
        s.

    Raises
    ------
    UserError
        If there are more than a million.
    """
    count = duration / sample_time
    if count > MOST:
        raise UserError(
            f"{where(scene, 'control.sample_time')}: makes {count:.3g} samples of {duration:g} s, and {MOST:.0e} are "
            f"the most (got {sample_time:g}). Write a longer one: samples of controllers take 0.001 to 0.1 s."
        )
