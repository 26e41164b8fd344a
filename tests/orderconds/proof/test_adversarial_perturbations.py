"""Random perturbations of proved files: no certificate is about a false order.

The judge is a second evaluation: the solution is enclosed to 4096 bits, and every condition up to the
certified order is evaluated there. Perturbations have at least 10^-160, far above that precision and far
below the 256 bits with which certificates are computed.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from random import Random

import pytest
from flint import fmpz

from orderconds import check, families
from orderconds.errors import InputError
from orderconds.proof.certificate import certify
from orderconds.proof.krawczyk import NotProved
from orderconds.ring import Balls
from orderconds.tableau import Tableau, find

BITS = 4096

TRIPLE_JUMP = """name = "jump"
family = "rk"
A = [["b1/2"], ["b1", "b2/2"], ["b1", "b2", "b1/2"]]
b = ["b1", "b2", "b1"]
numbers = { b1 = "1.351207191959657634047687808971460826921999~", b2 = "1 - 2*b1" }
[proof]
conditions = "vcg"
order = 4
reduction = "spelling"
"""

GAUSS = """name = "gauss"
family = "rk"
A = [["1/4", "1/4 - r/6"], ["1/4 + r/6", "1/4"]]
b = ["w", "1 - w"]
numbers = { w = "0.500000000000000000~", r = "sqrt(3)" }
[proof]
conditions = "rk"
order = 4
reduction = "spelling"
"""

KUTTA = """name = "kutta"
family = "rk"
A = [[], ["1/2"], ["x", "y"]]
b = ["p", "q", "1 - p - q"]
[numbers]
x = "-1.00000000000000000000~"
y = "2.00000000000000000000~"
p = "0.16666666666666666667~"
q = "0.66666666666666666667~"
[proof]
conditions = "rk"
order = 3
pins = ["x"]
"""

RADICALS = """name = "radicals"
family = "rk"
A = [["1/2 + z - 0.0001 + r - s"]]
b = ["1 + t*(r - s)"]
numbers = { z = "0.0001~", r = "sqrt(3)", s = "sqrt(3)", t = "sqrt(2)" }
[proof]
conditions = "rk"
order = 2
reduction = "spelling"
"""


def library(name: str) -> str:
    """Return a file of the library without its claims."""
    return re.sub(r"(?m)^\[claims\]\n(.+\n)*", "", find(name).read_text(encoding="utf-8"))


FILES: dict[str, tuple[str, tuple[str, ...]]] = {
    "jump": (TRIPLE_JUMP, ("vcg", "cg", "rk", "sprk")),
    "gauss": (GAUSS, ("rk", "sprk", "cg")),
    "kutta": (KUTTA, ("rk", "cg", "rkmk(1)")),
    "radicals": (RADICALS, ("rk",)),
    "cg4a": (library("cg4a"), ("cg", "rk")),
    "yoshida6": (library("yoshida6"), ("composition",)),
    "carpenter_kennedy4": (library("carpenter_kennedy4"), ("rk", "cf")),
    "vcf4_s2": (library("vcf4_s2"), ("cf", "rk")),
}
"""Proved files, and the families in which they are checked."""

KNOWN = {"jump": 4, "gauss": 4, "kutta": 3, "radicals": 2, "cg4a": 4, "yoshida6": 6, "vcf4_s2": 4}

COEFFICIENT = re.compile(r'"([^"\n]*\d[^"\n]*|[a-z]\w?(?:/2)?)"')


def coefficients(text: str) -> list[re.Match[str]]:
    """Return the quoted coefficients of a file: those above its [proof] table, without names and sources."""
    end = text.index("[proof]") if "[proof]" in text else len(text)
    plain = re.compile(r"[-+*/^()~.\w\s]+")
    found = [m for m in COEFFICIENT.finditer(text, 0, end) if plain.fullmatch(m[1])]
    keys = ("name", "family", "source", "bibtex", "base", "minpoly", "near", "note")
    lines = {m: text[text.rfind("\n", 0, m.start()) + 1 : m.start()] for m in found}
    return [m for m in found if not lines[m].lstrip().startswith(keys)]


def with_added(text: str, place: re.Match[str], term: str) -> str:
    return f"{text[: place.start(1)]}({place[1]}) + {term}{text[place.end(1) :]}"


def tiny_multiple(generator: Random) -> str:
    """Return a multiple of primes, among them those in use elsewhere, over a power of ten."""
    primes = [2147483647, 2147483587, 2147483629, 2**61 - 1]
    factor = generator.choice([1, 2147483647 * 2147483587])
    for _ in range(generator.randrange(3)):
        drawn = fmpz(generator.getrandbits(61) | 1)
        while not drawn.is_prime():
            drawn += 2
        factor *= generator.choice([*primes, int(drawn)])
    return f"{factor}/1{'0' * generator.randrange(85, 160)}"


def multiple_of_moduli(text: str, generator: Random) -> str:
    return with_added(text, generator.choice(coefficients(text)), tiny_multiple(generator))


def invisible_slope(text: str, generator: Random) -> str:
    names = re.findall(r'([a-z]\w*) = "[^"]*~"', text) or ["1"]
    term = f"{generator.choice(names)}^{generator.randrange(1, 4)}*{tiny_multiple(generator)}"
    return with_added(text, generator.choice(coefficients(text)), term)


def wrong_digit(text: str, generator: Random) -> str:
    decimals = [m for m in coefficients(text) if "~" in m[1]]
    if not decimals:
        return text
    place = generator.choice(decimals)
    at = generator.choice([i for i in range(*place.span(1)) if text[i].isdigit()])
    return text[:at] + str(generator.randrange(10)) + text[at + 1 :]


def fewer_digits(text: str, generator: Random) -> str:
    decimals = [m for m in coefficients(text) if re.fullmatch(r"-?\d+\.\d{3,}~", m[1])]
    if not decimals:
        return text
    place = generator.choice(decimals)
    kept = generator.randrange(place[1].index(".") + 2, len(place[1]))
    return f"{text[: place.start(1)]}{place[1][:kept]}~{text[place.end(1) :]}"


def other_pins(text: str, generator: Random) -> str:
    names = re.findall(r'([a-z]\w*) = "[^"]*~"', text)
    pins = generator.sample(names, generator.randrange(len(names) + 1))
    spelled = "pins = [" + ", ".join(f'"{name}"' for name in pins) + "]\n"
    return re.sub(r"(?m)^pins = .*\n", "", text).replace("[proof]\n", f"[proof]\n{spelled}")


def other_reduction(text: str, generator: Random) -> str:
    reduction = generator.choice(["spelling", "symmetric", "low-storage", None])
    line = f'reduction = "{reduction}"\n' if reduction else ""
    return re.sub(r"(?m)^reduction = .*\n", "", text).replace("[proof]\n", f"[proof]\n{line}")


def other_order(text: str, generator: Random) -> str:
    return re.sub(r"(?m)^order = \d", f"order = {generator.randrange(1, 6)}", text, count=1)


def other_family(text: str, generator: Random) -> str:
    family = generator.choice(["rk", "cg", "sprk", "cf", "rkmk(1)"])
    return re.sub(r'conditions = "[^"]*"', f'conditions = "{family}"', text)


def dependent_unknown(text: str, generator: Random) -> str:
    """Split a decimal in two, of which the equations see the sum alone."""
    decimals = [m for m in coefficients(text) if re.fullmatch(r"-?\d+\.\d+~", m[1])]
    if not decimals:
        return text
    place = generator.choice(decimals)
    other = f"0.{'0' * generator.randrange(1, 40)}1~"
    scale = generator.choice(["1", "0", tiny_multiple(generator)])
    return f"{text[: place.start(1)]}{place[1]} + {scale}*{other}{text[place.end(1) :]}"


PERTURBATIONS: list[Callable[[str, Random], str]] = [
    multiple_of_moduli,
    multiple_of_moduli,
    invisible_slope,
    wrong_digit,
    fewer_digits,
    other_pins,
    other_reduction,
    other_order,
    other_family,
    dependent_unknown,
]


def falsified(tableau: Tableau, family: str, order: int) -> list[str]:
    """Return the conditions up to ``order`` that the solution of the file's equations does not meet."""
    if tableau.proof is not None:
        with suppress(NotProved):
            tableau = certify(tableau, BITS).tableau
    if not isinstance(tableau.ring, Balls):
        return []
    read = families.get(family)
    method = read.read(tableau)
    assert method is not None
    conditions = [c for n in range(1, order + 1) for c in read.decisive_conditions(n)]
    residuals = read.residuals(method, tableau.ring, conditions)
    return [c.tree for c, x in zip(conditions, residuals, strict=True) if not x.value.contains(0)]


