"""Sums of functions of ad_x in nested form.

On some groups, each term of such a sum is f (1 + b ad_x + c ad_x^2) v with numbers f, b and c. Let A, B and C
be the sums of f v, f b v and f c v over all terms. The pass replaces the sum by the equal expression
A + ad_x (B + ad_x C). For n terms, this reduces the number of brackets from 2 n to 2. For example, the
momenta of variational Crouch-Grossman methods are such sums (equation (3.19) of Marthinsen's thesis).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from codegen.groups.capabilities import ClosedFormSeries
from codegen.ir.domain import Domain, Value
from codegen.ir.number import Number
from codegen.ir.operations import AdSeries
from codegen.ir.program import Assign, Program
from codegen.ir.values import ONE, Coefficient, Var
from codegen.passes.functions import ratio
from codegen.passes.rewrite import uses
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class Term:
    """A term c W(ad_x) v: a multiple of a function W of ad_x, applied to v."""

    target: Var
    coefficient: Coefficient
    series: AdSeries
    x: Var
    v: Var


@dataclass
class SeriesSums:
    """Evaluates sums such as f(ad_x) v + g(ad_x) w in nested form, with fewer Lie brackets."""

    program: Program
    scene: Problem
    definitions: dict[Var, Assign] = field(default_factory=dict)
    uses: dict[Var, int] = field(init=False)

    def __post_init__(self) -> None:
        self.uses = uses(self.program)

    def value(self, domain: Domain, assign: Assign, env: Mapping[Var, Value]) -> tuple[Value, ...] | None:
        """Evaluate ``assign`` as a nested sum, or return None if nesting saves nothing.

        The method must be called for every assignment of the program, in the order of execution.
        """
        for target in assign.targets:
            self.definitions[target] = assign
        # Only groups with closed forms for functions of ad_x have the method ``series_sum``.
        group = self.scene.group.offers(ClosedFormSeries)
        if not assign.terms or group is None:
            return None
        sums = self._groups(assign)
        if not sums:
            return None
        # Each list of terms in ``sums`` is evaluated as one nested sum.
        inner = {term.target for terms in sums for term in terms}
        total = [(c.evaluate(domain), env[v]) for c, v in assign.terms if v not in inner]
        values = [self._nested(domain, group, terms, env) for terms in sums]
        result = values[0]
        for other in values[1:]:
            result = tuple(a + b for a, b in zip(result, other, strict=True))
        for c, v in total:
            result = tuple(a + c * b for a, b in zip(result, v, strict=True))
        return result

    def _groups(self, assign: Assign) -> list[list[Term]]:
        """Return groups of terms of the sum ``assign``. Each group has two or more terms.

        A term is c f(ad_x) v with a coefficient c and a function f of ad_x. In each group, the elements x are
        parallel.
        """
        groups: list[list[Term]] = []
        for c, v in assign.terms:
            source = self.definitions.get(v)
            # The nested form does not compute ``v``. Therefore the term is skipped if another operation also
            # reads ``v``.
            if source is None or not isinstance(source.operation, AdSeries) or self.uses.get(v) != 1:
                continue
            term = Term(v, c, source.operation, *source.args)
            for group in groups:
                # If x is a multiple of y = ``group[0].x``, a function of ad_x is also a function of ad_y.
                if ratio(self.definitions, term.x, group[0].x) is not None:
                    group.append(term)
                    break
            else:
                groups.append([term])
        # A group with a single term is omitted, because the nested form of one term saves no Lie brackets.
        return [group for group in groups if len(group) > 1]

    def _nested(
        self, domain: Domain, group: ClosedFormSeries, members: list[Term], env: Mapping[Var, Value]
    ) -> tuple[Value, ...]:
        """Return the sum of the terms ``members`` in nested form."""
        x, dual = members[-1].x, members[-1].series.dual
        terms = []
        for term in members:
            scale = ratio(self.definitions, term.x, x)
            assert scale is not None
            word = tuple(f.scaled(scale) for f in term.series.word)
            terms.append((signed(domain, term.coefficient), word, env[term.v]))

        def total(numbers: tuple[int, ...]) -> tuple[Value, ...]:
            flat = self._flat([(members[k].coefficient, members[k].v) for k in numbers])
            return combined(domain, [(c, env[v]) for c, v in flat])

        return group.series_sum(domain, terms, dual, env[x], total)

    def _flat(self, terms: list[tuple[Coefficient, Var]]) -> list[tuple[Coefficient, Var]]:
        """Return ``terms`` with each inner sum replaced by the terms of this inner sum.

        If no term remains, or if the result is longer than ``terms``, return ``terms`` unchanged.
        """
        total: dict[tuple[Var, int], Number] = {}
        for c, v in terms:
            # An inner sum v is replaced by its terms. This shortens chains of dependent additions.
            source = self.definitions.get(v)
            inner = [(ONE, v)]
            if source is not None and source.terms:
                inner = list(source.terms)
            for d, u in inner:
                key, more = (u, c.power + d.power), c.value * d.value
                total[key] = total[key] + more if key in total else more
        flat = [(Coefficient(x, power), u) for (u, power), x in total.items() if not x.is_zero]
        # Each term costs a product, so a longer sum is not returned.
        return flat if 0 < len(flat) <= len(terms) else terms


def signed(domain: Domain, c: Coefficient) -> Value:
    """Return the value of a coefficient c.

    If c is rational and negative, evaluate -c, and return the negative of this value.
    """
    # The terms c x and (-c) x use the same product |c| x.
    if c.value.is_rational and c.value.fraction() < 0:
        return -Coefficient(-c.value, c.power).evaluate(domain)
    return c.evaluate(domain)


def combined(domain: Domain, terms: Sequence[tuple[Coefficient, tuple[Value, ...]]]) -> tuple[Value, ...]:
    """Return the sum of c v over all pairs (c, v) in ``terms``. Pairs with c = 1 are added first."""
    total: tuple[Value, ...] | None = None
    for c, v in sorted(terms, key=lambda term: not term[0].is_one):
        own = v if c.is_one else tuple(signed(domain, c) * a for a in v)
        total = own if total is None else tuple(a + b for a, b in zip(total, own, strict=True))
    assert total is not None
    return total
