# thesis2: Two-station torsional chain, Gholampour (2018), table 3-2
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 8302c2fdab02afb73919e09c91c3abafc3d83d0760e2c0e63be40bfdc341e62e
# sha256 of the rest of this file: 94acb56631ae78782799ee925c85bc52b9325fe9d85e8cfe71898464b8ec469d
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
