"""Semilinear equations by symbol: the derived coefficients, functions of h L, transforms, orders, errors."""

from __future__ import annotations

import shutil
import subprocess
from functools import cache
from math import pi

import mpmath
import numpy as np
import pytest
from click.testing import CliRunner
from sympy import I, Rational, Symbol, cos, sin, symbols
from sympy import pi as period

from codegen import emit, load, load_spectral
from codegen.arrival import Status
from codegen.build import find_compiler
from codegen.emitter import compile_method
from codegen.errors import MethodError, SceneError
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.mode_step import STATE
from codegen.lower import lower, method_for
from codegen.printers.c.module import FLAGS
from codegen.scene import Dx, SemilinearScene, param
from codegen.scene.semilinear import EIGENVALUE, model_of
from codegen.scenes import problem_of
from orderconds.cli import program
from orderconds.errors import InputError

u, k, x, t = symbols("u k x t", real=True)
KS = "kuramoto_sivashinsky"
ALLEN_CAHN = "allen_cahn_periodic"
TARGETS = ("python", "c")


def scene(**changes):
    given = {"L": -(k**2), "N": u - u**3, "length": 2 * period, "u0": cos(x) / 2, "span": (0, 1)}
    return SemilinearScene(u=u, k=k, x=x, **(given | changes))


@cache
def module(name, method, target):
    own = {"quiet": quiet, "timed": timed, "travel": travel, "exact": exactly, "dispersive": dispersive}
    return load_spectral(emit(own[name]() if name in own else name, method, target=target))


def quiet():
    return scene(N=-u * Dx(u) + Dx(u, 2) / 10, L=Rational(-1, 10) * k**2, u0=sin(x))


def travel():
    return scene(L=-I * k - k**2 / 10, N=0, u0=sin(x) + cos(2 * x))


def timed():
    return scene(N=cos(t) + cos(x) * sin(t), u0=0)


def exactly():
    c = param("c", 1)
    return scene(L=-c * abs(k), N=u**2, u0=0)


def dispersive():
    a, b = param("a", 1), param("b", 1)
    return scene(L=-a * k**2 + I * b * k, N=u**2, u0=0)


# The coefficients


def test_the_coefficients_of_cf4_are_the_published_ones():
    # Celledoni, Marthinsen and Owren (2003), for a semilinear problem; the first exponential acts first.
    lines = compile_method(KS, "cf:cf4").kernel.modes.explanation()
    assert lines[:4] == [
        "U1 = u",
        "U2 = exp(1/2 z) u + h 1/2 phi1(1/2 z) N1",
        "U3 = exp(1/2 z) u + h 1/2 phi1(1/2 z) N2",
        "U4 = exp(z) u + h (1/2 exp(1/2 z) phi1(1/2 z) - 1/2 phi1(1/2 z)) N1 + h phi1(1/2 z) N3",
    ]
    assert "all coefficients are bounded" in " ".join(lines)


@pytest.mark.parametrize(
    ("method", "growth"), [("cf:cf4", 0), ("cf:cf3", 0), ("rkmk:rk4", 2), ("rkmk(0):euler", 0)]
)
def test_the_bound_on_the_growth_of_the_tables_holds(method, growth):
    step = compile_method(KS, method).kernel.modes
    assert step.growth == growth
    with mpmath.workdps(30):
        far, near = (
            max(abs(value(table.multiplier, mpmath.mpf(z))) for table in step.tables) for z in (-1e6, -1e3)
        )
    assert far <= 1.01 * near * 1000**growth


def value(multiplier, z):
    """Return the value of a multiplier, from the definitions of its factors."""
    functions = {
        "exp": mpmath.exp,
        "phi1": lambda w: mpmath.expm1(w) / w if w else mpmath.mpf(1),
        "bernoulli": lambda w: w / mpmath.expm1(w) if w else mpmath.mpf(1),
        "z": lambda w: w,
    }
    total = mpmath.mpf(0)
    for monomial, number in multiplier.terms.items():
        product = mpmath.mpf(number.fraction().numerator) / number.fraction().denominator
        for f, n in monomial:
            scale = mpmath.mpf(f.scale.fraction().numerator) / f.scale.fraction().denominator
            product *= functions[f.function](scale * z) ** n
        total += product
    return total


