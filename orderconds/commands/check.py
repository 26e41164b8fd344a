"""``orderconds check``: compute the orders and properties of tableaux and compare them with the claims."""

from __future__ import annotations

import gc
import io
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import Struct
from msgspec.structs import replace

from orderconds import families
from orderconds.argument import CONDITION_ORDER, TOLERANCE
from orderconds.checking.limits import MAX_CONDITIONS, Limits
from orderconds.commands import screen
from orderconds.commands.names import completing, tableau_names
from orderconds.errors import InputError, TableauError
from orderconds.input_file import read_text
from orderconds.processes import in_processes

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder, Report
    from orderconds.checking.report import EmbeddedOrder, RegisterForm
    from orderconds.proof.certificate import Certificate
    from orderconds.tableau.work import Work

SHOWN = 5
"""The largest number of failing conditions that are printed for one family, and the largest number of names
of skipped files and folders that are printed for one directory."""

UNCLAIMED = "unclaimed"
HOW_TO_CLAIM = 'add `order = 4` (TOML, Python); `"order": 4` (JSON); `order,4` (CSV); `order=4` (numpy.savez)'

DIGITS = 12
"""The largest number of characters of a printed coefficient of a 2N scheme."""

WIDTH = 200
"""The largest number of characters of a printed formula or residual."""


@click.command(name="check")
@click.argument(
    "tableaux",
    nargs=-1,
    required=True,
    metavar="FILE|DIR|NAME...",
    shell_complete=completing(tableau_names, files=True),
)
@click.option(
    "--family",
    "-f",
    help="Check only this family, such as vcg or 'rkmk(1)'. The file need not claim an order in this family.",
)
@click.option(
    "--order",
    "-p",
    type=click.IntRange(*CONDITION_ORDER),
    help="Require at least this order. The orders claimed by the files are ignored.",
)
@click.option(
    "--complete",
    is_flag=True,
    help="Require a claim in every family to which the method belongs, and report each missing claim. "
    "For example, a Butcher tableau needs claims in rk, cg and rkmk.",
)
@click.option(
    "--certified",
    is_flag=True,
    help="Require a proof of each order: the certificate must be 'exact' or 'ball'. If a DIR contains a file "
    "DECIMAL, the tableaux listed in this file need no proof.",
)
@click.option(
    "--require-claims",
    is_flag=True,
    help="Exit with status 1 if at least one tableau contains no claim for the checked families. Exit with "
    "status 2 if a file in a DIR seems to be an incomplete tableau. For example, a JSON file with a "
    "matrix seems to be incomplete if the file contains none of the keys of tableaux (A, b, family, ...).",
)
@click.option(
    "--skip-others",
    is_flag=True,
    help="Skip each FILE that contains no tableau. In a DIR, such files are always skipped.",
)
@click.option(
    "--tolerance",
    type=click.FloatRange(*TOLERANCE),
    metavar="UNITS",
    help="The uncertainty of a binary float x, in units of 2^-53 max(1, |x|). Default: 8. With 0, floats are "
    "exact.",
)
@click.option(
    "--execute",
    is_flag=True,
    help="Execute Python files to obtain their arrays. By default Python files are only parsed.",
)
@click.option(
    "--max-conditions",
    type=click.IntRange(1),
    help="Evaluate at most this number of conditions of each order. Default: 50000.",
)
@click.option(
    "--max-seconds",
    type=click.FloatRange(0, min_open=True),
    help="Stop the check of a tableau after this number of seconds.",
)
@click.option(
    "--max-memory",
    type=click.IntRange(1),
    help="Stop the check of a tableau when it uses more than this number of megabytes of memory.",
)
@click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON list of records on stdout and nothing else."
)
def command(
    tableaux: Sequence[str],
    family: str | None,
    order: int | None,
    complete: bool,
    certified: bool,
    require_claims: bool,
    skip_others: bool,
    tolerance: float | None,
    execute: bool,
    max_conditions: int | None,
    max_seconds: float | None,
    max_memory: int | None,
    as_json: bool,
) -> int:
    """Find the exact order and the properties of each tableau. A tableau is given as a file (TOML, JSON, CSV,
    NPZ, Python, LaTeX or C) or by its name in the library.

    A file can claim an order, for example with the line `order = 4`. To claim an order in a given family,
    write a line such as `rk = 4` in the table `claims` of the file. A claimed order must equal the computed
    order. If a limit, such as --max-seconds, ends the computation, the computed order is a lower bound.

    If a directory is given, all tableau files below it are checked, and other files are skipped.

    The exit status is 0 if all claims hold, 1 if a claim fails or is undecided, 2 if a file cannot be read.

    \b
    Examples:
        orderconds check cf4
        orderconds check tableaux --require-claims
        orderconds check mine.toml --family 'rkmk(2)' --order 4
    """
    if family is not None:
        families.get(family)  # Refuse an unknown family before any file is read.
    job = _Job(
        path="",
        family=family,
        order=order,
        complete=complete,
        certified=certified,
        limits=Limits(max_conditions or MAX_CONDITIONS, max_seconds, max_memory),
        tolerance=tolerance,
        execute=execute,
        as_json=as_json,
        detailed=len(tableaux) == 1 and not os.path.isdir(tableaux[0]),
    )
    jobs = _jobs(tableaux, job, skip_others, strict=require_claims)
    outcomes = list(_outcomes(jobs, as_json))
    verdicts = [outcome.verdict for outcome in outcomes]
    held = set(verdicts) <= {"holds", "holds" if require_claims else UNCLAIMED}
    if as_json:
        import json

        screen.print_json([json.loads(outcome.text) for outcome in outcomes if outcome.verdict])
    elif len(outcomes) > 1 and screen.is_shown(held):
        _print_summary(verdicts)
    if require_claims:
        _report_missing_claims(verdicts)
    return 2 if None in verdicts else 0 if held else 1


