"""Commutator-free methods for vector fields: products of exponentials without brackets.

A step of size h starts at the state y0. Let k_j be the value of the field at stage j. To compute the point of
a stage, exponentials are applied to y0 or to the point of an earlier stage. The exponents are linear
combinations h sum_j beta_j k_j, each with its own coefficients beta_j. The new state is computed like the
point of a stage.
"""

from __future__ import annotations

from functools import reduce
from itertools import accumulate
from operator import add

from codegen.ir.program import EMBEDDED, Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.lower.field import FieldLowering
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element
from orderconds.tableau import CommutatorFree, Stage
from orderconds.tableau.methods import Row
from orderconds.tableau.properties import low_storage
from orderconds.tableau.two_registers import TwoRegisters, second_exponent


class CommutatorFreeLowering(FieldLowering):
    """Commutator-free methods."""

    family = "cf"
    repeats_substeps = True

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program for one step of a commutator-free method."""
        embedded = method.embedded()
        registers = _registers(method)
        if registers is not None:
            return two_registers(problem, method, *registers)
        lower = None if embedded is None else embedded.commutator_free().update
        return products(problem, method, method.commutator_free(), lower)

    def storage(self, method: Method) -> str:
        """Return the values that a low-storage scheme stores, as a line for the header of the emitted file.

        If the method has no low-storage scheme, the result is ''.
        """
        registers = _registers(method)
        if registers is None:
            return ""
        return STORAGE if registers[1] is None else STORAGE_OF_PAIR


STORAGE = (
    "two registers (2N): the state Y and one element K of the Lie algebra; stage i computes K <- A_i K + "
    "f(Y), then Y <- exp(h B_i K).Y, where A_i and B_i are coefficients"
)


STORAGE_OF_PAIR = (
    "three registers: the state Y, and two elements K and E of the Lie algebra. Stage i evaluates F = f(Y) "
    "and updates, in this order, K <- A_i K + F, E <- E + D_i F and Y <- exp(h B_i K).Y. A_i, B_i and D_i "
    "are coefficients. After the last stage, Y is the new state, and exp(h E).Y is the embedded solution"
)


def _registers(method: Method) -> tuple[TwoRegisters, Row | None] | None:
    """Return a low-storage scheme for ``method``, and the coefficients D_i of its embedded method.

    If k_i is the value of the field at stage i, the embedded method applies exp(h sum_i D_i k_i) to the
    result of ``method``. The function returns None if ``method`` has no low-storage scheme, or if the
    embedded method does not have this form.
    """
    if not isinstance(method.tableau.method, CommutatorFree):
        return None
    embedded, exponent = method.embedded(), None
    if embedded is not None:
        second = embedded.commutator_free().update
        exponent = second_exponent(method.commutator_free(), second, method.ring)
        # If the embedded solution is exp(h sum_i D_i k_i).y1 with the new state y1, ``exponent`` contains the
        # coefficients D_i. If the embedded solution has another form, ``exponent`` is None.
        if exponent is None:
            return None
    # If ``holds`` is True, the scheme and the tableau define the same step.
    rewriting = low_storage(method.tableau)
    if rewriting is None or not rewriting.holds or rewriting.scheme is None:
        return None
    return rewriting.scheme, exponent


def two_registers(
    problem: Problem, method: Method, scheme: TwoRegisters, estimate: Row | None = None
) -> Program:
    """Return the program of a low-storage scheme: K_i = A_i K_{i-1} + k_i, Y_{i+1} = exp(h B_i K_i) Y_i.

    Here k_i is the value of the field at Y_i. ``estimate`` is the row (D_1, ..., D_s) of coefficients of the
    embedded method, or None if there is no embedded method. The embedded method applies exp(h E) to the new
    state, where E is the sum of the D_i k_i.
    """
    y = Var("y", Kind.POINT)
    stages = Stages(problem, method, (y,))
    build = stages.builder
    k = [build.fresh(f"k{i + 1}", Kind.ALG) for i in range(scheme.s)]
    one = Coefficient(stages.number(method.ring.one))
    state: list[Var] = [y]
    register: list[Var] = []
    sums: list[Var] = []

    def advance(i: int) -> None:
        """Append the operations that compute the next state from k[i], the value of the field at stage i."""
        terms = [(one, k[i])]
        # The first stage adds no multiple of an earlier sum, because ``register`` is still empty.
        if register:
            terms = [(Coefficient(stages.number(scheme.A[i])), register[-1]), *terms]
        register.append(build.lin(f"K{i + 1}", Kind.ALG, terms))
        if estimate is not None:
            terms = [(Coefficient(stages.number(estimate[i])), k[i])]
            # E_i = E_{i-1} + D_i k_i, but E_1 = D_1 k_1, because ``sums`` is empty at the first stage.
            sums.append(build.lin(f"E{i + 1}", Kind.ALG, [*((one, x) for x in sums[-1:]), *terms]))
        x = build.lin(f"x{i + 1}", Kind.ALG, [(stages.times_h(scheme.B[i]), register[-1])])
        state.append(build.act(f"Y{i + 2}", build.exp(f"g{i + 1}", x), state[-1]))

    # Stage i is at the time t + times[i] h, where times[i] = steps[0] + ... + steps[i - 1].
    steps = [reduce(add, row) for row in scheme.increments(method.ring)]
    times = list(accumulate(steps, initial=method.ring.zero))

    def images() -> list[Var]:
        result = []
        for i in range(scheme.s):
            # Stage i begins at the state that stage i - 1 has computed.
            if i:
                advance(i - 1)
            result.append(stages.f(f"f{i + 1}", state[i], times[i] if i else None))
        return result

    def update() -> dict[str, Var]:
        # This call computes the new state exp(h B_s K_s) Y_s.
        advance(scheme.s - 1)
        if not sums:
            return {"y": state[-1]}
        # The entries of ``sums`` do not contain the factor h.
        x = build.lin("x", Kind.ALG, [(stages.times_h(method.ring.one), sums[-1])])
        return {"y": state[-1], EMBEDDED: build.act("Y", build.exp("g", x), state[-1])}

    # A low-storage scheme is explicit, so the initial guesses for the k_i do not matter.
    return stages.program(k, images, lambda: [stages.f("k0", y, None)] * scheme.s, update)


def products(problem: Problem, method: Method, tableau: CommutatorFree, lower: Stage | None) -> Program:
    """Return the program of a method whose stages and update are products of exponentials.

    ``lower`` contains the coefficients of the embedded update, or None if there is no embedded method.
    """
    y = Var("y", Kind.POINT)
    stages = Stages(problem, method, (y,))
    build = stages.builder
    k = [build.fresh(f"k{i + 1}", Kind.ALG) for i in range(tableau.s)]

    def product(stage: Stage, name: str, points: list[Var]) -> Var:
        # A stage begins at y or at the point of an earlier stage.
        point = y if stage.start is None else points[stage.start]
        for row in stage.exponentials:
            # Builder appends numbers to the name, because a variable is assigned only once.
            x = stages.combination(f"x{name}", Kind.ALG, row, k)
            # Each row of coefficients gives one exponential. The exponential of the first row acts first.
            point = build.act(f"Y{name}", build.exp(f"g{name}", x), point)
        return point

    def images() -> list[Var]:
        # ``points`` contains the points of all earlier stages. A stage can begin at one of these points.
        points: list[Var] = []
        times: list[Element] = []
        result = []
        for i, stage in enumerate(tableau.stages):
            points.append(product(stage, str(i + 1), points))
            entries = [x for row in stage.exponentials for x in row]
            # The time of stage i is t + times[i] h. If stage i begins at the point of stage j, times[i]
            # includes times[j].
            own = reduce(add, entries, method.tableau.ring.zero)
            times.append(own if stage.start is None else own + times[stage.start])
            result.append(stages.f(f"f{i + 1}", points[i], times[i]))
        # The function ``update`` needs the points of the stages.
        stage_points[:] = points
        return result

    stage_points: list[Var] = []

    def update() -> dict[str, Var]:
        # The embedded solution is another product of exponentials.
        more = {} if lower is None else {EMBEDDED: product(lower, "", stage_points)}
        return {"y": product(tableau.update, "", stage_points)} | more

    # The initial guess for every k_i is f(y0), with an error O(h).
    return stages.program(k, images, lambda: [stages.f("k0", y, None)] * tableau.s, update)
