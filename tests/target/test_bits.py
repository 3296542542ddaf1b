"""Comparison of two runs."""

from __future__ import annotations

import struct

import pytest

from tmm_gen.c_language.real import DOUBLE, FLOAT
from tmm_gen.target.bits import compare_bits, numbers
from tmm_gen.target.run import HarnessRun


def _run(*state: float, last_hash: str = "aa") -> HarnessRun:
    bits = " ".join(struct.pack("<d", value).hex() for value in state)
    return HarnessRun(
        {"start": bits, "first": bits, "hash0": "00", "hash1": last_hash, "last": bits, "outputs": ""}, {}
    )


def test_equal_runs_are_equal() -> None:
    found = compare_bits(_run(1.0, -2.0), _run(1.0, -2.0), DOUBLE)
    assert found.equal
    assert (found.first, found.one_step, found.last_step) == ("", 0.0, 0.0)


def test_a_hash_that_differs_is_a_difference() -> None:
    found = compare_bits(_run(1.0), _run(1.0, last_hash="ab"), DOUBLE)
    assert not found.equal
    assert found.first == "hash1"


def test_how_far_apart() -> None:
    found = compare_bits(_run(1.0, -4.0), _run(1.5, -4.0), DOUBLE)
    assert found.first == "start"
    assert found.one_step == found.last_step == 0.5 / 4.0


def test_runs_of_other_harnesses_are_no_runs_to_compare() -> None:
    with pytest.raises(ValueError, match="different harnesses"):
        compare_bits(_run(1.0), HarnessRun({"start": ""}, {}), DOUBLE)


def test_numbers_are_read_as_memory_holds_them() -> None:
    assert list(numbers("0000803f 000000c0", FLOAT)) == [1.0, -2.0]
