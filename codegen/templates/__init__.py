"""Jinja2 environments, one for each target, cached; an undefined variable is an error.

``snippets/NAME.j2`` is a file of ``codegen/snippets/TARGET``, ``module/NAME.j2`` is a file of
``codegen/templates/TARGET``.
"""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, PrefixLoader, StrictUndefined


@cache
def environment(target: str) -> Environment:
    """Return the environment of a target by its name."""
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
