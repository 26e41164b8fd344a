"""Measure the structure of both packages and fail if a limit is exceeded.

The script reads source files and imports none of them. It prints a table of figures, then one line for each
violation, and exits with status 1 if there is one.

    python .ci/structure.py            the table and the violations
    python .ci/structure.py --files    also, for each file, the counts behind the totals
    python .ci/structure.py --json     figures and violations as JSON

Complexity is McCabe's number as ruff's rule C901 counts it: one plus the branches, loops, exception handlers
and match cases of a function, with those of the functions inside it.

The import graph has an edge for each import statement, also for one inside a function. An import below
``if TYPE_CHECKING:`` never runs, so it cannot close a circle; the table counts it separately. Imports by name
(``import_module``, ``orderconds.lazy``) are not seen.
"""

from __future__ import annotations

import argparse
import ast
import io
import json
import re
import sys
import tokenize
from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

PACKAGES = ("orderconds", "codegen")
CORE = tuple(f"codegen/{room}" for room in ("lower", "passes", "kernel", "run", "printers", "ir"))
"""The folders whose comment density is measured."""


@dataclass(frozen=True)
class Limits:
    """The largest values allowed. ``density`` is the range of the comment density of the core, in percent."""

    function_lines: int = 60
    complexity: int = 15
    module_lines: int = 500
    any_lines: int = 199
    type_ignores: int = 14
    circles: int = 0
    density: tuple[float, float] = (8.0, 15.0)


Function = ast.FunctionDef | ast.AsyncFunctionDef

REASON = re.compile(r"#.*\bcomplexity: \S")
ANY = re.compile(r"\bAny\b")
TYPE_IGNORE = re.compile(r"#\s*type:\s*ignore")
MARKER = re.compile(r"#\s*(noqa|type:\s*ignore|pragma|fmt:|complexity:)")


@dataclass(frozen=True)
class Violation:
    """One broken limit: where, what was found, what is allowed."""

    where: str
    found: str
    allowed: str

    def __str__(self) -> str:
        return f"{self.where}: {self.found} (allowed: {self.allowed})"


@dataclass(frozen=True)
class Import:
    """An edge of the import graph. ``kind`` is "module", "function" or "typing"."""

    importer: str
    imported: str
    line: int
    kind: str


@dataclass(frozen=True)
class Source:
    """One source file: its path below the root, its module name, its text and its syntax tree."""

    path: str
    module: str
    text: str
    tree: ast.Module

    @property
    def lines(self) -> list[str]:
        """The lines of the file."""
        return self.text.splitlines()


@dataclass
class Report:
    """Figures by name, violations, and for each counted figure the number in each file."""

    figures: dict[str, float] = field(default_factory=dict)
    allowed: dict[str, str] = field(default_factory=dict)
    violations: list[Violation] = field(default_factory=list)
    files: dict[str, dict[str, int]] = field(default_factory=dict)

    def add(self, name: str, value: float, allowed: str) -> None:
        """Add one row of the table."""
        self.figures[name] = value
        self.allowed[name] = allowed


def sources(root: Path, packages: Iterable[str] = PACKAGES) -> list[Source]:
    """Read every module of the packages below ``root``, sorted by path."""
    result = []
    for package in packages:
        for path in sorted((root / package).rglob("*.py")):
            relative = path.relative_to(root)
            parts = relative.with_suffix("").parts
            module = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            text = path.read_text(encoding="utf-8")
            result.append(Source(relative.as_posix(), module, text, ast.parse(text, str(path))))
    return result


# Functions


def functions(tree: ast.Module) -> Iterator[tuple[str, Function]]:
    """Yield every function and method with its qualified name, also functions inside functions."""

    def visit(node: ast.AST, prefix: str) -> Iterator[tuple[str, Function]]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, Function):
                yield prefix + child.name, child
            if isinstance(child, Function | ast.ClassDef):
                yield from visit(child, f"{prefix}{child.name}.")
            else:
                yield from visit(child, prefix)

    yield from visit(tree, "")


