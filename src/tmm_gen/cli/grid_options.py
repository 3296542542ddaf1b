"""The options of `trade` that say what an arm goes through, what is tried, and who computes it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from tmm_gen.cli.given import positive
from tmm_gen.cli.study_options import corrections_option, numbers, one_of, whole_numbers, words


def grid_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that say what arm goes through and what is tried."""
    options = [
        click.option("--integrators", metavar="A,B", callback=words, help="By default all."),
        click.option(
            "--steps", metavar="S,S", callback=numbers, help="Steps, s; by default ten, each half the last."
        ),
        click.option(
            "--tolerances",
            metavar="T,T",
            callback=numbers,
            help="Runs too whose steps each integrator chooses by these, as `run --tolerance` does; by default none.",
        ),
        click.option(
            "--iterations",
            metavar="N,N",
            callback=whole_numbers,
            help="Sweeps per stage of an arm, or sweep and corrections; by default the scene's.",
        ),
        corrections_option,
        click.option(
            "--linearisations",
            metavar="A,B",
            callback=one_of("newton", "inertial", "taylor", "frozen"),
            help="Of an arm: newton, in a plane taylor and frozen, in space inertial; by default the scene's.",
        ),
        click.option(
            "--reals",
            metavar="A,B",
            callback=one_of("float64", "float32"),
            help="Number types of the C: float64, float32; by default the scene's.",
        ),
        click.option(
            "--input",
            "given",
            metavar="NAME=VALUE|NAME=FILE.csv|FILE.csv",
            multiple=True,
            help="What moves the arm, as in `run`; by default every input acts, smoothly.",
        ),
        click.option(
            "--until", type=float, callback=positive, help="Time simulated, s; by default five slow periods."
        ),
        click.option(
            "--output", metavar="NAME", help="Where errors are measured; by default the tip's place or angle."
        ),
        click.option(
            "--workers", type=click.IntRange(min=1), help="Compute errors in so many processes (Dask)."
        ),
        click.option(
            "--scheduler",
            metavar="ADDRESS",
            help="Compute errors on a running Dask cluster. Tasks are trusted code: workers run what they are sent, "
            "and what they answer is unpickled here. Name only a cluster you trust as this machine.",
        ),
        click.option(
            "--store",
            type=click.Path(path_type=Path),
            metavar="FILE.sqlite",
            help="Keep results; an interrupted study goes on where it stopped.",
        ),
        click.option(
            "--rounds",
            type=click.IntRange(min=0),
            default=9,
            show_default=True,
            help="Measurements of each time, of which the median counts; 0 for none.",
        ),
    ]
    for option in reversed(options):
        command = option(command)
    return command
