"""A program lowered for C, and what follows from its scene: which functions there are, and of which numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

from tmm_gen.c_language.real import Real, real_of
from tmm_gen.emit.c.box import complete_box
from tmm_gen.emit.c.circle import Circle, PairCircle, uses_circle
from tmm_gen.emit.c.fence import Fence, fence_of
from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.pair_outputs import rounded_last
from tmm_gen.emit.c.structs import Struct, structs_of
from tmm_gen.emit.c.vector_type import VectorType
from tmm_gen.emit.header import header_lines
from tmm_gen.program.statements import Program, Vectors
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class Emitted:
    """A program lowered for C.

    Parameters
    ----------
    source : Program
        As built, for reference values.
    program : Program
        Lowered.
    real : Real
        Number type.
    header : tuple of str
        Lines for the head of every file.
    structs : dict from str to Struct
        By name: params, model, state, inputs, outputs.
    scene : Scene
        What is emitted.
    """

    source: Program
    program: Program
    real: Real
    header: tuple[str, ...]
    structs: dict[str, Struct]
    scene: Scene

    @classmethod
    def of(cls, program: Program, scene: Scene) -> Self:
        """Prepare a program for a scene's number type."""
        real = real_of(scene.emit)
        structs = {struct.name: struct for struct in structs_of(program)}
        if scene.emit.parameters == "bound":
            structs = {name: struct for name, struct in structs.items() if name not in ("params", "model")}
        sizes = ", ".join(f"{name} {struct.size(real)}" for name, struct in structs.items())
        number = f"sums of two of type {real.c}" if real.pair else real.c
        fast, in_space = scene.emit.favour == "speed", scene.spatial is not None
        # arms side by side have their own loops, which long bodies would not make faster
        together = fast and in_space and scene.emit.batch is None
        lowered = lower(program, apart=fast and not in_space, together=together)
        counted, facts = program, []
        if fast and not in_space:  # there, a few operations more make chains shorter
            counted = replace(program, startup=lowered.startup, main=lowered.main)
        if (vectors := vectors_of(lowered, scene)) is not None:
            counted = replace(program, main=vectors.step)
            facts = [f"vectors: of {vectors.parts} numbers; what does all of one is one operation"]
        lines = (
            *header_lines(counted, scene),
            *facts,
            f"number type: {number}",
            f"bytes of the structs: {sizes}",
        )
        if real.pair:
            lowered = replace(lowered, output=rounded_last(lowered.output))
        return cls(program, lowered, real, lines, structs, scene)

    @property
    def bound(self) -> bool:
        """Whether parameters and step are bound at generation, so that there are neither params nor model."""
        return self.scene.emit.parameters == "bound"

    @property
    def fast(self) -> bool:
        """Whether the kernel is to be fast on processors with vectors, rather than small."""
        return self.scene.emit.favour == "speed"

    @property
    def vectors(self) -> VectorType | None:
        """The type of vectors, where the step is in vectors."""
        found = vectors_of(self.program, self.scene)
        return None if found is None else VectorType(self.real, found.parts)

    @cached_property
    def circle(self) -> Circle | None:
        """Own sine and cosine, where the scene asks for them and its arm needs them."""
        own = self.scene.emit.trigonometry == "own" and uses_circle(self.program)
        if not own:
            return None
        return PairCircle(self.real) if self.real.pair else Circle(self.real, self.fast)

    @cached_property
    def fences(self) -> dict[str, Fence]:
        """Bounds of intermediate results by routine, where the scene states a box."""
        box = complete_box(self.scene, self.program)
        if box is None:
            return {}
        return {
            routine.name: fence_of(self.program, box, routine, in_space=self.scene.spatial is not None)
            for routine in (self.program.initialise, *self.program.steps)
        }

    @property
    def fenced(self) -> bool:
        """Whether some intermediate result has bounds."""
        return any(self.fences.values())

    @property
    def number(self) -> str:
        """Type of parameters, model and state within the source."""
        return "pair" if self.real.pair else "real"

    @property
    def functions(self) -> tuple[str, ...]:
        """What the kernel offers, without its name in front."""
        phases = ("initialise", "step", "output")
        return phases if self.bound else ("default_params", "prepare", *phases)

    def pointers(self, *names: str | None) -> tuple[str, ...]:
        """Return those of some arguments that the kernel's functions have."""
        absent = ("params", "model") if self.bound else ()
        return tuple(name for name in names if name and name not in absent)

    @property
    def sources(self) -> list[str]:
        """The files of C to compile, without the test."""
        name = self.program.name
        more = {"_sensitivities": self.program.sensitivities, "_batch": self.scene.emit.batch}
        return [f"{name}.c", *(f"{name}{end}.c" for end, asked in more.items() if asked)]


def vectors_of(program: Program, scene: Scene) -> Vectors | None:
    """Return the step in vectors, where the kernel takes it: of several arms at once, each has the bits of its own."""
    return program.vectors if scene.emit.favour == "speed" and scene.emit.batch is None else None