@pytest.mark.parametrize(
    "method", ["cf:cf4", "cf:luescher3", "rkmk:rk4", "rkmk(2):rk4", "rkmk(1):kutta3", "cg:cg3"]
)
def test_a_step_is_the_program_on_the_affine_group(method):
    # The oracle executes the program with matrices [[lambda, b], [0, 0]] and their exponentials.
    problem = problem_of(KS)
    chosen = method_for(problem, method)
    compiled = compile_method(problem, method)
    model = model_of(compiled.scene)
    step, digits = compiled.kernel.modes, 40
    with mpmath.workdps(digits):
        h, start = mpmath.mpf(1) / 8, mpmath.mpf(1) / 3
        z = h * EIGENVALUE.numerator / EIGENVALUE.denominator
        domain = PreciseDomain(h, digits)
        oracle = interpret(lower(model, chosen), model, domain, {"y": (domain.rational(1, 3),)})["y"][0]

        def combined(terms):
            return sum(
                (mpmath.mpf(1) if x.table is None else table(step.tables[x.table])) * source(x.source)
                for x in terms
            )

        def table(own):
            return value(own.multiplier, z) * (h if own.power else 1)

        def source(number):
            return start if number == STATE else values[number]

        values = []
        for evaluation in step.evaluations:
            values.append(combined(evaluation.point) ** 2)
        assert abs(combined(step.result) - oracle) < mpmath.mpf(10) ** -27


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("name", ["exact", "dispersive"])
def test_functions_of_h_times_the_operator_have_all_digits(name, target):
    arguments = [2.0**-60, 1e-9, 1e-4, 0.03, 0.7, 1.0, 2.5, 6.0, 40.0, 700.0]
    cases = [(a,) for a in arguments] + [(-a,) for a in arguments[:-1]]
    if name == "dispersive":
        cases = [
            (a, b) for a in (*arguments, -1e-9, -0.5, 0.0) for b in (0.0, 1e-12, 1e-3, 1.0, -3.0, 6.0, 100.0)
        ]
    worst = 0.0
    for case in cases:
        exp, phi = tables_at(name, target, case)
        with mpmath.workdps(60):
            z = mpmath.mpc(-case[0], case[1] if len(case) > 1 else 0)
            exact = mpmath.expm1(z) / z if z else mpmath.mpf(1)
            worst = max(worst, float(abs(phi - exact) / abs(exact)), float(abs(exp / mpmath.exp(z) - 1)))
    assert worst < 8 * 2.0**-53


def tables_at(name, target, parameters):
    """Return the values exp(z) and phi_1(z) in the tables of the exponential Euler method for h = k = 1."""
    own = parametrised(name, target)
    if target == "python":
        tables, status = own._module.prepare(4, 1.0, *parameters)
        assert not status
        exp, phi = (complex(table[1]) for table in tables[2])
        return mpmath.mpc(exp), mpmath.mpc(phi)
    tables = np.empty(own._function("tables")(4))
    assert own._function("prepare")(4, 1.0, *parameters, own._pointer(tables)) == 0
    width = 1 if name == "exact" else 2
    rows = tables[2:].reshape(2, 3, width)[:, 1]
    return tuple(mpmath.mpc(*map(float, row)) for row in rows)


@cache
def parametrised(name, target):
    given = {"exact": (exactly, ["c"]), "dispersive": (dispersive, ["a", "b"])}
    make, parameters = given[name]
    return load_spectral(emit(make(), "rkmk(0):euler", target=target, parameters=parameters))


# Transforms


@pytest.mark.parametrize("n", [4, 8, 16, 32, 64, 1024, 2048])
def test_transforms_of_the_c_module_are_those_of_numpy(n):
    own = module(KS, "cf:cf4", "c")
    memory, spectrum, back = np.empty(own._function("fft_memory")(n)), np.empty(n + 2), np.empty(n)
    assert own._function("fft_prepare")(n, own._pointer(memory)) == Status.OK
    transform = own._function("fft")(own._pointer(memory))
    values = np.random.default_rng(n).normal(size=n)
    transform.forward(n, own._pointer(values), own._pointer(spectrum), transform.context)
    expected = np.fft.rfft(values)
    assert abs(spectrum.view(complex) - expected).max() < 4e-16 * np.log2(n) * np.sqrt(n) * 2
    transform.backward(n, own._pointer(spectrum), own._pointer(back), transform.context)
    assert abs(back - values).max() < 2e-15


@pytest.mark.parametrize("n", [0, 1, 2, 6, 12, 1000])
def test_transforms_of_other_lengths_are_refused(n):
    own = module(KS, "cf:cf4", "c")
    assert own._function("fft_prepare")(n, own._pointer(np.empty(4 * n + 4))) == Status.BAD_SHAPE


# Runs


