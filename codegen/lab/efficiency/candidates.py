"""Lists the recipes of a scene.

A recipe is a way to integrate the scene. A recipe consists of a method, one form of the equations, and the
choice of equal steps or step-size control.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from codegen.certify import certified_order
from codegen.command_names import bare, quoted
from codegen.errors import MethodError
from codegen.lower import families_for, lowering
from codegen.method import Method, parse, with_estimate
from codegen.scene.classical_forms import PRINTED, classical_forms
from codegen.scene.problem import Problem
from orderconds.families import Family, family_class
from orderconds.tableau import RungeKutta, Tableau, available, find
from orderconds.tableau.method_properties import explicit

SEARCHED = 5
"""The search for the fewest commutators is used only for methods of at most this order.

In this search, the compiler determines how few commutators a method needs to keep its order. For higher
orders, the search takes seconds.
"""


DEGREES = (4, 6, 8, 10, 12, 14, 16, 18, 20, 24)
"""The numbers n for which the methods ``taylor(n)`` are considered."""


@dataclass(frozen=True)
class Recipe:
    """A way to integrate a scene: a method, one form of the equations, and equal steps or step-size control.

    - ``method``: the name of the method, such as ``rkmk(2):rk4``.
    - ``order``: the order of the method.
    - ``stages``: the number of stages or factors of the tableau.
    - ``tableau``: the name of the tableau.
    - ``adaptive``: True for step-size control, and False for equal steps.
    - ``form``: the form of the equations, for example ``quaternion``, as in the option ``--form``.
    - ``explicit``: True if the tableau is explicit (:func:`is_explicit`).

    For the method ``taylor(n)``, both ``order`` and ``stages`` are n.
    """

    method: str
    order: int
    stages: int
    tableau: str
    adaptive: bool = False
    form: str = PRINTED
    explicit: bool = True

    @property
    def label(self) -> str:
        """The text that tables show for this recipe."""
        form = "" if self.form == PRINTED else f" ({self.form})"
        return f"{'adaptive ' * self.adaptive}{self.method}{form}"

    @property
    def family(self) -> str:
        """The family of the method."""
        return self.method.partition(":")[0].partition("(")[0]

    def command(self, scene: str) -> str:
        """Return the command line that emits the integrator.

        >>> Recipe("rkmk(2):rk4", 4, 4, "rk4").command("dipole")
        "orderconds emit dipole --method 'rkmk(2):rk4' -o ."
        """
        words = ["orderconds emit", quoted(bare(scene)), "--method", quoted(self.method)]
        words += ["--form", self.form] if self.form != PRINTED else []
        words += ["--adaptive"] if self.adaptive else []
        return " ".join([*words, "-o ."])


def candidates(problem: Problem, tableaux: Sequence[str] = ()) -> Iterator[Recipe]:
    """Yield the recipes for a scene.

    If ``tableaux`` is empty, all tableaux of the library are used. A method that treats the state as a vector
    in R^n has one recipe for each form of the equations (:func:`classical_forms`).
    """
    forms = [form.key for form in classical_forms(problem)]
    for recipe in in_printed_form(problem, tableaux):
        for form in forms if lowering(recipe.family).in_coordinates else forms[:1]:
            yield replace(recipe, form=form)


def in_printed_form(problem: Problem, tableaux: Sequence[str] = ()) -> Iterator[Recipe]:
    """Yield the recipes in which the equations use the coordinates of the scene.

    On an abelian group, several families can give the same method. Only one of these families is used. The
    function does not check whether a recipe can be compiled for the scene.
    """
    families = [f for f in families_for(problem) if family_class(f).has_tableau]
    if not tableaux:
        for family in families_for(problem):
            if not family_class(family).has_tableau:
                yield from degrees(family)
    for name in tableaux or available():
        tableau = Tableau.load(find(name))
        seen: set[str] = set()
        for family in families:
            kind = family_class(family)
            if not readable(tableau, kind):
                continue
            classical = kind.abelian or family if problem.group.abelian else family
            if classical in seen:
                continue
            seen.add(classical)
            yield from recipes(tableau, kind, family, problem)


def readable(tableau: Tableau, kind: type[Family]) -> bool:
    """Return True if the given tableau defines a method of a family.

    If the formulas of the family divide by the weights b_i of a Runge-Kutta tableau, all weights must be
    provably nonzero.
    """
    if tableau.family not in kind.formats and tableau.read_as(kind.formats) is None:
        return False
    method = tableau.read_as(("rk",))
    if kind.needs_nonzero_weights and isinstance(method, RungeKutta):
        return all(tableau.ring.is_zero(b) is False for b in method.b)
    return True


def recipes(tableau: Tableau, kind: type[Family], family: str, problem: Problem) -> Iterator[Recipe]:
    """Yield the recipes of one tableau in one family, with equal steps and with step-size control.

    The cut-off of a method is its number of commutators, such as the 2 in ``rkmk(2)``. For each order, only
    the smallest cut-off that gives this order is used. A method is omitted if its order is below half the
    classical order of the tableau. For some tableaux, the compiler can search for a formula with few
    commutators (:data:`SEARCHED`). These tableaux have an additional recipe without a cut-off.
    """
    stages, name, ordered = size(tableau), tableau.name, is_explicit(tableau)
    controlled = tableau.lower() is not None and family in with_estimate()
    stated = {claim.label: claim.order for claim in tableau.claims.orders}
    own = {c.cutoff: c.order for c in tableau.claims.orders if c.family.partition("(")[0] == family}
    least = max((2 * stated.get("rk", 0) + 3) // 4, 1)
    if not kind.takes_cutoff:
        # The order depends on the group, and on R^n it can be higher than on a general group.
        try:
            here = lowering(family).conditions(Method(family, tableau), problem).label()
        except MethodError:
            # The family cannot use the tableau on this scene.
            return
        order = stated.get(here) or max(own.values(), default=0) or kind().implied_order(stated)
        if order >= least:
            yield from _both(f"{family}:{name}", order, stages, name, controlled, ordered)
        return
    cheapest = {order: cutoff for cutoff, order in sorted(own.items(), key=lambda c: -(c[0] or 0))}
    for order, cutoff in sorted(cheapest.items()):
        if order >= least:
            method = family if cutoff is None else f"{family}({cutoff})"
            yield from _both(f"{method}:{name}", order, stages, name, controlled, ordered)
    best = max(cheapest, default=0)
    reducible = best <= min(kind.minimal_brackets, SEARCHED) and Method(family, tableau).can_reduce_brackets()
    if best and None not in own and reducible:
        yield Recipe(f"{family}:{name}", best, stages, name, explicit=ordered)


def size(tableau: Tableau) -> int:
    """Return the number of stages of a tableau.

    For a splitting or composition method, return the number of its factors.
    """
    return getattr(tableau.read_as(("rk",)) or tableau.method, "s", 1)


def is_explicit(tableau: Tableau) -> bool:
    """Return True if each stage of a tableau depends only on earlier stages.

    Tableaux that cannot be read as Runge-Kutta tableaux count as explicit.
    """
    method = tableau.read_as(("rk",))
    if not isinstance(method, RungeKutta):
        return True
    return explicit(method, tableau.ring) is True


def degrees(family: str) -> Iterator[Recipe]:
    """Yield the recipes of a family for each degree in :data:`DEGREES`.

    The methods of the family have a degree instead of a tableau, for example ``taylor(8)``. If the family has
    an error estimate, each degree also has a recipe with step-size control.
    """
    for degree in DEGREES:
        yield from _both(f"{family}({degree})", degree, degree, "", family_class(family).controls_steps)


def _both(
    method: str, order: int, stages: int, tableau: str, controlled: bool, ordered: bool = True
) -> Iterator[Recipe]:
    yield Recipe(method, order, stages, tableau, explicit=ordered)
    if controlled:
        yield Recipe(method, order, stages, tableau, adaptive=True, explicit=ordered)


def method_of(recipe: Recipe, problem: Problem) -> Method:
    """Return the method of a recipe.

    MethodError is raised if the method cannot be used for ``problem``.
    """
    method = replace(parse(recipe.method, families_for(problem)), adaptive=recipe.adaptive)
    method.embedded()
    return method


def named(problem: Problem, methods: Sequence[tuple[str, bool]]) -> Iterator[Recipe]:
    """Yield the recipes of the given methods.

    Each pair in ``methods`` contains the name of a method, and whether it has step-size control. A method
    that treats the state as a vector in R^n has one recipe for each form of the equations
    (:func:`classical_forms`).
    """
    forms = [form.key for form in classical_forms(problem)]
    for label, adaptive in methods:
        method = parse(label, families_for(problem))
        order = certified_order(method, problem).order
        bare = method.coefficients is None
        stages, ordered = (order, True) if bare else (size(method.tableau), is_explicit(method.tableau))
        for form in forms if lowering(method.family).in_coordinates else forms[:1]:
            yield Recipe(method.label, order, stages, method.name, adaptive, form, ordered)
