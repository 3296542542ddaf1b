"""An explanation of a scene: its terms, and what each costs or saves."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.explain.footprint import Footprint
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class Explained:
    """One term.

    Parameters
    ----------
    term : str
        What it is.
    modelled : bool
        Whether the scene has it.
    why : str
        What in the scene, or in the way programs are built, says so.
    worth : Footprint
        What it costs where it is modelled, what leaving it out saves where it is not; negative where that costs
        something.
    """

    term: str
    modelled: bool
    why: str
    worth: Footprint


@dataclass(frozen=True)
class Explanation:
    """What a scene makes the generator model.

    Parameters
    ----------
    scene : Scene
        What is explained.
    own : Footprint
        Of its program.
    terms : tuple of Explained
        In the order of the scene file, then what the way of building programs saves.
    everything : Footprint
        Of the program with every term that was left out put in at once, prepare's work done in each step.
    """

    scene: Scene
    own: Footprint
    terms: tuple[Explained, ...]
    everything: Footprint
