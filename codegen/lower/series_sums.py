"""Sums of functions of one ad, nested: sum_k f_k (1 + b_k ad_x + c_k ad_x^2) v_k in two brackets.

Exact. It is A + ad_x (B + ad_x C) with A = sum f_k v_k, B = sum f_k b_k v_k and C = sum f_k c_k v_k, however
many terms there are; one by one each takes two brackets. The momentum of (3.19) is such a sum: functions of
one ad applied to the momentum before and to the force. A group that knows them in closed form has
``series_sum``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from codegen.ir.domain import Domain
from codegen.ir.interpret import coefficient
from codegen.ir.program import Assign, Coefficient, Factor, Program, Var
from codegen.passes.functions import ratio
from codegen.passes.rewrite import uses
from codegen.setting import Setting

Term = tuple[Coefficient, Assign]
"""A multiple of a function of ad."""


@dataclass
class SeriesSums:
    """Finds such sums in a program while it is executed."""

    program: Program
    scene: Setting
    definitions: dict[Var, Assign] = field(default_factory=dict)
    uses: dict[Var, int] = field(init=False)

    def __post_init__(self) -> None:
        self.uses = uses(self.program)

    def value(self, domain: Domain, assign: Assign, env: Mapping[Var, Any]) -> tuple[Any, ...] | None:
        """Return the value of a sum with its functions of ad nested; None where nothing is saved by that.

        Assignments are taken note of, so that all of them have to pass here in order.
        """
        for target in assign.targets:
            self.definitions[target] = assign
        if assign.operation.name != "lin" or not hasattr(self.scene.group, "series_sum"):
            return None
        groups = self._groups(assign)
        if not groups:
            return None
        inner = {made.targets[0] for group in groups for _, made in group}
        total = [
            (coefficient(domain, c), env[v])
            for c, v in zip(assign.operation.coefficients, assign.args, strict=True)
            if v not in inner
        ]
        values = [self._nested(domain, group, env) for group in groups]
        result = values[0]
        for other in values[1:]:
            result = tuple(a + b for a, b in zip(result, other, strict=True))
        for c, v in total:
            result = tuple(a + c * b for a, b in zip(result, v, strict=True))
        return result

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

    def _nested(self, domain: Domain, group: list[Term], env: Mapping[Var, Any]) -> tuple[Any, ...]:
        """Return the value of one group, all in terms of the last x."""
        x, operation = group[-1][1].args[0], group[-1][1].operation
        terms = []
        for c, made in group:
            scale = ratio(self.definitions, made.args[0], x)
            assert scale is not None
            word: tuple[Factor, ...] = tuple(replace(f, scale=f.scale * scale) for f in made.operation.word)
            terms.append((coefficient(domain, c), word, env[made.args[1]]))
        nested: tuple[Any, ...] = self.scene.group.series_sum(
            domain, terms, operation.name == "seriest", env[x]
        )
        return nested
