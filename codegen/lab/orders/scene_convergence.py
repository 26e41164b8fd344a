"""Convergence tests of several methods on one scene: the observed orders and the stated orders."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

from codegen import scenes
from codegen.build import CompilerMissing
from codegen.certify import CertifiedOrder, certified_order
from codegen.lab.orders import convergence
from codegen.lab.orders.convergence import Convergence, NotEmitted
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference, cached_reference
from codegen.lab.runner import DOUBLE, check_target, runner
from codegen.lower import method_for
from codegen.method import Method
from codegen.printers import DEFAULT
from codegen.scene.classical_forms import PRINTED, ClassicalForm, find_form
from codegen.scene.problem import Problem
from orderconds.argument import CONDITION_ORDER, described, integer
from orderconds.errors import InputError
from orderconds.tableau import Tableau

STEPS = (1, 10**9)
DIGITS = (DOUBLE, 60)
"""The least and the largest number of decimal digits that a user can choose for the target ``interpreter``.
"""


@dataclass(frozen=True)
class ConvergenceTest:
    """A convergence test of methods on a scene.

    ``form`` is the form of the equations that the option ``--form`` selects, or None. ``equations`` is the
    initial value problem in this form. If ``form`` is None, ``equations`` is ``scene``.
    """

    scene: Problem
    equations: Problem
    methods: tuple[Method, ...]
    target: str
    steps: tuple[int, ...]
    digits: int
    stated: int | None
    form: ClassicalForm | None

    @classmethod
    def of(
        cls,
        scene: Problem | str,
        methods: Sequence[Method | Tableau | str],
        *,
        target: str | None = None,
        form: str | None = None,
        steps: Sequence[int] = (),
        digits: int = DOUBLE,
        stated: int | None = None,
    ) -> ConvergenceTest:
        """Check the arguments, and return a test. The arguments are those of :func:`converge`."""
        problem = scenes.with_one_system(scenes.problem_of(scene))
        chosen = find_form(problem, form) if form not in (None, PRINTED) else None
        equations = problem if chosen is None else chosen.problem
        known = tuple(method_for(equations, method) for method in methods)
        check_target(target or DEFAULT, digits)
        return cls(problem, equations, known, target or DEFAULT, tuple(steps), digits, stated, chosen)

    def reference(self) -> Reference:
        """Return the reference solution of the scene. All final states are compared with this solution."""
        return cached_reference(self.scene)

    def result(self, method: Method, exact: Reference, progress: Progress = str) -> Convergence | NotEmitted:
        """Run one method with several step sizes, and return the errors and the observed order.

        If the method cannot be emitted for the scene, the result is a NotEmitted object with the reason. If
        the target needs a compiler that is not installed, the function raises CompilerMissing.
        """
        try:
            known = self.stated
            order = (
                certified_order(method, self.equations) if known is None else CertifiedOrder(known, "stated")
            )
            run = runner(self.equations, method, self.target, self.digits, order)
            progress(f"running {method.label}")
            return convergence.converge(run, order, exact, steps=self.steps, form=self.form)
        except CompilerMissing:  # No method can run without the compiler, so the whole test fails.
            raise
        except (InputError, ArithmeticError) as error:
            return NotEmitted(self.scene.name, method.label, self.target, str(error))


@dataclass(frozen=True, repr=False)
class Convergences:
    """The results of convergence tests, in the order in which the user named the methods."""

    results: tuple[Convergence | NotEmitted, ...]

    def __iter__(self) -> Iterator[Convergence | NotEmitted]:
        return iter(self.results)

    def __len__(self) -> int:
        return len(self.results)

    def __getitem__(self, index: int) -> Convergence | NotEmitted:
        return self.results[index]

    def __bool__(self) -> bool:
        """Return True if every result has the verdict ``holds``."""
        return all(result.verdict == "holds" for result in self.results)

    def __repr__(self) -> str:
        return "\n".join(f"{result.method} on {result.scene}: {result.sentence()}" for result in self.results)

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{escape(result.method)}</td><td>{escape(result.sentence())}</td></tr>"
            for result in self.results
        )
        return f"<table><tr><th>method</th><th>order</th></tr>{rows}</table>"


def converge(
    scene: Problem | str,
    *methods: Method | Tableau | str,
    target: str | None = None,
    form: str | None = None,
    steps: Sequence[int] = (),
    digits: int = DOUBLE,
    stated: int | None = None,
    progress: Progress = str,
) -> Convergences:
    """Measure the order of methods on a scene, and compare the measured order with ``stated``.

    By default, ``stated`` is the order from the order conditions. The arguments are those of the command
    ``orderconds converge``. A method is given by its name, or by a :class:`orderconds.Tableau`. If a
    method cannot be emitted for the scene, its result contains the reason. Wrong arguments raise InputError.
    """
    if not methods:
        raise InputError("no method", where="converge", expected="at least one method, such as cf4")
    if isinstance(steps, int) or not isinstance(steps, Sequence):
        raise InputError(
            described(steps), where="steps", expected="a list of numbers of steps, such as [10, 20]"
        )
    steps = [integer(n, "steps", STEPS) for n in steps]
    digits = integer(digits, "digits", DIGITS)
    stated = None if stated is None else integer(stated, "stated", CONDITION_ORDER)
    test = ConvergenceTest.of(
        scenes.problem_of(scene), methods, target=target, form=form, steps=steps, digits=digits, stated=stated
    )
    exact = test.reference()
    return Convergences(tuple(test.result(method, exact, progress) for method in test.methods))
