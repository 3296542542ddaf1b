"""What a run by chosen steps did."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Chosen:
    """What a run by chosen steps did.

    Parameters
    ----------
    tolerance : float
        What it was to keep, as a share of the motion.
    steps : int
        Taken, halves counted.
    refused : int
        Steps, halves not counted, that were taken again shorter.
    smallest, largest : float
        Of the steps taken, s.
    prepared : int
        For how many lengths the kernel was prepared.
    runs : int
        In all, the last of which counts.
    """

    tolerance: float
    steps: int
    refused: int
    smallest: float
    largest: float
    prepared: int
    runs: int