def length(function: Function) -> int:
    """Return the number of lines from ``def`` to the end, docstring included, decorators not."""
    return (function.end_lineno or function.lineno) - function.lineno + 1


def complexity(function: Function) -> int:
    """Return McCabe's number of a function, functions inside it included."""
    return 1 + sum(map(_branches, ast.walk(function))) - _branches(function)


def _branches(node: ast.AST) -> int:
    if isinstance(node, ast.If | Function):
        return 1
    if isinstance(node, ast.For | ast.AsyncFor | ast.While):
        return 1 + bool(node.orelse)
    if isinstance(node, ast.Try | ast.TryStar):
        return len(node.handlers) + bool(node.orelse)
    if isinstance(node, ast.Match):
        return sum(not _matches_all(case) for case in node.cases)
    return 0


def _matches_all(case: ast.match_case) -> bool:
    return case.guard is None and isinstance(case.pattern, ast.MatchAs) and case.pattern.pattern is None


def has_reason(function: Function, lines: list[str]) -> bool:
    """Return whether a line of the signature has a comment ``# complexity: reason``."""
    end = max(function.body[0].lineno - 1, function.lineno)
    return any(REASON.search(line) for line in lines[function.lineno - 1 : end])


def measure_functions(files: Iterable[Source], limits: Limits, report: Report) -> None:
    """Add the figures of functions: length and complexity."""
    longest = most_complex = long = complicated = excused = 0
    for file in files:
        for name, function in functions(file.tree):
            where = f"{file.path}:{function.lineno}"
            size, number = length(function), complexity(function)
            longest, most_complex = max(longest, size), max(most_complex, number)
            if size > limits.function_lines:
                long += 1
                found = f"function {name} has {size} lines"
                report.violations.append(Violation(where, found, f"{limits.function_lines}"))
            if number > limits.complexity:
                if has_reason(function, file.lines):
                    excused += 1
                    continue
                complicated += 1
                allowed = f"{limits.complexity}, or a reason: # complexity: ..."
                report.violations.append(
                    Violation(where, f"function {name} has complexity {number}", allowed)
                )
    report.add("longest function (lines)", longest, f"<= {limits.function_lines}")
    report.add("functions that are too long", long, "0")
    report.add("highest complexity", most_complex, f"<= {limits.complexity}, or a reason")
    report.add("functions that are too complex", complicated, "0")
    report.add("complex functions with a reason", excused, "")


# Files and lines


def measure_modules(files: Iterable[Source], limits: Limits, report: Report) -> None:
    """Add the figures of modules: their number and length."""
    sizes = {file.path: len(file.lines) for file in files}
    report.add("modules", len(sizes), "")
    report.add("lines", sum(sizes.values()), "")
    report.add("longest module (lines)", max(sizes.values(), default=0), f"<= {limits.module_lines}")
    for path, size in sizes.items():
        if size > limits.module_lines:
            report.violations.append(Violation(f"{path}:1", f"{size} lines", f"{limits.module_lines}"))


def count_lines(
    name: str, pattern: re.Pattern[str], most: int, files: Iterable[Source], report: Report
) -> None:
    """Count the lines that contain ``pattern``. A total above ``most`` is one violation."""
    counts = {file.path: sum(bool(pattern.search(line)) for line in file.lines) for file in files}
    counts = {path: n for path, n in sorted(counts.items(), key=lambda item: -item[1]) if n}
    total = sum(counts.values())
    report.files[name] = counts
    report.add(name, total, f"<= {most}")
    if total > most:
        first = ", ".join(f"{path} {n}" for path, n in list(counts.items())[:5])
        found = f"{total} {name} in {len(counts)} files; most in {first}"
        report.violations.append(Violation("total", found, f"{most}"))


