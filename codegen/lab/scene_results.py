"""The results of all selected measurements on one scene."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from codegen.lab.measurement import Section
from codegen.lab.registry import AnyMeasurement, measurements
from codegen.lab.subject import Subject
from codegen.scene.problem import Problem
from orderconds.errors import InputError


@dataclass(frozen=True)
class Measured:
    """One measurement on a subject (a scene with methods).

    ``result`` is the result of the measurement. If the measurement failed, ``failure`` is the reason.
    """

    measurement: AnyMeasurement
    subject: Subject
    result: object = None
    failure: str = ""

    @property
    def name(self) -> str:
        """The name of the measurement."""
        return self.measurement.name

    @property
    def title(self) -> str:
        """The heading of the section."""
        return self.measurement.title

    @property
    def holds(self) -> bool:
        """True if the measurement succeeded and all its checks passed."""
        return not self.failure and self.measurement.holds(self.result)

    def section(self) -> Section | None:
        """Return the body of the section, or None if there is nothing to show."""
        return None if self.failure else self.measurement.section(self.result, self.subject)

    def verdict(self) -> str:
        """Return one sentence that states the result, or '' if there is no result."""
        return "" if self.failure else self.measurement.verdict(self.result, self.subject)

    def overview(self) -> Section | None:
        """Return a paragraph or table for the overview page of all scenes, or None if there is nothing to
        show."""
        return None if self.failure else self.measurement.overview(self.result, self.subject)

    def files(self) -> Mapping[str, str]:
        """Return the files to write into the folder of the report page, as a mapping from name to text."""
        return {} if self.failure else self.measurement.files(self.result, self.subject)

    def lines(self) -> Iterable[str]:
        """Return the lines that ``orderconds report`` prints on the terminal."""
        if self.failure:
            return [f"{self.subject.scene.name}: the measurement {self.name} failed: {self.failure}"]
        return self.measurement.lines(self.result, self.subject)

    def as_json(self) -> object:
        """Return plain data, which can be written as JSON."""
        return {"failure": self.failure} if self.failure else self.measurement.as_json(self.result)


@dataclass(frozen=True)
class SceneResults:
    """The results of the selected measurements on one scene."""

    subject: Subject
    measured: tuple[Measured, ...]

    @property
    def scene(self) -> Problem:
        """The scene."""
        return self.subject.scene

    @property
    def held(self) -> bool:
        """True if all measurements succeeded and passed their checks."""
        return all(m.holds for m in self.measured)

    def as_json(self) -> dict[str, object]:
        """Return a dictionary with the name of the scene and the results of all measurements as plain data.

        The value of a measurement that was not selected is [].
        """
        measured = {m.name: m.as_json() for m in self.measured}
        keys = {m.name: m.json_key or m.name for m in measurements()}
        return {"scene": self.scene.name} | {key: measured.get(name, []) for name, key in keys.items()}


def measure_scene(subject: Subject, chosen: Sequence[AnyMeasurement]) -> SceneResults:
    """Make the selected measurements. If a measurement fails, the remaining measurements are still made."""
    return SceneResults(subject, tuple(_measure(m, subject) for m in chosen))


def _measure(measurement: AnyMeasurement, subject: Subject) -> Measured:
    try:
        return Measured(measurement, subject, measurement.result(subject))
    except (InputError, ArithmeticError, ValueError) as error:
        return Measured(measurement, subject, failure=str(error))
