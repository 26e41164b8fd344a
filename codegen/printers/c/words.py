"""Words that emitted C code must not use as names of variables."""

from __future__ import annotations

from codegen.snippets.graph import LIBRARY

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
    FP_ZERO FP_INT_DOWNWARD FP_INT_TONEAREST FP_INT_TONEARESTFROMZERO FP_INT_TOWARDZERO FP_INT_UPWARD
    FP_LLOGB0 FP_LLOGBNAN MATH_ERREXCEPT MATH_ERRNO math_errhandling MAXFLOAT
    SNAN SNANF SNANL SNANF32 SNANF32X SNANF64 SNANF64X SNANF128
    HUGE_VAL_F32 HUGE_VAL_F32X HUGE_VAL_F64 HUGE_VAL_F64X HUGE_VAL_F128
    stdin stdout stderr BUFSIZ FILENAME_MAX FOPEN_MAX TMP_MAX P_tmpdir L_tmpnam L_ctermid L_cuserid
    EXIT_FAILURE EXIT_SUCCESS MB_CUR_MAX RAND_MAX BIG_ENDIAN LITTLE_ENDIAN PDP_ENDIAN BYTE_ORDER
    FD_SETSIZE NFDBITS WCONTINUED WEXITED WNOHANG WNOWAIT WSTOPPED WUNTRACED
    SEEK_CUR SEEK_DATA SEEK_END SEEK_HOLE SEEK_SET L_INCR L_SET L_XTND F_LOCK F_OK F_TEST F_TLOCK F_ULOCK
    R_OK W_OK X_OK STDERR_FILENO STDIN_FILENO STDOUT_FILENO CLOSE_RANGE_CLOEXEC CLOSE_RANGE_UNSHARE
    RENAME_EXCHANGE RENAME_NOREPLACE RENAME_WHITEOUT
    main NULL INFINITY NAN size_t memcpy memset fmax
    sqrt sin cos exp log sinh cosh fabs isfinite pow copysign sqrtf sinf cosf expf logf sinhf coshf fabsf
    input context arguments
"""

_CONSTANTS = """
    M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2 M_SQRT1_2
"""
# The C library glibc also defines constants with format suffixes, such as ``M_PIf32``.
_FORMATS = ("", "f", "l", "f32", "f32x", "f64", "f64x", "f128")

RESERVED = (
    frozenset(_WORDS.split())
    | {f"{name}{kind}" for name in _CONSTANTS.split() for kind in _FORMATS}
    | {f"{name}{kind}" for name in LIBRARY for kind in ("", "f")}
)
"""Words that are forbidden as names of variables in emitted C code.

The most important ones are the keywords of C and C++, the functions of the mathematical library, and the
macros of common headers.
"""
