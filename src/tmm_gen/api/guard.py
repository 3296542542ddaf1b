"""What goes wrong in a call, as one error that says how to mend it, without the way through tmm-gen."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

import numpy as np

from tmm_gen.api.wording import in_python
from tmm_gen.errors import UserError, beyond, of_numbers
from tmm_gen.inputs.sampled import FunctionError

__all__ = ["guarded"]

_Given = ParamSpec("_Given")
_Found = TypeVar("_Found")


def guarded(call: Callable[_Given, _Found]) -> Callable[_Given, _Found]:
    """Return a function whose every error that its caller can mend is a UserError.

    Options of the command line that a message names become arguments of Python; the traceback ends at the call. What
    is no fault of the caller passes as it is.
    """

    @wraps(call)
    def called(*args: _Given.args, **kwargs: _Given.kwargs) -> _Found:
        try:
            with np.errstate(all="ignore"):  # what overflows is told in words
                return call(*args, **kwargs)
        except UserError as error:
            error.args = (in_python(str(error)), *error.args[1:])
            # how a function that the caller gave failed is the caller's to see
            cause = error.__cause__ if isinstance(error, FunctionError) else None
            raise error.with_traceback(None) from cause
        except MemoryError:
            raise UserError("not enough memory for this. Ask for fewer steps, links or modes.") from None
        except OSError as error:
            if error.filename is None:
                raise
            raise UserError(f"{error.filename}: {error.strerror}") from None
        except Exception as error:
            if not of_numbers(error):
                raise
            raise UserError(f"{_named(args)}: {beyond(error)}") from None

    return called


def _named(args: tuple[object, ...]) -> str:
    """Return what a call was made of, by its name where it has one."""
    name = getattr(args[0], "name", None) if args else None
    return f"scene '{name}'" if isinstance(name, str) else "the scene"
