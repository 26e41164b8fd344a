"""Advice on the choice of a method: the fastest method for each requirement and accuracy."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.requirements import DECADES, Features, advise, features
from codegen.lab.efficiency.requirements import Advice as Recommendation
from codegen.lab.measurement import Measurement, Section
from codegen.lab.measurements.cost import Cost
from codegen.lab.page.formatting import decade, duration, enumeration
from codegen.lab.subject import Subject

BODY = '{% include "sections/advice.html.j2" %}'
OVERVIEW = '{% import "parts.html.j2" as parts with context %}{{ parts.advice(advice) }}'


@dataclass(frozen=True)
class Recommendations:
    """The fastest method for each requirement, and the properties of all methods."""

    advice: tuple[Recommendation, ...]
    features: tuple[Features, ...]


class Advice(Measurement[Recommendations]):
    """The fastest method for each requirement, computed from the rows of the cost measurement."""

    name = "advice"
    title = "Which method"
    about = "the fastest method for each requirement and accuracy"
    part_of = "cost"

    def run(self, subject: Subject) -> Recommendations:
        """Rank the rows of the cost measurement."""
        cost = Cost().result(subject)
        known = [features(m.compiled, m.artifact) for m in subject.compiled.measured]
        known += [
            features(c.compiled, c.runner.artifact, c.label)
            for c in cost.candidates
            if isinstance(c, EmittedCandidate) and c.method.adaptive and c.equations and c.equations.printed
        ]
        return Recommendations(advise(cost.result.entries, known), tuple(known))

    def as_json(self, result: Recommendations) -> object:
        """Return the best method and its CPU time for each requirement and accuracy."""
        return [
            {"need": a.need, "best": [b and {"method": b[0], "seconds": b[1]} for b in a.best]}
            for a in result.advice
        ]

    def verdict(self, result: Recommendations, subject: Subject) -> str:
        """Return the fastest method without requirements at the largest and the smallest error reached."""
        reached = [(k, best) for k, best in zip(DECADES, result.advice[0].best, strict=True) if best]
        if not reached:
            return ""
        choices = [
            f"at an error of {decade(k)}, {best[0].partition(' (')[0]} ({duration(best[1])})"
            for k, best in reached
        ]
        return f"The fastest emitted method: {enumeration(choices[:: max(1, len(choices) - 1)])}."

    def section(self, result: Recommendations, subject: Subject) -> Section:
        """Return the table of recommendations and the table of properties."""
        return Section(BODY, {"advice": table(result), "features": result.features})

    def overview(self, result: Recommendations, subject: Subject) -> Section:
        """Return the table of recommendations."""
        return Section(OVERVIEW, {"advice": table(result)})


def table(result: Recommendations) -> dict[str, object]:
    """Return the recommendations as a table; ``unmet`` lists the requirements that no method satisfies."""
    return {
        "errors": [decade(k) for k in DECADES],
        "rows": [
            {
                "need": a.need,
                "meaning": a.meaning,
                "best": [None if b is None else {"label": b[0], "time": duration(b[1])} for b in a.best],
            }
            for a in result.advice
            if any(a.best)
        ],
        "unmet": [a.need for a in result.advice if not any(a.best)],
    }
