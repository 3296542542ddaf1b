"""The JAX backend."""

from tmm_gen.emit.jax.kernel import emit_jax

__all__ = ["emit_jax"]
