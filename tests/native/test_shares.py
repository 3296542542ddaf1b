"""Threads share arms: each arm is one thread's, and none waits long for another at the end."""

from __future__ import annotations

import threading

import pytest

from tmm_gen.native.shares import GRAIN, shared, shares


@pytest.mark.parametrize("workers", [1, 2, 3, 16])
@pytest.mark.parametrize("arms", [1, GRAIN, GRAIN + 1, 4096, 10_000])
def test_each_arm_is_in_one_share(arms: int, workers: int) -> None:
    found = list(shares(arms, workers))
    assert [arm for first, end in found for arm in range(first, end)] == list(range(arms))
    assert all(first % GRAIN == 0 for first, _ in found)
    lengths = [end - first for first, end in found]
    assert lengths == sorted(lengths, reverse=True)
    if workers == 1:
        assert len(found) == 1
    elif arms >= 2 * workers * GRAIN:
        assert lengths[0] <= arms / workers  # or the others would wait for who has it
        assert lengths[-1] <= max(GRAIN, arms / (8 * workers))


def test_all_threads_take_part_and_each_share_is_taken_once() -> None:
    meeting, seen = threading.Barrier(3, timeout=60.0), []

    def work(first: int, end: int) -> None:
        if len({name for _, name in seen}) < 3:
            seen.append(((first, end), threading.get_ident()))
            meeting.wait()
        else:
            seen.append(((first, end), threading.get_ident()))

    shared(work, 6 * GRAIN, 3)
    assert sorted(share for share, _ in seen) == sorted(shares(6 * GRAIN, 3))
    assert len({name for _, name in seen}) == 3


@pytest.mark.parametrize("workers", [1, 2])
def test_what_goes_wrong_in_a_thread_is_raised(workers: int) -> None:
    def work(first: int, _: int) -> None:
        if first == 0:
            raise MemoryError

    with pytest.raises(MemoryError):
        shared(work, 4 * GRAIN, workers)
