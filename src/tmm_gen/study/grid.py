"""The grid of a study: which configurations are tried."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from tmm_gen.scene import Scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.integrator import Method, method_named
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.study.configuration import Configuration, Family, own

COARSEST = 40
"""Steps over the whole time at the coarsest of the default steps: eight in a slow period."""

HALVINGS = 10
"""Default steps, each half of the one before."""


@dataclass(frozen=True)
class Axes:
    """What is varied; an empty axis stands for the scene's own choice.

    Parameters
    ----------
    integrators : tuple of str
        With underscores; empty for all.
    steps : tuple of float
        s; empty for default steps.
    links : tuple of int
        Of a beam.
    linearisations : tuple of str
        Of an arm.
    iterations : tuple of int
        Sweeps per stage, with linearisation "newton"; sweep and corrections with "inertial".
    corrections : tuple of int
        Per stage behind its sweeps, of an arm in a plane with linearisation "newton".
    reals : tuple of str
        "float64", "float32".
    backends : tuple of str
        "c", "numpy".
    """

    integrators: tuple[str, ...] = ()
    steps: tuple[float, ...] = ()
    links: tuple[int, ...] = ()
    linearisations: tuple[str, ...] = ()
    iterations: tuple[int, ...] = ()
    corrections: tuple[int, ...] = ()
    reals: tuple[str, ...] = ()
    backends: tuple[str, ...] = ()


def default_steps(until: float) -> tuple[float, ...]:
    """Return steps that divide a time, longest first."""
    return tuple(until / (COARSEST * 2**k) for k in range(HALVINGS))


def configurations(scene: Scene, axes: Axes, until: float) -> tuple[Configuration, ...]:
    """Return the grid: every combination of the axes, and the scene's own configuration.

    Parameters
    ----------
    scene : Scene
        What is computed.
    axes : Axes
        What is varied.
    until : float
        s, for the default steps.
    """
    mine = own(scene)
    steps = axes.steps or default_steps(until)
    found = [Configuration(family, step) for family in families(scene, axes) for step in steps]
    return tuple(dict.fromkeys([*found, mine]))


def families(scene: Scene, axes: Axes) -> tuple[Family, ...]:
    """Return what is generated: every combination of the axes without the steps."""
    mine = own(scene).family
    fixed = axes.iterations or ((mine.iterations,) if _rounds_given(scene) else ())
    choices = product(
        axes.integrators or scene.integrators,
        axes.links or (mine.links,),
        axes.linearisations or (mine.linearisation,),
        fixed or (None,),
        axes.corrections or (mine.corrections,),
        axes.reals or (mine.real,),
        axes.backends or (mine.backend,),
    )
    found = []
    for integrator, links, linearisation, iterations, corrections, real, backend in choices:
        if iterations is None:
            iterations = _usual(scene, integrator, linearisation)
        # only Newton's linearisation sweeps again, and that in space corrects; NumPy has one number type
        sweeps = iterations if linearisation in ("newton", "inertial") else 1
        number = real if backend == "c" else "float64"
        more = corrections if linearisation == "newton" and not _method(integrator).coupled else 0
        found.append(Family(integrator, links, linearisation, sweeps, number, backend, more))
    return tuple(dict.fromkeys(found))


def alike(scene: Scene, integrator: str) -> Family:
    """Return what is generated of a scene with another integrator; rounds suit it where no number is said."""
    (found,) = families(scene, Axes(integrators=(integrator,)))
    return found


def _rounds_given(scene: Scene) -> bool:
    """Whether the scene says how often a stage sweeps, or is of a kind in which nothing is swept again."""
    if scene.spatial is None:
        return scene.model.linear or scene.model.iterations != "auto"
    return isinstance(document_of(scene.source).model.iterations, int)


def _method(integrator: str) -> Method:
    """Return what a scene may say of an integrator that there is."""
    found = method_named(integrator)
    assert found is not None
    return found


def _usual(scene: Scene, integrator: str, linearisation: str | None) -> int:
    """Return the sweep and corrections, or sweeps, that suit an integrator."""
    if scene.spatial is None:
        return _method(integrator).sweeps
    document = document_of(scene.source)
    assert isinstance(document, SpatialDocument)
    changes = {"linearisation": linearisation, "iterations": "auto"}
    return document.model.model_copy(update=changes).settled(integrator).sweeps
