"""Reserved words of emitted C."""

from __future__ import annotations

from codegen.snippets.stumpff import SETS

_WORDS = """
    auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile
    while _Bool _Complex _Imaginary
    alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual
    and and_eq asm bitand bitor catch char8_t char16_t char32_t class co_await co_return co_yield compl
    concept consteval constinit const_cast decltype delete dynamic_cast explicit export friend mutable
    namespace new noexcept not not_eq operator or or_eq private protected public reinterpret_cast
    requires static_cast template this throw try typeid typename using virtual wchar_t xor xor_eq
    complex imaginary I EOF errno assert far linux near unix
    HUGE_VAL HUGE_VALF HUGE_VALL FP_FAST_FMA FP_ILOGB0 FP_ILOGBNAN FP_INFINITE FP_NAN FP_NORMAL FP_SUBNORMAL
    FP_ZERO MATH_ERREXCEPT MATH_ERRNO math_errhandling
    M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2 M_SQRT1_2
    main NULL INFINITY NAN size_t memcpy memset fmax
    sqrt sin cos exp log sinh cosh fabs isfinite pow copysign sqrtf sinf cosf expf logf sinhf coshf fabsf
    greater largest quotient signed_stumpff0 signed_stumpff1 invert slope2 slope3 all_finite
    input context hold
"""

# All sets of orders, and not only those of one module: a name then does not depend on the functions
# called.
RESERVED = frozenset(_WORDS.split()) | {f"stumpff_{''.join(map(str, orders))}" for orders in SETS}
"""Words that are excluded as names of variables, besides the names of the run representation.

Keywords of C and, since both read headers, of C++; macros of headers that the module or its caller is likely
to include; the mathematical library; helpers.
"""