def _report_missing_claims(verdicts: Sequence[str | None]) -> None:
    """If tableaux claim no order, write the number of these tableaux to stderr."""
    if count := verdicts.count(UNCLAIMED):
        click.echo(
            f"--require-claims: {count} of {len(verdicts)} tableaux claim no order; {HOW_TO_CLAIM}",
            err=True,
        )


def _jobs(arguments: Sequence[str], job: _Job, skip_others: bool, *, strict: bool) -> list[_Job]:
    """Return one job for each tableau."""
    excused = _excused(arguments)
    paths = list(_files(arguments, skip_others, strict))
    return [
        replace(
            job,
            path=path,
            certified=job.certified and Path(path).stem not in excused,
            one_of_many=len(paths) > 1,
        )
        for path in paths
    ]


def _outcomes(jobs: Sequence[_Job], as_json: bool) -> Iterator[_Outcome]:
    """Check tableaux in parallel. Yield the outcomes in the same order as ``jobs``."""
    subject = jobs[0].path if len(jobs) == 1 else f"{len(jobs)} tableaux"
    with screen.counting(f"checking {subject}", len(jobs)) as done, _without_collection(jobs):
        for job, outcome in zip(jobs, in_processes(_checked, jobs), strict=True):
            done(job.path)
            if outcome.verdict is None:
                click.echo(outcome.text, err=True)
            elif not as_json and screen.is_shown(outcome.verdict == "holds"):
                click.echo(outcome.text, nl=False)
            yield outcome


@contextmanager
def _without_collection(jobs: Sequence[_Job]) -> Iterator[None]:
    """Disable garbage collection if there is only one job."""
    collects = gc.isenabled()
    if len(jobs) == 1:
        gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


class _Job(Struct, frozen=True):
    """One check: the file or name of a tableau, and the options."""

    path: str
    family: str | None
    order: int | None
    complete: bool
    certified: bool
    limits: Limits
    tolerance: float | None
    execute: bool
    as_json: bool
    detailed: bool
    one_of_many: bool = False


class _Outcome(Struct, frozen=True):
    """The verdict of one check, and the text to print. After an InputError, the verdict is None."""

    verdict: str | None
    text: str


def _checked(job: _Job) -> _Outcome:
    """Check one tableau."""
    from orderconds.checking import check, read

    try:
        report = check(
            read(job.path, execute=job.execute),
            family=job.family,
            order=job.order,
            complete=job.complete,
            certified=job.certified,
            limits=job.limits,
            tolerance=job.tolerance,
        )
    except InputError as error:
        message = str(error)
        return _Outcome(None, f"orderconds: {message if job.path in message else f'{job.path}: {message}'}")
    if job.as_json:
        import json

        return _Outcome(report.verdict, json.dumps(report.as_json()))
    if not job.one_of_many:  # A single job runs in the main process, so it prints directly.
        if screen.is_shown(report.verdict == "holds"):
            _print_report(report, detailed=job.detailed)
        return _Outcome(report.verdict, "")
    with redirect_stdout(io.StringIO()) as printed:
        _print_report(report, detailed=job.detailed)
    return _Outcome(report.verdict, printed.getvalue())


