"""Write texts of a tableau, for example the name, as one-line comments of source files.

A backslash is doubled. A line break or a control character becomes a Unicode code, for example ``\\u000a``.
The text ``*/`` becomes ``*\\/``, and ``/*`` becomes ``\\/*``.
"""

from __future__ import annotations

import re
import unicodedata

_ESCAPED = re.compile(r"\\(?:\\|/|u[0-9a-f]{4}|U[0-9a-f]{8})")


def escaped(text: str) -> str:
    r"""Return a text as one line for a comment. Characters that a comment cannot contain are escaped.

    >>> print(escaped("a\nb */ c\\d"))
    a\u000ab *\/ c\\d
    """
    plain = text.replace("\\", "\\\\").replace("*/", "*\\/").replace("/*", "\\/*")
    return "".join(_code_of(c) if _is_control(c) else c for c in plain)


def unescaped(text: str) -> str:
    r"""Return the original of an escaped text. This is the inverse of :func:`escaped`.

    >>> unescaped(escaped("a\nb */ c\\d")) == "a\nb */ c\\d"
    True
    """
    return _ESCAPED.sub(lambda m: m[0][1:] if len(m[0]) == 2 else chr(int(m[0][2:], 16)), text)


def _is_control(character: str) -> bool:
    """Return True for control and format characters, surrogates, and separators of lines or paragraphs."""
    return unicodedata.category(character) in ("Cc", "Cf", "Cs", "Zl", "Zp")


def _code_of(character: str) -> str:
    code = ord(character)
    return f"\\u{code:04x}" if code < 1 << 16 else f"\\U{code:08x}"
