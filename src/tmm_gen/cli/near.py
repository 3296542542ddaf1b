"""Choosing an equilibrium on the command line: ``--near JOINT=ANGLE``."""

from __future__ import annotations

import click

near_option = click.option(
    "--near",
    "near",
    metavar="JOINT=ANGLE",
    multiple=True,
    help="Take the equilibrium near this angle of a joint, in rad, stable or not. Repeatable; the rest is [initial].",
)
"""The option; gives a command the argument ``near``."""
