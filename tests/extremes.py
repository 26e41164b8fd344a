"""A program that calls an emitted module with extreme arguments and checks each status and each state."""

from __future__ import annotations

from codegen.artifact import Artifact

PROGRAM = """
#include "{module}.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {{ SIZE = {size}, PARAMETERS = {parameters}, INPUTS = {inputs}, ROWS = 4, DRAWS = {draws} }};
typedef {real} number;

static const number start[SIZE] = {{{start}}};
static const number defaults[PARAMETERS + 1] = {{{defaults}}};
static const number extremes[] = {{(number)NAN, (number)INFINITY, (number)-INFINITY, {huge}, -{huge},
    {big}, -{big}, {denormal}, -{denormal}, {least}, 0, -(number)0, 1, -1}};
enum {{ EXTREMES = sizeof extremes / sizeof *extremes }};

static number *state, *before, *inputs, *values, *rows;
static number t, h;
static uint32_t seed = 1;
static unsigned long calls, successes;

static uint32_t draw(uint32_t n)
{{
    seed = seed * 1664525u + 1013904223u;
    return (uint32_t)(((uint64_t)seed * n) >> 32);
}}

static void *buffer(size_t n)
{{
    void *memory = malloc((n ? n : 1) * sizeof(number));
    if (memory == NULL) exit(2);
    return memory;
}}

static void reset(void)
{{
    memcpy(state, start, sizeof start);
    for (int i = 0; i < PARAMETERS; i++) values[i] = defaults[i];
    for (int i = 0; i < INPUTS; i++) inputs[i] = 0;
    t = {time};
    h = {h};
}}

static int finite_state(const number *x)
{{
    for (int i = 0; i < SIZE; i++) if (!isfinite(x[i])) return 0;
    return 1;
}}

static void check(int truth, const char *what, int status)
{{
    if (truth) return;
    fprintf(stderr, "%s; status %d, h %g, call %lu\\nstate", what, status, (double)h, calls);
    for (int i = 0; i < SIZE; i++) fprintf(stderr, " %g -> %g", (double)before[i], (double)state[i]);
    fprintf(stderr, "\\n");
    exit(1);
}}

/* The promises of a status: a success has a finite state, a failure leaves the last good one. */
static void judge(int status, size_t completed)
{{
    calls++;
    check(status >= 0 && status <= 7, "an unknown status", status);
    if (status == 0) successes++;
    if (status == 0 && completed) check(finite_state(state), "a success that is not finite", status);
    if (completed == 0) check(memcmp(state, before, SIZE * sizeof *state) == 0, "a changed state", status);
    else check(finite_state(state), "a good state that is not finite", status);
    memcpy(state, before, SIZE * sizeof *state);
}}
{callback}
static void call(void)
{{
    int status;
    size_t completed = 7;
    memcpy(before, state, SIZE * sizeof *state);
    status = {prefix}step(state, {t}h{step});
    judge(status, status == 0);
    for (size_t steps = 0; steps < ROWS; steps += 1 + steps) {{
        status = {prefix}run(state, {t}h, steps, {run}rows, 1{counts}, &completed);
        check(completed <= steps && (status != 0) == (completed < steps), "a wrong count of steps", status);
        judge(status, completed);
    }}
    status = {prefix}run(state, {t}h, 2, {run}rows, SIZE_MAX{counts}, &completed);
    judge(status, completed);
    if (!isfinite(h)) {{
        status = {prefix}run(state, {t}h, SIZE_MAX, {run}NULL, 0{counts}, NULL);
        check(status == 3, "a step size that is no number", status);
        judge(status, 0);
    }}
{more}
}}

int main(void)
{{
    state = buffer(SIZE), before = buffer(SIZE), values = buffer(PARAMETERS), inputs = buffer(INPUTS);
    rows = buffer(SIZE * ROWS);
    /* The scene's step size, which may be too large for the method, and one that no method fails with. */
    reset();
    call();
    reset();
    h /= 1 << 20;
    successes = 0;
    call();
    const unsigned long ordinary = successes;
    for (int k = 0; k < EXTREMES; k++) {{
        for (int i = 0; i < SIZE + PARAMETERS + INPUTS + 2; i++) {{
            reset();
            if (i < SIZE) state[i] = extremes[k];
            else if (i < SIZE + PARAMETERS) values[i - SIZE] = extremes[k];
            else if (i < SIZE + PARAMETERS + INPUTS) inputs[i - SIZE - PARAMETERS] = extremes[k];
            else if (i == SIZE + PARAMETERS + INPUTS) t = extremes[k];
            else h = extremes[k];
            call();
        }}
        reset();
        for (int i = 0; i < SIZE; i++) state[i] = extremes[k];
        call();
        reset();
        h = -h;
        call();
    }}
    for (int n = 0; n < DRAWS; n++) {{
        reset();
        for (int i = 0; i < SIZE; i++) if (draw(4) == 0) state[i] = extremes[draw(EXTREMES)];
        for (int i = 0; i < PARAMETERS; i++) if (draw(4) == 0) values[i] = extremes[draw(EXTREMES)];
        for (int i = 0; i < INPUTS; i++) if (draw(4) == 0) inputs[i] = extremes[draw(EXTREMES)];
        if (draw(4) == 0) t = extremes[draw(EXTREMES)];
        if (draw(2) == 0) h = extremes[draw(EXTREMES)];
        call();
    }}
    free(state), free(before), free(values), free(inputs), free(rows);
    printf("%lu calls, %lu ordinary successes\\n", calls, ordinary);
    return 0;
}}
"""

