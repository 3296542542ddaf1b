"""The program of a torsional chain."""

from tmm_gen.program.torsion.build import build_chain

__all__ = ["build_chain"]
