# thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: ee57f7952242f19cc6be0f26d3460a304cc65a1747711d25b990a158587c6f1f
# sha256 of the rest of this file: 20a991477cdc4dd624458d484f460e6e634b49376de7030be56a620237561057
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
