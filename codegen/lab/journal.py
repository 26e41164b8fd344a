"""A journal of measured rows, so that an interrupted run goes on where it stopped.

One JSON line a row, written as soon as it is measured; a line that was cut off is dropped. A row answers only
for the same contestant: its key holds what the code was, and the machine's word for its processor.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
from pathlib import Path

from codegen.lab.contest import Contestant, Row
from codegen.lab.reference import Reference


class Journal:
    """Rows by contestant and control, kept in a file; None keeps nothing."""

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}
        if path is None or not path.exists():
            return
        for line in path.read_text(encoding="utf-8").splitlines():
            try:
                entry = json.loads(line)
                self.rows[entry["key"]] = Row(**entry["row"])
            except (ValueError, KeyError, TypeError):
                continue  # cut off by an interruption, or of another version

    def known(self, contestant: Contestant, exact: Reference, control: float) -> Row | None:
        """Return the row of this rung, if it was measured before."""
        return self.rows.get(_key(contestant, exact, control))

    def keep(self, contestant: Contestant, exact: Reference, row: Row) -> None:
        """Write a row down, once."""
        key = _key(contestant, exact, row.control)
        if key in self.rows:
            return
        self.rows[key] = row
        if self.path is not None:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with self.path.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps({"key": key, "row": row.as_json()}) + "\n")
                stream.flush()
                os.fsync(stream.fileno())

    def close(self) -> None:
        """Remove the file: the run is complete."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def _key(contestant: Contestant, exact: Reference, control: float) -> str:
    parts = (contestant.label, contestant.target, contestant.key, control, exact.digits(), platform.machine())
    return hashlib.sha256(repr(parts).encode()).hexdigest()
