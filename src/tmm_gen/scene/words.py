"""Words that names in a scene must not be: taken in some language, file system, or in the generated code."""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


C_AND_CPP = _words(
    """
    auto break case char const continue default do double else enum extern float for goto if inline int
    long register restrict return short signed sizeof static struct switch typedef union unsigned void
    volatile while bool true false nullptr typeof constexpr alignas alignof static_assert thread_local
    errno and and_eq asm bitand bitor catch class compl concept const_cast decltype delete dynamic_cast
    explicit export friend mutable namespace new noexcept not not_eq operator or or_eq private protected
    public reinterpret_cast requires static_cast template this throw try typeid typename using virtual
    wchar_t xor xor_eq
    """
)
"""Reserved in C; or in C++, which includes the generated headers too."""

GENERATED = _words(
    """
    step time t h n x u p y x_next state states param params parameters input inputs output outputs work
    initialise prepare simulate self real np numpy math ca casadi angles rates accelerations
    initial_angle initial_rate stiffness damping inertia hub_inertia hub_damping mass length center
    gravity tip_mass tip_inertia
    """
)
"""Used by the generated code, its CSV files, its parameters or ``[emit.box]``."""

MODULES_AND_HEADERS = _words(
    """
    scipy sympy matplotlib pydantic click jinja2 tmm_gen main test assert complex ctype errno fenv
    inttypes iso646 limits locale setjmp signal stdarg stdbool stddef stdint stdio stdlib string tgmath
    time wchar wctype aux con nul prn
    """
)
"""Would hide a package or C header; or no file of that name can exist on some system."""
