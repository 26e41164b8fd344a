"""The name of an emitted module, and names of scenes and methods in the command that regenerates it."""

from __future__ import annotations

import keyword
import re
import shlex
from pathlib import PurePath

from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.errors import InputError

HEADERS = frozenset({"math", "numpy", "stddef", "stdio", "string"})
"""Names of the headers and modules that emitted files or their examples include. No emitted file may have
such a name."""


def bare(name: str) -> str:
    """Return a name without folders, because emitted text must not contain a path of the machine.

    >>> bare("vcg:some/where/mine.toml"), bare("scenes/top.py")
    ('vcg:mine.toml', 'top.py')
    """
    name, bracket, values = name.partition("[")
    family, colon, rest = name.rpartition(":") if re.match(r"[a-z_]+(\(\d+\))?:", name) else ("", "", name)
    return f"{family}{colon}{PurePath(rest).name}{bracket}{values}"


def quoted(word: str) -> str:
    """Quote a word if a shell would otherwise interpret characters in it.

    >>> quoted("rkmk(2):rk4"), quoted("linear_oscillator+u")
    ("'rkmk(2):rk4'", 'linear_oscillator+u')
    """
    return shlex.quote(word)


def default_prefix(scene: Problem, method: Method) -> str:
    """Return the prefix SCENE_FAMILY_TABLEAU_, or SCENE_TABLEAU_ if the tableau's name starts with the
    family.

    A family's cut-off follows its name: ``free_rigid_body_rkmk2_rk4_``.
    """
    family = method.family + ("" if method.cutoff is None else str(method.cutoff))
    tableau = method.name
    named = bool(tableau) and tableau.startswith(method.family)
    parts = [scene.name, *([] if named else [family]), tableau]
    name = re.sub(r"\W", "_", "_".join(filter(None, parts)), flags=re.ASCII)
    return prefix_of(name, "this name is the scene's file name: rename the file, or use --prefix NAME")


def prefix_of(name: str, hint: str = "") -> str:
    """Return a prefix that ends in one underscore; raise an InputError if it is not an identifier of C and
    Python.

    The names of the files begin with the prefix. It must not be a keyword, because Python cannot import a
    module with this name. It must not be the name of a header or module that emitted code includes.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name):
        raise InputError(
            f"the prefix {name!r}",
            where="--prefix",
            expected="a letter, then letters, digits and _",
            hint=hint,
        )
    module = name.rstrip("_")
    if keyword.iskeyword(module) or module in HEADERS:
        raise InputError(
            f"the prefix {name!r}",
            where="--prefix",
            expected="a name that is neither a keyword of Python nor a standard header",
        )
    return module + "_"
