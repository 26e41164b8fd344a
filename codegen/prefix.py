"""Prefixes of emitted modules. All external names and all file names of a module begin with its prefix."""

from __future__ import annotations

import keyword
import re

from codegen.method import STEP, Method
from codegen.scene.problem import Problem
from orderconds.errors import InputError

HEADERS = frozenset({"math", "numpy", "stddef", "stdio", "string"})
"""Emitted files and their examples use these C headers and Python modules.

An emitted file must not have one of these names.
"""


def default_prefix(scene: Problem, method: Method) -> str:
    """Return the prefix SCENE_FAMILY_TABLEAU_ of the names in an emitted module.

    If the name of the tableau starts with the name of the family, the prefix is SCENE_TABLEAU_. The
    cut-off of a method (:attr:`codegen.method.Method.cutoff`) follows the name of the family, as in
    ``free_rigid_body_rkmk2_rk4_``.
    """
    family = STEP if method.step else method.family + ("" if method.cutoff is None else str(method.cutoff))
    tableau = method.name
    named = bool(tableau) and tableau.startswith(method.family)
    parts = [scene.name, *([] if named else [family]), tableau]
    name = re.sub(r"\W", "_", "_".join(filter(None, parts)), flags=re.ASCII)
    return prefix_of(
        name,
        "the prefix begins with the name of the scene's file, so the name must start with a letter: rename "
        "the file, or use --prefix",
    )


def prefix_of(name: str, hint: str = "") -> str:
    """Return ``name`` with exactly one underscore at its end.

    InputError is raised if ``name`` is not an identifier that starts with a letter. InputError is also raised
    if the prefix without the underscore is a Python keyword or a name in :data:`HEADERS`.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name):
        raise InputError(
            f"{name!r} cannot be the prefix of names in C and Python",
            where="--prefix",
            expected="a letter, then letters, digits and _",
            hint=hint,
        )
    module = name.rstrip("_")
    if keyword.iskeyword(module) or module in HEADERS:
        raise InputError(
            f"the prefix {name!r} is reserved: a Python keyword, C header or Python module has this name",
            where="--prefix",
            expected="another name",
        )
    return module + "_"
