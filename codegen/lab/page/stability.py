"""Stability on the page: the largest usable step, extreme input, stiff variants, long endurance."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from markupsafe import Markup

from codegen.lab.figures import region_figure
from codegen.lab.page.spelling import Picture, scientific
from codegen.lab.stability.endurance import Endurance
from codegen.lab.stability.extremes import ACCURATE, WRONG, Answer
from codegen.lab.stability.study import Stability


def section(found: Sequence[Stability], again: str) -> dict[str, Any]:
    """Return what the templates need of the stability of methods; ``again`` is the command for it."""
    stiff = [(s, v) for s in found for v in s.stiff]
    return {
        "rows": [_row(s) for s in found],
        "picture": _picture(found, again),
        "cases": [_cases(s) for s in found],
        "variants": [
            {"variant": name, "verdicts": [(s.method, v.verdict) for s, v in stiff if v.variant == name]}
            for name in dict.fromkeys(v.variant for _, v in stiff)
        ],
        "endurance": [(s.method, e.name, _ended(e)) for s in found for e in s.endurance],
        "notes": list(dict.fromkeys(note for s in found for note in s.notes)),
    }


def _picture(found: Sequence[Stability], again: str) -> Picture | None:
    functions = [(s.method, k, s.region.value) for k, s in enumerate(found) if s.region is not None]
    if not functions:
        return None
    return Picture(
        Markup(region_figure(f"{found[0].scene} regions", functions)),
        "Where |R(hλ)| = 1, the boundary of linear stability for y′ = λy. Zero lies on each; what lies next "
        "to it on the left is stable.",
        again,
    )


def _row(found: Stability) -> dict[str, Any]:
    kinds = Counter(_kind(a) for a in found.answers)
    limit, region = found.limit, found.region
    return {
        "label": found.method,
        "h": "none" if limit.h is None else f"{limit.h:.3g}",
        "reason": limit.reason,
        "real": "–" if region is None else _length(region.real),
        "imaginary": "–" if region is None else _length(region.imaginary),
        "accurate": kinds["accurate"],
        "status": kinds["status"],
        "other": kinds["undetermined"],
        "wrong": kinds["wrong"],
    }


def _kind(answer: Answer) -> str:
    if answer.verdict.startswith(WRONG):
        return "wrong"
    return answer.verdict.partition(":")[0] if answer.verdict != ACCURATE else "accurate"


def _length(x: float) -> str:
    return "unbounded" if x == float("inf") else f"{x:.3g}" if x else "none"


def _cases(found: Stability) -> dict[str, Any]:
    """Return the cases of a method; neighbours that got the same status share a row."""
    rows: list[dict[str, Any]] = []
    for a in found.answers:
        if rows and a.error is None and rows[-1]["verdict"] == a.verdict:
            rows[-1]["names"].append(a.case.name)
            continue
        rows.append(
            {
                "names": [a.case.name],
                "verdict": a.verdict,
                "kind": _kind(a),
                "error": "" if a.error is None else scientific(a.error),
                "digits": "" if a.determined in (None, float("inf")) else f"{a.determined:.0f}",
            }
        )
    return {"label": found.method, "count": len(found.answers), "rows": rows}


def _ended(run: Endurance) -> str:
    if run.failure:
        return run.failure
    parts = [f"{run.steps} steps"]
    parts += [] if run.defect is None else [f"{scientific(run.defect)} off the manifold"]
    parts += [] if run.returned is None else [f"{scientific(run.returned)} from the start"]
    return ", ".join(parts) + ("" if run.held else ": more than rounding explains")
