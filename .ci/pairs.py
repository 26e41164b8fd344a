"""Write the page of pairs: the families that are tested on each group and by each action, and in each target.

``python .ci/pairs.py`` writes the page; with ``--check`` it fails if the page is out of date.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = "docs/reference/pairs.md"

sys.path.insert(0, str(ROOT))


def main(arguments: list[str]) -> int:
    """Write or check the page."""
    from tests.codegen.pairs import page

    path, text = ROOT / PAGE, page()
    if "--check" in arguments:
        current = path.read_text(encoding="utf-8") if path.exists() else ""
        if current != text:
            print(f"{PAGE} is out of date; run python .ci/pairs.py", file=sys.stderr)
            return 1
        return 0
    path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