def examined(seed: int) -> bool:
    """Draw one perturbation, assert that no certificate is false, and say whether there was one."""
    generator = Random(seed)
    name = generator.choice(sorted(FILES))
    text, checked = FILES[name]
    for _ in range(generator.randrange(1, 3)):
        text = generator.choice(PERTURBATIONS)(text, generator)
    try:
        tableau = Tableau.loads(text)
        found = [f for family in checked for f in check(tableau, family).orders]
    except InputError:
        return False
    certified = [f for f in found if f.certificate in ("exact", "ball") and f.order]
    for order in certified:
        assert falsified(tableau, order.family, order.order) == [], (seed, order.family, order.order, text)
    return any(f.certificate == "ball" for f in certified)


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_files_are_certified_where_nothing_is_changed(name: str) -> None:
    text, checked = FILES[name]
    (found,) = check(Tableau.loads(text), checked[0]).orders
    assert (found.order, found.certificate) == (KNOWN[name], "ball")


LONG = (4, 17)
"""Seeds whose files take seconds and have no certificate."""


def test_no_certificate_of_a_perturbed_file_is_false() -> None:
    proved = sum(examined(seed) for seed in range(60) if seed not in LONG)
    assert proved > 5  # else the files were broken, and nothing was tested


@pytest.mark.slow
def test_no_certificate_of_many_perturbed_files_is_false() -> None:
    proved = sum(examined(seed) for seed in (*LONG, *range(1000, 3000)))
    assert proved > 200
