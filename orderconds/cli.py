"""The command-line program. A built-in command is imported when it is used, so the program starts quickly.

Other packages, for example ``codegen``, provide commands as entry points (see :data:`COMMAND_GROUP`).
"""

from __future__ import annotations

import gc
import importlib
import io
import os
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NoReturn

import click

from orderconds import __version__
from orderconds.errors import InputError, UnknownName
from orderconds.exit_status import Run, catch_signals, current_run, past_click

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

COMMAND_GROUP = "orderconds.commands"
"""The entry-point group in which other packages register commands."""

BUILT_IN = {
    "check": (
        "orderconds.commands.check",
        "Compute the exact orders of tableaux and compare them with the claimed orders.",
    ),
    "cite": ("orderconds.commands.cite", "Print the BibTeX of a tableau's source."),
    "completion": (
        "orderconds.commands.completion",
        "Print a shell script that completes commands, options and names.",
    ),
    "construct": (
        "orderconds.commands.construct",
        "Compute a Gauss, Radau or Lobatto method from its definition.",
    ),
    "convert": (
        "orderconds.commands.convert",
        "Convert a tableau from one file format to another.",
    ),
    "derive": ("orderconds.commands.derive", "Print the independent order conditions of a family."),
    "extend": ("orderconds.commands.extend", "Find a continuous extension of a Runge-Kutta method."),
    "list": ("orderconds.commands.list", "List families, tableaux, groups, actions, scenes and more."),
    "modified": ("orderconds.commands.modified", "Print the modified equation of a method."),
    "refine": (
        "orderconds.commands.refine",
        "Replace the decimals of a tableau by exact numbers, or by decimals with more correct digits.",
    ),
    "series": ("orderconds.commands.series", "Print the BCH, Magnus or dexp series in a basis of brackets."),
    "solve": ("orderconds.commands.solve", "Find a method, prove its order, and write its tableau."),
    "table": (
        "orderconds.commands.table",
        "Print a table of all tableaux of the library, or the Butcher tableau of each given method.",
    ),
    "trees": ("orderconds.commands.trees", "Enumerate, draw and explain trees, forests and Lyndon words."),
}
"""Maps the name of each built-in command to a pair (module, description in ``orderconds --help``)."""

OUTPUT_OPTIONS = {
    "quiet": "Print only failures, and no progress. The exit status states the outcome.",
    "verbose": "Write progress and the remaining time to stderr, even if stderr is not a terminal.",
}
"""The options that every command has, with their help texts."""


class Program(click.Group):
    """The program ``orderconds`` as a click group. If a command raises an error, the program prints a
    message and exits with an error status.

    >>> program.list_commands(click.Context(program))[:3]
    ['check', 'cite', 'completion']
    """

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of all commands. The built-in commands come first."""
        others = sorted({entry.name for entry in _offered()} - set(BUILT_IN))
        return [*BUILT_IN, *others]

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """Import and return one command. Return None if no package has a command of the given name."""
        if name in BUILT_IN:
            module, summary = BUILT_IN[name]
            command = importlib.import_module(module).command
            # Shell completion may show ``short_help`` next to the name of the command.
            command.short_help = summary
        else:
            entries = [entry for entry in _offered() if entry.name == name]
            if not entries:
                return None
            try:
                command = entries[0].load()
            except (ImportError, AttributeError) as error:
                raise UnknownName(
                    f"cannot load the command: {error}",
                    where=f"{name} ({entries[0].value})",
                    expected="a complete installation of the package that defines this command",
                ) from error
        if not isinstance(command, click.Command):
            raise UnknownName(f"{command!r} is not a click command", where=f"entry point {name}")
        return with_output_options(command)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command whose name is the first argument. Raise an error if there is no such command."""
        name = args[0]
        command = None if name.startswith("-") else self.get_command(ctx, name)
        if command is None and not name.startswith("-"):
            import difflib

            names = self.list_commands(ctx)
            close = difflib.get_close_matches(name, names, n=1)
            raise UnknownName(
                f"there is no command {name!r}",
                expected=f"one of {', '.join(names)}",
                hint=f"type: orderconds {close[0] if close else '--help'}",
            )
        resolved = super().resolve_command(ctx, args)
        # During shell completion, click reports no errors.
        if resolved[1] is not None and not ctx.resilient_parsing:
            _refuse_repetition(resolved[1], click.Context(resolved[1], parent=ctx, info_name=name), args[1:])
        return resolved

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list of all commands, with one line for each command."""
        rows = []
        for name in self.list_commands(ctx):
            if name in BUILT_IN:
                rows.append((name, BUILT_IN[name][1]))
                continue
            try:
                command = self.get_command(ctx, name)
            except InputError as error:
                rows.append((name, f"({error.found})"))
            else:
                rows.append((name, command.get_short_help_str(limit=100) if command else ""))
        with formatter.section("Commands"):
            formatter.write_dl(rows)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command and flush stdout."""
        with past_click():
            result = super().invoke(ctx)
            sys.stdout.flush()
        return result

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        """Parse the command line.

        Raises :class:`~orderconds.exit_status.Stopped` after Ctrl-C, or if the output pipe is closed.
        """
        with past_click():
            return super().make_context(*args, **extra)

    def main(self, *args: Any, **extra: Any) -> NoReturn:
        """Run one command and exit with its status. If an error occurs, print one message."""
        status = 0
        for name in ("stdout", "stderr"):
            if getattr(sys, name) is None:  # The caller has closed the stream, as in ``orderconds ... >&-``.
                setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115 - open until exit
        given = list(args[0] if args else extra.get("args") or sys.argv[1:])
        run = Run(as_json="--json" in given[: given.index("--") if "--" in given else None])
        settings = {"prog_name": "orderconds", **extra, "standalone_mode": False, "obj": run}
        try:
            result = super().main(*args, **settings)
            sys.stdout.flush()
            status = result if isinstance(result, int) else 0
        except click.exceptions.NoArgsIsHelpError as error:
            click.echo(error.format_message())
        except SystemExit:
            raise
        except BaseException as error:
            status = run.end(error)
        sys.exit(status)


