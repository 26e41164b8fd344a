"""Discrete gradient methods on groups. The methods preserve the energy exactly.

The source is section 2.6 of H. Marthinsen's thesis *On symplectic integration in Lie groups and manifolds*. A
step of size h from x0 to x1 is x1 = exp(eta).x0 with eta = h xi. The unknown is the element xi of the Lie
algebra.

The differential gamma(x) of the energy H is an element of the dual of the Lie algebra. For each element e of
the Lie algebra, <gamma(x), e> is the derivative of H(exp(s e).x) with respect to s at s = 0. The quadrature
with the nodes c_i and the weights b_i of the tableau approximates the mean of gamma over the step:

    g = sum_i b_i gamma(exp(c_i eta).x0).

A discrete differential is an element D of the dual with <D, eta> = H(x1) - H(x0). The method uses

    D = g + (H(x1) - H(x0) - <g, eta>)/|eta|^2 eta.

The last factor eta denotes the element of the dual that has the coordinates of eta. The number |eta| is the
Euclidean norm of the coordinates of eta. With the single node 1/2, g is the value of gamma at the midpoint,
and D is given by equation (2.31) of the thesis.

The step solves the equation xi = omega(D, .). Here omega is the bivector of the scene at the midpoint
exp(eta/2).x0 (:mod:`codegen.scene.energy`). Since omega is skew, <D, xi> = 0, so H(x1) = H(x0). The order is
two if sum_i b_i c_i = 1/2, otherwise one.

On a lattice, H is the total energy. The pairing <g, eta> and |eta|^2 are sums over all sites
(:mod:`codegen.kernel.site_sums`).
"""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.ir.number import Number
from codegen.ir.program import Program
from codegen.ir.scene_operations import Bivector, Differential, Energy, Secant
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.base import Objection
from codegen.lower.field import FieldLowering
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.energy import ENERGY, bivector, differential, energy_of
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem
from codegen.scene.unrolled import small

HALF = Number.rational(1, 2)


class DiscreteGradient(FieldLowering):
    """Discrete gradient methods."""

    family = "discrete_gradient"

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene, or None if the family accepts it.

        The family accepts a scene if the scene has an energy and does not depend on time.
        """
        expected = f"a Hamiltonian that does not depend on time, or a field with an invariant called {ENERGY}"
        if scene.sites is not None and not scene.sites.force:
            expected = 'the arguments "energy" and "bonds" in a lattice scene that does not depend on time'
        # If H depends on time, the exact solution does not preserve H.
        if not scene.autonomous:
            return Objection(", which depends on time", expected)
        return Objection(", which has no energy", expected) if energy_of(scene) is None else None

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a step.

        :class:`codegen.errors.MethodError` is raised if the differential of the energy is zero at a point
        where the field is not zero. The error is also raised if the force at an open boundary is not
        conservative.
        """
        # On a lattice, the energy of a single site is not conserved. Therefore ``_agrees`` tests a whole
        # lattice. A small lattice is enough, because the equations are the same at all sites.
        if not _agrees(problem if problem.sites is None else small(problem)):
            if problem.sites is not None and problem.sites.outside:
                raise MethodError(
                    f"{method.label} cannot be used on {problem.name}: the force at the open "
                    "boundary is not the derivative of an energy",
                    expected="an open boundary without force, or constant states for the missing neighbours "
                    '(the argument "outside" of the scene)',
                )
            raise MethodError(
                f"{method.label} cannot be used on {problem.name}: the differential of the energy is zero at "
                "a point where the field f is not zero",
                expected="an energy whose differential is zero only at points where f is zero",
            )
        return _program(problem, method)

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return False, because discrete gradient methods do not preserve the symplectic form."""
        return False


def _program(scene: Problem, method: Method) -> Program:
    tableau = method.runge_kutta()
    y = Var("y", Kind.POINT)
    stages = Stages(scene, method, (y,))
    build = stages.builder
    xi = build.fresh("xi", Kind.ALG)
    shared: dict[str, Var] = {}

    # ``moved`` returns the point exp(part * h * velocity).y.
    def moved(name: str, part: Number, velocity: Var) -> Var:
        x = build.lin(f"x{name}", Kind.ALG, [(stages.times_h(part), velocity)])
        return build.act(f"Y{name}", build.exp(f"g{name}", x), y)

    def images() -> list[Var]:
        slopes = [
            # The sum g of these terms approximates a mean over the step, not an integral over the step.
            # Therefore the weights are b_i and not h b_i.
            (Coefficient(stages.number(b)), build.add(Differential(), f"d{i + 1}", moved(f"{i + 1}", c, xi)))
            for i, (b, c) in enumerate(zip(tableau.b, map(stages.number, tableau.c), strict=True))
        ]
        # The bivector is evaluated at the midpoint of the step. With the bivector at the initial point y, the
        # method would only have order 1.
        middle, end = moved("m", HALF, xi), moved("", ONE.value, xi)
        # H(x1) depends on the unknown xi, so the energies are part of the equation for xi.
        energies = [build.add(Energy(), f"H{k}", point) for k, point in enumerate((y, end))]
        # ``Secant`` needs the displacement eta = h xi of a full step.
        eta = build.lin("eta", Kind.ALG, [(stages.times_h(ONE.value), xi)])
        # If eta = 0, the formula for D in the module docstring contains 0/0. Secant then returns D = g.
        D = build.add(Secant(), "D", build.lin("g", Kind.DUAL, slopes), eta, *energies)
        # The bivector omega is skew, so the vector f = omega(D, .) satisfies <D, f> = 0.
        shared["f"] = build.add(Bivector(), "f", middle, D)
        return [shared["f"]]

    def update() -> dict[str, Var]:
        # An iteration solves the equation xi = f(xi) only approximately. The error of f(xi) is O(h) times the
        # error of xi. For this reason, the update uses f(xi), which is ``shared["f"]``, in place of xi.
        return {"y": moved("1", ONE.value, shared["f"])}

    # The exact xi differs from f(y0) by O(h), so f(y0) is the initial guess.
    return stages.program([xi], images, lambda: [stages.f("k0", y, None)], update)


def _agrees(scene: Problem) -> bool:
    """Return True if the bivector maps the differential of the energy to the field at sample points."""
    # The sample points are on the orbit of the initial state. The solution stays on this orbit.
    orbit = orbit_of(scene)
    for point in orbit.points:
        y = tuple(point[s] for s in orbit.symbols)
        gamma = differential(scene, orbit.domain, y)
        image = bivector(scene, orbit.domain, y, gamma)
        f = scene.apply(orbit.domain, "field", None, (y,))[0]
        # The bivector maps zero to zero. Therefore the field must be zero where ``gamma`` is zero.
        if not all(orbit.sized(a - b, (a, b)) for a, b in zip(image, f, strict=True)):
            return False
    return True
