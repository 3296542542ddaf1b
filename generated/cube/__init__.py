# cube: Satellite with two flexible panels
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 94e01e390f9a78c7c028cd5c3496f9f2b400bdd211e17d698b0b276451e96c89
# sha256 of the rest of this file: 85c2cc7557684dd0faa0c1bd7de924cfc794271d640dd00e6e14fe7b6a340766
"""cube: Satellite with two flexible panels."""

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