@pytest.mark.parametrize("n", [16, 48, 128])
@pytest.mark.parametrize("name", [KS, "quiet", "timed", "travel"])
def test_both_targets_agree(name, n):
    first, second = (module(name, "cf:cf4", target) for target in TARGETS)
    start = first.start(n)
    assert abs(second.start(n) - start).max() < 4e-16
    one, two = (each.run(start, 1 / 32, 20) for each in (first, second))
    assert one.ok
    assert two.ok
    assert abs(one.values - two.values).max() < 1e-13


@pytest.mark.parametrize("target", TARGETS)
def test_a_linear_equation_is_solved_exactly(target):
    own = module("travel", "cf:cf4", target)
    points, end = own.points(32), 1.5
    exact = np.exp(-end / 10) * np.sin(points - end) + np.exp(-4 * end / 10) * np.cos(2 * (points - end))
    assert abs(own.run(own.start(32), 0.5, 3).values - exact).max() < 1e-14


@pytest.mark.parametrize("target", TARGETS)
def test_a_term_with_the_time_has_order_four(target):
    own = module("timed", "cf:cf4", target)
    errors = []
    for steps in (10, 20, 40):
        found = own.run(own.start(16), 1 / steps, steps, t=0.5).values
        # The mean is the integral of cos. The first mode a satisfies a' = -a + sin t.
        s, e = 0.5, 1.5
        a = (np.sin(e) - np.cos(e)) / 2 - np.exp(s - e) * (np.sin(s) - np.cos(s)) / 2
        exact = np.sin(e) - np.sin(s) + a * np.cos(own.points(16))
        errors.append(abs(found - exact).max())
    assert all(3.8 < slope < 4.2 for slope in np.log2(np.divide(errors[:-1], errors[1:])))


def reference(n, end):
    """Return the solution of the Kuramoto-Sivashinsky equation by a method of another kind, for its Fourier
    coefficients."""
    from scipy.integrate import solve_ivp

    length = 32 * pi
    wave = 2 * pi * np.arange(n // 2 + 1) / length
    odd = np.append(wave[:-1], 0.0)
    points = length * np.arange(n) / n

    def field(_, numbers):
        spectrum = numbers.view(complex)
        values = np.fft.irfft(spectrum, n)
        return ((wave**2 - wave**4) * spectrum - 0.5j * odd * np.fft.rfft(values**2)).view(float)

    first = np.fft.rfft(np.cos(points / 16) * (1 + np.sin(points / 16)))
    solution = solve_ivp(field, (0, end), first.view(float), method="DOP853", rtol=1e-12, atol=1e-12)
    return np.fft.irfft(np.ascontiguousarray(solution.y[:, -1]).view(complex), n)


ORDERS = [
    ("rkmk(0):euler", 1, 64),
    ("cf:cf4", 4, 8),
    ("rkmk:rk4", 4, 16),
    pytest.param("cf:cf3", 3, 16, marks=pytest.mark.slow),
    pytest.param("rkmk(2):rk4", 4, 16, marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("method", "order", "steps"), ORDERS)
def test_the_order_is_the_stated_one(method, order, steps):
    n, end = 32, 4.0
    exact, own = reference(n, end), module(KS, method, "c")
    errors = [
        abs(own.run(own.start(n), end / number, number).values - exact).max()
        for number in (steps, 2 * steps, 4 * steps)
    ]
    slopes = np.log2(np.divide(errors[:-1], errors[1:]))
    assert all(order - 0.35 < slope < order + 0.45 for slope in slopes)


@pytest.mark.slow
@pytest.mark.parametrize("name", [KS, ALLEN_CAHN])
def test_the_order_holds_for_1024_points(name):
    n, end, own = 1024, 4.0, module(name, "cf:cf4", "c")
    exact = own.run(own.start(n), end / 1024, 1024).values
    errors = [
        abs(own.run(own.start(n), end / number, number).values - exact).max() for number in (16, 32, 64)
    ]
    assert all(3.6 < slope < 4.3 for slope in np.log2(np.divide(errors[:-1], errors[1:])))


@pytest.mark.parametrize("target", TARGETS)
def test_both_forms_of_the_same_term_agree(target):
    product = module("quiet", "cf:cf4", target)
    other = scene(N=-Dx(u**2) / 2, L=Rational(-1, 5) * k**2, u0=sin(x))
    flux = load_spectral(emit(other, "cf:cf4", target=target))
    results = [own.run(product.start(64), 1 / 200, 40).values for own in (product, flux)]
    assert abs(results[0] - results[1]).max() < 1e-9


@pytest.mark.parametrize("target", TARGETS)
def test_aliases_are_removed(target):
    own = load_spectral(emit(scene(L=0, N=u**2, dealias=True), "rkmk(0):euler", target=target))
    points = own.points(24)
    spectrum = abs(np.fft.rfft(own.run(np.cos(4 * points) + np.cos(3 * points), 0.5, 1).values))
    # The modes 8, 7, 6, 1 and 0 are driven, and the modes from 8 = 24/3 on are not kept.
    assert spectrum[7] > 1
    assert spectrum[6] > 1
    assert spectrum[8:].max() < 1e-12


# Bad input


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"L": I * k**2}, "real functions"),
        ({"L": 1 / k}, "not finite at k = 0"),
        ({"L": t * k**2}, "depends on the time"),
        ({"L": u * k}, "the symbol u in L"),
        ({"L": "k"}, "L is 'k'"),
        ({"N": Dx(u * Dx(u**2))}, "nested derivative"),
        ({"N": u * Dx(u**2)}, "in a product"),
        ({"N": sin(Dx(u**2))}, "in a product or in a function"),
        ({"N": k * u}, "the symbol k in N"),
        ({"N": Symbol("other") * u}, "the symbol other in N"),
        ({"u0": Dx(x)}, "a derivative in u0"),
        ({"u0": t}, "u0 contains t"),
        ({"length": 0}, "length = 0"),
        ({"length": -1}, "length = -1"),
        ({"dealias": 2}, "dealias = 2"),
        ({"span": (1, 0)}, "the span"),
    ],
)
def test_a_scene_that_cannot_be_read_names_the_reason(changes, message):
    with pytest.raises(SceneError, match="(?i)" + message):
        scene(**changes)


