"""What is generated for a scene, and the bounds it must keep."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field, PlainValidator

from tmm_gen.backends import OWN, USUAL, backend_named, backend_names
from tmm_gen.scene.table import Count, Table, closest, fault, is_finite_number


def _known(name: object) -> str:
    """Return the name of a backend that is installed."""
    if isinstance(name, str) and backend_named(name) is not None:
        return name
    raise fault("is not one of the choices", closest(name, backend_names()))


def _distinct(backends: tuple[str, ...]) -> tuple[str, ...]:
    """Return the backends in one order whatever the order they are written in."""
    if not backends:
        raise fault("must name at least one backend", 'Write for example `backends = ["numpy", "c"]`.')
    if len(set(backends)) < len(backends):
        raise fault("names a backend twice", "Remove the repetition.")
    own = [each.name for each in OWN]
    return tuple(sorted(backends, key=lambda name: (own.index(name) if name in own else len(own), name)))


Backend = Annotated[str, PlainValidator(_known)]


def _interval(value: object) -> tuple[float, float]:
    """Return ``[low, high]`` of finite numbers as a pair."""
    if isinstance(value, list | tuple) and len(value) == 2 and all(is_finite_number(end) for end in value):
        low, high = float(value[0]), float(value[1])
        if low < high:
            return low, high
        raise fault("must be increasing", "Write the lower bound first.")
    raise fault("must be two finite numbers", "Write for example `[-10.0, 10.0]`.")


Interval = Annotated[tuple[float, float], PlainValidator(_interval)]


class Budget(Table):
    """``[emit.budget]``: what one step of the emitted C may cost on a target; absent bounds do not bind.

    Parameters
    ----------
    instructions : int, optional
        Instructions per step.
    flash, ram, stack : int, optional
        Bytes.
    """

    instructions: Count | None = Field(default=None, description="instructions per step", examples=["700"])
    flash: Count | None = Field(default=None, description="bytes of code and constants", examples=["900"])
    ram: Count | None = Field(default=None, description="bytes of data", examples=["2048"])
    stack: Count | None = Field(default=None, description="bytes of stack", examples=["256"])


class Emit(Table):
    """``[emit]``: what is generated.

    Parameters
    ----------
    backends : tuple of str
        Names of installed backends, each at most once: "numpy", "c", "casadi" in this order, which are the default,
        then "jax" and those of other packages.
    real : {"float64", "float32"}
        Number type of the C code.
    sensitivities : bool
        Whether to emit the step's exact first derivatives too.
    trigonometry : {"libm", "own"}
        Whose sine and cosine the C code calls: the C library's, or its own, with the same bits everywhere.
    parameters : {"free", "bound"}
        Whether the C code takes parameters and step when it runs, or has them built in as constants.
    compensated : bool
        Whether the C code keeps every number as the unevaluated sum of two floats, so that rounding does not add up
        over millions of steps; with ``real = "float32"`` only.
    favour : {"size", "speed"}
        What the C code is to be: small, as microcontrollers want it, or fast on processors that do several operations
        at a time and have vectors. The same to rounding.
    batch : {4, 8, 16}, optional
        How many arms a second kernel in C steps side by side, in the lanes of vector registers.
    budget : Budget, optional
        Bounds on the cost of the C code.
    box : dict from str to (low, high), optional
        Bounds within which the C code must be proved free of faults: ``angles`` (rad), ``rates`` (rad/s),
        ``accelerations`` (rad/s^2) of all stations, ``step`` (s), ``base_places``, ``base_velocities`` and
        ``base_accelerations`` (m, m/s, m/s^2) of a base that floats, and each input by its name.
    """

    backends: Annotated[tuple[Backend, ...], AfterValidator(_distinct)] = Field(
        default=USUAL,
        description="languages",
        examples=['["numpy", "c", "casadi"]'],
    )
    real: Literal["float64", "float32"] = Field(
        default="float64", description="number type of the C code", examples=['"float64"']
    )
    sensitivities: bool = Field(
        default=False, description="emit exact first derivatives of the step", examples=["true"]
    )
    trigonometry: Literal["libm", "own"] = Field(
        default="libm", description="sine and cosine of the C code", examples=['"own"']
    )
    parameters: Literal["free", "bound"] = Field(
        default="free", description="whether the C code's parameters are constants", examples=['"bound"']
    )
    compensated: bool = Field(
        default=False, description="float32 only: keep each number as a sum of two", examples=["true"]
    )
    favour: Literal["size", "speed"] = Field(
        default="size",
        description="what the C code is to be: small, or fast where there are vectors",
        examples=['"speed"'],
    )
    batch: Literal[4, 8, 16] | None = Field(
        default=None, description="arms side by side in a second kernel in C", examples=["8"]
    )
    budget: Budget | None = Field(default=None, description="bounds on the cost of the C code")
    box: dict[str, Interval] | None = Field(default=None, description="bounds of inputs and state")
