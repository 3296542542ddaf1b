"""Expansions about the last instant, as the thesis has them."""

from __future__ import annotations

import numpy as np
import sympy as sp

from tmm_gen.derive import expansions


def test_predicted_sines_are_of_second_order() -> None:
    """Eqs. 2-14 and 2-15: halving the span divides the error by eight."""
    values = {expansions.ANGLE: 0.6, expansions.RATE: 1.3, expansions.ACCELERATION: 0.8}
    sine, cosine = expansions.predicted_trigonometry()
    for predicted, exact in ((sine, np.sin), (cosine, np.cos)):
        errors = []
        for span in (0.02, 0.01):
            angle = 0.6 + 1.3 * span + 0.4 * span**2
            errors.append(abs(float(predicted.subs({**values, expansions.SPAN: span})) - exact(angle)))
        assert 2.8 < np.log2(errors[0] / errors[1]) < 3.2


def test_square_of_rate_is_that_of_the_thesis() -> None:
    """Eq. 2-17, from the product rule 2-16."""
    old, acceleration, span, new = (
        expansions.RATE,
        expansions.ACCELERATION,
        expansions.SPAN,
        expansions.NEW_RATE,
    )
    assert sp.expand(expansions.square_of_rate() - (2 * old * new - old**2 + acceleration**2 * span**2)) == 0
