"""``orderconds completion``: print a shell script that completes the words of a command line."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from orderconds.commands.screen import print_json

SHELLS = ("bash", "zsh", "fish")

VARIABLE = "_ORDERCONDS_COMPLETE"
"""The environment variable that a shell sets to request completions from click."""


@click.command("completion")
@click.argument("shell", type=click.Choice(SHELLS))
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
@click.pass_context
def command(ctx: click.Context, shell: str, as_json: bool) -> int:
    """Print the script that lets SHELL complete commands, options, families, tableaux and scenes.

    For bash, add the line `eval "$(orderconds completion bash)"` to ~/.bashrc. For zsh, add
    `eval "$(orderconds completion zsh)"` to ~/.zshrc. For fish, add `orderconds completion fish | source` to
    the configuration file of fish.

    \b
    Examples:
        orderconds completion bash
        orderconds completion fish
    """
    completion = get_completion_class(shell)
    assert completion is not None
    script = completion(ctx.find_root().command, {}, "orderconds", VARIABLE).source()
    if as_json:
        print_json({"shell": shell, "script": script})
    else:
        click.echo(script)
    return 0
