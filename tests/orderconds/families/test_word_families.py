"""Families over words: their counts, printed formulas, relations and independence."""

import re
from fractions import Fraction

import numpy as np
import pytest

from orderconds import families
from orderconds.derivation import derive
from orderconds.errors import InputError
from orderconds.families.splitting import stage_tables
from orderconds.formula import Coefficient, IndexSum, Power, Product, Total
from orderconds.ring import QQ, Residues
from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES
from orderconds.series.monomials import products
from orderconds.stage_expansion import expand_stages
from orderconds.tableau import Composition, Magnus
from tests.oracles.index_sums import value

COUNTS = {
    "composition": (1, 1, 2, 3, 6, 9, 18, 30),
    "symmetric_composition": (1, 0, 1, 0, 2, 0, 4, 0, 8, 0),
    "splitting": (2, 1, 2, 3, 6, 9, 18, 30, 56, 99),
    "splitting(3)": (3, 3, 8, 18, 48, 116),
    "rkn": (2, 1, 2, 2, 4, 5, 10, 14),
    "magnus": (1, 1, 2, 3, 6, 9, 18, 30),
    "cf_magnus": (1, 1, 2, 3, 6, 9, 18, 30),
    "fer": (1, 1, 2, 3, 6, 9, 18, 30),
    "cayley": (1, 1, 3, 4, 10, 16, 36),
}
SMALL = {name: min(len(counts), 5) for name, counts in COUNTS.items()}


@pytest.mark.parametrize("name", COUNTS)
def test_there_are_as_many_conditions_as_the_literature_counts(name):
    family = families.get(name)
    found = tuple(len(family.conditions(n)) for n in range(1, len(COUNTS[name]) + 1))
    assert found == COUNTS[name]


def test_symmetric_compositions_have_1_2_4_8_16_conditions_at_orders_2_4_6_8_10():
    family = families.get("symmetric-composition")
    counts = [len(family.conditions(n)) for n in range(1, 11)]
    assert [sum(counts[:n]) for n in (2, 4, 6, 8, 10)] == [1, 2, 4, 8, 16]


def test_cayley_conditions_are_words_up_to_reversal():
    # (2^(n-1) - palindromes)/2 pairs, and palindromes of odd length: none has an even number of letters.
    family = families.get("cayley")
    for n in range(1, 8):
        every = family.all_conditions(n)
        palindromes = [c.key for c in every if c.key == c.key[::-1]]
        odd = sum(len(word) % 2 for word in palindromes)
        assert len(every) == 2 ** (n - 1)
        assert len(family.conditions(n)) == (len(every) - len(palindromes)) // 2 + odd


@pytest.mark.parametrize("name", COUNTS)
def test_listed_conditions_are_independent_and_give_all_others(name):
    family, order = families.get(name), SMALL[name]
    ring = Residues(PRIMES[0], 280)
    method = family.random_method(ring, np.random.default_rng(5), order)
    generators = []
    for n in range(1, order + 1):
        lower = list(products(generators, n))
        own = list(family.evaluate(method, ring, family.conditions(n)))
        every = list(family.evaluate(method, ring, family.all_conditions(n)))
        below = len(pivot_columns(lower))
        assert len(pivot_columns([*lower, *own])) - below == COUNTS[name][n - 1]
        assert len(pivot_columns([*lower, *own, *every])) - below == COUNTS[name][n - 1]
        generators += [(n, x) for x in own]


def random_member(name, random_rational):
    """A random rational member of a family with three stages or nodes."""
    family = families.get(name)

    class OneSample:
        one, zero = QQ.one, QQ.zero

        def random(self, generator):
            return random_rational()

    method = family.random_method(OneSample(), np.random.default_rng(3), 3)
    return family, method


def numbered(formula):
    """Append the number of indices to omega and phi, which name one table for each number of letters."""
    match formula:
        case Coefficient(name, indices):
            return Coefficient(f"{name}{len(indices)}" if name in ("omega", "phi") else name, indices)
        case Product(factors):
            return Product(tuple(map(numbered, factors)))
        case Power(base, exponent):
            return Power(numbered(base), exponent)
        case Total(terms):
            return Total(tuple((scale, numbered(term)) for scale, term in terms))
        case IndexSum(indices, relations, body):
            return IndexSum(indices, relations, numbered(body))
    raise TypeError(formula)


