"""From a scene to its program: choose the integrator, then the builder of the scene's kind."""

from __future__ import annotations

from functools import lru_cache

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import UnsuitableUnknownError, affine_motion
from tmm_gen.digits.product import require_safe_product
from tmm_gen.digits.rounding import require_digits
from tmm_gen.errors import UserError
from tmm_gen.program.arm.assemble import Choices, build
from tmm_gen.program.arm.product import ProductWalks
from tmm_gen.program.arm.thesis import TaylorWalks, ThesisWalks
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.sensitivities.walks import TangentableWalks
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space, predicts_held
from tmm_gen.program.statements import Program
from tmm_gen.row.row import Row
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm


@lru_cache(maxsize=8)
def build_program(scene: Scene, *, auto: bool = False) -> Program:
    """Build the program of a scene; the last few are remembered.

    Parameters
    ----------
    scene : Scene
        What to build.
    auto : bool
        Whether the steps of a planar arm sweep as often as it takes: for simulations, not for controllers.

    Raises
    ------
    UserError
        If the scene asks for something that does not exist: a planar product sweep, a
        product over more stations than it is safe for, an unknown (displacement,
        increment) that an explicit integrator cannot be solved for, or a step of which
        rounding leaves too few digits.
    """
    chosen = integrator(scene.integrator.name, **scene.integrator.parameters)
    _require_carried(scene, chosen)
    try:
        if scene.spatial is not None:
            return _in_space(scene, scene.spatial, chosen, auto=auto)
        if scene.model.linear:
            require_safe_product(scene, chosen)
            require_digits(scene, chosen)
        else:
            _refuse_unsupported(scene)
        return build_unchecked(scene, chosen, auto=auto)
    except UnsuitableUnknownError as error:
        raise UserError(
            f"scene '{scene.name}': model.unknown = '{scene.model.unknown}' with model.sweep = "
            f"'{scene.model.sweep}' and integrator '{scene.integrator.name}': {error}"
        ) from error


def _require_carried(scene: Scene, chosen: Integrator) -> None:
    """Refuse an arm that methods whose stages are coupled do not go with yet."""
    if chosen.main.coupled and chosen.name not in scene.integrators:
        raise UserError(
            f"scene '{scene.name}': {chosen.name} solves all its stages at once, which is not derived in space for "
            "linearisation = 'newton'; use an integrator such as 'sdirk4'"
        )


def _in_space(scene: Scene, arm: SpatialArm, chosen: Integrator, *, auto: bool) -> Program:
    """Build the program of an arm in space."""
    auto = auto and scene.model.auto
    exact = scene.model.linearisation == "newton"
    more = "sweep" if exact else "correction"
    count = scene.model.sweeps - (not exact)
    rounds = f"as many {more}s as it takes" if auto else f"{count} {more}{'s' if count != 1 else ''}"
    parameters = "".join(f", {k} = {float(v):g}" for k, v in chosen.parameters.items())
    facts = {
        "model": "arm in space" + (", gravity" if any(arm.gravity) else ""),
        "integrator": chosen.title + parameters,
        "linearisation": f"{scene.model.linearisation}, {rounds}",
    }
    derived = scene.emit.sensitivities and not auto
    if derived:
        _require_one_step(scene, chosen)
    stages = len(chosen.main.stages)
    choices = SpaceChoices(
        step=scene.integrator.step,
        iterations=scene.model.sweeps,
        held=predicts_held(stages, scene.model.sweeps, auto=auto),
        auto=auto,
        exact=exact,
        sensitivities=derived,
        vectors=scene.emit.favour == "speed",
        single=scene.emit.real == "float32",
        facts=tuple(facts.items()),
    )
    return build_in_space(arm, scene.name, scene.title, chosen, choices)


