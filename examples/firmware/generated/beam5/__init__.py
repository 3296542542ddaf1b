# beam5: Five-link arm on a hub, the model of an observer
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 2aa7477fe5a1cf796a596a84ffa48c892dc54bfd3ece90a5d25a43813cf34ab5
# sha256 of the rest of this file: ecb161ea11a7156b1375e7ef9e1b7f892c0ce674af5802693eb508437cd05326
"""beam5: Five-link arm on a hub, the model of an observer."""

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
