"""Sentences that compare a method with all others: what was searched, and the tableaux of the library.

The sentences are in README.md, docs/ and tableaux/; tests/claims.toml lists them. A comparison with the
library reads every tableau in the family of the sentence, from whatever format its file has.
"""

import math
import re
import tomllib
from functools import cache
from pathlib import Path

import pytest

from orderconds import Tableau, check, families
from orderconds.errors import InputError
from orderconds.tableau import available, find

ROOT = Path(__file__).parents[1]
CLAIMS = tomllib.loads((ROOT / "tests" / "claims.toml").read_text(encoding="utf-8"))["claim"]
PAGES = ("README.md", "docs/**/*.md", "benchmarks/README.md", "tableaux/**/*.toml")
WRITTEN = ("docs/reference/commands.md", "docs/reference/api.md")
"""Pages that the program writes: helps and docstrings."""

KIND = r"(?:method|tableau|scheme|proof)\w*"
PHRASES = re.compile(
    rf"\b(?:no other (?:known )?{KIND}|no commutator-free {KIND}|new {KIND} (?:of|with)|new methods"
    rf"|(?:is|are) the fastest (?:structure-preserving|published|explicit|implicit) {KIND}|fastest published"
    rf"|the smallest (?:pair|{KIND})|smaller than (?:all|every|any)|better than (?:all|every|any)"
    r"|needs? at least|than order \w+ needs|errors? \d\.\d+"
    r"|(?:error norm|principal error)(?: times s\^\d)?,? (?:is )?[\d.]*\d"
    rf"|the only (?:known )?{KIND}|the only commutator-free|novel\w*"
    rf"|(?:is|are) not known|no {KIND} (?:with|of)|(?:the )?first {KIND} (?:of|with|to|that)"
    r"|fewest|least (?:principal )?(?:error|bound)|the best of|, the least|minimum number|state of the art"
    r"|unprecedented|in the literature|in print)\b",
    re.IGNORECASE,
)
SUPPORTS = ("library", "test", "theorem", "measured", "norms")


def plain(text):
    """Prose without the marks of comments and without line breaks."""
    return re.sub(r"\s+", " ", re.sub(r"(?m)^# ?", "", text))


@cache
def page(name):
    return plain((ROOT / name).read_text(encoding="utf-8"))


def unsupported(name, text, claims):
    """The sentences of a page that no entry of the list supports."""
    spans = []
    for claim in claims:
        if claim["file"] == name:
            spans += [m.span() for m in re.finditer(re.escape(claim["text"]), text)]
    return [
        text[max(0, m.start() - 60) : m.end() + 60]
        for m in PHRASES.finditer(text)
        if not any(start <= m.start() and m.end() <= end for start, end in spans)
    ]


def test_every_comparison_with_all_methods_is_listed():
    names = [p.relative_to(ROOT).as_posix() for pattern in PAGES for p in sorted(ROOT.glob(pattern))]
    found = {n: s for n in names if n not in WRITTEN and (s := unsupported(n, page(n), CLAIMS))}
    assert not found, f"{found}: add each sentence to tests/claims.toml with what was searched"


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim["text"][:40])
def test_entries_are_in_use_and_name_their_support(claim):
    assert claim["text"] in page(claim["file"])
    assert PHRASES.search(claim["text"])
    assert claim["searched"]
    assert sum(key in claim for key in SUPPORTS) == 1
    if "test" in claim:
        path, function = claim["test"].split("::")
        assert f"def {function}(" in (ROOT / path).read_text(encoding="utf-8")
    for name in claim.get("library", {}).get("named", ()):
        assert f"`{name}`" in page(claim["file"])
    if "measured" in claim:
        assert f"({claim['measured'].removeprefix('docs/').join(('../', ''))})" in page(claim["file"])
        picture = (ROOT / claim["measured"]).read_text(encoding="utf-8")
        assert all(f">{label}<" in picture for label in claim["labels"])
    if "theorem" in claim:
        assert re.search(r"[12]\d{3}", claim["theorem"])
        assert claim["theorem"] in page(claim["file"])


