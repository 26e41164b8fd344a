"""Hamilton's equations and the Poisson bracket on T*G: the laws that they satisfy on the manifold."""

from __future__ import annotations

import pytest

from codegen.ir.expr import walk
from codegen.scene.canonical_equations import poisson_bracket, velocity
from codegen.scene.orbit import orbit_of
from tests.strategies import hamiltonian_scene, top_scene


def bracket(problem):
    qs, mus = (block.symbols for block in problem.state)
    return lambda F, H: poisson_bracket(problem.group, qs, mus, F, H)


@pytest.mark.parametrize("name", ["SO(3)", "R^3", "SE(2)", "S^3"])
class TestThePoissonBracket:
    def functions(self, name):
        problem = hamiltonian_scene(name)
        q, mu = problem.state
        space = problem.hamiltonian.space
        a, b, c = (space.sym(s) for s in (q.symbols[-1], mu.symbols[1], mu.symbols[-1]))
        return problem, problem.hamiltonian, a * b, c * c + a * a

    def test_is_antisymmetric(self, name):
        problem, F, G, _ = self.functions(name)
        of = bracket(problem)
        assert orbit_of(problem).vanish([of(F, G) + of(G, F), of(F, F)])
        assert not orbit_of(problem).vanish([of(F, G)])

    def test_satisfies_the_jacobi_identity(self, name):
        problem, F, G, K = self.functions(name)
        of = bracket(problem)
        total = of(F, of(G, K)) + of(G, of(K, F)) + of(K, of(F, G))
        assert orbit_of(problem).vanish([total])
        assert not orbit_of(problem).vanish([of(F, of(G, K))])


@pytest.mark.parametrize("name", ["SO(3)", "SE(2)"])
def test_the_velocity_is_that_of_the_scene(name):
    problem = hamiltonian_scene(name)
    qs, mus = (block.symbols for block in problem.state)
    rates = velocity(problem.group, qs, mus, problem.hamiltonian)
    orbit = orbit_of(problem)
    for point in orbit.points:
        pairs = zip(orbit.values(rates, point), orbit.velocity(point), strict=True)
        assert all(orbit.sized(x - y, (x, y)) for x, y in pairs)


def test_momenta_of_a_free_body_in_space_are_constant():
    problem = top_scene([[1, 0, 0], [0, 2, 0], [0, 0, 3]])
    T = problem.parts["T"]
    space = T.space
    of, orbit = bracket(problem), orbit_of(problem)
    for symbol in problem.state[1].symbols:
        assert orbit.vanish([of(space.sym(symbol), T)])
    assert any(n.op == "sym" and n.payload == "g00" for n in walk([of(space.sym("mu0"), T)]))
