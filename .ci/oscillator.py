"""Write the page with Table 4.1 of Marthinsen's thesis from emitted C; this takes about a minute.

``python .ci/oscillator.py`` writes the page; with ``--check`` it fails if the page is out of date.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = "docs/reference/oscillator.md"

sys.path.insert(0, str(ROOT))


def main(arguments: list[str]) -> int:
    """Write or check the page."""
    from tests.codegen.oscillator import page

    path, text = ROOT / PAGE, page()
    if "--check" in arguments:
        current = path.read_text(encoding="utf-8") if path.exists() else ""
        if current != text:
            print(f"{PAGE} is out of date; run python .ci/oscillator.py", file=sys.stderr)
            return 1
        return 0
    path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
