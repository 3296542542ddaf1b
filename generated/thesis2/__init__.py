# thesis2: Two-station torsional chain, Gholampour (2018), table 3-2
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 4fdbd97419e7ff02c8d9faf01a8b79522b9a5dd593d6163ae5c751891e6cf0b2
# sha256 of the rest of this file: a9aca20adcee872bfc3564bd1efdc1a581b24f3fe0814d44473d32449c27612c
"""thesis2: Two-station torsional chain, Gholampour (2018), table 3-2."""

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
