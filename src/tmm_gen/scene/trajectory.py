"""``[control.trajectory]`` and ``[[control.keep]]``: what an arm by parts is to follow, where its parts are to stay."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, PlainValidator

from tmm_gen.scene.each import Each, OneOrEach
from tmm_gen.scene.table import Finite, NonNegative, Positive, Table, fault, is_finite_number


def _place(value: object) -> tuple[float, ...]:
    """Return ``[x, y]`` or, in space, ``[x, y, z]``."""
    numbers = value if isinstance(value, list | tuple) else ()
    if len(numbers) in (2, 3) and all(is_finite_number(number) for number in numbers):
        return tuple(float(number) for number in numbers)
    raise fault("must be a place", "Write for example `[0.5, -0.2]`, and in space `[0.5, -0.2, 0.3]`.")


def _orientation(value: object) -> tuple[float, ...]:
    """Return an angle in a plane, ``(angle,)``, or in space the quaternion ``(w, x, y, z)``."""
    if is_finite_number(value):
        return (float(value),)
    numbers = value if isinstance(value, list | tuple) else ()
    if len(numbers) in (1, 4) and all(is_finite_number(number) for number in numbers):
        if len(numbers) == 1 or any(numbers):
            return tuple(float(number) for number in numbers)
        raise fault("is no quaternion: one number must be other than 0", "Write for example `[1, 0, 0, 0]`.")
    raise fault(
        "must be an angle in rad, or in space a quaternion",
        "Write for example `0.5`, and in space `[1.0, 0.0, 0.0, 0.0]`: w, x, y, z.",
    )


def _direction(value: object) -> tuple[float, ...]:
    """Return a direction in a plane or in space, of any length but none."""
    numbers = value if isinstance(value, list | tuple) else ()
    if len(numbers) not in (2, 3) or not all(is_finite_number(number) for number in numbers):
        raise fault("must be a direction", "Write for example `[0.0, 1.0]`, and in space `[0.0, 0.0, 1.0]`.")
    if not any(numbers):
        raise fault("has no direction", "Write for example `[0.0, 1.0]`, and in space `[0.0, 0.0, 1.0]`.")
    return tuple(float(number) for number in numbers)


Orientation = Annotated[tuple[float, ...], PlainValidator(_orientation)]
Place = Annotated[tuple[float, ...], PlainValidator(_place)]
Direction = Annotated[tuple[float, ...], PlainValidator(_direction)]
EachAngle = Annotated[Each[float], PlainValidator(OneOrEach(Finite))]


class PoseEntry(Table):
    """``[[control.trajectory.pose]]``: where to go next, by joint angles or by where a part is to be.

    Parameters
    ----------
    angles : float, or dict from str to float, optional
        Of the motors' joints, rad.
    frame : str, optional
        Name of a part, whose outer end, at rest, is to be at ``position``.
    position : (x, y), in space (x, y, z), optional
        m.
    orientation : float, in space (w, x, y, z), optional
        Of that end: its angle from the x axis, rad; in space a quaternion of any length, as outputs show it.
    duration : float
        Of the way there, a quintic, s.
    dwell : float
        Of the rest there, s.
    """

    angles: EachAngle | None = Field(
        default=None, description="joint angles in rad", examples=["{ shoulder = 0.8, elbow = -1.2 }"]
    )
    frame: str | None = Field(default=None, description="part to be somewhere", examples=['"payload"'])
    position: Place | None = Field(
        default=None, description="where its outer end is to be in m", examples=["[0.5, -0.2]"]
    )
    orientation: Orientation | None = Field(
        default=None,
        description="how that end is to stand: an angle in rad, in space a quaternion",
        examples=["0.5", "[0.7, 0.0, 0.7, 0.0]"],
    )
    duration: Positive = Field(description="of the way there in s", examples=["0.8"])
    dwell: NonNegative = Field(default=0.0, description="of the rest there in s", examples=["0.4"])


class Trajectory(Table):
    """``[control.trajectory]``: what to follow, by poses one after the other or by a file; at its end it stays.

    Parameters
    ----------
    file : str, optional
        CSV with a column ``time`` (s) and one by the name of each motor (rad), or those of ``frame``; relative to the
        scene's folder. Cubic in between.
    frame : str, optional
        Name of a part: the file then has columns ``<frame>_x`` and ``<frame>_y``, in space ``<frame>_z`` too, m.
    orientation : bool
        Whether the file says how that part is to stand, too: column ``<frame>_angle``, rad; in space ``<frame>_qw``,
        ``<frame>_qx``, ``<frame>_qy`` and ``<frame>_qz``, a quaternion of any length.
    pose : tuple of PoseEntry
        From where the scene starts.
    """

    file: str | None = Field(default=None, description="CSV file of the way", examples=['"way.csv"'])
    frame: str | None = Field(
        default=None, description="part whose positions the file has", examples=['"payload"']
    )
    orientation: bool = Field(
        default=False, description="whether the file also says how that part is to stand", examples=["true"]
    )
    pose: tuple[PoseEntry, ...] = Field(default=(), description="poses")


class Keep(Table):
    """``[[control.keep]]``: where a part's outer end is to stay, ``normal . position >= offset + margin``.

    Parameters
    ----------
    frame : str
        Name of the part.
    normal : (x, y), in space (x, y, z)
        Away from wall or floor, of any length.
    offset : float
        How far the wall is from the base along the normal, m.
    margin : float
        To stay away from it, m.
    weight : float
        Of the square of what it comes nearer by, per sample, 1/m^2: the bound is soft.
    """

    frame: str = Field(description="part that is to keep away", examples=['"payload"'])
    normal: Direction = Field(description="direction away from the wall", examples=["[0.0, 1.0]"])
    offset: Finite = Field(description="of the wall along the normal in m", examples=["-0.3"])
    margin: NonNegative = Field(default=0.0, description="to stay away from it in m", examples=["0.01"])
    weight: Positive = Field(default=1e5, description="weight of coming nearer in 1/m^2", examples=["1e5"])
