"""The emitted C compiled for this machine and driven from Python."""

from tmm_gen.native.batch import BatchRun, NativeBatch, compile_batch
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.native.kernel import NativeKernel
from tmm_gen.native.library import NonFiniteStateError
from tmm_gen.native.loading import compile_kernel

__all__ = [
    "FLAGS",
    "BatchRun",
    "NativeBatch",
    "NativeKernel",
    "NonFiniteStateError",
    "compile_batch",
    "compile_kernel",
    "compile_library",
]