def node_tables(method):
    """c, and for a single exponent omega1, omega2, ...; for Fer b and phi2, phi3, ...; for CF beta."""
    series = method.words(QQ)
    tables = {"c": method.c, "beta": [[x.get((i,), QQ.zero) for i in range(method.s)] for x in series]}
    tables["b"] = tables["beta"][-1]
    for length in range(1, 5):
        tables[f"omega{length}"] = tables[f"phi{length}"] = _array(series[0], (), length, method.s)
    return tables


def _array(series, before, length, s):
    if length == 0:
        return series.get(before, QQ.zero)
    return [_array(series, (*before, i), length - 1, s) for i in range(s)]


def tables_of(name, method):
    if name.startswith("splitting") or name == "rkn":
        return stage_tables(method, QQ)
    if isinstance(method, Magnus):
        return node_tables(method)
    if isinstance(method, Composition):
        return {"gamma": method.gamma}
    return {"alpha": method.alpha, "beta": method.beta}


@pytest.mark.parametrize("name", sorted(COUNTS))
def test_every_printed_formula_is_what_the_engine_evaluates(name, random_rational):
    family, method = random_member(name, random_rational)
    if name == "magnus":  # its formulas are those of one exponential
        method = Magnus(
            method.c, families.get("fer").random_method(_rational(random_rational), _rng(), 3).exponents[:1]
        )
    for n in range(1, 5 if name != "splitting(3)" else 4):
        conditions = family.all_conditions(n)
        found = family.evaluate(method, QQ, conditions)
        tables = tables_of(name, method)
        for condition, x in zip(conditions, found, strict=True):
            assert value(numbered(condition.formula), QQ, tables) == x, condition


def _rng():
    return np.random.default_rng(3)


def _rational(random_rational):
    class OneSample:
        one, zero = QQ.one, QQ.zero

        def random(self, generator):
            return random_rational()

    return OneSample()


def evaluated(relation, values):
    """The value of a printed relation, ``<tree>`` replaced by the left-hand side of that condition."""
    total = Fraction(0)
    for sign, scale, factors in re.findall(r"(-|\+)?\s*(\d+(?:/\d+)?)?\s*((?:<[^>]*>\s*)+)", relation):
        term = Fraction(scale or 1) * (-1 if sign == "-" else 1)
        for tree in re.findall(r"<([^>]*)>", factors):
            term *= values[tree]
        total += term
    return total


@pytest.mark.parametrize("name", sorted(COUNTS))
def test_a_dependent_condition_obeys_its_printed_relation(name, random_rational):
    family, method = random_member(name, random_rational)
    values = {}
    for n in range(1, 6 if name != "splitting(3)" else 5):
        conditions = family.all_conditions(n)
        independent = {c.tree for c in family.conditions(n)}
        found = [Fraction(int(x.p), int(x.q)) for x in family.evaluate(method, QQ, conditions)]
        values |= {c.tree: x for c, x in zip(conditions, found, strict=True)}
        for condition, x in zip(conditions, found, strict=True):
            assert (condition.relation is None) == (condition.tree in independent)
            if condition.relation is not None:
                assert evaluated(condition.relation, values) == x, (condition.tree, condition.relation)
                assert set(re.findall(r"<([^>]*)>", condition.relation)) <= set(values)
                exact = {c.tree: c.rhs for m in range(1, n + 1) for c in family.all_conditions(m)}
                assert evaluated(condition.relation, exact) == condition.rhs


def test_a_wrong_relation_is_noticed():
    values = {"A": Fraction(2), "B": Fraction(3), "AB": Fraction(5)}
    assert evaluated("-<AB> + 1/2 <A> <B>", values) == -2
    assert evaluated("0", values) == 0
    assert evaluated("2 <AB> - <A> <A>", values) == 6


def printed(name, n):
    return [f"{c.tree}: {c}" for c in families.get(name).conditions(n)]


