# thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: f0c976d21d4524b79e43b0ef658e9df768725b961ac09b0a12bdaf9596a590df
# sha256 of the rest of this file: 4b8bbd9bd4418c348ffa9e1055edde6e49ff5eb53d4d8ef503fb67c96fdff8b9
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
