"""Files made to obtain a certificate for a false order: none gets one."""

from __future__ import annotations

from random import Random

import pytest

from orderconds import check
from orderconds.proof.certificate import certify
from orderconds.proof.krawczyk import NotProved
from orderconds.tableau import Tableau

LARGEST = (2147483647, 2147483587)
"""The largest primes below 2^31 that are 3 modulo 4."""

INVISIBLE = f"{LARGEST[0] * LARGEST[1]}/1{'0' * 100}"
"""Zero modulo both primes, and too small to be seen by balls of 256 bits."""

COMPOSITION = """name = "spelled"
family = "rk"
A = [["b1/2"], ["b1", "b2/2"], ["b1", "b2", "b1/2"]]
b = ["b1", "b2", "b1"]
numbers = { b1 = "1.351207191959657634047687808971460826921999~", b2 = "1 - 2*b1" }
[proof]
conditions = "vcg"
order = 4
reduction = "spelling"
"""


def certified(text: str, family: str) -> list[tuple[int, str]]:
    """Return the orders of a file that have a certificate."""
    found = check(Tableau.loads(text), family).orders
    return [(f.order, f.certificate) for f in found if f.order and f.certificate in ("exact", "ball")]


def one_stage(entry: str, weight: str, numbers: str = "", digits: str = "0.0001~") -> str:
    return (
        f'name = "adversarial"\nfamily = "rk"\nA = [["{entry}"]]\nb = ["{weight}"]\n'
        f'[numbers]\nz = "{digits}"\n{numbers}'
        '[proof]\nconditions = "rk"\norder = 2\nreduction = "spelling"\n'
    )


def test_the_composition_itself_is_certified() -> None:
    assert certified(COMPOSITION, "vcg") == [(4, "ball")]


def test_a_weight_that_is_one_modulo_large_primes_has_no_order() -> None:
    assert certified(one_stage("1/2 + z - 0.0001", f"1 + {INVISIBLE}"), "rk") == []


@pytest.mark.parametrize("place", ['"b2/2"', '["b1/2"]', 'b = ["b1"'])
def test_a_perturbation_divisible_by_large_primes_is_seen(place: str) -> None:
    changed = place.replace('"]', f' + {INVISIBLE}"]') if "]" in place else place[:-1] + f' + {INVISIBLE}"'
    text = COMPOSITION.replace(place, changed)
    assert text != COMPOSITION
    assert certified(text, "vcg") == []


def test_a_coefficient_of_an_unknown_divisible_by_large_primes_is_seen() -> None:
    assert certified(COMPOSITION.replace("1 - 2*b1", f"1 - 2*b1 + b1^3*{INVISIBLE}"), "vcg") == []


def test_radicals_that_agree_modulo_large_primes_are_different() -> None:
    root, other = "sqrt(3)", f"sqrt(3 + {INVISIBLE})"
    text = one_stage("1/2 + z - 0.0001", f"1 + {root} - {other}")
    assert certified(text, "rk") == []
    # A third radical makes the square roots random numbers in the search for dependences.
    assert certified(text.replace("1/2 + z", "1/2 + z + 0*sqrt(2)"), "rk") == []


def test_a_radicand_that_is_constant_modulo_large_primes_only_is_no_constant() -> None:
    assert certified(one_stage("1/2 + z - 0.0001", f"sqrt(1 + z*{INVISIBLE})"), "rk") == []


def test_a_polynomial_that_vanishes_at_samples_drawn_from_the_primes_is_seen() -> None:
    # The residues that a generator seeded with the prime gives, interpolated at 0, 1, 2, ...
    from flint import nmod_poly

    columns = 40
    seen = []
    for prime in LARGEST:
        generator = Random(prime)
        drawn = nmod_poly([generator.randrange(prime) for _ in range(columns)], prime)
        seen.append([int(drawn(k)) for k in range(columns)])
    p, q = LARGEST
    points = [(x * q * pow(q, -1, p) + y * p * pow(p, -1, q)) % (p * q) for x, y in zip(*seen, strict=True)]
    groups = [points[i : i + 10] for i in range(0, columns, 10)]
    numbers = "".join(f'v{i} = "{"*".join(f"(z - {x})" for x in group)}"\n' for i, group in enumerate(groups))
    vanishing = f"1/1{'0' * 950}*v0*v1*v2*v3"
    assert certified(one_stage("1/2 + z - 0.0001", f"1 + {vanishing}", numbers), "rk") == []


