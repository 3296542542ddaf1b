"""tmm-gen: a scene goes in; transfer-matrix kernels in NumPy, C99 and CasADi come out."""

import os

# SymPy reads this as it is imported: a sweep's long sums drive out the thousand results that it remembers otherwise
os.environ.setdefault("SYMPY_CACHE_SIZE", "100000")

from tmm_gen.version import __version__

__all__ = ["__version__"]
