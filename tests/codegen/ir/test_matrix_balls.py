"""Exponentials of matrices with many digits, against the exponential of mpmath."""

from __future__ import annotations

import mpmath
import pytest
from flint import arb, ctx

from codegen.ir.domain import PreciseDomain
from codegen.ir.matrix_balls import MOST_BITS, ball, exponential, midpoint

D, EXACT = PreciseDomain(0, 50), PreciseDomain(0, 120).context


def expected(n: int, blocks: list[list[mpmath.mpf]]) -> list[mpmath.mpf]:
    """Return the exponential of A, and of (A, E; 0, A) if E is given, computed by mpmath."""
    rows = [[block[n * i : n * i + n] for block in blocks] for i in range(n)]
    if len(blocks) == 1:
        result = EXACT.expm(EXACT.matrix([row[0] for row in rows]))
        return [result[i, j] for i in range(n) for j in range(n)]
    zero = [EXACT.mpf(0)] * n
    whole = [a + e for a, e in rows] + [zero + a for a, _ in rows]
    result = EXACT.expm(EXACT.matrix(whole))
    return [result[i, n * k + j] for k in range(2) for i in range(n) for j in range(n)]


MATRICES = {
    "small": ["1e-30", "2e-31", "-1e-30", "3e-30"],
    "rotation": ["0", "1000.25", "-1000.25", "0"],
    "stiff": ["-300", "1", "1", "-0.5"],
    "far from normal": ["-40", "1e11", "0", "1"],
    "nilpotent": ["0", "1e30", "0", "0"],
}


@pytest.mark.parametrize("derivative", [None, ["1", "2", "3", "4"], ["1e-40", "0", "0", "-1e-40"]])
@pytest.mark.parametrize("name", MATRICES)
def test_the_exponential_is_that_of_mpmath(name: str, derivative: list[str] | None) -> None:
    blocks = [[EXACT.mpf(x) for x in texts] for texts in (MATRICES[name], derivative) if texts]
    given = [D.context.mpf(x) for block in blocks for x in block]
    if name == "nilpotent":
        with pytest.raises(OverflowError, match=r"below 2\^40"):
            D.vector("expm2", given[:4])
        return
    exact = expected(2, [[EXACT.mpf(x) for x in given[4 * k : 4 * k + 4]] for k in range(len(blocks))])
    found = D.vector("expm2" if derivative is None else "expm2_d1", given)
    for start in range(0, len(exact), 4):
        scale = max(abs(x) for x in exact[start : start + 4])
        pairs = zip(found[start : start + 4], exact[start : start + 4], strict=True)
        assert max(abs(x - y) for x, y in pairs) <= scale * EXACT.mpf(10) ** -49


def test_the_precision_grows_until_the_error_is_small() -> None:
    # The eigenvalues are 1 and -1, but the entries have 12 digits: the series cancels.
    a = [arb(x) for x in (10**12, 1 - 10**24, 1, -(10**12))]
    with pytest.raises(OverflowError, match=r"below 2\^40"):
        exponential(2, 0, 200, [*a])
    a = [arb(x) for x in (10**6, 1 - 10**12, 1, -(10**6))]
    before = ctx.prec
    result = exponential(2, 0, 200, a)
    assert ctx.prec == before
    # exp(A) = cosh(1) + sinh(1) A, because A^2 is the unit matrix.
    with mpmath.workdps(100):
        context = mpmath.mp.clone()
        sinh, cosh = mpmath.sinh(1), mpmath.cosh(1)
        numbers = [midpoint(x, context) for x in result]
        exact = [cosh + sinh * 10**6, sinh * (1 - 10**12), sinh, cosh - sinh * 10**6]
        assert max(abs(x - y) for x, y in zip(numbers, exact, strict=True)) < 1e12 * mpmath.mpf(2) ** -200


@pytest.mark.parametrize("x", ["inf", "-inf", "nan"])
def test_entries_that_are_not_finite_are_refused(x: str) -> None:
    for place in (0, 5):
        numbers = [D.context.mpf(x if k == place else 1) for k in range(8)]
        with pytest.raises(OverflowError, match="finite entries"):
            D.vector("expm2_d1", numbers)


def test_more_bits_than_the_limit_are_refused() -> None:
    with pytest.raises(OverflowError, match="is not accurate with"):
        exponential(1, 0, MOST_BITS, [arb(1)])


def test_numbers_are_converted_exactly() -> None:
    for text in ("0", "-0.375", "1e-300", "12345678901234567890.5"):
        x = D.context.mpf(text)
        assert midpoint(ball(x), D.context) == x
    assert mpmath.isnan(midpoint(arb("nan"), D.context))