def test_a_spelling_of_exploding_degree_is_no_proof() -> None:
    powers = "".join(f'w{i + 1} = "w{i}^64"\n' for i in range(8))
    tiny = f"0.{'0' * 60}1"
    text = one_stage(f"1/2 + z - {tiny}", "1 + w8 - w8", f'w0 = "1 + z - {tiny}"\n{powers}', f"{tiny}~")
    with pytest.raises(NotProved):
        certify(Tableau.loads(text))


GAUSS = """name = "weighted"
family = "rk"
A = [["1/4", "1/4 - r/6"], ["1/4 + r/6", "1/4"]]
b = ["w", "1 - w"]
numbers = { w = "0.50000000~", r = "sqrt(3)" }
[proof]
conditions = "rk"
order = 4
reduction = "spelling"
"""


def test_combinations_over_the_field_of_one_square_root_are_verified() -> None:
    assert certify(Tableau.loads(GAUSS)).equations == 1
    assert certified(GAUSS, "rk") == [(4, "ball")]
    assert certified(GAUSS.replace("sqrt(3)", f"sqrt(3 + {INVISIBLE})"), "rk") == []


def test_combinations_with_coefficients_of_many_digits_are_verified() -> None:
    many = COMPOSITION.replace('b2 = "1 - 2*b1"', 'b2 = "1 - 2*b1 + 0*b1/0.123456789012345678901234567891"')
    assert certified(many, "vcg") == [(4, "ball")]
    scaled = COMPOSITION.replace("b1 = ", "k = ").replace(
        'b2 = "1 - 2*b1"',
        'm = "123456789012345678901234567/1000", b1 = "k + m*(k - 1) - m*(k - 1)", b2 = "1 - 2*b1"',
    )
    assert certified(scaled, "vcg") == [(4, "ball")]


def midpoint(digits: str, pins: str = "") -> str:
    return (
        f'name = "m"\nfamily = "rk"\nA = [["a"]]\nb = ["1"]\nnumbers = {{ a = "{digits}~" }}\n'
        f'[proof]\nconditions = "rk"\norder = 2\n{pins}[claims]\nrk = 2\n'
    )


def test_pins_that_name_every_decimal_are_a_message() -> None:
    report = check(Tableau.loads(midpoint("0.50000000", 'pins = ["a"]\n')))
    assert report.verdict == "fails"
    assert report.broken_claims[0].startswith('no proof: every decimal is in the list "pins"')
    assert report.orders[0].certificate == "decimal"


@pytest.mark.parametrize("digits", ["0.5", "0.50", "0.5000000000000000000000000"])
def test_digits_that_are_the_solution_rounded_hold(digits: str) -> None:
    assert check(Tableau.loads(midpoint(digits))).verdict == "holds"


@pytest.mark.parametrize(("digits", "right"), [("0.4", "0.5"), ("0.499", "0.500"), ("0.6", "0.5")])
def test_digits_that_are_not_the_solution_rounded_fail(digits: str, right: str) -> None:
    report = check(Tableau.loads(midpoint(digits)))
    assert report.verdict == "fails"
    (broken,) = report.broken_claims
    assert broken.startswith(
        f"the decimal a = {digits}~ is not correctly rounded: the solution rounds to {right}~"
    )


def test_embedded_orders_carry_a_certificate() -> None:
    embedded = check("dormand_prince5", "rk").embedded
    assert embedded is not None
    assert embedded.as_json()["certificates"] == {"rk": "exact"}
    rounded = midpoint("0.3").replace("[proof]", '[embedded]\nb = ["0.9999999999~"]\norder = 1\n[proof]')
    found = check(Tableau.loads(rounded.partition("[proof]")[0])).embedded
    assert found is not None
    assert found.certificates == {"rk": "decimal"}


def test_an_order_beyond_the_search_is_decided_by_theorem_and_one_condition() -> None:
    for family in ("vrkmk(4)", "rkmk(4)"):
        (found,) = check("gauss4", family).orders
        assert (found.order, found.certificate, found.limit) == (7, "exact", None)
        assert found.failing[0].condition.order == 8
