"""An arm in motion, in a plane or in space."""

from __future__ import annotations

from tmm_gen.report.animate import animation
from tmm_gen.report.space_page import space_page
from tmm_gen.report.space_picture import space_gif
from tmm_gen.simulate.simulation import Simulation


def moving(simulation: Simulation, form: str) -> bytes:
    """Return an arm in motion.

    Parameters
    ----------
    simulation : Simulation
        Of an arm that has a shape, with the motion of its links.
    form : {"gif", "html"}
        A page lets an arm in space be turned.
    """
    if simulation.scene.spatial is None:
        return animation(simulation, form)
    if form == "gif":
        return space_gif(simulation)
    return space_page(simulation)