def test_derivatives_have_a_largest_order():
    with pytest.raises(SceneError, match="Dx of order 0"):
        Dx(u, 0)


@pytest.mark.parametrize(
    ("method", "options", "message"),
    [
        ("rkmk(2):gauss2", {}, "implicit"),
        ("cf:cf43", {"adaptive": True}, "an error estimate"),
        ("rk:rk4", {}, "whose group is"),
        ("ambient:rk4", {}, "a semilinear equation"),
        ("cf:cf4", {"jacobian": True}, "a Jacobian"),
        ("cf:cf4", {"compensate": True}, "compensated summation"),
        ("cf:cf4", {"batch": True}, "batch is not available on a semilinear"),
    ],
)
def test_a_method_that_cannot_be_compiled_is_refused(method, options, message):
    with pytest.raises(MethodError, match=message):
        emit(KS, method, **options)


@pytest.mark.parametrize("target", TARGETS)
def test_bad_numbers_have_a_status_or_an_error(target):
    own = module(KS, "cf:cf4", target)
    start = own.start(16)
    assert own.run(start, float("nan"), 1).status == Status.BAD_STEP
    backwards = module(ALLEN_CAHN, "cf:cf4", target).run(np.zeros(64), -1e6, 1)
    assert backwards.status == Status.BAD_OPERATOR
    assert not backwards.ok
    assert "is not finite" in backwards.reason
    far = module("quiet", "cf:cf4", target).run(1e200 * module("quiet", "cf:cf4", target).start(16), 1.0, 5)
    assert far.status == Status.NOT_FINITE
    assert far.completed < 5
    assert np.isfinite(far.values).all()
    for wrong, message in (
        (np.zeros(15), "even number"),
        (np.zeros(0), "even number"),
        (np.zeros((4, 4)), "shape"),
        (np.array([1.0, np.nan]), "finite numbers"),
    ):
        with pytest.raises(ValueError, match=message):
            own.run(wrong, 0.1, 1)
    with pytest.raises(TypeError, match="real numbers"):
        own.run(["a", "b"], 0.1, 1)
    with pytest.raises(TypeError, match="unknown parameter"):
        own.run(start, 0.1, 1, eps=1)
    assert (own.run(start, 0.1, 0).values == start).all()


def test_tables_for_another_number_of_points_are_refused():
    own = module(KS, "cf:cf4", "c")
    tables, work = np.empty(own._function("tables")(16)), np.empty(own._function("workspace")(16))
    assert own._function("prepare")(8, 0.1, own._pointer(tables)) == Status.OK
    transform = own._ffi.new(f"{own.interface.prefix}transform *")
    values, done = np.zeros(16), own._ffi.NULL
    call = own._function("run")
    assert call(16, own._pointer(values), 1, own._pointer(tables), transform, own._pointer(work), done) == 12
    assert own._function("prepare")(7, 0.1, own._pointer(tables)) == Status.BAD_SHAPE


