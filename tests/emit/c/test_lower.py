"""What happens to a program before it is written."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from tmm_gen.emit.c.lower import lower
from tmm_gen.program.statements import Loop
from tmm_gen.program.variables import Role


def test_all_of_the_state_is_defined_at_the_start(chain: Any) -> None:
    program = chain(integrator="park", base="prescribed").program
    assert not set(program.state) <= program.initialise.written()  # start-up steps shift what nothing has set
    assert set(program.state) <= lower(program).initialise.written()


def test_a_routine_that_reads_what_nothing_has_written_is_refused(chain: Any) -> None:
    program = chain(base="motor").program
    late = replace(program.prepare, sections=tuple(reversed(program.prepare.sections)))
    with pytest.raises(ValueError, match="prepare reads hub_admittance before it is written"):
        lower(replace(program, prepare=late))


def test_a_newmark_step(chain: Any) -> None:
    """Two loops, the prediction within the inward one, and three arrays that go from one to the next."""
    step = lower(chain(alike=True).program).main
    assert [s.order.value for s in step.statements() if isinstance(s, Loop)] == ["inward", "outward"]
    assert len(step.variables(Role.WORK)) == 3
