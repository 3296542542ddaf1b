"""The limit of more and more links, for beams whose last link is half a piece and for beams of equal links."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.scene.beam import piece_length
from tmm_gen.study.excitation import excitation
from tmm_gen.study.modelling import modelling_errors
from tmm_gen.study.truth import Truth

LIMIT, SLOPE = 0.7, 0.3


class Exact(Truth):
    """A motion whose error is a power of the pieces' length."""

    order = 2.0

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        assert self.scene.beam is not None
        off = SLOPE * float(piece_length(self.scene.beam)) ** self.order
        return (LIMIT + off) * np.sin(times)[None]


@pytest.mark.parametrize("springs", ["clamped-segment", "half-clamp"])
@pytest.mark.parametrize("order", [1.0, 2.0, 4.0])
def test_errors_that_go_by_the_length_of_pieces_are_found_exactly(
    springs: str, order: float, arm: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Exact, "order", order)
    cut = arm.replace(**{"beam.springs": springs})
    until = excitation(cut, until=2.0)

    def truth(links: int) -> Truth:
        return Exact(cut.replace(**{"beam.links": links}), until, None, unit=1.0)

    found = modelling_errors([3, 25], truth)
    for links, each in found.items():
        beam = truth(links).scene.beam
        assert beam is not None
        right = SLOPE * float(piece_length(beam)) ** order * np.max(np.sin(np.linspace(0.0, 2.0, 401)))
        assert each.error == pytest.approx(right, rel=1e-6)
        assert each.order == pytest.approx(order, rel=1e-6)
    assert len(found) == 5


def test_what_does_not_converge_is_no_limit(arm: Scene) -> None:
    class Wanders(Exact):
        def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
            assert self.scene.beam is not None
            return np.full((1, len(times)), float(np.cos(3.0 * self.scene.beam.links)))

    went = excitation(arm, until=2.0)
    assert modelling_errors([5], lambda n: Wanders(arm.replace(**{"beam.links": n}), went, None, 1.0)) == {}
