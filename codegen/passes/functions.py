"""Functions of one ad: dexp, dexp^{-1} and exp applied one after the other become one function.

Exact. Ad_{exp x} = exp(ad_x) and Ad*_{exp x} = exp(ad*_x), so that a chain of such operations with multiples
of one x is a product of functions of ad_x, or of ad*_x on duals, which a group may know in closed form: on
SO(3) it is 1 + b ad_x + c ad_x^2. An exponential that only one adjoint operation uses is not formed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from codegen.groups.capabilities import ClosedFormSeries
from codegen.ir.expr import walk
from codegen.ir.number import Number
from codegen.ir.program import Assign, Factor, Kind, Operation, Program, Var
from codegen.passes.rewrite import Rewriter, rewrite
from codegen.scene.problem import Problem

ONE = Fraction(1)
ADJOINT = {"Ad": ONE, "Adinv": -ONE, "Adt": ONE, "Adtinv": -ONE}
"""Ad_{exp x} is exp(s t) with this s; t is ad_x, or ad*_x on duals."""

DUAL = frozenset({"Adt", "Adtinv", "dexpt", "dexpinvt", "seriest"})


def run(program: Program, scene: Problem) -> Program:
    """Return the program with functions of ad combined, where the group knows them in closed form."""
    return program if scene.group.offers(ClosedFormSeries) is None else rewrite(program, _rule)


def rows(program: Program, scene: Problem) -> Program:
    """Return the program with q exp(x) formed row by row where the body's field reads one row of it.

    Then exp(x) need not be formed for it.
    """
    if scene.body is None:
        return program
    names = scene.state[0].symbols
    read = {n.payload for n in walk([*scene.body.velocity, *scene.body.force]) if n.op == "sym"}
    side = round(len(names) ** 0.5)
    if len({k // side for k, name in enumerate(names) if name in read}) > 1:
        return program
    fields = {a.args[0] for a in program.assigns() if a.operation.name.startswith(("velocity", "force"))}
    kept = {var for _, var in program.outputs}

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        made = rewriter.definitions.get(assign.args[-1]) if assign.operation.name == "mul" else None
        own = assign.targets[0] in fields and assign.targets[0] not in kept
        if made is None or made.operation.name != "exp" or not own:
            return rewriter.emit(assign)
        return rewriter.emit(
            replace(assign, operation=Operation("mulexp"), args=(assign.args[0], made.args[0]))
        )

    return rewrite(program, rule)


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    found = _function(rewriter, assign)
    if found is None:
        return rewriter.emit(assign)
    x, word = found
    v = assign.args[-1]
    made = rewriter.definitions.get(v)
    inner = _function(rewriter, made) if made is not None else None
    if made is not None and inner is not None:
        scale = ratio(rewriter.definitions, x, inner[0])
        if scale is not None:
            x, word, v = (
                inner[0],
                (*inner[1], *(replace(f, scale=f.scale * scale) for f in word)),
                made.args[-1],
            )
            return _emit(rewriter, assign, x, word, v)
    if made is not None and made.operation.name == "lin" and assign.operation.name in ADJOINT:
        parts = [_function_of(rewriter, arg, x) for arg in made.args]
        if len(parts) > 1 and all(part is not None for part in parts):
            return _distributed(rewriter, made, [p for p in parts if p is not None], word)
    if assign.operation.name in ADJOINT and rewriter.uses.get(assign.args[0], 0) > 1:
        return rewriter.emit(assign)
    return _emit(rewriter, assign, x, word, v)


def _emit(rewriter: Rewriter, assign: Assign, x: Var, word: tuple[Factor, ...], v: Var) -> tuple[Var, ...]:
    word = simplified(word)
    if not word:
        return (v,)
    name = "seriest" if assign.operation.name in DUAL else "series"
    return rewriter.emit(Assign(assign.targets, Operation(name, word=word), (x, v)))


Part = tuple[Var, tuple[Factor, ...], Var]
"""x, a function of ad_x, and what it is applied to."""


def _function_of(rewriter: Rewriter, var: Var, x: Var) -> tuple[Fraction, Part] | None:
    """Return s and the function of y that var is, where x = s y and var has no other use."""
    made = rewriter.definitions.get(var)
    if made is None or not made.operation.word or rewriter.uses.get(var, 0) > 1:
        return None
    scale = ratio(rewriter.definitions, x, made.args[0])
    return None if scale is None else (scale, (made.args[0], made.operation.word, made.args[1]))


def _distributed(
    rewriter: Rewriter, total: Assign, parts: list[tuple[Fraction, Part]], word: tuple[Factor, ...]
) -> tuple[Var, ...]:
    """Append a function of ad_x applied to each term of a sum of such functions."""
    terms = []
    for scale, (y, inner, v) in parts:
        joined = simplified((*inner, *(replace(f, scale=f.scale * scale) for f in word)))
        target = rewriter.builder.fresh(v.name, v.kind)
        name = "seriest" if v.kind is Kind.DUAL else "series"
        made = Assign((target,), Operation(name, word=joined), (y, v))
        terms.append(rewriter.emit(made)[0] if joined else v)
    target = rewriter.builder.fresh(total.targets[0].name, total.targets[0].kind)
    return rewriter.emit(Assign((target,), total.operation, tuple(terms)))


def _function(rewriter: Rewriter, assign: Assign) -> tuple[Var, tuple[Factor, ...]] | None:
    """Return x and the function of ad_x that an assignment applies to its last argument."""
    operation, args = assign.operation, assign.args
    if operation.name in ADJOINT:
        made = rewriter.definitions.get(args[0])
        if made is None or made.operation.name != "exp":
            return None
        return made.args[0], (Factor("exp", ADJOINT[operation.name]),)
    if operation.name in ("dexpinv", "dexpinvt"):
        assert operation.order is not None
        return args[0], (Factor("dexpinv", ONE, operation.order),)
    if operation.name == "dexpt":
        return args[0], (Factor("dexp", ONE),)
    return (args[0], operation.word) if operation.word else None


def simplified(word: tuple[Factor, ...]) -> tuple[Factor, ...]:
    """Return a word with its exponentials joined and without factors that cancel.

    exp(-s t) dexp(s t) = dexp(-s t).

    >>> simplified((Factor("dexp", ONE), Factor("exp", -ONE)))[0].text()
    'dexp(-t)'
    """
    powers: dict[tuple[str, Fraction, int], int] = {}
    rate = Fraction(0)
    for f in word:
        if f.function == "exp":
            rate += f.scale * f.power
        else:
            key = (f.function, f.scale, f.order)
            powers[key] = powers.get(key, 0) + f.power
    for (function, scale, order), n in list(powers.items()):
        if function == "dexp" and n > 0 and rate == -scale:
            powers[function, scale, order] -= 1
            powers[function, -scale, order] = powers.get((function, -scale, order), 0) + 1
            rate = Fraction(0)
    found = [Factor("exp", rate)] if rate else []
    for (function, scale, order), n in sorted(powers.items()):
        found += [Factor(function, scale, order, 1 if n > 0 else -1)] * abs(n)
    return tuple(found)


def ratio(definitions: Mapping[Var, Assign], x: Var, y: Var) -> Fraction | None:
    """Return the rational number s with x = s y, where one is seen."""
    a, b = _terms(definitions, x), _terms(definitions, y)
    if list(a) != list(b):
        return None
    quotients = {(a[k] / b[k]).key: a[k] / b[k] for k in a}
    (s, *others) = quotients.values()
    return s.fraction() if not others and s.is_rational else None


def _terms(definitions: Mapping[Var, Assign], x: Var) -> dict[tuple[str, int], Number]:
    """Return x as a linear combination: coefficients by variable and power of h, sorted."""
    total: dict[tuple[str, int], Number] = {}
    waiting = [(Number.rational(1), 0, x)]
    while waiting:
        c, power, var = waiting.pop()
        made = definitions.get(var)
        if made is not None and made.operation.name == "lin":
            for k, arg in zip(made.operation.coefficients, made.args, strict=True):
                waiting.append((c * k.value, power + k.power, arg))
            continue
        old = total.get((var.name, power))
        total[var.name, power] = c if old is None else old + c
    return {k: c for k, c in sorted(total.items()) if not c.is_zero}
