"""The sources are in plain English: no phrase, no word and no name that was replaced comes back.

Prose is: docstrings, comments and strings of both packages (messages and help are strings), the templates
with their emitted text, README, CONTRIBUTING and docs. Names are those of modules, templates, classes,
functions, arguments and variables.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("orderconds", "codegen")
PAGES = (
    "README.md",
    "CONTRIBUTING.md",
    *sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "docs").rglob("*.md")),
)

SHORTEN = "Shorten the critical path after each function call."
PHRASES = {
    "what waits for a function's value": SHORTEN,
    "is written so that it waits as little as it can": SHORTEN,
    "what a run of many steps puts off": "Flows deferred across steps.",
    "what a run puts off": "flows deferred across steps",
    "in how many sweeps fixed points must": "Accept fixed-point iteration if ...",
    "more than so many unknowns": "above MANY unknowns",
    "and is younger": "and was created after its inputs",
    "as what is computed from it must be": "and was created after its inputs",
    "what cannot be read is told": "Report unreadable files and continue.",
    "keep as it is what": "step-constant subexpressions of the matrix are not expanded",
    "whose momentum it is": "The frame of the momentum.",
    "is known to no": "has no correct digit",
    "it holds or was done": "success",
    "wishes that make no sense": "contradictory options",
    "certificates exact or ball, but of those": "Require an exact or ball certificate ...",
    "answered wrongly without a word": "silent wrong answers",
    "without a word": "silent",
    "say what held": "Stress-test emitted steps on stiff and extreme inputs",
    "depend on the others at the decimals": "only M of the N conditions are independent near the decimals",
    "owe nothing to the manifold": "do not preserve the manifold",
    "the order of things turns round": "If the fast part has an exact flow, the ranking reverses.",
    "how the first of some steps begins": "Apply the first flow of a step, unless ...",
    "of a state with the other": "Convert body momentum to space momentum.",
}
"""A phrase, or the part of it that every form has, and what to write instead."""

ARRAY = r"""TableauError\(f"a value of type \{"""
"""The message on NumPy arrays; instead: NumPy arrays are not accepted here; pass nested lists."""

WORDS = {
    r"told": "reported, or the noun",
    r"spell(s|ed|ing|ings)": "render, format, write",
    r"stands": "is",
    r"anew": "again; recompute",
    r"so many": "the number, N",
    r"put(s|ting)? off": "defer",
    r"wish(es|ed)?": "options, specification",
    r"chords?": "simplified Newton",
    r"written out": "expanded in stages",
}
"""A word as a pattern, and what to write instead."""

MODULES = {
    "codegen": {
        "late": "critical_path",
        "put_off": "deferred_flows",
        "pieces": "outlined functions",
        "trees": "repeated_trees",
        "fewest": "minimal_brackets",
        "variants": "column_choice",
        "frames": "carried_momentum",
        "frame": "body_frame",
        "sharing": "value_numbering",
        "signs": "shared_negatives",
        "merge": "equal_unknowns",
        "meaning": "equivalence",
        "scalars": "hoist_scalars",
        "factor": "factor_linear",
        "zeros": "fold_zeros",
        "gather": "collect_constants",
        "normal": "normal_form",
        "chain": "angle_depth",
        "arrange": "schedule",
        "layout": "identifiers",
        "setting": "problem",
        "emission": "artifact",
        "kept": "invariants",
        "remembered": "measurement_cache",
        "records": "measurement_cache",
        "straight": "straight_line_field",
        "journal": "measurement_cache",
        "protocol": "base",
        "spelling": "render or format",
    },
    "orderconds": {
        "served": "claimable families",
        "written_out": "expand_stages",
        "once": "memo",
        "wishes": "spec",
        "finish": "certify_solution",
        "layouts": "parametrise",
        "spelling": "render or format",
    },
}
"""Names of modules and templates, and the better name."""

NAMES = {
    "put_off": "deferred",
    "piece": "function",
    "pieces": "functions",
    "setting": "problem",
    "view": "problem",
    "emission": "artifact",
    "served": "claimable",
    "written_out": "expand_stages",
    "once": "memo",
    "wishes": "spec",
    "spelled": "rendered, text",
    "spelling": "render, format",
    "told": "reported, summary",
    "anew": "recomputed",
    "joint": "a precise noun",
    "chord": "simplified_newton",
    "chords": "simplified_newton",
    "do": "b",
}
"""Words of identifiers (``put_off`` occurs in ``put_off_flows`` and ``PutOff``), and the better name."""

PARTICIPLES = {"made": "a precise noun", "found": "a precise noun"}
"""Names that say how a value came about and not what it is."""

WHOLE = frozenset({"once", "view", "do", "served", *PARTICIPLES})
"""Names that are ordinary words within longer names; these are sought as whole identifiers."""

CONTRACT = {
    ("orderconds/errors.py", "found"): "InputError: what was found, where, what was expected, what to do",
}
"""Identifiers that stay, and why."""

Text = tuple[int, str]
"""A piece of prose and the line it begins in."""


def prose(source: str) -> Iterator[Text]:
    """Yield docstrings, strings and blocks of comments of a Python source."""
    tree = ast.parse(source)
    formatted = [node for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)]
    parts = {id(value) for node in formatted for value in node.values}
    for string in formatted:
        values = [v.value if isinstance(v, ast.Constant) else "{}" for v in string.values]
        yield string.lineno, "".join(map(str, values))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in parts:
            yield node.lineno, node.value
    block: list[Text] = []
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            if block and token.start[0] != block[-1][0] + 1:
                yield block[0][0], "\n".join(text for _, text in block)
                block = []
            block.append((token.start[0], token.string.lstrip("# ")))
    if block:
        yield block[0][0], "\n".join(text for _, text in block)


