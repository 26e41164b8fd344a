"""What scenes say of themselves is checked: true statements pass, and a small error in any is seen."""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import Matrix, Rational, Symbol, diag, eye, sqrt, symbols

from codegen.errors import SceneError
from codegen.groups import SO3, LeftMultiplication, Rn, Rotation
from codegen.scene import FieldScene, HamiltonianScene, param
from codegen.scenes import GALLERY, load

y = Matrix(symbols("y0:3", real=True))
I = diag(1, 2, 5)  # noqa: E741 (the inertia tensor's name)
G = SO3()
g, mu = G.point("g"), G.dual("mu")
SMALL = Rational(1, 10**15)


def sphere(**changes):
    arguments = {"f": -I.inv() * y, "y0": [1, 2, 3], "span": (0, 1)}
    return FieldScene(group=SO3(), action=Rotation(), y=y, **(arguments | changes))


def top(**changes):
    w = g * I.inv() * g.T * mu
    arguments = {"H": mu.dot(w) / 2 + g[2, 1], "q0": eye(3), "mu0": [1, 2, 3], "span": (0, 1)}
    return HamiltonianScene(group=G, q=g, mu=mu, **(arguments | changes))


class TestInvariants:
    def test_of_the_rigid_body_are_accepted(self):
        sphere(invariants={"radius": sqrt(y.dot(y)), "energy": y.dot(I.inv() * y)})

    def test_that_change_by_a_part_in_a_thousand_million_million_are_not(self):
        energy = y.dot(I.inv() * y) + SMALL * y[0]
        with pytest.raises(SceneError, match=r"the invariant energy changes at the rate .*e-15"):
            sphere(invariants={"energy": energy})

    def test_that_hold_on_the_group_alone_are_accepted(self):
        top(invariants={"determinant": (g.T * g)[0, 1] + (g.T * g)[2, 2] * mu[2]})

    def test_may_depend_on_time(self):
        t = Symbol("t")
        FieldScene(
            group=Rn(1),
            action=LeftMultiplication(),
            y=Matrix(y[:1]),
            f=[1 + 2 * t],
            y0=[0],
            span=(0, 1),
            invariants={"offset": y[0] - t - t**2},
        )

    def test_may_hold_for_a_symmetric_top_only(self):
        body = {"momentum_about_body_axis": mu.dot(g * Matrix([0, 1, 0]))}
        with pytest.raises(SceneError, match="momentum_about_body_axis"):
            top(invariants=body)
        symmetric = diag(3, 1, 3)
        top(H=mu.dot(g * symmetric.inv() * g.T * mu) / 2 + g[2, 1], invariants=body)

    def test_the_energy_is_none_where_the_hamiltonian_depends_on_time(self):
        assert "energy" in top().invariants
        assert "energy" not in top(H=mu.dot(mu) + Symbol("t") * g[2, 1]).invariants


class TestHandWrittenFields:
    def test_that_are_right_pass(self):
        sphere(velocity=y.cross(I.inv() * y))
        w = g * I.inv() * g.T * mu
        top(xi=w, n=mu.cross(w) + (g * Matrix([0, 1, 0])).cross(Matrix([0, 0, -1])))

    def test_isotropy_leaves_the_velocity(self):
        sphere(f=-I.inv() * y + param("alpha", 3) * y, velocity=y.cross(I.inv() * y))

    @pytest.mark.parametrize("k", range(3))
    def test_with_a_small_error_in_a_component_are_refused(self, k):
        off = Matrix([SMALL * int(i == k) * y[(i + 1) % 3] for i in range(3)])
        with pytest.raises(SceneError, match=rf"velocity\[{k}\] is .*from f.y"):
            sphere(velocity=y.cross(I.inv() * y) + off)

    def test_a_momentum_equation_without_the_coadjoint_term_is_refused(self):
        torque = (g * Matrix([0, 1, 0])).cross(Matrix([0, 0, -1]))
        with pytest.raises(SceneError, match=r"n\[0\] is .*from the derivatives of H"):
            top(n=torque)

    def test_have_as_many_components_as_the_state(self):
        with pytest.raises(SceneError, match="velocity has 2 components; expected 3 components"):
            sphere(velocity=[1, 2])


class TestTheInitialState:
    def test_is_on_the_group(self):
        with pytest.raises(SceneError, match=r"violates g\^T g = 1 by"):
            top(q0=eye(3) + SMALL * diag(1, 0, 0))

    def test_of_an_algebraic_rotation_passes(self):
        c = sqrt(2) / 2
        top(q0=Matrix([[c, -c, 0], [c, c, 0], [0, 0, 1]]))

    def test_of_a_field_on_the_group_is_on_the_group(self):
        q = SO3().point("q")
        with pytest.raises(SceneError, match=r"violates det g = 1 by -2"):
            FieldScene(group=SO3(), action=LeftMultiplication(), y=q, f=[1, 2, 3], y0=-eye(3), span=(0, 1))


@pytest.mark.parametrize("name", GALLERY)
def test_every_scene_of_the_gallery_loads_with_a_smooth_start(name):
    scene = load(name)
    assert scene.span[0] == Fraction(0)
    assert scene.title
