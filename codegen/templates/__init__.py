"""Jinja2 environments, one for each target (``c``, ``python``, ...).

An error is raised if a template uses an undefined variable. In an environment, ``snippets/NAME.j2`` denotes a
file in ``codegen/snippets/TARGET``, and ``module/NAME.j2`` denotes a file in ``codegen/templates/TARGET``.
"""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, PrefixLoader, StrictUndefined


@cache
def environment(target: str) -> Environment:
    """Return the environment of a target, such as ``c``. Later calls return the same object."""
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
