"""The NumPy backend."""

from tmm_gen.emit.numpy.kernel import emit_numpy

__all__ = ["emit_numpy"]
