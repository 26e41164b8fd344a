"""Tableaux of splittings, compositions and Magnus methods: read, written, refused, and their properties."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds.checking import check
from orderconds.errors import InputError, TableauError
from orderconds.ring import QQ
from orderconds.tableau import AdjointComposition, Magnus, RungeKutta, Splitting, Tableau, dumps, find
from orderconds.tableau.brackets import Bracket, Product, parse, spell
from orderconds.tableau.file import text_of
from orderconds.tableau.properties import properties
from orderconds.tableau.reversal import sign, symmetric_exponents

SPLITTING = 'name = "t"\nfamily = "splitting"\nparts = ["T", "V"]\n'
PAIR = 'name = "t"\nfamily = "composition"\nbase = "adjoint-pair"\n'
MAGNUS = 'name = "t"\nfamily = "magnus"\nc = ["0", "1"]\n'

COEFFICIENTS = st.sampled_from(["1", "1/3", "-2", "0", "sqrt(2)", "1/(2 - 2^(1/3))", "0.25"])
TERMS = st.recursive(
    st.sampled_from(["1", "2", "e"]),
    lambda inner: st.tuples(inner, inner).map(lambda pair: f"[{pair[0]},{pair[1]}]"),
    max_leaves=4,
)


@st.composite
def files(draw: st.DrawFn) -> str:
    some = st.lists(COEFFICIENTS, min_size=1, max_size=4)
    kind = draw(st.sampled_from(["splitting", "pair", "magnus"]))
    if kind == "splitting":
        steps = draw(st.lists(st.tuples(st.sampled_from("TV"), COEFFICIENTS), min_size=1, max_size=5))
        rkn = draw(st.sampled_from(["", 'rkn = "V"\n']))
        written = ", ".join(f'["{p}", "{x}"]' for p, x in steps)
        return SPLITTING + rkn + f"step = [{written}]\n"
    if kind == "pair":
        alpha = draw(some)
        beta = draw(st.lists(COEFFICIENTS, min_size=len(alpha), max_size=len(alpha)))
        quoted = [", ".join(f'"{x}"' for x in row) for row in (alpha, beta)]
        return PAIR + f"alpha = [{quoted[0]}]\nbeta = [{quoted[1]}]\n"
    tables = draw(st.lists(st.dictionaries(TERMS, COEFFICIENTS, max_size=3), min_size=1, max_size=2))
    written = ", ".join("{" + ", ".join(f'"{t}" = "{x}"' for t, x in table.items()) + "}" for table in tables)
    return MAGNUS + f'elements = {{ e = {{ "1" = "1/2" }} }}\nexponents = [{written}]\n'


@given(text=files())
def test_a_written_tableau_reads_back_the_same(text: str) -> None:
    tableau = Tableau.loads(text)
    assert Tableau.loads(dumps(tableau)) == tableau
    assert dumps(Tableau.loads(dumps(tableau))) == dumps(tableau)


def test_a_claim_of_a_family_with_parts_survives_writing() -> None:
    text = 'name = "t"\nfamily = "splitting"\nparts = ["A", "B", "C"]\nstep = [["A", "1"]]\n'
    tableau = Tableau.loads(text + '[claims]\n"splitting(3)" = 1\n')
    assert Tableau.loads(dumps(tableau)).claims == tableau.claims


def test_a_cayley_method_keeps_its_map_and_its_products() -> None:
    text = MAGNUS + 'map = "cay"\nexponents = [{ "1*2*1" = "1/3", "1*2" = 1, "2*1" = -1 }]\n'
    tableau = Tableau.loads(text)
    assert isinstance(tableau.method, Magnus)
    assert tableau.method.transform == "cay"
    assert Tableau.loads(dumps(tableau)) == tableau


@pytest.mark.parametrize("text", ["1", "name", "[2,1]", "[[1,a],[2,b]]", "1*2*a", "[1*2,3]"])
def test_terms_are_read_as_they_are_written(text: str) -> None:
    assert spell(parse(text, "")) == text
    assert parse(text.replace(",", " , "), "") == parse(text, "")


def test_brackets_are_commutators_in_the_order_of_action() -> None:
    method = Magnus((QQ.zero, QQ.one), (((Bracket(1, 0), QQ.rational(1, 2)),),))
    half = QQ.rational(1, 2)
    assert method.words(QQ) == ({(0, 1): half, (1, 0): -half},)  # A_2 A_1: A_1 acts first
    product = Magnus((QQ.zero, QQ.one), (((Product((0, 1)), QQ.one), (Product((1, 0)), -QQ.one)),))
    assert product.words(QQ) == ({(1, 0): 1, (0, 1): -1},)


def test_named_elements_stand_for_their_combinations() -> None:
    text = 'elements = { e = { "1" = "1/2", "2" = "1/2" }, f = { "[e,2]" = "2" } }\nexponents = [{ f = 3 }]\n'
    method = Tableau.loads(MAGNUS + text).method
    plain = Tableau.loads(MAGNUS + 'exponents = [{ "[1,2]" = "3" }]\n').method
    assert isinstance(method, Magnus)
    assert isinstance(plain, Magnus)
    assert method.words(QQ) == plain.words(QQ)
    assert not method.is_commutator_free(QQ)


def test_equal_brackets_that_cancel_leave_a_method_free_of_commutators() -> None:
    text = 'exponents = [{ "1" = "1", "[1,2]" = "1/2", "[2,1]" = "1/2" }]\n'
    method = Tableau.loads(MAGNUS + text).method
    assert isinstance(method, Magnus)
    assert method.is_commutator_free(QQ)


def test_brackets_of_brackets_are_judged_without_writing_them_out() -> None:
    text = text_of(find("magnus8"))
    method = Tableau.loads(text).method
    assert isinstance(method, Magnus)
    assert method.extents() == ((1, 11),)  # 4^11 products of the A_i
    assert properties(Tableau.loads(text))["symmetric"] is True
    assert not method.is_commutator_free(QQ)
    # b is even under reversal where s1 is odd
    skew = Tableau.loads(text.replace('s2 = "-7/120"', 's2 = "-7/120", b = "1/7"'))
    assert properties(skew)["symmetric"] is None
    moved = Tableau.loads(text.replace('"1/2 + u"]', '"1/2 + 2*u"]'))
    assert properties(moved)["symmetric"] is False


@pytest.mark.parametrize("name", ["magnus2", "magnus4", "magnus6", "fer4", "cayley4", "cayley6"])
def test_the_sign_of_an_exponent_says_what_its_products_of_nodes_say(name: str) -> None:
    tableau = Tableau.load(find(name))
    method, ring = tableau.method, tableau.ring
    assert isinstance(method, Magnus)
    written_out = symmetric_exponents(replace(method, exponents=(*method.exponents, ())), ring)
    assert written_out is False  # nothing undoes the first exponent
    if sign(method, ring) == -1 and len(method.exponents) == 1:
        (series,) = method.words(ring)
        last = method.s - 1
        for word, value in series.items():
            mirrored = series.get(tuple(last - i for i in word), ring.zero)
            assert ring.is_zero(value - mirrored if len(word) % 2 else value + mirrored)


MALFORMED = {
    "one part": ('name = "t"\nfamily = "splitting"\nparts = ["T"]\nstep = []\n', "1 parts", "2 to 6"),
    "a part twice": (
        'name = "t"\nfamily = "splitting"\nparts = ["T", "T"]\nstep = [["T", 1]]\n',
        "'T' twice",
        "different names of the parts",
    ),
    "a part without name": (
        'name = "t"\nfamily = "splitting"\nparts = ["T", ""]\nstep = [["T", 1]]\n',
        "without name",
        "different names of the parts",
    ),
    "no step": (SPLITTING + "step = []\n", "0 stages", "1 to 200"),
    "a step of an unknown part": (
        SPLITTING + 'step = [["T", 1], ["W", 1]]\n',
        "step[2]: the part 'W'",
        "T, V",
    ),
    "a step without coefficient": (SPLITTING + 'step = [["T"]]\n', "step[1]", "length"),
    "a step with a float": (
        SPLITTING + 'step = [["T", 0.5]]\n',
        "step[1][2]: a value of type float",
        "write it in quotation marks",
    ),
    "rkn of no part": (
        SPLITTING + 'rkn = "W"\nstep = [["T", 1]]\n',
        "rkn = 'W'",
        "as the value of rkn",
    ),
    "unknown key of a splitting": (
        SPLITTING + 'steps = []\nstep = [["T", 1]]\n',
        "unknown key 'steps'",
        "parts",
    ),
    "gamma of a pair": (
        PAIR + 'gamma = ["1"]\nalpha = ["1"]\nbeta = ["0"]\n',
        "base = adjoint-pair with the key gamma",
        "alpha and beta",
    ),
    "a pair without beta": (PAIR + 'alpha = ["1"]\n', "without the key beta", "alpha and beta"),
    "beta too short": (
        PAIR + 'alpha = ["1", "2"]\nbeta = ["0"]\n',
        "beta has 1 entries, alpha has 2",
        "same length",
    ),
    "alpha of a symmetric base": (
        'name = "t"\nfamily = "composition"\nbase = "symmetric-2"\nalpha = ["1"]\n',
        "base = symmetric-2 without the key gamma",
        "gamma if the base is symmetric-2",
    ),
    "another base": ('name = "t"\nfamily = "composition"\nbase = "euler"\n', "base", ""),
    "a node beyond c": (MAGNUS + 'exponents = [{ "3" = 1 }]\n', "the node 3", "1 to 2"),
    "node zero": (MAGNUS + 'exponents = [{ "0" = 1 }]\n', "the node 0", "1 to 2"),
    "an unknown name": (MAGNUS + 'exponents = [{ "[1,x]" = 1 }]\n', "the name 'x'", "none"),
    "a name used before": (
        MAGNUS + 'elements = { a = { b = 1 }, b = { "1" = 1 } }\nexponents = [{ a = 1 }]\n',
        "elements.a: the name 'b'",
        "none",
    ),
    "a name that is none": (
        MAGNUS + 'elements = { "1a" = { "1" = 1 } }\nexponents = [{ "1" = 1 }]\n',
        "the name '1a'",
        "a letter",
    ),
    "a term twice": (
        MAGNUS + 'exponents = [{ "[1,2]" = 1, "[1, 2]" = 2 }]\n',
        "'[1,2]' occurs twice",
        "once",
    ),
    "an open bracket": (MAGNUS + 'exponents = [{ "[1,2" = 1 }]\n', "a missing ']'", "a bracket"),
    "no comma": (MAGNUS + 'exponents = [{ "[1 2]" = 1 }]\n', "a missing ','", "a bracket"),
    "an empty term": (MAGNUS + 'exponents = [{ "" = 1 }]\n', "an incomplete term", "a node"),
    "an empty bracket": (MAGNUS + 'exponents = [{ "[,1]" = 1 }]\n', "',' in place of a term", "a node"),
    "more than a term": (MAGNUS + 'exponents = [{ "1 2" = 1 }]\n', "'2' after a complete term", "a node"),
    "another sign": (MAGNUS + 'exponents = [{ "1+2" = 1 }]\n', "'+'", "a node"),
    "brackets too deep": (
        MAGNUS + 'exponents = [{ "' + "[" * 40 + '1" = 1 }]\n',
        "nested deeper",
        "a node",
    ),
    "a product in an exponential": (MAGNUS + 'exponents = [{ "1*2" = 1 }]\n', "the product '1*2'", "cay"),
    "a product that leaves the algebra": (
        MAGNUS + 'map = "cay"\nexponents = [{ "1*2" = 1 }]\n',
        "for some quadratic Lie groups, exponent number 1 is not in the Lie algebra",
        "A*B - B*A",
    ),
    "no exponents": (MAGNUS + "exponents = []\n", "0 exponents", "1 to 200"),
    "another map": (MAGNUS + 'map = "log"\nexponents = [{ "1" = 1 }]\n', "map", ""),
}


@pytest.mark.parametrize("what", MALFORMED)
def test_malformed_files_are_refused_by_place_and_expectation(what: str) -> None:
    text, found, expected = MALFORMED[what]
    with pytest.raises(TableauError) as caught:
        Tableau.loads(text, "file.toml")
    message = str(caught.value)
    assert message.startswith("file.toml") or "t: exponents" in message
    assert found in message
    assert expected in message


def test_an_adjoint_pair_of_euler_methods_is_a_runge_kutta_method() -> None:
    method = Tableau.loads(PAIR + 'alpha = ["1/3", "1/2"]\nbeta = ["1/6", "0"]\n').method
    assert isinstance(method, AdjointComposition)
    third, sixth, half = QQ.rational(1, 3), QQ.rational(1, 6), QQ.rational(1, 2)
    assert method.as_runge_kutta(QQ) == RungeKutta(((sixth, 0), (half, 0)), (half, half))
    assert method.as_splitting() == Splitting(
        ("A", "B"), ((1, sixth), (0, sixth + third), (1, third + QQ.zero), (0, half), (1, half))
    )


@pytest.mark.parametrize(
    ("text", "symmetric"),
    [
        (SPLITTING + 'step = [["T", "1/2"], ["V", 1], ["T", "1/2"]]', True),
        (SPLITTING + 'step = [["T", "1/2"], ["V", 1], ["T", "1/3"]]', False),
        (SPLITTING + 'step = [["T", 1], ["V", 1]]', False),
        (PAIR + 'alpha = ["1/3", "1/6"]\nbeta = ["1/6", "1/3"]', True),
        (PAIR + 'alpha = ["1/3", "1/6"]\nbeta = ["1/3", "1/6"]', False),
        (MAGNUS + 'exponents = [{ "1" = "1/2", "2" = "1/2", "[2,1]" = 3 }]', True),
        (MAGNUS + 'exponents = [{ "1" = "1/2", "2" = "1/2", "[[2,1],1]" = 3 }]', False),
        (MAGNUS + 'exponents = [{ "1" = "1/2", "2" = "1/3" }]', False),
        (MAGNUS + 'exponents = [{ "1" = "1/2" }, { "2" = "1/2" }]', True),
        ('name = "t"\nfamily = "magnus"\nc = ["0"]\nexponents = [{ "1" = 1 }]', False),
    ],
)
def test_symmetry_is_derived(text: str, symmetric: bool) -> None:
    assert properties(Tableau.loads(text)) == {"symmetric": symmetric}


def test_without_claims_the_format_names_the_family() -> None:
    three = 'name = "t"\nfamily = "splitting"\nparts = ["A", "B", "C"]\nstep = [["A", 1], ["B", 1], ["C", 1]]'
    texts = {
        "splitting": SPLITTING + 'step = [["T", 1], ["V", 1]]',
        "splitting(3)": three,
        "composition": PAIR + 'alpha = ["1"]\nbeta = ["0"]',
        "magnus": MAGNUS + 'exponents = [{ "1" = "1" }]',
        "cayley": MAGNUS + 'map = "cay"\nexponents = [{ "1" = "1" }]',
    }
    for label, text in texts.items():
        (found,) = check(Tableau.loads(text)).orders
        assert (found.family, found.order) == (label, 1)


@pytest.mark.parametrize(
    ("family", "text", "message"),
    [
        ("splitting(3)", SPLITTING + 'step = [["T", 1]]', "use the family 'splitting'"),
        ("rkn", SPLITTING + 'step = [["T", 1]]', "has no key rkn"),
        ("symmetric_composition", PAIR + 'alpha = ["1"]\nbeta = ["0"]', "symmetric-2"),
        ("cf_magnus", MAGNUS + 'exponents = [{ "[1,2]" = 1 }]', "use the family 'magnus'"),
        ("magnus", MAGNUS + 'map = "cay"\nexponents = [{ "1" = 1 }]', "use the family 'cayley'"),
        ("cayley", MAGNUS + 'exponents = [{ "1" = 1 }]', "use the family 'magnus'"),
        ("fer", MAGNUS + 'exponents = [{ "1" = 1 }, { "[1,2]" = 1 }]', "the exponent that acts last"),
        ("rk", MAGNUS + 'exponents = [{ "1" = 1 }]', "cannot be converted to a Runge-Kutta method"),
        ("magnus", SPLITTING + 'step = [["T", 1]]', "is not a method of family magnus"),
    ],
)
def test_a_family_refuses_what_is_no_member_of_it(family: str, text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        check(Tableau.loads(text), family=family)


def test_unsymmetric_steps_are_refused_by_symmetric_composition() -> None:
    text = 'name = "t"\nfamily = "composition"\nbase = "symmetric-2"\ngamma = ["1/3", "2/3"]'
    with pytest.raises(InputError, match=r"gamma\[1\] and gamma\[2\] differ"):
        check(Tableau.loads(text), family="symmetric_composition")
    assert check(Tableau.loads(text), family="composition").orders[0].order == 2
