"""Who computes the errors of a study."""

from __future__ import annotations

from tmm_gen.errors import UserError
from tmm_gen.study.tasks import Executor

__all__ = ["executor"]


def executor(workers: int | None, scheduler: str | None) -> Executor | None:
    """Return who computes the errors; None for this process.

    Parameters
    ----------
    workers : int, optional
        Processes of a cluster that is started on this machine.
    scheduler : str, optional
        Address of a running cluster.

    Raises
    ------
    UserError
        If both are given, or Dask is asked for and not installed.
    """
    if workers is None and scheduler is None:
        return None
    if workers is not None and scheduler is not None:
        raise UserError("--workers starts a cluster, --scheduler names one: give one of them.")
    from tmm_gen.study.cluster import Cluster, require_dask  # it imports Dask

    require_dask()
    return Cluster(workers or 0, scheduler)
