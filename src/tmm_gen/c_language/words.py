"""Words that the emitted C needs for itself, so that no member may be called so and no ``#undef`` may take them away.

All else a user may call a member is bare in our own sources. ``tests/emit/c/test_words.py`` reads what must stand here
off the emitted texts.
"""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


KEYWORDS = _words(
    """
    auto break case char const continue default do double else enum extern float for goto if inline int long register
    restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual
    asm catch char8_t char16_t char32_t class co_await co_return co_yield concept const_cast consteval constinit
    decltype delete dynamic_cast explicit export friend mutable namespace new noexcept operator private protected
    public reinterpret_cast requires static_cast template this throw try typeid typename using virtual wchar_t
    and and_eq bitand bitor compl not not_eq or or_eq xor xor_eq defined
    """
)
"""Keywords of C up to C23 and of C++ up to C++20, and ``defined``, which no ``#ifndef`` can ask for."""

LIBRARY = _words(
    """
    NULL offsetof size_t ptrdiff_t
    FLT_MAX DBL_MAX NAN INFINITY HUGE_VAL HUGE_VALF HUGE_VALL
    isfinite isinf isnan isnormal signbit fpclassify FP_INFINITE FP_NAN FP_NORMAL FP_SUBNORMAL FP_ZERO
    sin cos sqrt fabs floor fma sinf cosf sqrtf fabsf floorf fmaf
    uint8_t uint16_t uint32_t uint64_t UINT32_MAX UINT64_MAX UINT64_C
    printf memcpy memset memcmp strcmp strncpy calloc free
    clock_gettime CLOCK_THREAD_CPUTIME_ID CLOCK_MONOTONIC TIMER_ABSTIME clock_nanosleep EINTR errno
    SCHED_FIFO sched_setscheduler sched_get_priority_min sched_priority
    rint ceil fmin memmove strtod strerror fprintf stderr
    """
)
"""What the emitted sources that use members take from the C library, and what its macros are made of in some library:
``isfinite`` is a comparison of ``fpclassify`` with ``FP_INFINITE`` in newlib."""

OWN = _words(
    "SAMPLES ROWS STATES OUTPUTS SUBSTEPS END_ROWS LANES ACROSS KINDS STEPS PATTERN PAINTED STACK_POINTER TORQUE "
    "STAGES FUTURE KNOWNS PAST MOTORS TERMS INPUTS UNKNOWNS SENSORS COLUMNS SPAN SQUARES SLOPED WEIGHED DIRECTIONS "
    "WALLS ANSWERED STEADY BIASES FREE_KNOWNS SHIFT_KNOWNS TORQUES SECONDS PERIOD LATE NEAR "
    "BINS PULLS TIMER_CTRL TIMER_RELOAD TIMER_VALUE"
)
"""Macros of the emitted sources themselves, controllers and test programs included."""

OWN_PREFIXES = ("tmm_", "TMM_GEN_", "INSTANCE_", "FMI_", "DAQP_", "SYST_")
"""How other macros of theirs begin, and the members that have a prefix."""

TYPES = ("real", "pair", "many")
"""Behind a scene's name: types by which its structs are declared. In C++ no member may be called as the type of
another."""


def taken(name: str, scene: str, macros: str) -> bool:
    """Return whether the sources emitted for a scene need a name for themselves.

    Parameters
    ----------
    name : str
        Of an input or output.
    scene : str
        Name of the scene.
    macros : str
        What stands in front of its macros. Those of its controllers have the scene's name in capitals.
    """
    if name in KEYWORDS or name in LIBRARY or name in OWN or name in {f"{scene}_{end}" for end in TYPES}:
        return True
    return name.startswith((*OWN_PREFIXES, f"{macros}_", f"{scene.upper()}_"))
