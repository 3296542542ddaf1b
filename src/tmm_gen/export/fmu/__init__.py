"""Functional mock-up units for co-simulation, FMI 2.0 and 3.0."""

from __future__ import annotations

from tmm_gen.export.fmu.identity import FmiVersion
from tmm_gen.export.fmu.unit import fmu

__all__ = ["FmiVersion", "fmu"]
