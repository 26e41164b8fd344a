"""Combine successive functions of ad_x (dexp, dexp^{-1}, exp) into one function of ad_x.

The pass is exact. The adjoint maps Ad_{exp x} = exp(ad_x) and Ad*_{exp x} = exp(ad*_x) are also functions of
ad_x or ad*_x. A group may have a closed form for a product of functions: on SO(3) the product is 1 + b ad_x +
c ad_x^2 with scalars b and c.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from codegen.groups.capabilities import ClosedFormSeries
from codegen.ir.ad_series import UNIT, Factor, Word, simplified
from codegen.ir.expr import walk
from codegen.ir.number import Number
from codegen.ir.operations import Adjoint, AdSeries, DualDexp, Exp, InverseDexp, Multiply, MultiplyExp
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import BodyForce, BodyVelocity
from codegen.ir.values import Kind, Var
from codegen.passes.rewrite import Rewriter, rewrite
from codegen.scene.problem import Problem


def run(program: Program, scene: Problem) -> Program:
    """Combine successive functions of ad_x, if the group has closed forms for products of such functions."""
    return program if scene.group.offers(ClosedFormSeries) is None else rewrite(program, _rule)


def rows(program: Program, scene: Problem) -> Program:
    """Fuse some products q exp(x) of matrices: one operation computes the product directly from q and x.

    A product is fused if three conditions hold:
    - The velocity or the force in the body frame is evaluated at the product.
    - The product is not an output of the program.
    - The formulas for velocity and force contain entries of at most one row of the product.
    """
    if scene.body is None:
        return program
    names = scene.state[0].symbols
    read = {n.payload for n in walk([*scene.body.velocity, *scene.body.force]) if n.op == "sym"}
    # For a matrix group, ``names`` are the symbols of the matrix entries, row by row.
    side = round(len(names) ** 0.5)
    if len({k // side for k, name in enumerate(names) if name in read}) > 1:
        return program
    fields = {a.args[0] for a in program.assigns() if isinstance(a.operation, BodyVelocity | BodyForce)}
    kept = {var for _, var in program.outputs}

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        source = rewriter.definitions.get(assign.args[-1]) if isinstance(assign.operation, Multiply) else None
        # Let Q be the variable ``assign.targets[0]``, which is the result of the operation ``assign``.
        # ``own`` is True if two conditions hold. First, the velocity or the force is evaluated at Q. Second,
        # Q is not an output of the program.
        own = assign.targets[0] in fields and assign.targets[0] not in kept
        if source is None or not isinstance(source.operation, Exp) or not own:
            return rewriter.emit(assign)
        return rewriter.emit(replace(assign, operation=MultiplyExp(), args=(assign.args[0], source.args[0])))

    return rewrite(program, rule)


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    function = _function(rewriter, assign)
    if function is None:
        return rewriter.emit(assign)
    # The assignment computes f(ad_x) v. If v = g(ad_y) w and x is a multiple of y, f and g are combined.
    x, word = function
    v = assign.args[-1]
    source = rewriter.definitions.get(v)
    inner = _function(rewriter, source) if source is not None else None
    if source is not None and inner is not None:
        scale = ratio(rewriter.definitions, x, inner[0])
        if scale is not None:
            # Since x = scale * y, the product f(ad_x) g(ad_y) is a function of ad_y.
            joined = (*inner[1], *(f.scaled(scale) for f in word))
            return _emit(rewriter, assign, inner[0], joined, source.args[-1])
    # If v is a sum of terms g(ad_x) w, then f(ad_x) v is the sum of the terms (f g)(ad_x) w.
    adjoint = isinstance(assign.operation, Adjoint)
    if adjoint and source is not None and source.terms:
        parts = [_function_of(rewriter, arg, x) for arg in source.args]
        if len(parts) > 1 and all(part is not None for part in parts):
            return _distributed(rewriter, source, [p for p in parts if p is not None], word)
    # If other operations also need exp(x), the adjoint operation is not replaced by exp(ad_x).
    if adjoint and rewriter.uses.get(assign.args[0], 0) > 1:
        return rewriter.emit(assign)
    return _emit(rewriter, assign, x, word, v)


def _emit(rewriter: Rewriter, assign: Assign, x: Var, word: Word, v: Var) -> tuple[Var, ...]:
    word = simplified(word)
    if not word:
        # All factors cancel, so the combined function is the identity.
        return (v,)
    return rewriter.emit(Assign(assign.targets, AdSeries(word, v.kind is Kind.DUAL), (x, v)))


Part = tuple[Var, Word, Var]
"""A triple (x, factors, v) for the value f(ad_x) v, where the function f is the product of the factors."""


def _function_of(rewriter: Rewriter, var: Var, x: Var) -> tuple[Fraction, Part] | None:
    """Return a number s and a triple (y, W, v) such that ``var`` = W(ad_y) v and ``x`` = s * y.

    The function W is a product of factors, and s is a rational number. The result is None if such s, y, W and
    v are not known, or if ``var`` is read more than once.
    """
    source = rewriter.definitions.get(var)
    # If another operation also reads ``var``, combining functions saves nothing.
    if source is None or not isinstance(source.operation, AdSeries) or rewriter.uses.get(var, 0) > 1:
        return None
    scale = ratio(rewriter.definitions, x, source.args[0])
    return None if scale is None else (scale, (source.args[0], source.operation.word, source.args[1]))


def _distributed(
    rewriter: Rewriter, total: Assign, parts: list[tuple[Fraction, Part]], word: Word
) -> tuple[Var, ...]:
    terms = []
    for scale, (y, inner, v) in parts:
        joined = simplified((*inner, *(f.scaled(scale) for f in word)))
        target = rewriter.builder.fresh(v.name, v.kind)
        applied = Assign((target,), AdSeries(joined, v.kind is Kind.DUAL), (y, v))
        terms.append(rewriter.emit(applied)[0] if joined else v)
    target = rewriter.builder.fresh(total.targets[0].name, total.targets[0].kind)
    return rewriter.emit(Assign((target,), total.operation, tuple(terms)))


def _function(rewriter: Rewriter, assign: Assign) -> tuple[Var, Word] | None:
    """If ``assign`` computes f(ad_x) v, return x and the factors of f. Otherwise return None."""
    operation, args = assign.operation, assign.args
    if isinstance(operation, Adjoint):
        source = rewriter.definitions.get(args[0])
        # The operation is Ad_g or its dual with g = ``args[0]``. If the program does not compute g as exp(x),
        # the exponent x is unknown and the result is None.
        if source is None or not isinstance(source.operation, Exp):
            return None
        # Ad_{exp x} = exp(ad_x), Ad*_{exp x} = exp(ad*_x), and the inverse of exp(ad_x) is exp(-ad_x).
        return source.args[0], (Factor("exp", -UNIT if operation.inverse else UNIT),)
    if isinstance(operation, InverseDexp | DualDexp | AdSeries):
        return args[0], operation.word
    return None


def ratio(definitions: Mapping[Var, Assign], x: Var, y: Var) -> Fraction | None:
    """Return the rational number s with x = s y, or None if no such number is found."""
    a, b = _terms(definitions, x), _terms(definitions, y)
    # If x = 0 and y = 0, the number s with x = s y is not unique.
    if not a or list(a) != list(b):
        return None
    quotients = {(a[k] / b[k]).key: a[k] / b[k] for k in a}
    # In a function f(s ad_y), the number s must be rational.
    (s, *others) = quotients.values()
    return s.fraction() if not others and s.is_rational else None


def _terms(definitions: Mapping[Var, Assign], x: Var) -> dict[tuple[str, int], Number]:
    """Return x as a linear combination of values that are not sums themselves.

    The result maps pairs (name of a value, power of h) to coefficients. The keys are sorted.
    """
    total: dict[tuple[str, int], Number] = {}
    waiting = [(Number.rational(1), 0, x)]
    while waiting:
        c, power, var = waiting.pop()
        source = definitions.get(var)
        if source is not None and source.terms:
            for k, arg in source.terms:
                # A nested sum is replaced by its terms.
                waiting.append((c * k.value, power + k.power, arg))
            continue
        old = total.get((var.name, power))
        total[var.name, power] = c if old is None else old + c
    return {k: c for k, c in sorted(total.items()) if not c.is_zero}
