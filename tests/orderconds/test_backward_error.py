"""Modified equations of tableaux: linear problems, orders, and the words behind the commutators."""

from __future__ import annotations

from fractions import Fraction

import pytest

from orderconds import families
from orderconds.backward_error import ModifiedEquation, modified_equation
from orderconds.checking import read
from orderconds.errors import InputError
from orderconds.series.characters import ORDERED, Character
from orderconds.series.modified_equations import modified_field
from orderconds.tableau import Tableau
from orderconds.trees.levels import parse, trees_of
from orderconds.trees.ordered import ordered_forests
from orderconds.words.lie import expand, standard_bracketing
from orderconds.words.shuffle import add


def tall_trees(equation: ModifiedEquation) -> list[Fraction]:
    """The coefficients of f'(f'(...f)), the only terms on a linear problem y' = z y, for orders 1, 2, ..."""
    tall = {len(parse(t.tree)): t.coefficient for t in equation.terms if max(parse(t.tree)) == t.order - 1}
    return [Fraction(str(tall.get(n, 0))) for n in range(1, equation.order + 1)]


def logarithm(stability: list[Fraction]) -> list[Fraction]:
    """The Taylor coefficients of log R(z) from those of R(z), R(0) = 1, by R' = (log R)' R."""
    result = [Fraction(0)]
    for n in range(1, len(stability)):
        rest = sum((k * result[k] * stability[n - k] for k in range(1, n)), Fraction(0))
        result.append(stability[n] - rest / n)
    return result[1:]


@pytest.mark.parametrize(
    ("name", "stability"),
    [
        ("euler", [1, 1, 0, 0, 0, 0, 0]),
        ("rk4", [1, 1, Fraction(1, 2), Fraction(1, 6), Fraction(1, 24), 0, 0]),
        ("midpoint", [1, *(Fraction(1, 2**n) for n in range(6))]),
    ],
)
def test_on_linear_problems_the_modified_field_is_the_logarithm_of_the_stability_function(
    name: str, stability: list[Fraction]
) -> None:
    expected = logarithm([Fraction(x) for x in stability])
    assert tall_trees(modified_equation(read(name), 6)) == expected


@pytest.mark.parametrize("family", ["rk", "cg", "rkmk(2)"])
def test_lie_group_methods_have_the_modified_equation_of_linear_problems_too(family: str) -> None:
    # The names of ordered and of unordered trees without branchings are the same.
    assert tall_trees(modified_equation(read("rk4"), 5, family)) == [1, 0, 0, 0, Fraction(-1, 120)]


def test_on_linear_problems_the_modifying_field_of_the_euler_method_is_the_exponential() -> None:
    terms = tall_trees(modified_equation(read("euler"), 5, modifying=True))
    assert terms == [1, Fraction(1, 2), Fraction(1, 6), Fraction(1, 24), Fraction(1, 120)]


@pytest.mark.parametrize(
    ("name", "family", "order", "modifying"),
    [
        ("rk4", "rk", 4, False),
        ("rk4", "rk", 4, True),
        ("rk4", "rkmk(1)", 3, False),
        ("rk4", "rkmk(2)", 4, False),
        ("rk4", "cg", 2, False),
        ("cg3", "cg", 3, False),
        ("cf4", None, 4, False),
        ("gauss2", None, 4, False),
        ("gauss2", None, 4, True),
        ("kahan", None, 2, True),
    ],
)
def test_beyond_f_the_first_term_is_one_above_the_order(
    name: str, family: str | None, order: int, modifying: bool
) -> None:
    first, *others = modified_equation(read(name), order + 1, family, modifying=modifying).terms
    assert (first.order, first.name) == (1, "f")
    assert first.coefficient == 1
    assert {term.order for term in others} == {order + 1}


@pytest.mark.parametrize("name", ["cf4", "cg3"])
def test_commutators_multiply_out_to_the_field_on_every_forest(name: str) -> None:
    tableau, order = read(name), 5
    equation = modified_equation(tableau, order, "cf" if name == "cf4" else "cg")
    family = families.get(equation.family)
    series = family.series(tableau.read_as(family.formats), tableau.ring)  # type: ignore[attr-defined]
    field = modified_field(Character(tableau.ring, ORDERED, series))

    def place(tree: bytes) -> tuple[int, bytes]:
        return -len(tree), bytes(255 - level for level in tree)

    products = add(
        *(
            (Fraction(str(t.coefficient)), expand(standard_bracketing(trees_of(parse(t.tree)), place)))
            for t in equation.terms
        )
    )
    for n in range(1, order + 1):
        for forest in ordered_forests(n):
            # The first tree of a forest acts first, so that it is the last factor of the product.
            product = products.get(trees_of(forest)[::-1], Fraction(0))
            assert product == Fraction(str(field(forest))), forest


def test_only_symplectic_methods_have_a_modified_hamiltonian() -> None:
    found = {name: modified_equation(read(name), 5).hamiltonian for name in ("midpoint", "gauss2", "rk4")}
    assert found["rk4"] is None
    assert [t.order for t in found["midpoint"] or ()] == [1, 3, 5, 5, 5]
    assert [t.order for t in found["gauss2"] or ()] == [1, 5, 5, 5]


def test_a_method_of_rounded_coefficients_is_not_said_to_be_symplectic() -> None:
    text = 'name = "m"\nfamily = "rk"\nA = [["0.5000000000000~"]]\nb = ["1"]\n'
    assert modified_equation(Tableau.loads(text), 3).hamiltonian is None


@pytest.mark.parametrize(
    ("name", "family", "order", "modifying", "message"),
    [
        ("rk4", None, 0, False, "order 0"),
        ("rk4", "vcg", 3, False, "neither a B-series nor a Lie-Butcher series"),
        ("rk4", "cf4", 3, False, "unknown family"),
        ("strang", None, 3, False, "expected a tableau that is a method of family rk or cf"),
        ("cf4", "cf", 3, True, "expected a B-series"),
    ],
)
def test_bad_requests_are_refused(
    name: str, family: str | None, order: int, modifying: bool, message: str
) -> None:
    with pytest.raises(InputError) as error:
        modified_equation(read(name), order, family, modifying=modifying)
    assert message in str(error.value)


def test_an_inconsistent_method_has_no_modifying_equation() -> None:
    tableau = Tableau.loads('name = "half"\nfamily = "rk"\nA = [[]]\nb = ["1/2"]\n')
    with pytest.raises(InputError, match="the weights sum to 1/2"):
        modified_equation(tableau, 2, modifying=True)