def refutations(family, order, stages, least_error=None, named=()):
    """The tableaux of the library that refute a claim: they have this number of stages and this order in the
    family, and a smaller error. Without ``least_error`` every tableau of this order refutes the claim. The
    tableaux ``named`` are exceptions that the sentence names."""
    reader = families.get(family)
    errors = {}
    for name in available():
        tableau = Tableau.load(find(name))
        method = reader.read(tableau)
        highest = max(claim.order for claim in tableau.claims.orders)
        if name in named or highest < order or getattr(method, "s", None) != stages:
            continue
        try:
            result = check(tableau, family=family, order=order).orders[0]
        except InputError:  # a weight is zero, and the family divides by it
            continue
        if result.order >= order:
            errors[name] = 0.0 if result.order > order else result.error_norm
    bound = errors.pop(least_error) if least_error else float("inf")
    return {name: error for name, error in errors.items() if error < bound}


COMPARED = {repr(claim["library"]): claim["library"] for claim in CLAIMS if "library" in claim}


@pytest.mark.slow
@pytest.mark.parametrize("wanted", COMPARED)
def test_no_tableau_of_the_library_refutes_a_claim(wanted):
    assert not refutations(**COMPARED[wanted])


@pytest.mark.slow
def test_false_claims_are_refuted():
    """Commutator-free methods of order 3 with three stages are in two formats of the library. Those of order
    5 and more with nine stages include a tableau (A, b) and a composition."""
    assert {"cf3", "luescher3", "cg3"} <= set(refutations("cf", 3, 3))
    assert {"cg5", "triple_jump6"} <= set(refutations("cf", 5, 9))
    assert set(refutations("vcf", 4, 2, least_error="vcf_gauss2")) == {"vcf4_s2"}


NORMS = [claim for claim in CLAIMS if "norms" in claim]


@cache
def principal_error(name, family, order):
    """The 2-norm of the residuals that ``solve --minimise error`` minimises, and the number of stages."""
    tableau = Tableau.load(find(name))
    reader = families.get(family)
    method = reader.read(tableau)
    residuals = reader.principal_residuals(method, tableau.ring, order + 1)
    return math.hypot(*(tableau.ring.nearest_float(x) for x in residuals)), method.s


@pytest.mark.parametrize("claim", NORMS, ids=lambda claim: claim["text"][:40])
def test_error_norms_are_those_of_the_tableaux(claim):
    """The digits are those of the norm of the residuals of the next order, times s^power."""
    for name, digits in claim["norms"].items():
        assert digits in claim["text"]
        assert name == claim.get("tableau") or f"`{name}`" in claim["text"] or name in claim.get("meant", ())
        error, stages = principal_error(name, claim["family"], claim["order"])
        places = len(digits.partition(".")[2])
        assert abs(error * stages ** claim.get("power", 0) - float(digits)) <= 0.51 * 10.0**-places


def test_the_table_of_ensembles_supports_its_sentence():
    """The table in benchmarks/README.md: published tableaux are those that ``solve`` did not find."""
    text = (ROOT / "benchmarks" / "README.md").read_text(encoding="utf-8")
    times = {
        name: float(time)
        for name, time in re.findall(
            r"(?m)^\| driven_spin \| (\w+) \| (?:2N|all stages) \|.* ([\d.]+) \|$", text
        )
    }
    published = {n for n in times if not Tableau.load(find(n)).source.startswith("orderconds solve")}
    assert {"yan5", "berland4", "carpenter_kennedy4", "cf4"} <= published
    ratio = times["cf5_2n_s10"] / min(times[n] for n in published)
    assert f"needs {ratio:.2f} of the time of the fastest published method" in page("benchmarks/README.md")


def test_sentences_without_an_entry_are_found():
    text = "This scheme has the fewest stages. No other method of order 5 does."
    assert len(unsupported("x", text, [])) == 2
    (found,) = unsupported("x", text, [{"file": "x", "text": "has the fewest stages"}])
    assert "No other method" in found
