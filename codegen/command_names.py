"""Names of scenes and methods in the command that regenerates a module.

If a name is the path of a file, only the file name is kept. Names with characters that a shell would
interpret are quoted.
"""

from __future__ import annotations

import re
import shlex
from pathlib import PurePath


def bare(name: str) -> str:
    """Return the name of a scene or a method without the path of its folder.

    >>> bare("vcg:some/where/mine.toml"), bare("scenes/top.py")
    ('vcg:mine.toml', 'top.py')
    """
    name, bracket, values = name.partition("[")
    family, colon, rest = name.rpartition(":") if re.match(r"[a-z_]+(\(\d+\))?:", name) else ("", "", name)
    return f"{family}{colon}{PurePath(rest).name}{bracket}{values}"


def quoted(word: str) -> str:
    """Quote a word if it contains characters that a shell would interpret.

    >>> quoted("rkmk(2):rk4"), quoted("linear_oscillator+u")
    ("'rkmk(2):rk4'", 'linear_oscillator+u')
    """
    return shlex.quote(word)
