"""The program of a planar arm with large rotations."""

from tmm_gen.program.planar.build import build_planar

__all__ = ["build_planar"]
