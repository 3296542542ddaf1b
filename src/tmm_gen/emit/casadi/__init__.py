"""The CasADi backend."""

from tmm_gen.emit.casadi.model import emit_casadi

__all__ = ["emit_casadi"]