FORMAT = re.compile(r"""``spelling``|reduction = ["']spelling["']|\Aspelling\Z""")
"""A value of the file format, which stays: ``reduction = "spelling"`` in the proof of a tableau."""


def occurrences(texts: Iterable[Text], patterns: Iterable[str]) -> Iterator[tuple[int, str]]:
    """Yield line and pattern wherever one of ``patterns`` matches whole words, across line breaks too."""
    wanted = [(p, re.compile(r"\b" + p.replace(" ", r"\s+") + r"\b", re.IGNORECASE)) for p in patterns]
    for line, text in texts:
        plain = FORMAT.sub("", text).replace("`", "").replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
        for pattern, compiled in wanted:
            for match in compiled.finditer(plain):
                yield line + plain.count("\n", 0, match.start()), pattern


@cache
def sources() -> dict[str, str]:
    """The text of every Python file of both packages, by path."""
    return {
        path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
        for package in PACKAGES
        for path in sorted((ROOT / package).rglob("*.py"))
    }


@cache
def all_prose() -> dict[str, list[Text]]:
    """The prose of the repository, by file."""
    result = {path: list(prose(text)) for path, text in sources().items()}
    templates = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.j2"))]
    for path in [*templates, *(ROOT / page for page in PAGES)]:
        result[path.relative_to(ROOT).as_posix()] = [(1, path.read_text(encoding="utf-8"))]
    return result


def hits(patterns: dict[str, str]) -> list[str]:
    return [
        f"{path}:{line}: {pattern!r}; better: {patterns[pattern]}"
        for path, texts in all_prose().items()
        for line, pattern in sorted(occurrences(texts, patterns))
    ]


