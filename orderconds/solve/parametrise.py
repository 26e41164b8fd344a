"""The parametrisations that a search tries, for each format of a tableau."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from orderconds import families
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.low_storage import low_storage
from orderconds.solve.path_ansatz import commutator_free, path_structures
from orderconds.solve.product_ansatz import composition, one_structure, splitting
from orderconds.solve.spec import Spec
from orderconds.solve.tableau_ansatz import runge_kutta, tableau_structures


@dataclass(frozen=True)
class Layout:
    """The parametrisations of one tableau format. Each parametrisation is called a structure, and is denoted
    by a text such as ``"full"``.

    ``ansatz`` returns an :class:`~orderconds.solve.ansatz.Ansatz`, a tableau with free coefficients. The four
    arguments of ``ansatz`` are a family of methods, the required properties of the method (:class:`Spec`), a
    structure, and a name for the tableau. ``structures`` returns the structures that a search tries, in order
    of trial.
    """

    ansatz: Callable[[Family, Spec, str, str], Ansatz]
    structures: Callable[[Family, Spec], tuple[str, ...]]


LAYOUTS = {
    "rk": Layout(runge_kutta, tableau_structures),
    "cf": Layout(commutator_free, path_structures),
    "composition": Layout(composition, one_structure),
    "splitting": Layout(splitting, one_structure),
}
"""Maps the name of a tableau format to a pair of functions (:class:`Layout`). The first function returns an
ansatz. The second function returns the names of the parametrisations that a search tries."""

TWO_REGISTERS = Layout(low_storage, lambda family, spec: ("low-storage",))
"""The parametrisation of low-storage schemes (:mod:`orderconds.solve.low_storage`)."""


def ansatz(family: str, spec: Spec, structure: str = "full", name: str = "found") -> Ansatz:
    """Return the ansatz for methods that satisfy the specification. ``family`` is the label of a family.

    Raises :class:`~orderconds.errors.InputError` if options of the specification contradict each other, or if
    the family does not support an option.

    >>> example = ansatz("rk", Spec(stages=2, explicit=True, fix=("a21=1/2",)))
    >>> example.free, example.body[2]
    (('b1', 'b2'), 'A = [[], ["1/2"]]')
    """
    member = families.get(family)
    layout = _layout(member, spec)
    if spec.stages < 1:
        raise InputError(f"{spec.stages} stages", where="--stages", expected="at least one")
    return layout.ansatz(member, spec, structure, name)


def structures(family: str, spec: Spec) -> tuple[str, ...]:
    """Return the names of the parametrisations that a search in ``family`` tries, in order of trial.

    >>> structures("vcg", Spec(stages=3)), structures("cg", Spec(stages=3))
    (('abscissae', 'full'), ('full',))
    """
    chosen = families.get(family)
    return _layout(chosen, spec).structures(chosen, spec)


def _layout(family: Family, spec: Spec) -> Layout:
    if spec.low_storage:
        return TWO_REGISTERS
    if family.unknowns not in LAYOUTS:
        searched = [n for n in families.names() if families.family_class(n).unknowns in LAYOUTS]
        raise InputError(
            f"methods of family {family.label()!r} cannot be searched",
            where="solve",
            expected=f"one of {', '.join(searched)}",
        )
    return LAYOUTS[family.unknowns]
