"""What is derived about each integrator."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import sympy as sp

from tmm_gen.api.given import number
from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.several import Few, texts
from tmm_gen.derive.integrators import registry
from tmm_gen.derive.integrators.analysis import Analysis, analyse
from tmm_gen.errors import UserError
from tmm_gen.scene.integrator import underscored

__all__ = ["Integrators", "derived", "integrators"]

_COLUMNS = {
    "name": "integrator",
    "order": "order",
    "stages": "stages",
    "startup_steps": "start-up",
    "explicit": "explicit",
    "stability_limit_exact": "limit of Ω",
    "stability_limit_damped": "damped",
    "rho_infinity": "ρ at infinity",
    "period_error": "period error",
    "numerical_damping": "numerical damping",
}


@dataclass(frozen=True, eq=False, repr=False)
class Integrators:
    """Properties of integrators, derived from their declarations.

    Parameters
    ----------
    analyses : tuple of Analysis
        One each, in exact numbers.
    """

    analyses: tuple[Analysis, ...]

    @property
    def rows(self) -> list[dict[str, Any]]:
        """What ``tmm-gen integrators --json`` has of each."""
        return [_row(each) for each in self.analyses]

    def __iter__(self) -> Iterator[Analysis]:
        """Go through the analyses."""
        return iter(self.analyses)

    def __len__(self) -> int:
        """Count them."""
        return len(self.analyses)

    def __repr__(self) -> str:
        """Name them."""
        return f"<Integrators: {', '.join(each.name for each in self.analyses)}>"

    def _repr_html_(self) -> str:
        title = "Ω = frequency in rad/s times step; period error and numerical damping ratio: leading terms"
        return html_table(title, _COLUMNS, self.rows)


@guarded
def integrators(names: Few = None, *, zeta: float = 0.05) -> Integrators:
    """Return order, stability and dissipation of integrators, derived from their declarations.

    Parameters
    ----------
    names : str or iterable of str, optional
        Of whom; by default of all, which takes some seconds.
    zeta : float
        Physical damping ratio of the damped stability limit.

    Raises
    ------
    UserError
        If there is no such integrator, or the ratio is none.
    """
    if not 0.0 <= (ratio := number("zeta", zeta)) < 1.0:
        raise UserError(f"zeta: must be a number from 0 to less than 1, not {zeta!r}.")
    return derived(ratio, texts("names", names))


def derived(
    zeta: float, names: tuple[str, ...] = (), advance: Callable[[str], None] = lambda name: None
) -> Integrators:
    """Return what is derived about integrators, by default all; ``advance`` hears of each."""
    known = registry.names()
    found = []
    for name in map(underscored, names or known):
        if name not in known:
            raise UserError(f"integrator '{name}': choose from {', '.join(known)}.")
        declared = registry.integrator(name)
        with registry.failing_in(name):  # relations that are not linear, or leave nothing to solve for
            found.append(analyse(declared, zeta))
        advance(name)
    return Integrators(tuple(found))


def _row(analysis: Analysis) -> dict[str, Any]:
    """Return an analysis as plain data."""
    return {
        "name": analysis.name,
        "title": analysis.title,
        "source": analysis.source,
        "parameters": {name: float(value) for name, value in analysis.parameters.items()},
        "order": analysis.order,
        "stages": analysis.stages,
        "startup_steps": analysis.startup_steps,
        "history_depth": analysis.history_depth,
        "explicit": analysis.explicit,
        "unconditionally_stable": bool(analysis.stability_limit.is_infinite),
        "stability_limit": float(analysis.stability_limit),
        "stability_limit_exact": _exact(analysis.stability_limit),
        "stability_limit_damped": float(analysis.stability_limit_damped),
        "stability_limit_damped_exact": _exact(analysis.stability_limit_damped),
        "rho_infinity": float(analysis.rho_infinity),
        "period_error": _exact(analysis.period_error),
        "numerical_damping": _exact(analysis.numerical_damping),
    }


def _exact(value: sp.Expr) -> str:
    """Return an exact value as text; "inf" as the numbers beside it would be written."""
    return "inf" if value.is_infinite else str(value).replace("**", "^")
