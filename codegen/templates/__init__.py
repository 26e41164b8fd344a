"""Environments of the template engine Jinja2, one for each target language (``c``, ``python``, ...).

If a template uses an undefined variable, an error is raised. In the environment of a target,
``snippets/NAME`` is the file NAME in ``codegen/snippets/TARGET``, and ``module/NAME`` is the file NAME in
``codegen/templates/TARGET``.
"""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, PrefixLoader, StrictUndefined


@cache
def environment(target: str) -> Environment:
    """Return the environment of the target language ``target``, for example ``c``. The result is cached."""
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
