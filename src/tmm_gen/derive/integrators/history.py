"""How much history an integrator needs to carry."""

from __future__ import annotations

from collections.abc import Iterable

from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Past, Scheme, pasts_in
from tmm_gen.derive.integrators.relations import Unknown, affine_motion


def history(integrator: Integrator, unknown: Unknown) -> tuple[Past, ...]:
    """Return the history an integrator carries, start-up included, when solved for an unknown.

    Returns
    -------
    tuple of Past
        Newest first, then displacement, velocity, acceleration. Closed under ageing: what is needed two steps
        late is carried one step late too.

    Raises
    ------
    UnsuitableUnknownError
        If the integrator does not determine motion from the unknown.
    """
    return history_of(integrator.schemes, unknown)


def history_of(schemes: Iterable[Scheme], unknown: Unknown) -> tuple[Past, ...]:
    """Return the history that some schemes need, ordered and closed as in :func:`history`."""
    needed: set[Past] = set()
    for scheme in schemes:
        for index in range(1, len(scheme.stages) + 1):
            for offset in affine_motion(scheme, index, unknown).offset.values():
                needed |= pasts_in(offset)
        for value in scheme.update.values():
            needed |= pasts_in(value)
    closed = {Past(past.kind, lag) for past in needed for lag in range(past.lag + 1)}
    return tuple(sorted(closed, key=lambda past: (past.lag, KINDS.index(past.kind))))


def history_depth(integrator: Integrator) -> int:
    """Return how many instants the main step looks back to: 1 for one-step methods."""
    return 1 + max(past.lag for past in history_of([integrator.main], "acceleration"))
