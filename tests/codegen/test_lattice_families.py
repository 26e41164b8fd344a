"""Every family on a chain of four coupled bodies: its order, and the emitted step against the product.

The table contains every family of the compiler, and the tests fail if a family is missing. The order is that
of the unrolled program on the product of the groups of four sites. It is computed over Q[[h]]: the local
error begins with h^(p+1). So the order is at least p, and not p + 1. The emitted C module for any number of
sites then makes the steps of this program up to rounding errors, so it has the same order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
from sympy import Matrix, Symbol, symbols

from codegen import emit, load_lattice
from codegen.certify import certified_order
from codegen.errors import MethodError
from codegen.flows.recognise import recognise
from codegen.flows.site_flow import SiteFlow
from codegen.groups import LeftMultiplication, Product, Rn
from codegen.ir.domain import ExprDomain, FloatDomain, SeriesDomain
from codegen.ir.expr import evaluate
from codegen.ir.interpret import interpret
from codegen.ir.number import Number
from codegen.ir.program import Builder, Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.lab.orders.local_error import exact_flow, local_error
from codegen.lower import lower, lowering, method_for, names, problem_for
from codegen.lower.flow_words import FlowLowering, Reading
from codegen.lower.linear import LinearLowering
from codegen.lower.variational import VariationalLowering
from codegen.method import Method
from codegen.scene import SiteScene, left
from codegen.scene.problem import Problem, StateField
from codegen.scene.static_coordinates import reads_only_static
from codegen.scene.unrolled import neighbour_place, unrolled
from tests.codegen.chains import linear_group_chain
from tests.codegen.family_cases import LATTICE_CASES, LatticeCase
from tests.codegen.four_bodies import clamped_bodies, fast_springs, plane_states, pushed_spins, turning_bodies

NUMBER, TIME, STEP = 4, Fraction(1, 3), Fraction(1, 16)


def test_every_family_is_in_the_table():
    assert sorted(LATTICE_CASES) == sorted(names())
    assert all(case.method.startswith(family) for family, cases in LATTICE_CASES.items() for case in cases)


FIRST = [cases[0] for cases in LATTICE_CASES.values()]
BODIES = (turning_bodies, clamped_bodies)


def marked(quick: Callable[[LatticeCase], bool]) -> list[Any]:
    """Return all cases as parameters of a test; the cases that are not quick are slow."""
    listed = [case for cases in LATTICE_CASES.values() for case in cases]
    slow = pytest.mark.slow
    return [pytest.param(c, id=c.method, marks=() if quick(c) else slow) for c in listed]


def family_of(case: LatticeCase) -> str:
    return method_for(case.chain(), case.method).family


@cache
def field_of_sites(case: LatticeCase) -> Problem:
    """Return the system of four sites as a field on the product of their groups, with the states of the case
    as initial state at the time TIME."""
    whole = unrolled(case.chain(), (NUMBER,))
    space = whole.roots[0].space
    (block,) = whole.state
    numbers = [Number.rational(*x.as_integer_ratio()) for state in case.states() for x in state]
    start = replace(block, initial=tuple(map(space.const, numbers)))
    return replace(whole, state=(start,), span=(TIME, TIME + 1))


def phase_space(whole: Problem, chain: Problem) -> Problem:
    """Return a field on a product of groups T*G as Hamilton's equations on T*(G x ... x G). Its parts are the
    kinetic energy and the sum of all other energies."""
    (block,), group = whole.state, Product(*[chain.group] * NUMBER)
    places = by_kind(chain)
    q, mu = (
        StateField(own.name, own.kind, *(tuple(x[k] for k in ks) for x in (block.symbols, block.initial)))
        for own, ks in zip(chain.state, places, strict=True)
    )
    dim = chain.group.dim
    rows = [
        whole.roots[2 * dim * i + k * dim + j] for k in range(2) for i in range(NUMBER) for j in range(dim)
    ]
    joined = {"group": group, "action": LeftMultiplication(), "state": (q, mu), "roots": tuple(rows)}
    H = whole.hamiltonian
    assert H is not None
    domain = ExprDomain(H.space)
    sites = [f"_s{i}" for i in range(NUMBER)]
    parts = {}
    for name, root in chain.parts.items():
        values = [{s: H.space.sym(s + site) for s in chain.symbols} for site in sites]
        parts[name] = (
            sum(evaluate([root], domain, x)[0] for x in values[1:]) + evaluate([root], domain, values[0])[0]
        )
    return replace(whole, **joined, paired=True, parts=parts)


def by_kind(chain: Problem) -> list[list[int]]:
    """Return the places of q of all sites, and those of mu, among the coordinates of all sites."""
    size, first = len(chain.symbols), len(chain.state[0].symbols)
    return [
        [size * i + k for i in range(NUMBER) for k in range(size) if (k < first) == (own == 0)]
        for own in (0, 1)
    ]


def unrolled_program(case: LatticeCase, method: Method) -> tuple[Program, Problem]:
    """Return the program of a step on the product, and the problem that defines its operations. For a family
    of Hamiltonian scenes the state is (q, mu), with q of all sites."""
    whole, own = field_of_sites(case), lowering(method.family)
    if own.hamiltonian:
        whole = phase_space(whole, case.chain())
    if isinstance(own, FlowLowering):
        return flows_of_the_product(case, method, whole)
    return lower(whole, method), problem_for(whole, method)


def flows_of_the_product(case: LatticeCase, method: Method, whole: Problem) -> tuple[Program, Problem]:
    """Return the flows of a step on the lattice, in the same order and with the same durations, as flows of
    the energies of all sites."""
    kinetic, H = whole.parts["kinetic"], whole.hamiltonian
    assert H is not None
    energies = {"kinetic": kinetic, "potential": H - kinetic}
    flows = {part.name: part.summands[0].flows[0][1] for part in recognise(replace(whole, parts=energies))}
    q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
    inputs, build = (q, mu), Builder({"q", "mu", "t", "h"})
    for summand, duration in reading_of(case, method).word:
        ((name, _),) = summand.flows
        q, mu = build.flow(name, q, mu, Coefficient(duration, 1))
    program = verify(Program(case.method, inputs, build.take(), (("q", q), ("mu", mu))))
    return program, replace(whole, flows=flows)


def reading_of(case: LatticeCase, method: Method) -> Reading:
    """Return the flows of a step on the lattice with their durations."""
    own = lowering(method.family)
    assert isinstance(own, FlowLowering)
    return own.read(case.chain(), method)


def site_by_site(case: LatticeCase) -> bool:
    """Return True if the flows of a method have no formulas on the product, as flows of pairs and of tops,
    or if they depend on time."""
    composed, chain = isinstance(lowering(family_of(case)), FlowLowering), case.chain()
    return composed and not (chain.paired and chain.group.abelian and chain.autonomous)


def composed_flows(case: LatticeCase, method: Method, domain: Any) -> list[Any]:
    """Return the states after one step of a composition of flows, each applied to one site after another."""
    start, chain = field_of_sites(case).initial(domain), case.chain()
    size = len(chain.symbols)
    states = [tuple(start[size * i : size * i + size]) for i in range(NUMBER)]
    reading = reading_of(case, method)
    t = domain.rational(*TIME.as_integer_ratio())
    for summand, duration in reading.word:
        tau = domain.number(duration) * domain.h
        for _, flow in summand.flows:
            states = (
                moved_pairs(chain, domain, flow, tau, states)
                if isinstance(flow, SiteFlow)
                else [moved_site(chain, domain, flow, (tau, t), states, i) for i in range(NUMBER)]
            )
        t = t + tau if summand is reading.carrier else t
    return [x for state in states for x in state]


def moved_pairs(chain: Problem, d: Any, flow: SiteFlow, tau: Any, states: list[Any]) -> list[Any]:
    """Return the states after the flow of a part of a field: of single sites, or of pairs of one colour."""
    part, dim, new = chain.sites.parts[flow.part], chain.group.dim, list(states)
    last = NUMBER if chain.sites.periodic or not part.symbols else NUMBER - 1
    for i in range(flow.colour, last, 2 if part.symbols else 1):
        places = (i, (i + 1) % NUMBER) if part.symbols else (i,)
        values = chain.values(d, states[i]) | dict(zip(part.symbols, states[places[-1]], strict=False))
        roots = evaluate(list(part.roots), d, values)
        for k, place in enumerate(places):
            x = tuple(tau * r for r in roots[k * dim : k * dim + dim])
            new[place] = chain.action.actexp(d, chain.group, x, states[place])
    return new


def moved_site(chain: Problem, d: Any, flow: Any, times: Any, states: list[Any], i: int) -> Any:
    """Return the state of a site of a Hamiltonian chain after a flow, which may read its neighbours.
    ``times`` are the duration of the flow and the time, which is constant during the flow."""
    tau, t = times
    values, size = chain.values(d, states[i], t), len(chain.state[0].symbols)
    for k, offset in enumerate(chain.sites.offsets):
        there = neighbour_place(chain.sites, (i,), offset, (NUMBER,))
        near = evaluate(list(chain.sites.outside[k]), d, values) if there is None else states[there]
        values |= dict(zip(chain.sites.symbols[k], near, strict=True))
    q, mu = flow.advance(d, chain.group, values, tau, states[i][:size], states[i][size:])
    return (*q, *mu)


def step_of_the_product(case: LatticeCase, h: float) -> np.ndarray[Any, Any]:
    """Return the states after one step of the unrolled program."""
    method, domain = method_for(case.chain(), case.method), FloatDomain(h)
    if site_by_site(case):
        return np.reshape(composed_flows(case, method, domain), (NUMBER, -1))
    program, problem = unrolled_program(case, method)
    inputs: dict[str, Any] = {"t": float(TIME)}
    start, first = problem.initial(domain), 0
    for block in problem.state:
        inputs[block.name] = tuple(start[first : first + len(block.symbols)])
        first += len(block.symbols)
    end = interpret(program, problem, domain, inputs)
    values = [x for block in problem.state for x in end[block.name]]
    if len(problem.state) == 2:
        places = [k for ks in by_kind(case.chain()) for k in ks]
        values = [x for _, x in sorted(zip(places, values, strict=True))]
    return np.reshape(values, (NUMBER, -1))


def error_of_the_product(case: LatticeCase, method: Method, degree: int) -> Any:
    """Return the local error of the unrolled program as power series in h up to h^degree."""
    if not site_by_site(case):
        return local_error(*unrolled_program(case, method), method.ring, degree)
    end = composed_flows(case, method, SeriesDomain(method.ring, degree))
    exact = exact_flow(field_of_sites(case), method.ring, degree)
    return [x - y for x, y in zip(end, exact, strict=True)]


def first_power(error: Any, ring: Any) -> int | None:
    """Return the first power of h whose coefficient is not zero. For a tableau of rounded decimals, the
    coefficients are balls, and a ball that contains zero counts as zero."""
    for power in range(len(error[0].coefficients)):
        if any(ring.is_zero(x.coefficients[power]) is False for x in error):
            return power
    return None


@pytest.mark.parametrize("case", marked(lambda case: case in FIRST))
def test_the_order_on_four_sites_is_exact(case):
    method = method_for(case.chain(), case.method)
    error = error_of_the_product(case, method, case.order + 1)
    assert first_power(error, method.ring) == case.order + 1
    assert certified_order(method, case.chain()).order == case.order


@pytest.mark.parametrize("case", marked(lambda case: case in FIRST and case.chain not in BODIES))
def test_the_emitted_step_of_four_sites_is_that_of_the_product(case):
    lattice = load_lattice(emit(case.chain(), case.method, target="c"))
    start = np.array([[float(x) for x in state] for state in case.states()])
    result = lattice.run(start, float(STEP), 1, t=float(TIME))
    expected = step_of_the_product(case, float(STEP))
    assert result.ok
    assert np.abs(result.states - expected).max() < 2e-14 * np.abs(expected).max()
    # The step depends on the neighbours: it changes at the sites 2 and 3 if the sites 0 and 1 are exchanged.
    other = lattice.run(start[[1, 0, 2, 3]], float(STEP), 1, t=float(TIME)).states
    assert np.abs(other[2:] - expected[2:]).max() > 1e-9


def test_a_nystroem_splitting_has_a_lower_order_if_the_kinetic_energy_is_not_quadratic():
    # Its conditions contain [V, [V, [V, T]]] = 0, which does not hold for T = p^2/2 + p^4/4.
    case = LatticeCase("splitting:mclachlan_atela4", 3, fast_springs, plane_states)
    method = method_for(fast_springs(), case.method)
    assert certified_order(method, fast_springs()).order == 3
    error = error_of_the_product(case, method, 4)
    assert first_power(error, method.ring) == 4


LINEAR = [family for family in LATTICE_CASES if isinstance(lowering(family), LinearLowering)]


def static_coordinates(**options):
    """Return a chain of numbers x with static numbers w; the field of x reads a neighbour."""
    y = Matrix(symbols("x w", real=True))
    given = {"group": Rn(2), "action": LeftMultiplication(), "y": y, "f": [left(y)[1], 0], "y0": [0, 1]}
    return SiteScene(**(given | {"span": (0, 1), "name": "static"} | options))


@pytest.mark.parametrize("family", LINEAR)
@pytest.mark.parametrize(
    "scene",
    [
        # The field of a site reads neighbours only, but these move. The values of the field at the nodes are
        # then not known at the beginning of a step, and the method would have order one.
        linear_group_chain,
        lambda: static_coordinates(f=[left(symbols("x w", real=True))[0], 0]),
        lambda: static_coordinates(boundary="open", outside=[0, Symbol("x", real=True)]),
        turning_bodies,
    ],
)
def test_methods_for_linear_equations_refuse_coupled_states_that_move(family, scene):
    with pytest.raises(MethodError, match="field of the lattice depends on coordinates that change in time"):
        emit(scene(), LATTICE_CASES[family][0].method, target="c")


@pytest.mark.parametrize("outside", [None, [0, 1], [0, Symbol("t")], [0, Symbol("w", real=True) / 2]])
def test_the_field_of_a_linear_chain_may_read_static_coordinates_of_neighbours(outside):
    options = {} if outside is None else {"boundary": "open", "outside": outside}
    assert reads_only_static(static_coordinates(**options))
    assert reads_only_static(unrolled(static_coordinates(**options), (3,)))


@pytest.mark.parametrize(
    "family", [f for f in LATTICE_CASES if issubclass(type(lowering(f)), VariationalLowering)]
)
def test_variational_methods_need_a_hamiltonian(family):
    # The discrete action contains momenta, and a vector field on a manifold has none.
    with pytest.raises(MethodError, match="expected a Hamiltonian scene"):
        emit(pushed_spins(), LATTICE_CASES[family][0].method, target="c")