def test_conditions_are_printed_as_in_the_literature():
    # HLW III.3 for compositions; McLachlan and Quispel 2002 for splittings.
    assert printed("splitting", 3) == [
        "AAB: sum_i c_i^2 b_i = 1/3",
        "ABB: sum_i c_i b_i^2 + 2 sum_{i<j} c_i b_i b_j = 1/3",
    ]
    assert printed("splitting(3)", 2) == [
        "AB: sum_{i<=j} a_i b_j = 1/2",
        "AC: sum_{i<=j} a_i c_j = 1/2",
        "BC: sum_{i<=j} b_i c_j = 1/2",
    ]
    assert printed("composition", 2) == ["2: sum_i (alpha_i^2 - beta_i^2) = 0"]
    assert printed("symmetric-composition", 5) == [
        "1 1 3: sum_i gamma_i^5 + 3 sum_{i<j} gamma_i gamma_j^4 + 3 sum_{i<j} gamma_i^2 gamma_j^3"
        " + 6 sum_{i<j<k} gamma_i gamma_j gamma_k^3 = 0",
        "5: sum_i gamma_i^5 = 0",
    ]
    assert printed("fer", 3) == ["1 2: sum_{i,j} phi_ij c_j = 1/12", "3: sum_i b_i c_i^2 = 1/3"]


def test_latex_of_these_families_has_greek_letters():
    assert families.get("magnus").conditions(2)[0].latex == r"\sum_{i} \omega_{i} c_{i}"
    assert families.get("symmetric_composition").conditions(3)[0].latex == r"\sum_{i} \gamma_{i}^{3}"


def test_names_are_read_with_hyphens_and_parts():
    assert families.get("cf-magnus").label() == "cf_magnus"
    assert (
        families.get("splitting(3)").label() == families.get("splitting", parts=3).label() == "splitting(3)"
    )
    assert families.get("splitting(2)").label() == "splitting"
    with pytest.raises(InputError, match="7 parts"):
        families.get("splitting(7)")


def test_splittings_and_compositions_are_written_out_in_their_steps():
    def written(name, n, stages):
        return [str(c) for c in expand_stages(derive(name, n), stages).by_order[-1]]

    assert written("splitting", 2, 2) == ["a_1 b_1 + a_1 b_2 + a_2 b_2 = 1/2"]
    assert written("rkn", 1, 2) == ["a_1 + a_2 = 1", "b_1 + b_2 = 1"]
    assert written("composition", 2, 1) == ["alpha_1^2 - beta_1^2 = 0"]
    assert written("symmetric-composition", 3, 3) == ["2 gamma_1^3 + gamma_2^3 = 0"]
    assert written("symmetric-composition", 3, 4) == ["2 gamma_1^3 + 2 gamma_2^3 = 0"]


@pytest.mark.parametrize("name", ["splitting", "splitting(3)", "rkn", "composition", "symmetric_composition"])
def test_written_out_conditions_have_the_values_of_the_engine(name, random_rational):
    family, stages = families.get(name), 3
    form = family.in_stages(stages)
    names = form.names
    values = [random_rational() for _ in names]
    known = {
        n: dict(
            zip(
                (i for m, (i,) in names if m == n),
                (v for (m, _), v in zip(names, values, strict=True) if m == n),
                strict=True,
            )
        )
        for n in dict(names)
    }
    derivation = derive(name, 3)
    found = family.evaluate(form.method(values, QQ), QQ, derivation.conditions)
    for condition, x in zip(expand_stages(derivation, stages).conditions, found, strict=True):
        assert substituted(condition.formula, known) == x


def substituted(formula, known):
    match formula:
        case Coefficient(name, (index,)):
            return known[name][index]
        case Power(base, exponent):
            return substituted(base, known) ** exponent
        case Product(factors):
            result = QQ.one
            for factor in factors:
                result = result * substituted(factor, known)
            return result
        case Total(terms):
            return sum(
                (QQ.rational(s.numerator, s.denominator) * substituted(t, known) for s, t in terms), QQ.zero
            )
    raise TypeError(formula)


def test_what_has_no_stages_or_cannot_be_explicit_is_refused():
    with pytest.raises(InputError, match="cannot expand the conditions of family magnus"):
        expand_stages(derive("magnus", 2), 2)
    with pytest.raises(InputError, match="explicit"):
        expand_stages(derive("splitting", 2), 2, explicit=True)