def comment_lines(text: str) -> int:
    """Return how many lines hold a comment. Markers for tools (noqa, type: ignore) are no comments."""
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return sum(t.type == tokenize.COMMENT and not MARKER.match(t.string) for t in tokens)


def measure_comments(files: Iterable[Source], limits: Limits, report: Report) -> None:
    """Add the comment density of the compiler's core in percent, and of each of its folders."""
    low, high = limits.density
    core = [(folder, [f for f in files if f.path.startswith(folder + "/")]) for folder in CORE]
    for folder, inside in [("the core", [f for _, part in core for f in part]), *core]:
        lines = sum(len(f.lines) for f in inside)
        if not lines:
            continue
        density = round(100 * sum(comment_lines(f.text) for f in inside) / lines, 1)
        whole = folder == "the core"
        report.add(f"comments in {folder} (%)", density, f"{low:g} to {high:g}" if whole else "")
        if whole and not low <= density <= high:
            found = f"{density} % comment lines in the core"
            report.violations.append(Violation("total", found, f"{low:g} to {high:g} %"))


# Imports


def imports(file: Source, modules: Collection[str]) -> list[Import]:
    """Return the edges from one file to modules of the packages."""
    result: list[Import] = []

    def visit(node: ast.AST, kind: str) -> None:
        if isinstance(node, ast.Import | ast.ImportFrom):
            for target in _targets(file, node, modules):
                if target != file.module:
                    result.append(Import(file.module, target, node.lineno, kind))
        elif isinstance(node, ast.If) and _is_type_checking(node.test):
            for child in node.body:
                visit(child, "typing")
            for child in node.orelse:
                visit(child, kind)
        else:
            inside = kind == "module" and isinstance(node, Function | ast.Lambda)
            for inner in ast.iter_child_nodes(node):
                visit(inner, "function" if inside else kind)

    visit(file.tree, "module")
    return result


def _is_type_checking(test: ast.expr) -> bool:
    name = test.attr if isinstance(test, ast.Attribute) else getattr(test, "id", "")
    return name == "TYPE_CHECKING"


def _targets(file: Source, node: ast.Import | ast.ImportFrom, modules: Collection[str]) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names if alias.name in modules)
        return
    base = node.module or ""
    if node.level:
        parts = file.module.split(".")
        up = node.level - file.path.endswith("__init__.py")
        base = ".".join([*parts[: len(parts) - up], *filter(None, [node.module])])
    for alias in node.names:
        submodule = f"{base}.{alias.name}"
        if submodule in modules:
            yield submodule
        elif base in modules:
            yield base


def components(edges: Iterable[Import]) -> list[set[str]]:
    """Return the modules of each strongly connected component with more than one module, largest first."""
    graph = _graph(edges)
    reach = {module: _reachable(graph, module) for module in graph}
    found = {
        frozenset(other for other in reach[module] if module in reach.get(other, ()))
        for module in graph
        if module in reach[module]
    }
    return sorted(map(set, found), key=lambda part: (-len(part), min(part)))


def shortest_circle(edges: Iterable[Import], component: Collection[str]) -> list[Import]:
    """Return the imports of a shortest circle inside a strongly connected component."""
    graph = _graph(e for e in edges if e.importer in component and e.imported in component)
    return min((_circle(graph, start) for start in sorted(component)), key=len)


def _graph(edges: Iterable[Import]) -> dict[str, dict[str, Import]]:
    graph: dict[str, dict[str, Import]] = {}
    for edge in edges:
        graph.setdefault(edge.importer, {}).setdefault(edge.imported, edge)
    return graph


def _reachable(graph: Mapping[str, Collection[str]], start: str) -> set[str]:
    seen: set[str] = set()
    waiting = list(graph.get(start, ()))
    while waiting:
        module = waiting.pop()
        if module not in seen:
            seen.add(module)
            waiting.extend(graph.get(module, ()))
    return seen


