"""The stack that the functions of an emitted module use, measured on threads with painted stacks."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from codegen.artifact import Artifact
from codegen.build import Compiler, compile_files

PROGRAM = """
#include "{module}.h"
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {{ STACK = 1 << 20, PAINT = 0x5a }};

static const {real} start[{size}] = {{{start}}};
static {real} state[{size}], rows[{size} * 8];
static unsigned char *bottom;
static size_t depth;

/* Count the bytes between a frame and the deepest byte that the thread has written so far. */
static void measure(const unsigned char *frame)
{{
    size_t untouched = 0;
    while (bottom[untouched] == PAINT) untouched++;
    depth = (size_t)(frame - (bottom + untouched));
}}

{more}
static void *call_step(void *argument)
{{
    {prefix}step(state, {t}{h}{step});
    measure(__builtin_frame_address(0));
    return argument;
}}

static void *call_run(void *argument)
{{
    {prefix}run(state, {t}{h}, 5, {run}rows, 1{counts}, NULL);
    measure(__builtin_frame_address(0));
    return argument;
}}

static size_t used(void *(*function)(void *))
{{
    bottom = aligned_alloc(4096, STACK);
    pthread_attr_t attributes;
    pthread_t thread;
    memset(bottom, PAINT, STACK);
    memcpy(state, start, sizeof start);
    if (pthread_attr_init(&attributes) || pthread_attr_setstack(&attributes, bottom, STACK)) exit(1);
    if (pthread_create(&thread, &attributes, function, NULL) || pthread_join(thread, NULL)) exit(1);
    free(bottom);
    return depth;
}}

int main(void)
{{
    printf("step %zu\\nrun %zu\\n", used(call_step), used(call_run));
{calls}
    return 0;
}}
"""

INPUT = """
static {real} held[{inputs}];

static void sample({real} t, {real} *inputs, void *context)
{{
    (void)t;
    (void)context;
    memset(inputs, 0, sizeof held);
}}
"""

ADAPTIVE = """
static void *call_adaptive(void *argument)
{{
    {real} now = {time}, size = {h};
    {prefix}run_adaptive(state, &now, {time} + 3 * {h}, &size, {rtol}, {rtol}, 30, {run}{first}NULL, NULL);
    measure(__builtin_frame_address(0));
    return argument;
}}
"""

JACOBIAN = """
static {real} matrix[{columns} * {columns}];

static void *call_jacobian(void *argument)
{{
    {prefix}jacobian(state, {t}{h}{held}, matrix);
    measure(__builtin_frame_address(0));
    return argument;
}}
"""


def painted(artifact: Artifact, compiler: Compiler, level: str, folder: Path) -> dict[str, int]:
    """Return the bytes of stack of each public function of a module in C, measured from the initial state."""
    files = {**artifact.files, "painted.c": _program(artifact)}
    flags = ("-std=gnu11", level, "-ffp-contract=off", "-pthread")
    compile_files(files, folder, folder / "painted", flags, compiler)
    # The loader resolves all symbols at the start, not on the painted stack.
    environment = {**os.environ, "LD_BIND_NOW": "1"}
    answer = subprocess.run(
        [folder / "painted"], env=environment, capture_output=True, text=True, check=True, timeout=600
    )
    pairs = (line.split() for line in answer.stdout.splitlines())
    return {name: int(size) for name, size in pairs}


def _program(artifact: Artifact) -> str:
    about, interface = artifact.manifest, artifact.manifest["interface"]
    single = interface["precision"] == "single"

    def number(x: float) -> str:
        return f"{float(x)!r}{'f' if single else ''}"

    first, last = about["span"]
    inputs, counts = interface["inputs"], bool(interface["blocks"])
    values = [number(about["defaults"].get(name, 0.0)) for name in interface["parameters"]]
    held = "".join(f", {x}" for x in (*values, *(["held"] if inputs else [])))
    words = {
        "module": interface["prefix"].removesuffix("_"),
        "prefix": interface["prefix"],
        "real": "float" if single else "double",
        "size": interface["size"],
        "start": ", ".join(map(number, about["initial"])),
        "t": f"{number(first)}, " if interface["time"] else "",
        "time": number(first),
        "h": number((last - first) / 100),
        "held": held,
        "step": held + (", NULL" if counts else ""),
        "run": "".join(f"{x}, " for x in (*values, *(["sample", "NULL"] if inputs else []))),
        "counts": ", NULL" if counts else "",
        "first": "NULL, " if counts else "",
        "rtol": number(1e-4),
        "inputs": len(inputs),
        "columns": interface["variations"],
    }
    chosen = {"adaptive": interface["adaptive"], "jacobian": interface["variations"]}
    texts = {"adaptive": ADAPTIVE, "jacobian": JACOBIAN}
    more = [INPUT] * bool(inputs) + [texts[name] for name, there in chosen.items() if there]
    calls = [f'    printf("{name} %zu\\n", used(call_{name}));' for name, there in chosen.items() if there]
    return PROGRAM.format(**words, more="".join(x.format(**words) for x in more), calls="\n".join(calls))
