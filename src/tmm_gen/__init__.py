"""tmm-gen: a scene goes in; transfer-matrix kernels in NumPy, C99 and CasADi come out."""

from tmm_gen.version import __version__

__all__ = ["__version__"]