def _circle(graph: Mapping[str, Mapping[str, Import]], start: str) -> list[Import]:
    paths = deque[list[Import]]([edge] for edge in graph[start].values())
    seen: set[str] = set()
    while paths:
        path = paths.popleft()
        end = path[-1].imported
        if end == start:
            return path
        if end not in seen:
            seen.add(end)
            paths.extend([*path, edge] for edge in graph.get(end, {}).values())
    raise ValueError(f"{start} is in no circle")


def measure_imports(files: Collection[Source], limits: Limits, report: Report) -> None:
    """Add the figures of the import graph. Circles of imports that run are violations."""
    paths = {file.module: file.path for file in files}
    edges = [edge for file in files for edge in imports(file, paths)]
    runtime = [edge for edge in edges if edge.kind != "typing"]
    report.add("imports inside functions", sum(e.kind == "function" for e in edges), "")
    found = components(runtime)
    report.add("circles of imports", len(found), f"<= {limits.circles}")
    at_load = components([e for e in edges if e.kind == "module"])
    report.add("  of these without imports inside functions", len(at_load), "")
    report.add("  modules in circles", sum(map(len, found)), "")
    report.add("circles with TYPE_CHECKING imports added", len(components(edges)), "")
    if len(found) <= limits.circles:
        return
    for part in found:
        circle = shortest_circle(runtime, part)
        steps = [f"{paths[e.importer]}:{e.line} ({e.kind}) -> {e.imported}" for e in circle]
        text = f"{len(part)} modules import each other; a shortest circle: {'; '.join(steps)}"
        if len(part) > len(circle):
            text += f"; all: {', '.join(sorted(part))}"
        where = f"{paths[circle[0].importer]}:{circle[0].line}"
        report.violations.append(Violation(where, text, "no circle"))


# The report


def measure(root: Path, limits: Limits | None = None, packages: Iterable[str] = PACKAGES) -> Report:
    """Return the report on the packages below ``root``."""
    limits = limits or Limits()
    files, report = sources(root, packages), Report()
    measure_modules(files, limits, report)
    measure_functions(files, limits, report)
    count_lines("lines with Any", ANY, limits.any_lines, files, report)
    count_lines("lines with type: ignore", TYPE_IGNORE, limits.type_ignores, files, report)
    measure_imports(files, limits, report)
    measure_comments(files, limits, report)
    return report


def table(report: Report) -> str:
    """Return the figures as text, one a line."""
    width = max(map(len, report.figures))
    rows = [("figure", "found", "allowed")]
    rows += [(name, f"{value:g}", report.allowed[name]) for name, value in report.figures.items()]
    return "\n".join(f"{a:<{width}}  {b:>7}  {c}".rstrip() for a, b, c in rows)


def main(arguments: list[str] | None = None) -> int:
    """Print the report; return the exit status."""
    parser = argparse.ArgumentParser(description="Measure the structure of the packages.")
    default = Path(__file__).resolve().parents[1]
    parser.add_argument("root", nargs="?", type=Path, default=default, help="the folder of both packages")
    parser.add_argument("--json", action="store_true", help="print figures and violations as JSON")
    parser.add_argument("--files", action="store_true", help="print the counts of each file")
    options = parser.parse_args(arguments)
    report = measure(options.root)
    if not report.figures["modules"]:
        parser.error(f"no modules of {' or '.join(PACKAGES)} below {options.root}")
    if options.json:
        violations = [asdict(v) for v in report.violations]
        result = {"figures": report.figures, "files": report.files, "violations": violations}
        print(json.dumps(result, indent=2))
        return bool(report.violations)
    print(table(report))
    for name, counts in report.files.items() if options.files else ():
        print(f"\n{name}:")
        print("\n".join(f"{n:5} {path}" for path, n in counts.items()))
    if report.violations:
        print(f"\n{len(report.violations)} violations:")
        print("\n".join(map(str, report.violations)))
    return bool(report.violations)


if __name__ == "__main__":
    sys.exit(main())
