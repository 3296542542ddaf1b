"""The unit of work of a study: one configuration, under a key that says all it depends on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from tmm_gen.inputs.signals import Signal
from tmm_gen.package.generator import generator_digest
from tmm_gen.scene import Scene
from tmm_gen.study.configuration import Configuration
from tmm_gen.study.evaluate import evaluate
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.outcome import Result
from tmm_gen.study.store import Store
from tmm_gen.study.truth import Truth


@dataclass(frozen=True, eq=False)
class Task:
    """One configuration to evaluate.

    Parameters
    ----------
    key : str
        Hash of scene, excitation, configuration and tmm-gen: equal keys have equal results.
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    configuration : Configuration
        How it is computed.
    """

    key: str
    scene: Scene
    excitation: Excitation
    configuration: Configuration


class Executor(Protocol):
    """Computes tasks, here or elsewhere."""

    def results(
        self, tasks: Iterable[Task], truths: Mapping[int | None, Truth], store: Path | None
    ) -> Iterator[tuple[Task, Result]]:
        """Yield each task with its result as it is done, in any order; results go to the store, if there is one."""


def make_tasks(scene: Scene, excitation: Excitation, configurations: Iterable[Configuration]) -> list[Task]:
    """Return the tasks of a grid."""
    common = study_key(scene, excitation)
    return [Task(_hash([common, each.values()]), scene, excitation, each) for each in configurations]


def study_key(scene: Scene, excitation: Excitation) -> str:
    """Return the hash of what all tasks of a study have in common."""
    signals = {name: _content(signal) for name, signal in excitation.signals.items()}
    said = [scene.digest, generator_digest(), signals, excitation.until, excitation.output]
    return _hash(said)


def compute(task: Task, truth: Truth, store: Path | None) -> Result:
    """Evaluate a task, unless the store knows its result; leave the result there at once.

    Whatever happens to the process afterwards, nothing that is in the store need be computed again.
    """
    if store is None:
        return evaluate(task.scene, task.excitation, task.configuration, truth)
    with Store(store) as kept:
        known = kept.result(task.key)
        if known is not None:
            return known
        kept.begin(task.key)
        result = evaluate(task.scene, task.excitation, task.configuration, truth)
        kept.keep(task.key, result)
        return result


def _content(signal: Signal) -> list[Any]:
    """Return a signal's class and numbers."""
    values = [getattr(signal, field.name) for field in fields(signal) if field.compare]  # type: ignore[arg-type]
    return [type(signal).__name__, *(np.asarray(value, float).tolist() for value in values)]


def _hash(said: object) -> str:
    return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()
