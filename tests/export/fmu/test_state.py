"""Saved states bring a unit back, and only a unit of the same kind."""

from __future__ import annotations

from typing import Any

import pytest
from fmpy.fmi1 import FMICallException

from tmm_gen.export.fmu import FmiVersion

pytestmark = [
    pytest.mark.compiler,
    pytest.mark.xdist_group("fmu"),  # units are exported once
    pytest.mark.parametrize("version", [2, 3]),
]


def functions(unit: Any) -> tuple[Any, Any, Any, Any, Any]:
    it = unit.unit
    if unit.three:
        return it.getFMUState, it.setFMUState, it.freeFMUState, it.serializeFMUState, it.deserializeFMUState
    return it.getFMUstate, it.setFMUstate, it.freeFMUstate, it.serializeFMUstate, it.deSerializeFMUstate


def test_a_saved_state_is_gone_back_to(version: FmiVersion, scene_named: Any, instance: Any) -> None:
    unit = instance(scene_named("arm10"), version)
    save, restore, free, _, _ = functions(unit)
    unit.begin(hub_torque=2.0)
    unit.step(0.0, 0.02)
    saved = save()
    at_save = unit.state()
    unit.step(0.02, 0.03)
    first = unit.state()
    restore(saved)
    assert unit.state() == at_save
    assert unit.get("time") == 0.02
    unit.step(0.02, 0.03)
    assert unit.state() == first != at_save
    free(saved)


def test_a_serialised_state_moves_to_another_instance(
    version: FmiVersion, scene_named: Any, instance: Any
) -> None:
    scene = scene_named("thesis10")
    one, other = instance(scene, version), instance(scene, version)
    save, _, free, serialise, _ = functions(one)
    one.begin(tip_torque=1.0, parameters__inertia=3.0)
    one.step(0.0, 0.05)
    saved = save()
    content = serialise(saved)
    free(saved)
    _, restore, free, _, deserialise = functions(other)
    taken = deserialise(content)
    restore(taken)
    free(taken)
    for unit in (one, other):
        unit.step(0.05, 0.05)
    assert one.state() == other.state()
    assert other.get("parameters.inertia") == 3.0


def test_what_is_not_a_state_of_this_model_is_refused(
    version: FmiVersion, scene_named: Any, instance: Any
) -> None:
    unit = instance(scene_named("thesis10"), version)
    stranger = instance(scene_named("thesis10").replace(**{"integrator.step": 0.02}), version)
    stranger.begin()
    save, _, free, serialise, _ = functions(stranger)
    saved = save()
    content = serialise(saved)
    free(saved)
    deserialise = functions(unit)[-1]
    for bad in (content, content[:-1]):
        with pytest.raises(FMICallException):
            deserialise(bad)
    assert "another model" in unit.logged[-1]
