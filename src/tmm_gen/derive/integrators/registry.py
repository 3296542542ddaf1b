"""All integrators, found by looking: a module ``x`` whose function ``x`` returns an Integrator is one.

Their parameters, with defaults and ranges, are declared in :mod:`tmm_gen.scene.integrator`, which needs no SymPy.
"""

from __future__ import annotations

import inspect
import pkgutil
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

import sympy as sp

import tmm_gen.derive.integrators as package
from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.parameters import Number, bind
from tmm_gen.errors import UserError
from tmm_gen.scene.integrator import Method, method_named, underscored

Factory = Callable[..., Integrator]

_TABLE = "METHODS of scene/integrator.py"


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
    UserError
        If its row and its file do not go together, or the file fails.
    """
    factories = _factories()
    key = underscored(name)
    method = method_named(key)
    if key not in factories:
        if method is not None:
            raise UserError(
                f"{_file(key)}: integrator '{key}' has a row in {_TABLE}, but no function `{key}` with "
                "`-> Integrator` here. Write it, or remove the row."
            )
        raise ValueError(f"no integrator is named {name!r}; there are {', '.join(factories)}")
    if method is None:
        raise UserError(
            f"{_file(key)}: integrator '{key}' has no row: add {_row(key, factories[key])} to {_TABLE}."
        )
    _require_arguments(method, factories[key])
    bound = bind(method, parameters)
    with failing_in(key):
        declared = factories[key](**bound)
    _require_exact(key, declared)
    return declared


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
        with failing_in(name):
            candidate = getattr(import_module(f"{package.__name__}.{name}"), name, None)
        if inspect.isfunction(candidate) and candidate.__annotations__.get("return") in (
            "Integrator",
            Integrator,
        ):
            found[name] = candidate
    return found


def _row(name: str, factory: Factory) -> str:
    """Return the row that a file asks for; defaults are the author's to choose."""
    parameters = "".join(
        f'Parameter("{argument}", 0.5), ' for argument in inspect.signature(factory).parameters
    )
    return f'Method("{name}"' + (f", ({parameters.rstrip()}))" if parameters else ")")


def _require_arguments(method: Method, factory: Factory) -> None:
    """Refuse a file whose arguments are not the parameters of its row.

    Raises
    ------
    UserError
        If names differ.
    """
    arguments = list(inspect.signature(factory).parameters)
    told = [parameter.name for parameter in method.parameters]
    if sorted(arguments) != sorted(told):
        raise UserError(
            f"{_file(method.name)}: integrator '{method.name}' takes {_listed(arguments)}, and its row in {_TABLE} has "
            f"{_listed(told)}. Write the same names in both."
        )


def _require_exact(name: str, declared: Integrator) -> None:
    """Refuse numbers of which order and limits could not be derived: decimals, pi, roots of polynomials.

    Raises
    ------
    UserError
        If there is one.
    """
    for scheme in declared.schemes:
        relations = [relation for each in scheme.stages for relation in (each.instant, *each.relations)]
        for expression in map(sp.sympify, (*relations, *scheme.update.values())):
            odd = expression.atoms(sp.Function, sp.CRootOf) or {
                atom for atom in expression.atoms() if atom.is_number and not atom.is_Rational
            }
            if odd:
                raise UserError(
                    f"{_file(name)}: integrator '{name}' has the number {min(odd, key=str)}, of which nothing exact "
                    "can be derived. Write fractions and roots: sp.Rational(1, 3), sp.sqrt(3)."
                )


def _listed(names: list[str]) -> str:
    return ", ".join(f"'{name}'" for name in names) if names else "no parameter"


def _file(name: str) -> Path:
    """Return where an integrator is declared, or would be."""
    folders = [Path(folder) for folder in package.__path__]
    return next(
        (f / f"{name}.py" for f in folders if (f / f"{name}.py").is_file()), folders[0] / f"{name}.py"
    )


@contextmanager
def failing_in(name: str) -> Iterator[None]:
    """Say of whatever a declaration raises, or what follows from it, in which file and, where known, line.

    Parameters
    ----------
    name : str
        Of the integrator.

    Raises
    ------
    UserError
        In place of any other error.
    """
    try:
        yield
    except SyntaxError as error:
        raise UserError(
            f"{error.filename}:{error.lineno}: {error.msg}. Mend the integrator's file."
        ) from error
    except UserError:
        raise
    except Exception as error:
        file = _file(name)
        frames = traceback.extract_tb(error.__traceback__)
        line = next((f":{frame.lineno}" for frame in reversed(frames) if Path(frame.filename) == file), "")
        raise UserError(
            f"{file}{line}: integrator '{name}' fails: {type(error).__name__}: {error}. Mend the integrator's file."
        ) from error
