"""Units of scenes, extracted once, and instances of them behind the same few functions for both versions."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import fmpy
import fmpy.fmi2
import fmpy.fmi3
import pytest

from tmm_gen.export.fmu import FmiVersion, fmu
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene, parse_scene

SERVO = """
name = "servo"
[model]
kind = "planar"
[integrator]
name = "sdirk4"
step = 2e-3
[base]
kind = "prescribed"
[beam]
length = 0.5
bending_stiffness = 4.0
mass_per_length = 0.6
links = 2
springs = "half-clamp"
damping_time = 0.002
[[input]]
name = "angle"
at = "base"
acts = "angle"
[[input]]
name = "push"
at = "tip"
acts = "force_y"
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


@pytest.fixture(scope="session")
def servo() -> Scene:
    """Two links whose base is told where to stand: five stages a step."""
    return parse_scene(SERVO)


class Instance:
    """An instance of a unit, its variables by name."""

    def __init__(self, folder: Path) -> None:
        self.description = fmpy.read_model_description(str(folder))
        self.folder = folder
        self.logged: list[str] = []
        self.unit = self._make()
        self.variables = {v.name: v for v in self.description.modelVariables}

    @property
    def three(self) -> bool:
        return str(self.description.fmiVersion).startswith("3")

    def _make(self) -> Any:
        kind = fmpy.fmi3.FMU3Slave if self.three else fmpy.fmi2.FMU2Slave
        token = self.description.instantiationToken if self.three else self.description.guid
        unit = kind(
            guid=token,
            unzipDirectory=str(self.folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="test",
        )
        if self.three:
            unit.instantiate(logMessage=lambda env, status, category, text: self.logged.append(text.decode()))
        else:
            callbacks = fmpy.fmi2.fmi2CallbackFunctions()
            callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(
                lambda env, name, status, category, text: self.logged.append(text.decode())
            )
            self._kept = callbacks
            unit.instantiate(callbacks=callbacks)
        return unit

    def begin(self, start: float = 0.0, **values: Any) -> None:
        """Initialise with some variables set."""
        if not self.three:
            self.unit.setupExperiment(startTime=start)
            self.unit.enterInitializationMode()
        else:
            self.unit.enterInitializationMode(startTime=start)
        for name, value in values.items():
            self.set(name.replace("__", "."), value)
        self.unit.exitInitializationMode()

    def references(self, name: str) -> list[int]:
        if name in self.variables:
            return [self.variables[name].valueReference]
        found = [v.valueReference for key, v in self.variables.items() if key.startswith(f"{name}[")]
        assert found, name
        return found

    def set(self, name: str, value: Any) -> None:
        values = [float(x) for x in (value if hasattr(value, "__len__") else [value])]
        (self.unit.setFloat64 if self.three else self.unit.setReal)(self.references(name), values)

    def get(self, name: str) -> Any:
        references = self.references(name)
        if self.three:
            shape = self.variables[name].shape or (1,)
            found = list(self.unit.getFloat64(references, nValues=shape[0]))
        else:
            found = self.unit.getReal(references)
        return found[0] if len(found) == 1 else found

    def outputs(self) -> dict[str, float]:
        return {v.name: self.get(v.name) for v in self.description.modelVariables if v.causality == "output"}

    def state(self) -> dict[str, Any]:
        return {name: self.get(name) for name in ("state.angle", "state.rate", "state.acceleration")}

    def step(self, time: float, size: float) -> None:
        self.unit.doStep(currentCommunicationPoint=time, communicationStepSize=size)


@pytest.fixture(scope="session")
def unit_of(
    tmp_path_factory: pytest.TempPathFactory, program_of: Callable[[Scene], Program]
) -> Callable[[Scene, FmiVersion], Path]:
    """Export a scene into a file, each scene and version once."""
    known: dict[tuple[Scene, int], Path] = {}

    def of(scene: Scene, version: FmiVersion) -> Path:
        if (scene, version) not in known:
            path = tmp_path_factory.mktemp("fmu") / f"{scene.name}.fmu"
            path.write_bytes(fmu(scene, version, program=program_of(scene)))
            known[scene, version] = path
        return known[scene, version]

    return of


@pytest.fixture
def opened(tmp_path: Path) -> Iterator[Callable[[Path], Instance]]:
    """Make instances of unit files."""
    made: list[Instance] = []

    def make(file: Path) -> Instance:
        folder = tmp_path / file.parent.name
        if not folder.exists():
            fmpy.extract(str(file), str(folder))
        made.append(Instance(folder))
        return made[-1]

    yield make
    for each in made:
        each.unit.freeInstance()
    shutil.rmtree(tmp_path, ignore_errors=True)


@pytest.fixture
def instance(
    unit_of: Callable[[Scene, FmiVersion], Path], opened: Callable[[Path], Instance]
) -> Callable[[Scene, FmiVersion], Instance]:
    """Make instances of a scene's unit."""
    return lambda scene, version: opened(unit_of(scene, version))
