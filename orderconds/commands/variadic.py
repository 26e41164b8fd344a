"""Options with several values, such as ``--method A B C``.

A :class:`Variadic` command accepts ``--method A B`` as a short form of ``--method A --method B``. The option
must have ``multiple=True``. The short form must come after the first positional argument, as in
``bench dipole --method cf4 rkmk:rk4``.
"""

from __future__ import annotations

import click


class Variadic(click.Command):
    """A command in which several values may follow the name of a repeatable option.

    >>> @click.command("show", cls=Variadic)
    ... @click.argument("scene")
    ... @click.option("--method", "-m", multiple=True)
    ... def show(scene: str, method: tuple[str, ...]) -> None:
    ...     click.echo(f"{scene}: {', '.join(method)}")
    ...
    >>> show(["dipole", "--method", "a", "b", "-m", "c"], standalone_mode=False)
    dipole: a, b, c
    >>> show(["-m", "a", "dipole"], standalone_mode=False)
    dipole: a
    """

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Replace ``-m a b`` by ``-m a -m b``, then parse the arguments with click. Click expects one value
        after each ``-m``.
        """
        options = [p for p in self.params if isinstance(p, click.Option)]
        repeated = {name for p in options if p.multiple for name in p.opts}
        valued = {name for p in options if not p.is_flag for name in p.opts}
        words: list[str] = []
        current, argued, expecting = "", False, False
        for k, word in enumerate(args):
            if word == "--":
                words += args[k:]
                break
            if expecting:
                expecting = False
            elif word.startswith("-") and word != "-":
                current = word if word in repeated else ""
                expecting = word in valued
            elif current and argued:
                words.append(current)
            else:
                argued, current = True, ""
            words.append(word)
        return super().parse_args(ctx, words)