def identifiers(source: str) -> Iterator[tuple[int, str]]:
    """Yield line and name of everything a source defines: classes, functions, arguments, variables."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                yield node.lineno, node.name
            case ast.arg():
                yield node.lineno, node.arg
            case ast.Name(ctx=ast.Store()) | ast.Attribute(ctx=ast.Store()):
                yield node.lineno, node.id if isinstance(node, ast.Name) else node.attr
            case ast.MatchAs(name=str(name)) | ast.MatchStar(name=str(name)):
                yield node.lineno, name


@cache
def defined(source: str) -> list[tuple[int, str]]:
    """Return the sorted identifiers of a source; two tests read those of all modules."""
    return sorted(set(identifiers(source)))


def words(identifier: str) -> str:
    """Return an identifier in snake case, between underscores: ``_put_off_`` for PutOff."""
    return "_" + re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", identifier).lower().strip("_") + "_"


def replaced(identifier: str, names: Iterable[str]) -> str | None:
    """Return the name among ``names`` that an identifier contains, if any."""
    for name in names:
        if words(identifier) == f"_{name}_" or (name not in WHOLE and f"_{name}_" in words(identifier)):
            return name
    return None


def replaced_names(path: str, source: str, names: Mapping[str, str]) -> list[str]:
    return [
        f"{path}:{line}: {name}; better: {names[old]}"
        for line, name in defined(source)
        if (old := replaced(name, names)) is not None and (path, old) not in CONTRACT
    ]


def replaced_module(path: str) -> str | None:
    """Return the better name of a module or template with a replaced name, also of a folder."""
    package, *folders = path.split("/")
    for part in folders:
        if (better := MODULES[package].get(part.partition(".")[0])) is not None:
            return better
    return None


def test_no_replaced_phrase_occurs() -> None:
    assert hits(PHRASES) == []


def test_no_word_occurs_that_a_term_replaced() -> None:
    assert hits(WORDS) == []


def test_the_message_on_arrays_says_what_to_pass() -> None:
    assert [path for path, text in sources().items() if re.search(ARRAY, text)] == []


def test_no_module_or_template_has_a_replaced_name() -> None:
    paths = [
        p.relative_to(ROOT).as_posix()
        for package in PACKAGES
        for pattern in ("*.py", "*.j2")
        for p in sorted((ROOT / package).rglob(pattern))
    ]
    assert [f"{path}; better: {replaced_module(path)}" for path in paths if replaced_module(path)] == []


def test_no_identifier_has_a_replaced_name() -> None:
    assert [hit for path, text in sources().items() for hit in replaced_names(path, text, NAMES)] == []


def test_no_variable_is_named_made_or_found() -> None:
    assert [hit for path, text in sources().items() for hit in replaced_names(path, text, PARTICIPLES)] == []


@pytest.mark.parametrize("phrase", PHRASES)
def test_each_phrase_is_found_in_any_form(phrase: str) -> None:
    broken = phrase.replace(" ", "\n    ", 1)
    for source in (
        f'"""{phrase.capitalize()}."""',
        f'def f():\n    """Say.\n\n    {broken} in a method.\n    """',
        f'raise ValueError(f"{{x}} {phrase} {{y}}")',
        'x = ("' + phrase.replace(" ", ' "\n"', 1) + '")',
        "# " + phrase.replace(" ", "\n# ", 1),
    ):
        assert list(occurrences(prose(source), [phrase])), source


def test_a_value_of_the_file_format_is_no_prose() -> None:
    for text in ("spelling", 'reduction = "spelling"', "the reduction ``spelling``"):
        assert list(occurrences([(1, text)], WORDS)) == []
    assert list(occurrences([(1, "the spelling of a name")], WORDS)) != []


def test_an_occurrence_has_its_line() -> None:
    source = '"""One.\n\nTwo is told.\n"""\n\nx = 1  # made\n# told, and\n# so\n# many\n'
    assert sorted(occurrences(prose(source), ["told", "so many"])) == [
        (3, "told"),
        (7, "told"),
        (8, "so many"),
    ]


@pytest.mark.parametrize(
    "text",
    ["It is told.", "It spells them.", "Spelled so", "computed anew", "puts off", "so\nmany", "it stands"],
)
def test_each_word_is_found(text: str) -> None:
    assert len(list(occurrences([(1, text)], WORDS))) == 1


@pytest.mark.parametrize("text", ["untold", "standstill", "renewal", "misspelling", "so much", "put it off"])
def test_parts_of_other_words_are_not_found(text: str) -> None:
    assert list(occurrences([(1, text)], WORDS)) == []


@pytest.mark.parametrize(
    "source",
    [
        "class PutOff: pass",
        "def put_off_flows(): pass",
        "def f(setting): pass",
        "for piece in x: pass",
        "told = 1",
        "_spelled: int = 2",
        "if (found := f()): pass",
        "self.chord_matrix = 1",
        "[made for made in x]",
        "match x:\n case [view]: pass",
    ],
)
def test_a_replaced_identifier_is_found(source: str) -> None:
    assert replaced_names("codegen/example.py", source, NAMES | PARTICIPLES) != []


@pytest.mark.parametrize(
    "source", ["problem = 1", "not_found = 1", "f(found=1)", "overview = 1", "settings = 1", "x.found"]
)
def test_other_identifiers_are_free(source: str) -> None:
    assert replaced_names("codegen/example.py", source, NAMES | PARTICIPLES) == []


def test_a_replaced_module_is_found_in_its_package_only() -> None:
    assert replaced_module("codegen/kernel/late.py") == "critical_path"
    assert replaced_module("codegen/templates/c/put_off.c.j2") == "deferred_flows"
    assert replaced_module("orderconds/solve/wishes.py") == "spec"
    assert replaced_module("orderconds/commands/trees.py") is None
    assert replaced_module("codegen/kernel/repeated_trees.py") is None


def test_prose_has_every_source_of_text() -> None:
    kinds = {Path(path).suffix for path in all_prose()}
    assert kinds == {".py", ".j2", ".md"}
    assert len(all_prose()) > 300
