"""The base class of measurements.

A measurement computes a result, and writes the result as JSON and as a section of the report.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar, Generic, TypeVar, cast

if TYPE_CHECKING:
    from codegen.lab.subject import Subject

R = TypeVar("R")


@dataclass(frozen=True)
class Section:
    """The content of a section of the report.

    ``template`` is the source text of a Jinja template with the variables ``data``. HTML characters in
    ``data`` are escaped, except in objects of the class ``Markup``.
    """

    template: str
    data: Mapping[str, object] = field(default_factory=dict)


class Measurement(ABC, Generic[R]):
    """A measurement of methods on a scene, with a result of type R.

    Subclasses define :meth:`run`, :meth:`as_json` and :meth:`section`, and set the following names:

    - ``name``: the name for ``orderconds report --only``, for the JSON, and for links in the page;
    - ``title``: the heading of the section;
    - ``about``: one line of text for ``orderconds list measurements``;
    - ``json_key``: the key of the result in the JSON of the report, by default ``name``;
    - ``part_of``: the name of another measurement. ``--only`` with that name selects this measurement, too.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    about: ClassVar[str]
    json_key: ClassVar[str] = ""
    part_of: ClassVar[str] = ""

    @abstractmethod
    def run(self, subject: Subject) -> R:
        """Measure the methods of ``subject`` (a scene with methods), and return the result.

        If a method fails, the measurement continues with the next method (:meth:`Subject.each`).
        """

    @abstractmethod
    def as_json(self, result: R) -> object:
        """Return the result as plain data for JSON."""

    @abstractmethod
    def section(self, result: R, subject: Subject) -> Section | None:
        """Return the content of the section, or None if there is nothing to show."""

    def verdict(self, result: R, subject: Subject) -> str:
        """Summarize the result in one sentence, for the beginning of the section in the report.

        If a subclass does not define this method, there is no such sentence: the method returns ''.
        """
        return ""

    def holds(self, result: R) -> bool:
        """Return True if every check passed. If a check failed, the exit status of ``report`` is 1."""
        return True

    def lines(self, result: R, subject: Subject) -> Iterable[str]:
        """Return the lines that ``orderconds report`` prints on the terminal."""
        return ()

    def overview(self, result: R, subject: Subject) -> Section | None:
        """Return a paragraph or table for the overview page, or None if there is nothing to show."""
        return None

    def files(self, result: R, subject: Subject) -> Mapping[str, str]:
        """Return the files to write into the folder of the page. The keys are the file names."""
        return {}

    def result(self, subject: Subject) -> R:
        """Return the result for a subject. Only the first call makes the measurement."""
        if self.name not in subject.results:
            subject.results[self.name] = self.run(subject)
        return cast("R", subject.results[self.name])
