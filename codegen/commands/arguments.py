"""Arguments and options that several commands share: scene, methods, parameters, targets."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import click

from orderconds.commands.names import completing, tableau_names

Command = TypeVar("Command", bound=Callable[..., object])


def scene_names() -> tuple[str, ...]:
    """Return the names in the output of `orderconds list scenes`."""
    from codegen import scenes

    return scenes.every_name()


def method_names() -> list[str]:
    """Return the names that the shell proposes after ``--method``.

    The names have the form ``TABLEAU`` or the form ``FAMILY:TABLEAU``.
    """
    from codegen import lower

    tableaux = tableau_names()
    return [*tableaux, *(f"{family}:{tableau}" for family in lower.names() for tableau in tableaux)]


def target_names() -> tuple[str, ...]:
    """Return the names of the target languages of emitted code."""
    from codegen import printers

    return tuple(printers.names())


def scene_argument(*, required: bool = True) -> Callable[[Command], Command]:
    """Return the decorator that adds the argument SCENE to a command."""
    complete = completing(scene_names, files=True)
    return click.argument("scene", required=required, metavar="SCENE", shell_complete=complete)


def methods_option(*, required: bool = False) -> Callable[[Command], Command]:
    """Return the decorator that adds the repeatable option ``--method``."""
    return click.option(
        "--method",
        "-m",
        "methods",
        multiple=True,
        required=required,
        help="A method: TABLEAU or FAMILY:TABLEAU. The option may be repeated.",
        shell_complete=completing(method_names, files=True),
    )


def values_option(command: Command) -> Command:
    """Add the repeatable option ``--parameter NAME=VALUE``."""
    return click.option(
        "--parameter",
        "-P",
        "parameters",
        multiple=True,
        metavar="NAME=VALUE",
        help="The value of a parameter of the scene, such as nu=3/5. The option may be repeated.",
    )(command)


def targets_option(command: Command) -> Command:
    """Add the repeatable option ``--target``."""
    return click.option(
        "--target",
        "-t",
        "targets",
        multiple=True,
        help="A target language, by default 'c'; see `orderconds list targets`. The option may be repeated.",
        shell_complete=completing(target_names),
    )(command)
