"""Sums of functions of one ad, nested: sum_k f_k (1 + b_k ad_x + c_k ad_x^2) v_k in two brackets.

Exact. It is A + ad_x (B + ad_x C) with A = sum f_k v_k, B = sum f_k b_k v_k and C = sum f_k c_k v_k, however
many terms there are; one by one each takes two brackets. The momentum of (3.19) is such a sum: functions of
one ad applied to the momentum before and to the force. A group that knows them in closed form has
``series_sum``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from codegen.ir.domain import Domain
from codegen.ir.interpret import apply, coefficient
from codegen.ir.program import Assign, Coefficient, Factor, Operation, Program, Var
from codegen.passes.functions import ratio
from codegen.passes.rewrite import uses
from codegen.setting import Setting

Term = tuple[Coefficient, Assign]
"""A multiple of a function of ad."""


@dataclass(frozen=True)
class SeriesSum(Operation):
    """sum_k f_k W_k(ad_x) v_k, or ad*_x, for one or more x, and plain terms, as one operation.

    Its arguments are the x, then the v; ``coefficients`` and ``words`` are those of the v, ``of`` says which
    x each word is of; plain terms come last and have an empty word.
    """

    words: tuple[tuple[Factor, ...], ...] = ()
    of: tuple[int, ...] = ()
    dual: bool = False

    def value(
        self, scene: Setting, domain: Domain, factors: Sequence[Any], args: Sequence[tuple[Any, ...]]
    ) -> tuple[Any, ...]:
        """Return the value for numbers f_k in place of the coefficients."""
        xs, vectors = args[: -len(self.words)], args[-len(self.words) :]
        terms = list(zip(factors, self.words, vectors, strict=True))
        total: tuple[Any, ...] | None = None
        for k, x in enumerate(xs):
            own = [term for term, place in zip(terms, self.of, strict=True) if place == k and term[1]]
            part: tuple[Any, ...] = scene.group.series_sum(domain, own, self.dual, x)
            total = part if total is None else tuple(a + b for a, b in zip(total, part, strict=True))
        assert total is not None
        for factor, word, v in terms:
            if not word:
                total = tuple(a + factor * b for a, b in zip(total, v, strict=True))
        return total

    def spelled(self, args: Sequence[str]) -> list[str]:
        """Spell the terms, without their coefficients."""
        name, vectors = "seriest" if self.dual else "series", args[-len(self.words) :]
        return [
            f"{Operation(name, word=word).text()}({args[k]}, {v})" if word else v
            for word, k, v in zip(self.words, self.of, vectors, strict=True)
        ]


def executed(scene: Setting, domain: Domain, assign: Assign, args: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the values of an assignment's targets, also of a :class:`SeriesSum`."""
    operation = assign.operation
    if not isinstance(operation, SeriesSum):
        return apply(scene, domain, assign, args)
    factors = [coefficient(domain, c) for c in operation.coefficients]
    return (operation.value(scene, domain, factors, args),)


@dataclass
class SeriesSums:
    """Finds such sums in a program while it is executed."""

    program: Program
    scene: Setting
    definitions: dict[Var, Assign] = field(default_factory=dict)
    uses: dict[Var, int] = field(init=False)

    def __post_init__(self) -> None:
        self.uses = uses(self.program)

    def taken(self, assign: Assign) -> tuple[Assign, frozenset[Var]]:
        """Return a sum as one operation, and the variables that only it would have read; others as they are.

        Assignments are taken note of, so that all of them have to pass here in order.
        """
        for target in assign.targets:
            self.definitions[target] = assign
        if assign.operation.name != "lin" or not hasattr(self.scene.group, "series_sum"):
            return assign, frozenset()
        groups = self._groups(assign)
        if not groups:
            return assign, frozenset()
        inner = frozenset(made.targets[0] for group in groups for _, made in group)
        xs: list[Var] = []
        coefficients: list[Coefficient] = []
        words: list[tuple[Factor, ...]] = []
        of: list[int] = []
        vectors: list[Var] = []
        for k, group in enumerate(groups):
            x = group[-1][1].args[0]
            xs.append(x)
            for c, made in group:
                scale = ratio(self.definitions, made.args[0], x)
                assert scale is not None
                coefficients.append(c)
                words.append(tuple(replace(f, scale=f.scale * scale) for f in made.operation.word))
                of.append(k)
                vectors.append(made.args[1])
        for c, v in zip(assign.operation.coefficients, assign.args, strict=True):
            if v not in inner:
                coefficients.append(c)
                words.append(())
                of.append(-1)
                vectors.append(v)
        dual = groups[0][0][1].operation.name == "seriest"
        operation = SeriesSum("sum", tuple(coefficients), words=tuple(words), of=tuple(of), dual=dual)
        return Assign(assign.targets, operation, (*xs, *vectors)), inner

    def _groups(self, assign: Assign) -> list[list[Term]]:
        """Return the terms that are functions of ad of multiples of one x, where there are two or more."""
        groups: list[list[Term]] = []
        for c, v in zip(assign.operation.coefficients, assign.args, strict=True):
            made = self.definitions.get(v)
            if made is None or not made.operation.word or self.uses.get(v) != 1:
                continue
            for group in groups:
                if ratio(self.definitions, made.args[0], group[0][1].args[0]) is not None:
                    group.append((c, made))
                    break
            else:
                groups.append([(c, made)])
        return [group for group in groups if len(group) > 1]