def test_single_precision_is_refused():
    with pytest.raises(InputError, match="single precision"):
        emit(KS, "cf:cf4", precision="single")


@pytest.mark.parametrize("command", ["bench", "converge", "localerror", "longrun", "report", "stability"])
def test_a_command_that_runs_one_system_refuses_a_semilinear_equation(command, tmp_path):
    output = ["-o", str(tmp_path)] if command == "report" else []
    result = CliRunner().invoke(program, [command, ALLEN_CAHN, "--method", "cf:cf4", *output])
    assert result.exit_code == 2
    assert "the scene is a semilinear equation without a fixed number of grid points" in result.output
    assert "codegen.load_spectral" in result.output
    assert not list(tmp_path.iterdir())


def test_modules_are_loaded_by_their_own_function():
    artifact = emit(KS, "cf:cf4", target="python")
    with pytest.raises(InputError, match="semilinear"):
        load(artifact)
    with pytest.raises(InputError, match="expected a module for a semilinear"):
        load_spectral(emit("free_rigid_body", "cf:cf4", target="python"))


def test_parameters_are_arguments_on_request():
    for target in TARGETS:
        own = load_spectral(emit(ALLEN_CAHN, "cf:cf4", target=target, parameters=["eps"]))
        fixed = module(ALLEN_CAHN, "cf:cf4", target)
        start = own.start(32)
        assert abs(own.run(start, 0.1, 5).values - fixed.run(start, 0.1, 5).values).max() < 1e-15
        assert abs(own.run(start, 0.1, 5, eps=0.5).values - fixed.run(start, 0.1, 5).values).max() > 1e-2


def test_the_text_does_not_depend_on_names_of_the_user():
    n, mode = param("n", 1), param("mode", 2)
    w = Symbol("tables", real=True)
    own = SemilinearScene(
        u=w,
        k=Symbol("steps", real=True),
        x=Symbol("work", real=True),
        L=-n * Symbol("steps", real=True) ** 2,
        N=mode * w - w**3,
        length=1,
        u0=Rational(1, 2),
        span=(0, 1),
    )
    results = []
    for target in TARGETS:
        loaded = load_spectral(emit(own, "cf:cf4", target=target, parameters=["n", "mode"]))
        results.append(loaded.run(loaded.start(8), 0.1, 5, n=2, mode=1).values)
    assert abs(results[0] - results[1]).max() < 1e-15


@pytest.mark.slow
@pytest.mark.parametrize("name", [KS, "dispersive"])
def test_the_example_of_the_header_runs_under_sanitizers(tmp_path, name):
    artifact = emit(dispersive() if name == "dispersive" else name, "rkmk(2):rk4", target="c", prefix="p")
    for file, text in artifact.files.items():
        (tmp_path / file).write_text(text)
    example = artifact.files["p.c"].partition(" * Use:\n")[2].partition("\n */")[0]
    (tmp_path / "main.c").write_text(
        "\n".join(line.removeprefix(" *").removeprefix("     ") for line in [*example.splitlines(), ""])
    )
    compiler = shutil.which("gcc") or find_compiler().command[0]
    flags = [f for f in FLAGS if f != "-O2"] + [
        "-O1",
        "-fsanitize=address,undefined",
        "-fno-sanitize-recover",
    ]
    subprocess.run(
        [compiler, *flags, "main.c", "p.c", "p_fft.c", "-lm", "-o", "main"], cwd=tmp_path, check=True
    )
    if clang := shutil.which("clang"):
        subprocess.run([clang, *FLAGS, "-c", "main.c", "p.c", "p_fft.c"], cwd=tmp_path, check=True)
    found = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=False)
    assert "status" in found.stdout
    assert not found.stderr


def test_an_error_in_a_transform_of_numpy_is_raised(monkeypatch):
    equation, transform, calls = module("quiet", "cf:cf4", "c"), np.fft.rfft, []

    def interrupted(values):
        calls.append(values)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return transform(values)

    monkeypatch.setattr(np.fft, "rfft", interrupted)
    with pytest.raises(KeyboardInterrupt):
        equation.run(equation.start(20), 0.01, 5)


def test_an_overflow_in_a_transform_of_numpy_is_a_status():
    equation = module("quiet", "cf:cf4", "c")
    with np.errstate(all="raise"):
        result = equation.run(1e300 * equation.start(20), 0.01, 5)
    assert result.status == Status.NOT_FINITE