def _excused(arguments: Sequence[str]) -> set[str]:
    """Return the names of the tableaux that need no proof.

    The names come from the file ``DECIMAL`` in each given directory. Each line of this file is
    "NAME: reason", where NAME is the file name of a tableau without the suffix.
    """
    names = set[str]()
    for argument in arguments:
        listed = Path(argument) / "DECIMAL"
        if os.path.isdir(argument) and listed.exists():
            lines = read_text(listed, 'lines "NAME: reason"').splitlines()
            names |= {line.partition(":")[0].strip() for line in lines if not line.startswith("#")}
    return names


def _files(arguments: Sequence[str], skip_others: bool, strict: bool) -> Iterator[str]:
    """Yield the files to check, with each directory replaced by the tableau files below it.

    A file in a directory may resemble a tableau, but lack the required names, such as A or b. This file is
    yielded if ``strict`` is true, and skipped if ``strict`` is false
    (:func:`~orderconds.exchange.folder.reason_to_skip`).
    """
    for argument in arguments:
        if not argument.strip():
            raise TableauError(
                f"the argument {argument!r} is empty", expected="a file, a folder or a tableau's name"
            )
        if not os.path.isdir(argument) and not skip_others:
            yield argument
            continue
        from orderconds.exchange.folder import SUFFIXES, reason_to_skip, scan

        if not os.path.isdir(argument):
            if reason := reason_to_skip(argument, strict=strict):
                click.echo(f"skipped {argument}: {reason}", err=True)
            else:
                yield argument
            continue
        below = scan(argument, strict=strict)
        for path, reason in below.skipped:
            click.echo(f"skipped {path}: {reason}", err=True)
        if below.others:
            names = list(dict.fromkeys(below.others))
            shown = ", ".join(names[:SHOWN]) + (", ..." if len(names) > SHOWN else "")
            click.echo(
                f"skipped {len(below.others)} items (hidden folders, files with an unknown suffix): {shown}",
                err=True,
            )
        if not below.tableaux:
            kinds = ", ".join(f"*{suffix}" for suffix in SUFFIXES)
            raise TableauError("no tableau below this directory", where=argument, expected=f"files {kinds}")
        yield from below.tableaux


def _print_report(report: Report, *, detailed: bool) -> None:
    """Print the orders, the failing conditions and the properties of one tableau."""
    heading = f"{report.name}: {report.conclusion}"
    click.secho(heading + (f"  ({report.file})" if report.file else ""), bold=True)
    # No order is computed if the method belongs to none of the families that its file claims.
    if report.orders:
        screen.print_table(
            ("family", "claimed", "order", "verdict", "certificate", "error norm"),
            [_row(family) for family in report.orders],
            indent=2,
        )
    for family in report.orders:
        if family.certificate == "double" and report.verdict != UNCLAIMED:
            click.echo(f"  {family.family}: {family.sentence}")
        if detailed or family.verdict not in ("holds", UNCLAIMED):
            _print_failing(family)
    for broken in report.broken_claims:
        click.echo(f"  claim fails: {broken}")
    if report.hint:
        click.echo(f"  hint: {report.hint}")
    if report.embedded is not None:
        click.echo(f"  embedded method: order {_embedded(report.embedded)}")
    if report.proof is not None:
        click.echo(f"  proof: {_proof(report.proof)}")
    if report.work:
        click.echo(f"  cost of a step: {_work(report.work)}")
    holding = [name for name, value in report.properties.items() if value]
    click.echo(f"  properties: {', '.join(holding) or 'none'}")
    if report.low_storage is not None and report.low_storage.holds:
        click.echo(f"  {_register_form(report.low_storage)}")
    if report.effective_symmetry is not None:
        click.echo(
            "  effectively symmetric: a step of size h followed by a step of size -h agrees with the "
            f"identity up to and including h^{report.effective_symmetry}"
        )
    for reason in dict.fromkeys(report.undecided.values()):
        names = [name for name, why in report.undecided.items() if why == reason]
        click.echo(f"  undecided: {', '.join(names)} ({reason})")
    click.echo()


