# thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 5710bb166e10f184e97b3afa485de4cad13e83bb6918e415c8a1050afcb47e12
# sha256 of the rest of this file: 25f19eb003cde086af431ee11723f7f296f3b36497dd9918a4953504b2c3bc2c
"""thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1."""

from .kernel import (
    INPUT_NAMES,
    OUTPUT_NAMES,
    STAGE_INSTANTS,
    STATIONS,
    STEP,
    Input,
    Model,
    Output,
    Params,
    Result,
    State,
    VanishingPivotError,
    initialise,
    output,
    prepare,
    simulate,
    step,
)

__all__ = [
    "INPUT_NAMES",
    "OUTPUT_NAMES",
    "STAGE_INSTANTS",
    "STATIONS",
    "STEP",
    "Input",
    "Model",
    "Output",
    "Params",
    "Result",
    "State",
    "VanishingPivotError",
    "initialise",
    "output",
    "prepare",
    "simulate",
    "step",
]
