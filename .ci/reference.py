"""Write the pages of the reference that follow from the program: helps of commands, docstrings of packages.

``python .ci/reference.py`` writes the pages; with ``--check`` it fails if a page is out of date.
"""

from __future__ import annotations

import importlib
import inspect
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

ROOT = Path(__file__).parents[1]
COMMANDS, API = "docs/reference/commands.md", "docs/reference/api.md"
WIDTH = 100
"""Columns of a help text in the page."""

GROUPS = {
    "Conditions and trees": ("derive", "trees", "series", "modified"),
    "Tableaux": ("check", "solve", "extend", "refine", "construct", "convert", "table", "list", "cite"),
    "Integrators": ("emit", "regenerate"),
    "Measurements": (
        "converge",
        "localerror",
        "bench",
        "longrun",
        "stability",
        "recommend",
        "report",
        "figure",
    ),
}
"""The chapters of the page of commands. Other commands form the last chapter."""

NOTE = "<!-- written by `make reference`; do not edit -->"


def commands() -> str:
    """Return the page of commands: a table, and the help of each command."""
    from orderconds.cli import program

    context = click.Context(program, info_name="orderconds")
    found = {
        name: command
        for name in program.list_commands(context)
        if (command := program.get_command(context, name)) is not None and not command.hidden
    }
    listed = {name for names in GROUPS.values() for name in names}
    others = tuple(name for name in found if name not in listed)
    chapters = {**GROUPS, **({"Other commands": others} if others else {})}
    lines = [
        NOTE,
        "",
        "# Commands",
        "",
        "Every command accepts `--help` and `--json`. With `--json` a command prints one JSON document on",
        "stdout and nothing else ([JSON](json.md)). [Exit statuses](statuses.md) are the same in every",
        "command. [Scenes and methods](methods.md) explains the arguments SCENE and METHOD.",
        "",
        "| command | purpose |",
        "|---|---|",
    ]
    from orderconds.cli import BUILT_IN

    for names in chapters.values():
        for name in names:
            short = BUILT_IN[name][1] if name in BUILT_IN else found[name].get_short_help_str(limit=100)
            lines.append(f"| [`{name}`](#{name}) | {short} |")
    lines += ["", "## The program", "", *block(help_of(program, "orderconds"))]
    for title, names in chapters.items():
        lines += ["", f"## {title}"]
        for name in names:
            lines += ["", f"### {name}", "", *block(help_of(found[name], f"orderconds {name}"))]
    return "\n".join(lines) + "\n"


def help_of(command: click.Command, name: str) -> str:
    """Return the help text of one command, with lines of at most :data:`WIDTH` columns."""
    context = click.Context(
        command,
        info_name=name,
        terminal_width=WIDTH,
        max_content_width=WIDTH,
        help_option_names=["-h", "--help"],
    )
    return command.get_help(context)


def block(text: str) -> list[str]:
    """Return the lines of a fenced block."""
    return ["```text", *(line.rstrip() for line in text.strip().splitlines()), "```"]


def api() -> str:
    """Return the page of the Python interface: the public names of both packages with their docstrings."""
    lines = [
        NOTE,
        "",
        "# Python",
        "",
        "Both packages have type annotations (`py.typed`). The names on this page are stable.",
    ]
    for package in ("orderconds", "codegen"):
        module = importlib.import_module(package)
        lines += ["", f"## {package}", "", *prose(inspect.getdoc(module) or "")]
        for name in sorted(module.__all__, key=str.lower):
            lines += described(f"{package}.{name}", getattr(module, name))
    return "\n".join(lines) + "\n"


def described(name: str, thing: Any) -> Iterator[str]:
    """Yield the lines of one public name: its signature, its docstring, and the methods of a class."""
    yield from ("", f"### {name}", "")
    if inspect.isclass(thing) or callable(thing):
        yield from ("```python", name + signature(thing), "```", "")
    yield from prose(inspect.getdoc(thing) or "")
    if not inspect.isclass(thing):
        return
    for member, value in sorted(vars(thing).items()):
        if member.startswith("_"):
            continue
        plain = value.__func__ if isinstance(value, classmethod | staticmethod) else value
        if isinstance(value, property) or hasattr(value, "func"):
            head = f"{name}.{member}"
        elif inspect.isfunction(plain):
            head = f"{name}.{member}{signature(plain)}"
        else:
            continue
        if text := inspect.getdoc(plain):
            yield from ("", f"`{head}`", "", *prose(text))


def signature(thing: Any) -> str:
    """Return the signature without the first argument of a method and without names of modules."""
    try:
        given = inspect.signature(thing)
    except (TypeError, ValueError):
        return "(...)"
    parameters = [
        p.replace(annotation=annotation(p.annotation))
        for p in given.parameters.values()
        if p.name not in ("self", "cls")
    ]
    shown = given.replace(parameters=parameters, return_annotation=annotation(given.return_annotation))
    text = str(shown).removesuffix(" -> None")
    if len(text) <= WIDTH:
        return text
    lines, named = "", False
    for p in shown.parameters.values():
        if p.kind is p.KEYWORD_ONLY and not named:
            lines += "    *,\n"
        named = named or p.kind in (p.KEYWORD_ONLY, p.VAR_POSITIONAL)
        lines += f"    {p},\n"
    return f"(\n{lines}){text[text.rindex(')') + 1 :]}"


class Plain(str):
    """An annotation that a signature prints without quotes."""

    __slots__ = ()
    __repr__ = str.__str__


def annotation(given: Any) -> Any:
    """Return an annotation as text without names of modules."""
    if not isinstance(given, str):
        return given
    return Plain(re.sub(r"\b(?:[a-z_]\w*\.)+(?=[A-Z])", "", given))


def prose(docstring: str) -> Iterator[str]:
    """Yield Markdown for a docstring in reStructuredText: roles, literals, underlined titles and doctests."""
    lines = docstring.splitlines()
    example = False
    for index, line in enumerate(lines):
        following = lines[index + 1] if index + 1 < len(lines) else ""
        if example and not line.strip() and not following.startswith(">>>"):
            example = False
            yield from ("```", "")
        elif example:
            yield line
        elif line.startswith(">>> "):
            example = True
            yield from ("```pycon", line)
        elif re.fullmatch(r"[-=]{3,}", line):
            continue
        elif re.fullmatch(r"[-=]{3,}", following):
            yield f"**{line}**"
            yield ""
        else:
            line = re.sub(r":\w+:`~?\.?(?:[\w.]+\.)?(\w+)`", r"`\1`", line)
            code = line.startswith("    ")
            yield line if code else literal(line)
    if example:
        yield "```"


def literal(line: str) -> str:
    """Return a line with Markdown's literals, and with stars and bars escaped outside of literals."""
    parts = re.split(r"(``.*?``|`[^`]*`)", line)
    return "".join(
        re.sub(r"``", "`", part)
        if part.startswith("`")
        else re.sub(r"(?<=\w)\*(?=[\w ]|$)|(?<![a-zA-Z0-9])_|_(?![a-zA-Z0-9])", r"\\\g<0>", part)
        for part in parts
    )


PAGES = {COMMANDS: commands, API: api}
"""The pages, and the functions that return their text."""


def main(arguments: list[str]) -> int:
    """Write or compare the pages; return the exit status."""
    status = 0
    for page, text in PAGES.items():
        path, new = ROOT / page, text()
        old = path.read_text(encoding="utf-8") if path.exists() else ""
        if new == old:
            continue
        if "--check" in arguments:
            print(f"{page}: out of date; type: make reference", file=sys.stderr)
            status = 1
        else:
            path.write_text(new, encoding="utf-8")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
