"""From a scene to its row."""

from __future__ import annotations

from collections.abc import Callable

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.row.chain import chain_row
from tmm_gen.row.planar import planar_row
from tmm_gen.row.row import Row
from tmm_gen.scene import Scene
from tmm_gen.scene.flat import require_flat

ROWS: dict[str, Callable[[Scene, str], Row]] = {"chain": chain_row, "planar": planar_row}
"""What makes the row of each kind of model."""


def row_of(scene: Scene, integrator: Integrator) -> Row:
    """Return the row of a scene.

    Parameters
    ----------
    integrator : Integrator
        Named in headers, with its parameters.
    """
    require_flat(scene, "rows of transfer matrices do not")
    parameters = "".join(f", {k} = {float(v):g}" for k, v in integrator.parameters.items())
    # the one place that knows which rows there are
    return ROWS[scene.model.kind](scene, integrator.title + parameters)
