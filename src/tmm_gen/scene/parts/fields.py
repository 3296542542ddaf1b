"""Keys that parts of arms in a plane and in space have alike, with what `tmm-gen keys` and messages say of them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from tmm_gen.scene.table import NonNegative, Positive

RotorInertia = Annotated[
    NonNegative,
    Field(
        description="inertia of the rotor in kg m^2; gear^2 times it acts along the joint", examples=["2e-5"]
    ),
]
Gear = Annotated[Positive, Field(description="turns of the motor per turn of the joint", examples=["100"])]
OutputDamping = Annotated[
    NonNegative, Field(description="damping at the output in N m s/rad", examples=["0.02"])
]
Rest = Annotated[
    float,
    Field(
        strict=True,
        allow_inf_nan=False,
        description="angle in rad at which the spring is slack",
        examples=["0.1"],
    ),
]
GearStiffness = Annotated[
    Positive | None,
    Field(
        description="stiffness of the gear at the output in N m/rad",
        examples=["4000.0"],
        json_schema_extra={"absent": "a rigid gear"},
    ),
]
MotorDamping = Annotated[
    NonNegative,
    Field(description="damping of the rotor, on the motor's side, in N m s/rad", examples=["1e-4"]),
]
GearDamping = Annotated[
    NonNegative,
    Field(description="damping of the gear's spring over its stiffness in s", examples=["0.001"]),
]
EncoderSide = Annotated[
    Literal["rotor", "output"],
    Field(
        description="side of an elastic gear at which control has the motor's encoder", examples=['"output"']
    ),
]
BeamDamping = Annotated[
    NonNegative, Field(description="damping of a spring over its stiffness in s", examples=["0.002"])
]
Mass = Annotated[NonNegative, Field(description="mass in kg", examples=["0.3"])]