def build_unchecked(scene: Scene, chosen: Integrator, *, auto: bool = False) -> Program:
    """Build the program of a scene without asking whether it keeps enough digits.

    Parameters
    ----------
    chosen : Integrator
        With its parameters bound to numbers.
    auto : bool
        Whether each stage sweeps until that changes next to nothing, instead of as often as the scene says; without
        sensitivities.
    """
    if scene.model.linearisation != "newton":
        _require_one_implicit_stage(scene, chosen)
    row = row_of(scene, chosen)
    once = row.about == "prediction" and not auto
    auto = auto and row.about == "prediction"
    derived = scene.emit.sensitivities and not auto
    if derived:
        _require_derivatives(scene, chosen, row)
    return build(
        row,
        chosen,
        Choices(
            step=scene.integrator.step,
            unknown=scene.model.unknown,
            iterations=scene.sweeps,
            # no polynomial of a last step leads into the first one
            first_iterations=scene.sweeps + 1 if scene.coupled and scene.model.auto and once else None,
            corrections=0 if auto else scene.model.corrections,
            walks=_walks(scene, row, derived=derived),
            places=scene.model.linearisation != "newton",
            # behind gears a turn of the hub is another angle: those of such chains grow as they turn
            turns_apart=scene.emit.compensated
            and row.boundary == "free"
            and row.about == "known"
            and all(turn == 1.0 for turn in scene.turns),
            auto=auto,
            sensitivities=derived,
        ),
    )


def _walks(scene: Scene, row: Row, *, derived: bool) -> type[Walks]:
    """Return what walks a scene's sweeps take."""
    if scene.model.sweep == "product":
        return ProductWalks
    if derived and row.about == "prediction":
        return TangentableWalks
    return WALKS[scene.model.linearisation]


WALKS: dict[str, type[Walks]] = {"newton": Walks, "taylor": TaylorWalks, "frozen": ThesisWalks}
"""What walks a sweep takes by each linearisation."""


def _require_one_implicit_stage(scene: Scene, chosen: Integrator) -> None:
    """Refuse integrators that the thesis's step, which derives accelerations from places, has no form for."""
    explicit = any(affine_motion(scheme, 1, "acceleration").gain["q"] == 0 for scheme in chosen.schemes)
    if explicit or any(len(scheme.stages) > 1 for scheme in chosen.schemes):
        raise UserError(
            f"scene '{scene.name}': model.linearisation = '{scene.model.linearisation}' integrates places in one "
            f"implicit stage, which '{chosen.name}' does not have; use linearisation = 'newton', or an "
            "integrator such as 'newmark'"
        )


def _require_derivatives(scene: Scene, integrator: Integrator, row: Row) -> None:
    """Refuse a scene that asks for derivatives of a step that has none.

    Raises
    ------
    UserError
        If the step is not Newton's, needs other steps before it, or sums up energy.
    """
    what = f"scene '{scene.name}': emit.sensitivities = true"
    if scene.model.linearisation != "newton":
        raise UserError(
            f"{what} needs model.linearisation = 'newton', not '{scene.model.linearisation}', whose step is no "
            "iteration on the exact equations"
        )
    _require_one_step(scene, integrator)
    if row.counts_heat:
        raise UserError(f"{what} does not go with an output of dissipated energy; remove one of the two")


def _require_one_step(scene: Scene, integrator: Integrator) -> None:
    """Refuse derivatives of a step that needs other steps before it."""
    if integrator.startup:
        raise UserError(
            f"scene '{scene.name}': emit.sensitivities = true needs an integrator without start-up steps, such as "
            f"'newmark', 'generalized_alpha', 'bathe' or 'sdirk4', not '{scene.integrator.name}'"
        )


def _refuse_unsupported(scene: Scene) -> None:
    if scene.model.sweep != "riccati":
        raise UserError(
            f"scene '{scene.name}': model.sweep = '{scene.model.sweep}' multiplies transfer matrices, which loses "
            "all digits in a planar arm; use sweep = 'riccati'"
        )
