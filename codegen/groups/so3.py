"""The group SO(3) of rotation matrices. The algebra so(3) and the dual of so(3) are identified with R^3."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from codegen.groups.ad_polynomial import ad_polynomial
from codegen.groups.capabilities import (
    BodyFrame,
    CayleyMap,
    ClosedFormSeries,
    Covered,
    DependentCoordinates,
    Projection,
    RightTrivialisation,
    Rotations,
    Term,
)
from codegen.groups.linear_algebra import S, Vector, cross, dot, matmul, matvec
from codegen.groups.s3 import S3
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation
from codegen.ir.number import Number
from codegen.ir.summation import corrected


class SO3(
    Rotations,
    BodyFrame,
    Covered,
    ClosedFormSeries,
    RightTrivialisation,
    Projection,
    DependentCoordinates,
    CayleyMap,
):
    """Rotation matrices of R^3, stored row by row.

    The hat map and the dot product identify so(3) and so(3)* with R^3. In the formulas below
    c_k is the value of the Stumpff function with the index k at x.x.

    - The bracket is [x, y] = x cross y, and ad*_x mu = -x cross mu.
    - The adjoint action is Ad_g x = g x, and Ad*_g mu = g^T mu.
    - The exponential is exp(x) = 1 + c_1 hat(x) + c_2 hat(x)^2 (Rodrigues).
    - The differential of the exponential is dexp_x = 1 + c_2 ad_x + c_3 ad_x^2, and dexp*_x = dexp_{-x}.

    If ``dependent`` is a column index k, :meth:`expmul` rotates only the other two columns of g. Column k of
    the result is the cross product of the two rotated columns.
    """

    name = "SO(3)"
    layout = ", row by row"
    dim, size = 3, 9
    covering_formula = (
        "the rotation matrix g of the quaternion q (real part first): (0, g x) = q (0, x) q^c / |q|^2, where "
        "q^c is the conjugate of q"
    )

    def __init__(self, dependent: int | None = None) -> None:
        self.dependent = dependent

    def variants(self) -> Sequence[SO3]:
        """Return this object, followed by SO3(k) for the columns k = 0, 1, 2 (see :class:`SO3`)."""
        return (self, *(SO3(column) for column in range(3)))

    def identity(self, d: Domain) -> Vector[S]:
        """Return the unit matrix."""
        one, zero = d.rational(1), d.rational(0)
        return tuple(one if i == j else zero for i in range(3) for j in range(3))

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the matrix product g k."""
        return matmul(g, k, 3)

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the rotation about x by the angle |x|."""
        z = dot(x, x)
        c1, c2 = d.call("stumpff1", z), d.call("stumpff2", z)
        a, b, c = (c1 * t for t in x)
        p, q, r = (c2 * t for t in x)
        xy, xz, yz = p * x[1], p * x[2], q * x[2]
        xx, yy, zz = p * x[0], q * x[1], r * x[2]
        one = d.rational(1)
        return (
            *(one - (yy + zz), xy - c, xz + b),
            *(xy + c, one - (xx + zz), yz - a),
            *(xz - b, yz + a, one - (xx + yy)),
        )

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return 1 + (hat(x) + hat(x)^2/2)/(1 + x.x/4): the rotation about x by the angle 2 atan(|x|/2)."""
        quarter = d.rational(1, 4) * dot(x, x)
        one = d.rational(1)
        c1 = one / (one + quarter)
        c2 = d.rational(1, 2) * c1
        a, b, c = (c1 * t for t in x)
        p, q, r = (c2 * t for t in x)
        xy, xz, yz = p * x[1], p * x[2], q * x[2]
        xx, yy, zz = p * x[0], q * x[1], r * x[2]
        return (
            *(one - (yy + zz), xy - c, xz + b),
            *(xy + c, one - (xx + zz), yz - a),
            *(xz - b, yz + a, one - (xx + yy)),
        )

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y = y - (x cross y)/2 + (x.y) x/4."""
        half, factor = d.rational(1, 2), d.rational(1, 4) * dot(x, y)
        return tuple(b - half * c + factor * a for a, b, c in zip(x, y, cross(x, y), strict=True))

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return -(x.y) x, the vector that represents the matrix product hat(x) hat(y) hat(x)."""
        factor = -dot(x, y)
        return tuple(factor * a for a in x)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the transpose of g."""
        return tuple(g[3 * j + i] for i in range(3) for j in range(3))

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x cross y."""
        return cross(x, y)

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return -x cross mu."""
        return cross(mu, x)

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g x."""
        return matvec(g, x)

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return g^T mu."""
        return tuple(dot(g[j::3], mu) for j in range(3))

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return g mu."""
        return matvec(g, mu)

    def Adinv(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g^T x."""
        return self.Adt(d, g, x)

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu = dexp_{-x} mu.

        The formula is mu - c_2 (x cross mu) + c_3 (x cross (x cross mu)). Here c_2 and c_3 are the values of
        the Stumpff functions with the indices 2 and 3 at x.x.
        """
        z = dot(x, x)
        c2, c3 = d.call("stumpff2", z), d.call("stumpff3", z)
        v = cross(x, mu)
        w = cross(x, v)
        return tuple(m - c2 * p + c3 * q for m, p, q in zip(mu, v, w, strict=True))

    def series(self, d: Domain, word: Sequence[Factor], dual: bool, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return W(ad_x) v, where W(t) is the product of the factors in ``word``. If ``dual`` is true,
        ad*_x = -ad_x replaces ad_x.
        """
        b, c = ad_polynomial(d, word, dot(x, x))
        first = cross(x, v)
        second = cross(x, first)
        return tuple(
            p - b * q + c * r if dual else p + b * q + c * r for p, q, r in zip(v, first, second, strict=True)
        )

    def series_sum(
        self,
        d: Domain,
        terms: Sequence[Term[S]],
        dual: bool,
        x: Vector[S],
        total: Callable[[tuple[int, ...]], Vector[S]] | None = None,
    ) -> Vector[S]:
        """Return the sum of f W(ad_x) v over the triples (f, W, v) in ``terms``.

        Here f is a scalar, W is a product of functions of ad_x, and v is a vector. If ``dual`` is true,
        ad*_x = -ad_x replaces ad_x.

        The argument ``total`` is described in :meth:`ClosedFormSeries.series_sum`.
        """

        def added(numbers: tuple[int, ...]) -> Vector[S]:
            if total is not None:
                return total(numbers)
            owns = [tuple(f * a for a in v) for f, _, v in (terms[k] for k in numbers)]
            return tuple(sum(parts[1:], start=parts[0]) for parts in zip(*owns, strict=True))

        # Vectors with equal coefficients are added first, which saves multiplications.
        z = dot(x, x)
        groups: tuple[dict[S, tuple[int, ...]], dict[S, tuple[int, ...]]] = ({}, {})
        for k, (_, word, _) in enumerate(terms):
            b, c = ad_polynomial(d, word, z)
            for group, factor in zip(groups, (-b if dual else b, c), strict=True):
                group[factor] = (*group.get(factor, ()), k)
        inner: Vector[S] = (d.rational(0),) * 3
        for b, numbers in groups[0].items():
            inner = tuple(p + b * a for p, a in zip(inner, added(numbers), strict=True))
        for c, numbers in groups[1].items():
            inner = tuple(p + c * a for p, a in zip(inner, cross(x, added(numbers)), strict=True))
        plain = added(tuple(range(len(terms))))
        return tuple(p + q for p, q in zip(plain, cross(x, inner), strict=True))

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return hat(x) g: the cross product of x with every column of g."""
        columns = [cross(x, g[j::3]) for j in range(3)]
        return tuple(columns[j][i] for i in range(3) for j in range(3))

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x such that v = hat(x) g. The skew matrix hat(x) = v g^T contains the components of x."""
        return tuple(dot(v[3 * i : 3 * i + 3], g[3 * j : 3 * j + 3]) for i, j in ((2, 1), (0, 2), (1, 0)))

    def mulexp(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g exp(x)."""
        back = tuple(-a for a in x)
        return tuple(a for i in (0, 3, 6) for a in self.rotate(d, back, g[i : i + 3]))

    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g hat(x), the derivative of g exp(eps x) at eps = 0.

        The rows of the result are r cross x for the rows r of g.
        """
        return tuple(a for i in (0, 3, 6) for a in cross(g[i : i + 3], x))

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return the equations g^T g = 1 as replacement rules for products of entries of the first row.

        For j <= k, a rule replaces g_0j g_0k by delta_jk - g_1j g_1k - g_2j g_2k. Here delta_jk is 1 if
        j = k, and 0 if j < k. The names of the entries g_ij are in ``q``, row by row.
        """
        one, minus = Number.rational(1), Number.rational(-1)
        relations: list[Relation] = []
        for j in range(3):
            for k in range(j, 3):
                rest = [(minus, (q[3 * i + j], q[3 * i + k])) for i in (1, 2)]
                relations.append(((q[j], q[k]), [*([(one, ())] if j == k else []), *rest]))
        return tuple(relations)

    def rotate(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y.

        The formula is y + c_1 (x cross y) + c_2 (x cross (x cross y)). The numbers c_1 and c_2 are the values
        of the Stumpff functions at x.x.
        """
        z = dot(x, x)
        c1, c2 = d.call("stumpff1", z), d.call("stumpff2", z)
        v = cross(x, y)
        w = cross(x, v)
        # For short steps, v and w are small.
        return tuple(corrected(d, a, (c1, b), (c2, c)) for a, b, c in zip(y, v, w, strict=True))

    def expmul(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return exp(x) g."""
        if self.dependent is None:
            return self.mul(d, self.exp(d, x), g)
        j, k = (self.dependent + 1) % 3, (self.dependent + 2) % 3
        columns = {i: self.rotate(d, x, g[i::3]) for i in sorted((j, k))}
        columns[self.dependent] = cross(columns[j], columns[k])
        return tuple(columns[i % 3][i // 3] for i in range(9))

    def transport(self, d: Domain, x: Vector[S], n: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return exp(x) mu + dexp_x n."""
        if self.dependent is None:
            return super().transport(d, x, n, mu)
        z = dot(x, x)
        c1, c2, c3 = (d.call(f"stumpff{k}", z) for k in (1, 2, 3))
        v, w = cross(x, mu), cross(x, n)
        p, q = cross(x, v), cross(x, w)
        return tuple((mu[i] + n[i]) + ((c1 * v[i] + c2 * (p[i] + w[i])) + c3 * q[i]) for i in range(3))

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return pairs (name, residual) for the equations g^T g = 1 and det g = 1."""
        columns, (one, zero) = [g[j::3] for j in range(3)], (d.rational(1), d.rational(0))
        pairs = [(i, j) for i in range(3) for j in range(i, 3)]
        gram = [dot(columns[i], columns[j]) - (one if i == j else zero) for i, j in pairs]
        determinant = dot(columns[0], cross(columns[1], columns[2])) - one
        return (*(("g^T g = 1", x) for x in gram), ("det g = 1", determinant))

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return g (3 - g^T g)/2: one Newton-Schulz step towards the orthogonal polar factor of g."""
        transposed = tuple(g[3 * i + j] for j in range(3) for i in range(3))
        half, three = d.rational(1, 2), d.rational(3)
        gram = matmul(transposed, g, 3)
        defect: Vector[S] = tuple(half * ((three - x) if i % 4 == 0 else -x) for i, x in enumerate(gram))
        return matmul(g, defect, 3)

    def determined(self) -> tuple[tuple[int, ...], ...]:
        """Return six tuples of indices: one tuple for each row of the matrix, then one for each column.

        Each tuple contains the indices of the three matrix entries in the row or column.

        If the entries of one row are unknown, the cross product of the other two rows gives these entries.
        The same is true for columns.
        """
        rows = tuple((3 * i, 3 * i + 1, 3 * i + 2) for i in range(3))
        return (*rows, *((j, 3 + j, 6 + j) for j in range(3)))

    def complete(self, d: Domain, g: Vector[S], missing: tuple[int, ...]) -> Vector[S]:
        """Compute a missing row or column of g, and return the complete matrix.

        ``missing`` contains the indices of the missing entries. A row (column) is the cross product of the
        next two rows (columns) in cyclic order.
        """
        sets = self.determined()
        place = sets.index(missing)
        first = place - place % 3
        others = (sets[first + (place + k) % 3] for k in (1, 2))
        a, b = (tuple(g[i] for i in indices) for indices in others)
        values = dict(zip(missing, cross(a, b), strict=True))
        return tuple(values.get(i, x) for i, x in enumerate(g))

    def hat(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the skew matrix of x, row by row."""
        zero = d.rational(0)
        return (zero, -x[2], x[1], x[2], zero, -x[0], -x[1], x[0], zero)

    def vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the vector x whose skew matrix hat(x) is ``matrix``."""
        return (matrix[7], matrix[2], matrix[3])

    @property
    def cover(self) -> S3:
        """The group S^3 of unit quaternions."""
        return S3()

    def covering(self, d: Domain, q: Vector[S]) -> Vector[S]:
        """Return the rotation matrix of a unit quaternion q.

        The matrix maps a vector x to the imaginary part of q (0, x) q^c. Here q^c is the conjugate of q.
        """
        one, double = d.rational(1), tuple(d.rational(2) * a for a in q[1:])
        squares = tuple(a * b for a, b in zip(double, q[1:], strict=True))
        diagonal = (one - (squares[1] + squares[2]), one - (squares[0] + squares[2]))
        return self._covering((*diagonal, one - (squares[0] + squares[1])), q, double)

    def projected_covering(self, d: Domain, q: Vector[S]) -> Vector[S]:
        """Return the rotation matrix of the unit quaternion q/|q|. The quaternion q must not be zero."""
        (w, x, y, z), length = (a * a for a in q), dot(q, q)
        diagonal = ((w + x) - (y + z), (w + y) - (x + z), (w + z) - (x + y))
        return tuple(a / length for a in self._covering(diagonal, q, tuple(d.rational(2) * a for a in q[1:])))

    def _covering(self, diagonal: Vector[S], q: Vector[S], double: Vector[S]) -> Vector[S]:
        """Return |q|^2 times the rotation matrix of q/|q|. ``diagonal`` is the diagonal of the result, and
        ``double`` is twice the imaginary part of q.
        """
        (w, x, y, _), (a, b, c) = q, double
        xy, xz, yz, wx, wy, wz = x * b, x * c, y * c, w * a, w * b, w * c
        return (diagonal[0], xy - wz, xz + wy, xy + wz, diagonal[1], yz - wx, xz - wy, yz + wx, diagonal[2])

    def lifted_velocity(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return x/2. The matrix exp(x) is the rotation matrix of the unit quaternion exp(x/2)."""
        return tuple(d.rational(1, 2) * a for a in x)

    def pivots(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return 4 w^2, 4 x^2, 4 y^2, 4 z^2 for a unit quaternion (w, x, y, z) with the rotation matrix g."""
        one = d.rational(1)
        return (
            one + (g[0] + g[4] + g[8]),
            one + (g[0] - g[4] - g[8]),
            one + (g[4] - g[0] - g[8]),
            one + (g[8] - g[0] - g[4]),
        )

    def lift(self, d: Domain, g: Vector[S], formula: int) -> Vector[S]:
        """Return a unit quaternion whose rotation matrix is g.

        The component with the index ``formula`` is positive.
        """
        root: S = d.call("sqrt", self.pivots(d, g)[formula])
        half = d.rational(1, 2)
        wx, wy, wz = g[7] - g[5], g[2] - g[6], g[3] - g[1]
        xy, xz, yz = g[1] + g[3], g[2] + g[6], g[5] + g[7]
        products: tuple[Vector[S], ...] = ((wx, wy, wz), (wx, xy, xz), (wy, xy, yz), (wz, xz, yz))
        others = tuple(half * a / root for a in products[formula])
        return (*others[:formula], half * root, *others[formula:])
