"""Jinja2 environments, one a target, made once; an undefined variable is an error.

A template named ``snippets/NAME.j2`` is found among the target's snippets, any other in its folder here.
"""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, PrefixLoader, StrictUndefined


@cache
def environment(target: str) -> Environment:
    """Return the environment of a target ("c", "python")."""
    loader = PrefixLoader(
        {
            "module": PackageLoader("codegen.templates", target),
            "snippets": PackageLoader("codegen.snippets", target),
        }
    )
    return Environment(
        loader=loader,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
