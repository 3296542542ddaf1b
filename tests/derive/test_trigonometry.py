"""Own sine and cosine: constants follow from definitions, errors stay within what the generated code states."""

from __future__ import annotations

from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.derive.trigonometry import Trigonometry, trigonometry
from tmm_gen.emit.c.circle import COUNT_BITS, ERROR

Array = NDArray[np.floating[Any]]
TYPES = {"float32": (np.float32, 24), "float64": (np.float64, 53)}


def _constants(real: str) -> Trigonometry:
    return trigonometry(TYPES[real][1], COUNT_BITS[real])


def sine_and_cosine(angle: Array, t: Trigonometry) -> tuple[Array, Array]:
    """Do what the template of C does, operation by operation, in the type of the angle."""
    kind = angle.dtype.type
    whole = (angle * kind(t.quarters_per_radian) + kind(t.whole)) - kind(t.whole)
    rest = angle
    for part in t.quarter:
        rest = rest - whole * kind(part)
    z = rest * rest

    def horner(coefficients: tuple[float, ...]) -> Array:
        total = np.full_like(z, kind(coefficients[-1]))
        for coefficient in reversed(coefficients[:-1]):
            total = kind(coefficient) + z * total
        return total

    sine = rest + rest * z * horner(t.sine)
    cosine = (kind(1.0) - kind(0.5) * z) + z * z * horner(t.cosine)
    quarters = whole.astype(np.int64) % 4
    table = np.array([0, 1, 0, -1, 0], dtype=kind)
    return (
        sine * table[quarters + 1] + cosine * table[quarters],
        cosine * table[quarters + 1] - sine * table[quarters],
    )


def _hostile(real: str, count: int) -> Array:
    """Return angles where a reduction errs most: neighbours of multiples of an eighth of a turn, and the ends."""
    kind, _ = TYPES[real]
    t = _constants(real)
    draw = np.random.default_rng(7)
    eighths = np.unique(draw.integers(0, 2 ** (COUNT_BITS[real] + 1) - 1, count))
    with mpmath.workdps(40):
        near = np.array([float(mpmath.pi / 4 * int(k)) for k in eighths]).astype(kind)
    ends = np.array([0.0, 2.0**-60, 2.0**-20, t.largest_angle], dtype=kind)
    angles = np.concatenate([near, np.nextafter(near, kind(np.inf)), np.nextafter(near, kind(0)), ends])
    angles = angles[angles <= t.largest_angle]
    return np.concatenate([angles, -angles])


def test_the_parts_of_a_quarter_multiply_exactly() -> None:
    for real, (_, digits) in TYPES.items():
        t = _constants(real)
        largest = 2 ** COUNT_BITS[real]
        for part in t.quarter[:2]:
            with mpmath.workdps(60):
                product = mpmath.mpf(part) * largest
                mantissa = int(product.man)
            assert mantissa.bit_length() + COUNT_BITS[real] <= digits
        with mpmath.workdps(60):
            left = abs(mpmath.pi / 2 - mpmath.fsum(map(mpmath.mpf, t.quarter)))
            assert left * largest < mpmath.mpf(2) ** -(digits + 10)


def test_polynomials_are_the_shortest_that_will_do() -> None:
    assert len(_constants("float32").sine) == 3
    assert len(_constants("float64").sine) == 6
    for real, (_, digits) in TYPES.items():
        t = _constants(real)
        with mpmath.workdps(40):
            for r in mpmath.linspace(0, mpmath.pi / 4, 101):
                z = r * r
                sine = r + r * z * mpmath.polyval(list(reversed(t.sine)), z)
                cosine = 1 - z / 2 + z * z * mpmath.polyval(list(reversed(t.cosine)), z)
                assert abs(sine - mpmath.sin(r)) <= abs(r) * mpmath.mpf(2) ** -(digits + 1)
                assert abs(cosine - mpmath.cos(r)) <= mpmath.mpf(2) ** -(digits + 1)


def test_single_precision_is_within_the_stated_error_densely() -> None:
    """Double sines are exact enough to judge single ones."""
    t = _constants("float32")
    dense = np.random.default_rng(3).uniform(-t.largest_angle, t.largest_angle, 400_000).astype(np.float32)
    small = np.linspace(-7.0, 7.0, 400_001, dtype=np.float32)
    for angles in (dense, small, _hostile("float32", 10_000)):
        sine, cosine = sine_and_cosine(angles, t)
        exact = angles.astype(np.float64)
        for found, right in ((sine, np.sin(exact)), (cosine, np.cos(exact))):
            assert found.dtype == np.float32
            assert np.max(np.abs(found.astype(np.float64) - right)) * 2.0**24 <= ERROR


@pytest.mark.parametrize("which", ["dense", "small", "hostile"])
def test_double_precision_is_within_the_stated_error(which: str) -> None:
    t = _constants("float64")
    draw = np.random.default_rng(5)
    angles = {
        "dense": draw.uniform(-t.largest_angle, t.largest_angle, 4000),
        "small": draw.uniform(-7.0, 7.0, 4000),
        "hostile": _hostile("float64", 600),
    }[which]
    sine, cosine = sine_and_cosine(angles, t)
    with mpmath.workdps(40):
        for angle, s, c in zip(angles, sine, cosine, strict=True):
            x = mpmath.mpf(float(angle))
            assert abs(float(s) - mpmath.sin(x)) * 2**53 <= ERROR
            assert abs(float(c) - mpmath.cos(x)) * 2**53 <= ERROR


def test_the_stated_error_is_not_generous() -> None:
    angles = np.linspace(-7.0, 7.0, 400_001, dtype=np.float32)
    _, cosine = sine_and_cosine(angles, _constants("float32"))
    worst = np.max(np.abs(cosine.astype(np.float64) - np.cos(angles.astype(np.float64)))) * 2.0**24
    assert worst > ERROR / 2


def test_small_angles_keep_their_digits() -> None:
    """Below an eighth of a turn nothing is subtracted: the error is relative there."""
    angles = np.geomspace(1e-30, 0.78, 100_001).astype(np.float32)
    sine, _ = sine_and_cosine(angles, _constants("float32"))
    right = np.sin(angles.astype(np.float64))
    assert np.max(np.abs(sine.astype(np.float64) - right) / right) * 2.0**24 <= ERROR
