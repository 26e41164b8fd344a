"""Whatever a tableau file holds, it is read and checked or refused: no traceback and no hang."""

from __future__ import annotations

import random
from contextlib import suppress
from datetime import timedelta

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orderconds import Tableau
from orderconds.checking import check
from orderconds.errors import InputError
from orderconds.tableau import available, find

SOURCES = [find(name).read_text(encoding="utf-8") for name in available() if "6" not in name]
INVALID = [
    "9^9^9^9",
    "1/0",
    "1/(1 - 1)",
    "(" * 60,
    "sqrt(-1)",
    "2^(1/25)",
    "10^64^2",
    "1e400",
    "nan",
    "~",
    "0.~",
    "-" * 500 + "1",
    "sqrt(" * 30 + "2" + ")" * 30,
    "x",
    "os.system('x')",
    "9" * 1999,
    "(1 + 2^(1/23))^64",
    "²",
    "\u0000",
]
KEYS = [
    "A",
    "b",
    "c",
    "family",
    "name",
    "numbers",
    "claims",
    "embedded",
    "proof",
    "stage",
    "update",
    "gamma",
    "base",
]
VALUES = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=6),
        st.sampled_from([*INVALID, "rk", "cf", "1/2", "symmetric-2"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.sampled_from(KEYS), inner, max_size=3)
    ),
    max_leaves=6,
)
QUICK = settings(
    deadline=timedelta(seconds=20), suppress_health_check=[HealthCheck.too_slow], max_examples=150
)


def read_or_refused(text: str) -> None:
    """Read and check; only InputError may come out of it."""
    with suppress(InputError):
        tableau = Tableau.loads(text)
        for claim in tableau.claims.orders[:3]:
            if claim.order <= 4 and (claim.cutoff or 0) <= 4:
                check(tableau, family=claim.label)
        if not tableau.claims.orders:
            check(tableau)


def toml(value: object) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, str):
        return '"' + "".join(f"\\u{ord(c):04x}" if ord(c) < 65536 else "?" for c in value) + '"'
    if isinstance(value, bool):
        return str(value).lower()
    return "0" if value is None else repr(value)


@QUICK
@given(st.dictionaries(st.sampled_from(KEYS), VALUES, max_size=6))
def test_any_keys_and_values(data: dict[str, object]) -> None:
    read_or_refused("\n".join(f"{key} = {toml(value)}" for key, value in data.items()))


@QUICK
@given(st.text(max_size=300))
def test_any_text(text: str) -> None:
    read_or_refused(text)


@QUICK
@given(st.sampled_from(SOURCES), st.randoms(use_true_random=False), st.sampled_from(INVALID))
def test_a_good_file_with_a_bad_coefficient(text: str, numbers: random.Random, bad: str) -> None:
    quoted = [i for i, part in enumerate(text.split('"')) if i % 2]
    parts = text.split('"')
    parts[numbers.choice(quoted)] = bad.replace("\u0000", "\\u0000")
    read_or_refused('"'.join(parts))


def test_decimals_without_digits_among_quotients_are_read_or_refused() -> None:
    """What is known to no digit decides nothing, and its spelling divides by a sum: no polynomial."""
    parts = find("vcf4_s2").read_text(encoding="utf-8").split('"')
    for i in (i for i, part in enumerate(parts) if i % 2 and part.endswith("~")):
        read_or_refused('"'.join([*parts[:i], "0.~", *parts[i + 1 :]]))


@QUICK
@given(st.sampled_from(SOURCES), st.randoms(use_true_random=False))
def test_a_good_file_with_a_piece_cut_out_moved_or_doubled(text: str, numbers: random.Random) -> None:
    i, j = sorted(numbers.randrange(len(text) + 1) for _ in range(2))
    changed = numbers.choice(
        (text[:i] + text[j:], text[:i] + text[i:j] * 2 + text[j:], text[i:j] + text[:i] + text[j:])
    )
    read_or_refused(changed)


def test_numbers_of_thousands_of_digits_are_spelled() -> None:
    huge = "9" * 1999
    exact = f'name = "t"\nfamily = "rk"\nA = [[], ["{huge}"]]\nb = ["{huge}", "{huge}"]\n'
    for text in (exact, exact.replace('"]', '~"]', 1)):
        report = check(Tableau.loads(text), family="rk", order=3)
        assert report.verdict == "fails"
        assert report.orders[0].failing[0].residual