def _embedded(embedded: EmbeddedOrder) -> str:
    """Return one line with the orders of an embedded method and the certificate of each order."""
    groups: dict[str, list[str]] = {}
    for label, order in embedded.orders.items():
        groups.setdefault(embedded.certificates[label], []).append(f"{order} ({label})")
    return "; ".join(f"{', '.join(orders)}, certificate: {name}" for name, orders in groups.items())


def _register_form(form: RegisterForm) -> str:
    """Return one line with the coefficients A_i and B_i of a 2N scheme (a scheme with two registers)."""
    space = "on a vector space" if form.space == "vector space" else "on every group"
    A, B = (
        f"[{', '.join(x if len(x) <= DIGITS else x[:DIGITS] + '...' for x in row)}]"
        for row in (form.A, form.B)
    )
    return f"two registers (2N) {space}: A = {A}, B = {B}"


def _work(work: dict[str, Work]) -> str:
    """Return one line that describes the cost of a step."""
    evaluations = max(cost.evaluations for cost in work.values())
    counts = [_count(evaluations, "evaluation")]
    for label, cost in work.items():
        if cost.exponentials is not None:
            brackets = f" and {_count(cost.brackets, 'bracket')}" if cost.brackets else ""
            counts.append(f"{label}: {_count(cost.exponentials, 'exponential')}{brackets}")
    return "; ".join(counts)


def _count(n: int, what: str) -> str:
    return f"{n} {what}{'' if n == 1 else 's'}"


def _proof(proof: Certificate) -> str:
    """Return one line that describes the result of ``proof``."""
    text = (
        f"the {proof.equations} equations from [proof] have exactly one solution "
        f"within {proof.radius} of the rounded decimals in the file"
    )
    if not proof.printed:
        return text
    furthest = max(proof.printed.values(), key=float)
    return (
        f"{text}; the digits printed in the cited publication differ from this solution by up to {furthest}"
    )


def _row(family: FamilyOrder) -> tuple[str, ...]:
    if family.required is not None:
        claimed = f">= {family.required}"
    else:
        claimed = "-" if family.claimed is None else str(family.claimed)
    order = f">= {family.order}" if family.limit is not None else str(family.order)
    norm = "-" if family.error_norm is None else f"{family.error_norm:.3e}"
    certificate = f"certificate: {family.certificate}"
    return family.family, claimed, order, family.verdict, certificate, norm


def _print_failing(family: FamilyOrder) -> None:
    """Print why the order is not higher."""
    n = family.order + 1
    if family.limit is not None:
        reached = f"{family.family}: no condition fails up to order {family.limit}"
        if family.stopped is None:
            click.echo(f"  {reached}, the highest order searched")
        else:
            click.echo(
                f"  {reached}; a limit on conditions, time or memory ended the check after "
                f"{family.stopped} conditions"
            )
        return
    if not family.decided:
        click.echo(f"  {family.family}: the coefficients have too few digits to decide order {n}")
        return
    count = len(family.failing)
    if not count:
        click.echo(f"  {family.family}: order {family.order} is the highest possible order in this family")
        return
    text = "1 condition" if count == 1 else f"{count} conditions"
    click.echo(f"  {family.family}: {text} of order {n} not met")
    shown = 1 if family.verdict in ("holds", UNCLAIMED) else SHOWN
    for failure in family.failing[:shown]:
        decimal = "" if failure.decimal == failure.residual else f" = {failure.decimal}"
        formula = failure.condition.expression
        formula = formula if len(formula) <= WIDTH else formula[:WIDTH] + " ..."
        click.echo(f"    {failure.condition.tree}: {formula} = {failure.condition.rhs}")
        residual = failure.residual if len(failure.residual) <= WIDTH else failure.residual[:WIDTH] + " ..."
        click.echo(f"      residual {residual}{decimal}")
    if count > shown:
        click.echo(f"    ... and {count - shown} more (--json lists all)")


def _print_summary(verdicts: Sequence[str | None]) -> None:
    counts = [
        f"{n} {verdict}"
        for verdict in ("holds", "fails", "undecided", UNCLAIMED)
        if (n := verdicts.count(verdict))
    ]
    counts += [f"{n} not read"] if (n := verdicts.count(None)) else []
    click.echo(f"{len(verdicts)} tableaux: {', '.join(counts)}")
