"""The laws of a Lie group, verified at sample elements.

The scene of a user may contain a group of the user. The order of a method on this group is a theorem only if
the formulas of the group satisfy the laws of a Lie group: a bracket with the wrong sign, for example, lowers
the order of most methods. :func:`check_laws` compares both sides of each law in arithmetic with many digits.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import CotangentBundle, DirectProduct
from codegen.groups.capability_laws import laws_of_capabilities
from codegen.groups.law import DEXPINV_ORDER, EXACT, SLOPE, STEP, Law, Sample
from codegen.groups.linear_algebra import vector_sum
from codegen.groups.representations import Representation


def check_laws(group: LieGroup, where: str = "") -> None:
    """Raise :class:`SceneError` if a formula of ``group`` fails or violates a law of Lie groups.

    The error names the class that must be corrected. If a law is violated, the error also names the law and
    a method of the class that is probably wrong. ``where`` is the name of the scene. Classes of this package
    are not checked: the tests of this project check them.
    """
    # The laws of a direct product and of T*G follow from those of the factors and of G.
    if (product := group.offers(DirectProduct)) is not None:
        for factor in product.factors:
            check_laws(factor, where)
    elif (bundle := group.offers(CotangentBundle)) is not None:
        check_laws(bundle.base, where)
    elif not is_built_in(group):
        try:
            _check_all(Sample(group), where)
        except (ArithmeticError, ValueError, IndexError) as error:
            raise SceneError(
                f"a formula of the group {group.name} fails at a sample element: {error}",
                where=where,
                expected="formulas valid near the neutral element, and a formula for exp(x) valid at x = 0",
                hint=f"correct the class {type(group).__name__}",
            ) from error


def is_built_in(part: object) -> bool:
    """Return True if this package defines the classes of a group and of all its parts."""
    package = LieGroup.__module__.rpartition(".")[0]
    values = vars(part).values()
    entries = chain(values, *(x for x in values if isinstance(x, tuple)))
    parts = (x for x in entries if isinstance(x, LieGroup | Representation))
    return type(part).__module__.startswith(f"{package}.") and all(map(is_built_in, parts))


def _check_all(sample: Sample, where: str) -> None:
    for laws in (
        _sizes,
        _laws_of_products,
        _laws_of_the_algebra,
        _laws_of_shorter_formulas,
        laws_of_capabilities,
    ):
        for law in laws(sample):
            _check(sample, law, where)


def _check(sample: Sample, law: Law, where: str) -> None:
    group, context = sample.group, sample.d.context
    hint = f"correct the class {type(group).__name__}, for example its member {law.method}"
    what = f"the group {group.name} violates {law.text}"
    if len(law.left) != len(law.right):
        raise SceneError(
            f"{what}: {law.method} has {len(law.left)} components",
            where=where,
            expected=f"{len(law.right)} components",
            hint=hint,
        )
    scale = max((abs(a.value) for a in (*law.left, *law.right)), default=context.mpf(0))
    bound = (1 + scale) * context.mpf(10) ** -(SLOPE if law.slope else EXACT)
    for i, (a, b) in enumerate(zip(law.left, law.right, strict=True)):
        difference = a - b
        # A comparison with NaN is false, so that NaN counts as a difference.
        if not abs(difference.value) <= bound + sample.d.rounding(difference):
            left, right, gap = (context.nstr(c.value, 6) for c in (a, b, difference))
            raise SceneError(
                f"{what}: component {i} is {left} on the left side and {right} on the right side, "
                f"a difference of {gap}",
                where=where,
                expected="equal sides",
                hint=hint,
            )


def _sizes(s: Sample) -> Iterator[Law]:
    """Yield laws that compare the lengths of vectors and the sums of ``blocks`` with ``dim`` and ``size``."""
    group, d = s.group, s.d
    dims, sizes = zip(*group.blocks, strict=True)
    sums = tuple(d.rational(sum(column)) for column in (dims, sizes))
    stated = (d.rational(group.dim), d.rational(group.size))
    yield Law("blocks", "the sum of the blocks is (dim, size)", sums, stated)
    for method, values, text, n in (
        ("identity", s.e, "size is the number of coordinates of an element", group.size),
        ("exp", s.exp(s.x), "size is the number of coordinates of an element", group.size),
        ("ad", group.ad(d, s.x, s.y), "dim is the dimension of the algebra", group.dim),
    ):
        zero = d.rational(0)
        yield Law(method, text, s.times(0, values), (zero,) * n)


def _laws_of_products(s: Sample) -> Iterator[Law]:
    group, d, g, k = s.group, s.d, s.g, s.k
    yield Law("exp", "exp(0) = e", s.exp(s.x, 0), s.e)
    yield Law("mul", "e g = g", s.mul(s.e, g), g)
    yield Law("mul", "g e = g", s.mul(g, s.e), g)
    m = s.exp(s.z)
    yield Law("mul", "(g k) m = g (k m)", s.mul(g, k, m), s.mul(g, s.mul(k, m)))
    yield Law("exp", "exp(x) exp(2 x) = exp(3 x)", s.mul(s.exp(s.x), s.exp(s.x, 2)), s.exp(s.x, 3))
    yield Law("exp", "exp(x) exp(-x) = e", s.mul(s.exp(s.x), s.exp(s.x, -1)), s.e)
    moved = s.slope(lambda x: s.mul(s.exp(x), g), s.x)
    text = "velocity(x, g) = d/deps exp(eps x) g"
    yield Law("velocity", text, group.velocity(d, s.x, g), moved, slope=True)
    for text, residual in group.laws(d, g):
        # The law is residual = 0. Adding 1 to both sides does not change their difference.
        one = d.rational(1)
        yield Law("laws", text, (residual + one,), (one,))


def _laws_of_the_algebra(s: Sample) -> Iterator[Law]:
    group, d = s.group, s.d
    bracket = group.ad(d, s.x, s.y)
    if group.abelian:
        yield Law("ad", "[x, y] = 0, because abelian is true", bracket, s.times(0, bracket))
    eps = d.rational(1, 10**STEP)
    total = s.times(-2, s.e)
    for t in (eps, -eps):
        x, y = (tuple(t * a for a in v) for v in (s.x, s.y))
        total = vector_sum(total, s.mul(s.exp(x), s.exp(y), s.exp(x, -1), s.exp(y, -1)))
    quotient = tuple(a / (d.rational(2) * eps * eps) for a in total)
    text = "exp(h x) exp(h y) exp(-h x) exp(-h y) = exp(h^2 [x, y] + O(h^3))"
    yield Law("ad", text, group.velocity(d, bracket, s.e), quotient, slope=True)


def _laws_of_shorter_formulas(s: Sample) -> Iterator[Law]:
    """Yield a law for each formula that replaces a formula of :class:`LieGroup`."""
    group, d = s.group, s.d
    product = s.mul(s.exp(s.x), s.g)
    for variant in (group, *group.variants()):
        yield Law("expmul", "expmul(x, g) = exp(x) g", variant.expmul(d, s.x, s.g), product)
    t, zero = d.rational(2, 3), d.rational(0)
    for i in range(group.dim):
        x = tuple(t if i == j else zero for j in range(group.dim))
        yield Law("expbasis", "expbasis(k, t) = exp(t e_k)", group.expbasis(d, i, t), s.exp(x))
    if type(group).dexpinv is LieGroup.dexpinv:
        return
    for order in range(DEXPINV_ORDER + 1):
        yield Law(
            "dexpinv",
            f"dexpinv(x, y, {order}) = sum of B_k/k! ad_x^k y for k = 0, ..., {order}",
            group.dexpinv(d, s.x, s.y, order),
            LieGroup.dexpinv(group, d, s.x, s.y, order),
        )