CALLBACK = """
static void sample(number now, number *x, void *context)
{
    (void)now;
    (void)context;
    memcpy(x, inputs, INPUTS * sizeof *x);
}
"""

ADAPTIVE = """
    static const number tolerances[] = {{1, 0, (number)INFINITY, (number)NAN, -1}};
    for (int k = 0; k < 5; k++) {{
        number now = t, size = h;
        const number to = k % 2 ? {huge} : now + 2 * h;
        size_t accepted = 7, rejected = 7;
        status = {prefix}run_adaptive(
            state, &now, to, &size, tolerances[k] / 1024, tolerances[draw(5)], k == 4 ? 0 : 8, {run}{counts}
            &accepted, &rejected);
        check(accepted + rejected <= 8, "more steps than the limit", status);
        judge(status, accepted);
    }}
"""

JACOBIAN = """
    number *jacobian = buffer({columns} * {columns});
    status = {prefix}jacobian(state, {t}h{held}, jacobian);
    check(memcmp(state, before, SIZE * sizeof *state) == 0, "a changed state", status);
    free(jacobian);
"""


def program(artifact: Artifact, draws: int) -> str:
    """Return the program, for a module with ``draws`` random combinations of extreme arguments."""
    about, interface = artifact.manifest, artifact.manifest["interface"]
    single = interface["precision"] == "single"
    suffix = "f" if single else ""
    first, last = about["span"]

    def number(x: float) -> str:
        return f"{float(x)!r}{suffix}"

    parameters, inputs = interface["parameters"], interface["inputs"]
    values = "".join(f"values[{i}], " for i in range(len(parameters)))
    words = {
        "module": interface["prefix"].removesuffix("_"),
        "prefix": interface["prefix"],
        "size": interface["size"],
        "parameters": len(parameters),
        "inputs": len(inputs),
        "draws": draws,
        "real": "float" if single else "double",
        "start": ", ".join(map(number, about["initial"])),
        "defaults": ", ".join(number(about["defaults"].get(name, 0.0)) for name in parameters) or "0",
        "huge": "3e38f" if single else "1e300",
        "big": "1e20f" if single else "1e150",
        "denormal": "1e-40f" if single else "1e-310",
        "least": "1e-45f" if single else "4.9406564584124654e-324",
        "time": number(first),
        "h": number((last - first) / 100),
        "t": "t, " if interface["time"] else "",
        "run": values + ("sample, NULL, " if inputs else ""),
        "callback": CALLBACK if inputs else "",
    }
    held = ", " + values.removesuffix(", ") if values else ""
    words["held"] = held + (", inputs" if inputs else "")
    counts = bool(interface["blocks"])
    words["step"] = words["held"] + (", NULL" if counts else "")
    words["counts"] = ", NULL" if counts else ""
    more = ADAPTIVE.format(**{**words, "counts": "NULL, " if counts else ""}) if interface["adaptive"] else ""
    columns = interface["variations"]
    more += JACOBIAN.format(**words, columns=columns) if columns else ""
    return PROGRAM.format(**words, more=more)
