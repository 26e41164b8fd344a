"""The exit status of the program, and its messages about errors. A message is one line on stderr. With
``--json``, the error is also written to stdout as one JSON document.

=====  ===============================================================================
0      success
1      the command ran, and a claim or check failed
2      bad input or usage
70     an internal error: a fault of this program
129    stopped by the signal SIGHUP
130    interrupted by Ctrl-C
141    another program, such as ``head``, closed the output pipe; no message
143    stopped by the signal SIGTERM
=====  ===============================================================================
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from types import FrameType
from typing import Any

import click

from orderconds.errors import InputError

BAD_INPUT = 2
INTERNAL = 70
INTERRUPTED = 130
BROKEN_PIPE = 141
SIGNALS = ("SIGTERM", "SIGHUP")
"""The signals that the program handles like Ctrl-C."""

MAX_TEXT = 300
"""A message about an internal error contains at most this number of characters from the exception's text."""


class Terminated(KeyboardInterrupt):
    """The error that is raised when the program receives one of :data:`SIGNALS`."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


class Stopped(Exception):
    """A substitute for the exceptions KeyboardInterrupt and BrokenPipeError.

    The library click would handle these two exceptions itself. To prevent this, the function
    :func:`past_click` raises a substitute. The attribute ``cause`` contains the original exception.
    """

    def __init__(self, cause: BaseException) -> None:
        super().__init__()
        self.cause = cause


def json_text(value: Any) -> str:
    r"""Return a JSON document as indented text in ASCII. The keys keep their order.

    >>> json_text(["\u00fc"]).split()
    ['[', '"\\u00fc"', ']']
    """
    import json

    return json.dumps(value, indent=2, allow_nan=False)


@dataclass
class Run:
    """One run of the program: its options, and the number of JSON documents that the run has printed."""

    as_json: bool = False
    traceback: bool = False
    quiet: bool = False
    verbose: bool = False
    documents: int = 0

    def print_document(self, value: Any) -> None:
        """Print one JSON document in the format of :func:`json_text`."""
        text = json_text(value)
        self.documents += 1
        click.echo(text)

    def end(self, error: BaseException) -> int:
        """Print the message of an error, and return the exit status. With ``--json``, also print JSON.

        >>> Run(as_json=True).end(InputError("a row of 3", where="x.toml", expected="2 entries"))
        {
          "error": {
            "status": 2,
            "kind": "InputError",
            "message": "x.toml: a row of 3; expected 2 entries",
            "found": "a row of 3",
            "where": "x.toml",
            "expected": "2 entries",
            "hint": ""
          }
        }
        2
        """
        error = error.cause if isinstance(error, Stopped) else error
        if isinstance(error, BrokenPipeError):
            _silence_stdout()
            return BROKEN_PIPE
        status, message = _reported(error)
        if status == INTERNAL and self.traceback:
            import traceback

            traceback.print_exception(error)
        record: dict[str, Any] = {"status": status, "kind": type(error).__name__, "message": message}
        if isinstance(error, InputError):
            record |= {key: getattr(error, key) for key in ("found", "where", "expected", "hint")}
        self.refuse(record)
        return status

    def refuse(self, record: dict[str, Any]) -> None:
        """Print the message of an error. With ``--json``, also print ``record`` as JSON if this run has not
        yet printed a JSON document.
        """
        with contextlib.suppress(OSError):  # If writing fails, the exit status remains the same.
            click.echo(f"orderconds: {record['message']}", err=True)
        if self.as_json and not self.documents:
            with contextlib.suppress(OSError):
                self.print_document({"error": record})
                sys.stdout.flush()


def _reported(error: BaseException) -> tuple[int, str]:
    """Return the exit status and the message of an error."""
    match error:
        case InputError():
            return BAD_INPUT, str(error)
        case click.UsageError():
            return BAD_INPUT, _usage_message(error)
        case click.ClickException():
            return BAD_INPUT, error.format_message()
        case OSError():
            return BAD_INPUT, f"{error.filename or 'system'}: {error.strerror or error}"
        case Terminated():
            name = signal.Signals(error.number).name
            return 128 + error.number, "; ".join([f"stopped by {name}", *_notes(error)])
        case KeyboardInterrupt() | click.Abort():
            return INTERRUPTED, "; ".join(["interrupted", *_notes(error)])
    text = " ".join(str(error).split())
    shown = text if len(text) <= MAX_TEXT else text[:MAX_TEXT] + " ..."
    return INTERNAL, (
        f"internal error: {type(error).__name__}{': ' * bool(shown)}{shown}; please report this error with "
        "the command, the input, and the traceback that ORDERCONDS_TRACEBACK=1 shows"
    )


def _notes(error: BaseException) -> list[str]:
    return list(getattr(error, "__notes__", []))


def _usage_message(error: click.UsageError) -> str:
    message = error.format_message().rstrip(".")
    if error.ctx is None:
        return message
    path = error.ctx.command_path
    return f"{path.partition(' ')[2] or 'usage'}: {message}; type: {path} --help"


@contextlib.contextmanager
def past_click() -> Iterator[None]:
    """Replace the exceptions KeyboardInterrupt and BrokenPipeError by :class:`Stopped`.

    The library click would handle these two exceptions itself.

    >>> with past_click():
    ...     raise KeyboardInterrupt
    Traceback (most recent call last):
    orderconds.exit_status.Stopped
    """
    try:
        yield
    except (KeyboardInterrupt, BrokenPipeError) as cause:
        raise Stopped(cause) from cause


def _silence_stdout() -> None:
    """Redirect a closed stdout to the null device. Otherwise, Python would report an error at exit."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def catch_signals() -> None:
    """Install handlers for :data:`SIGNALS` that raise :class:`Terminated`. If the same signal arrives a
    second time, the program ends at once."""

    def stop(number: int, frame: FrameType | None) -> None:
        signal.signal(number, signal.SIG_DFL)
        raise Terminated(number)

    for name in SIGNALS:
        number = getattr(signal, name, None)
        # If a parent process such as nohup ignores a signal, this program ignores the signal, too.
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, stop)


def current_run() -> Run:
    """Return the :class:`Run` of the current command, or a new :class:`Run` if no command is running.

    >>> current_run().documents
    0
    """
    context = click.get_current_context(silent=True)
    return (context.find_object(Run) if context is not None else None) or Run()
