"""All integrators, found by looking: a module ``x`` whose function ``x`` returns an Integrator is one.

Their parameters, with defaults and ranges, are declared in :mod:`tmm_gen.scene.integrator`, which needs no SymPy.
"""

from __future__ import annotations

import inspect
import pkgutil
from collections.abc import Callable
from importlib import import_module

import tmm_gen.derive.integrators as package
from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.parameters import Number, bind
from tmm_gen.scene.integrator import method_named, underscored

Factory = Callable[..., Integrator]


def integrator(name: str, **parameters: Number) -> Integrator:
    """Return an integrator with its parameters bound.

    Parameters
    ----------
    name : str
        Hyphens and underscores are the same.
    **parameters : number or sympy.Expr
        The method's own; those not given have its defaults. Floats become exact fractions.

    Raises
    ------
    ValueError
        If the name or a parameter is unknown, or a value is out of its range.
    """
    factories = _factories()
    key = underscored(name)
    if key not in factories:
        raise ValueError(f"no integrator is named {name!r}; there are {', '.join(factories)}")
    method = method_named(key)
    if method is None:
        raise ValueError(
            f"{key}: its parameters are not declared; add a Method to METHODS of scene/integrator.py"
        )
    return factories[key](**bind(method, parameters))


def names() -> tuple[str, ...]:
    """Return the names of all integrators, sorted."""
    return tuple(_factories())


def all_integrators() -> tuple[Integrator, ...]:
    """Return every integrator with its default parameters, sorted by name."""
    return tuple(integrator(name) for name in names())


def _factories() -> dict[str, Factory]:
    """Look through the package anew, so that a module added at run time is found too."""
    found: dict[str, Factory] = {}
    for name in sorted(module.name for module in pkgutil.iter_modules(package.__path__)):
        candidate = getattr(import_module(f"{package.__name__}.{name}"), name, None)
        if inspect.isfunction(candidate) and candidate.__annotations__.get("return") in (
            "Integrator",
            Integrator,
        ):
            found[name] = candidate
    return found
