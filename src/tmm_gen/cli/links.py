"""How few links a scene requires: `tmm-gen frequency SCENE --links-for ERROR --band HZ`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table

if TYPE_CHECKING:
    from tmm_gen.scene import Scene


def show_links(scene: Scene, error: float, band: float, json_mode: bool) -> None:
    """Print the smallest number of links whose natural frequencies are those of the continuous beam.

    Parameters
    ----------
    scene : Scene
        With a ``[beam]``.
    error : float
        Largest relative error.
    band : float
        Upper end of the band, Hz.
    json_mode : bool
        Whether JSON is asked for.

    Raises
    ------
    UserError
        If the scene has no ``[beam]``, or no number of links is enough.
    """
    with progress(f"cutting the beam of {scene.name}"):
        from tmm_gen.modal.discretised import links_for

        found = links_for(scene, error, band)
    beam = scene.beam
    assert beam is not None  # or it was refused
    rows = [
        {
            "mode": k + 1,
            "exact_hz": float(exact) / (2.0 * math.pi),
            "links_hz": float(own) / (2.0 * math.pi),
            "error": float(off),
            "error_percent": 100.0 * float(off),
            "one_less_percent": None if found.errors_below is None else 100.0 * float(found.errors_below[k]),
        }
        for k, (exact, own, off) in enumerate(zip(found.exact, found.discretised, found.errors, strict=True))
    ]
    facts = {
        "scene": scene.name,
        "springs": beam.springs,
        "error": error,
        "band_hz": band,
        "links": found.links,
        "links_now": scene.stations,
        "worst_error": found.worst,
    }
    plural = "s" * (found.links > 1)
    table(
        rows,
        [
            Column("mode"),
            Column("exact_hz", "continuous beam (Hz)", ".6g"),
            Column("links_hz", f"{found.links} link{plural} (Hz)", ".6g"),
            Column("error_percent", "error (%)", ".3f"),
            Column("one_less_percent", "with one link less (%)", ".3f"),
        ],
        json_mode,
        title=f"{scene.title}: natural frequencies up to {band:g} Hz",
        more=facts,
    )
    if not json_mode:
        click.echo(
            f"{found.links} link{plural} keep{'' if plural else 's'} every natural frequency up to {band:g} Hz "
            f"within {100.0 * error:g} % of the continuous beam ({beam.springs} springs); "
            f"the scene has {scene.stations}"
        )