def _offered() -> Iterable[EntryPoint]:
    """Return the entry points by which other packages provide commands.

    ``importlib.metadata`` is imported inside this function, because the import is slow.
    """
    from importlib import metadata

    return metadata.entry_points(group=COMMAND_GROUP)


def _refuse_repetition(command: click.Command, ctx: click.Context, args: list[str]) -> None:
    """Raise a UsageError if an option with a value is repeated, or if two flags set the same parameter.

    Options with ``multiple=True`` may be repeated.
    """
    try:
        _, _, met = command.make_parser(ctx).parse_args(list(args))
    except click.UsageError as error:
        error.ctx = error.ctx or ctx  # If an option lacks its value, the error has no context.
        raise
    given: dict[str | None, click.Option] = {}
    seen: set[str | None] = set()
    for option in met:
        if not isinstance(option, click.Option) or option.multiple or option.count:
            continue
        before = given.setdefault(option.name, option)
        if before is not option:
            raise click.UsageError(f"{before.opts[0]} and {option.opts[0]} contradict each other", ctx)
        if option.name in seen and not option.is_flag:
            raise click.UsageError(f"{option.opts[0]} is given twice; give it once", ctx)
        seen.add(option.name)


def with_output_options(command: click.Command) -> click.Command:
    """Add the options ``--quiet`` and ``--verbose`` to a command if they are missing.

    >>> [p.opts[0] for p in with_output_options(click.Command("list")).params]
    ['--quiet', '--verbose']
    """
    known = {name for p in command.params for name in p.opts}
    for name, meaning in OUTPUT_OPTIONS.items():
        if f"--{name}" not in known:
            option = click.Option(
                [f"--{name}", f"-{name[0]}"],
                is_flag=True,
                expose_value=False,
                callback=_set_output,
                help=meaning,
            )
            command.params.append(option)
    return command


def _set_output(ctx: click.Context, parameter: click.Parameter, given: bool) -> None:
    run = current_run()
    setattr(run, str(parameter.name), given)
    if run.quiet and run.verbose:
        raise click.UsageError("--quiet and --verbose contradict each other", ctx)


def _ask_for_traceback(ctx: click.Context, parameter: click.Parameter, asked: bool) -> None:
    current_run().traceback = asked


@click.group(cls=Program, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="orderconds")
@click.option(
    "--traceback",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_ask_for_traceback,
    envvar="ORDERCONDS_TRACEBACK",
    help="Show the traceback of an internal error. The environment variable ORDERCONDS_TRACEBACK=1 has the "
    "same effect.",
)
def program() -> None:
    """Derive, prove and compile Lie group integrators."""


def main() -> NoReturn:
    """Run the program with the arguments of the command line.

    Garbage is collected less often than by default, because a command creates little garbage.
    """
    gc.set_threshold(100_000, 20, 20)
    catch_signals()
    for stream in (sys.stdout, sys.stderr):
        # Replace characters that the terminal cannot display.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        program.main()
    finally:
        gc.freeze()


if __name__ == "__main__":
    main()
