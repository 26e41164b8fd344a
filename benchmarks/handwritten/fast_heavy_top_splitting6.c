/*
 * Fast heavy top by the splitting SRKN_14^a of order 6 (Blanes and Moan 2002), written by hand: exact flows of the
 * free top between kicks by gravity; the last flow of a step and the first of the next are one.
 */
#include "fast_heavy_top.h"

void handwritten_run(double state[static 12], double h, size_t steps)
{
    static const double A[8] = {0.037859319840610453709, 0.10263563310243814396, -0.025867888266559097249,
        0.314241403071447, -0.130144459517415, 0.106417700369543, -0.0087942431285097904800,
        0.20730506905689058012};
    static const double B[7] = {0.09171915262446165, 0.183983170005006, -0.05653436583288827,
        0.00491468877471162654, 0.14376112716836226437, 0.328567693746804, -0.19641146648645727091};
    const double k = h / inertia, g = h * weight;
    struct top s;
    begin(&s, state);
    struct kick table[14];
    for (int i = 0; i < 14; i++) {
        const double turn = i < 13 ? A[i < 7 ? i + 1 : 13 - i] : 2.0 * A[0];
        table[i] = prepared(B[i < 7 ? i : 13 - i] * g, turn * k, s.m[2]);
    }
    const struct kick first = prepared(0.0, A[0] * k, s.m[2]);
    double x[4] = {A[0] * k * s.m[0], A[0] * k * s.m[1], first.c, first.cc};
    for (size_t n = 1; n <= steps; n++) {
        if (n == steps) {
            table[13] = prepared(B[0] * g, A[0] * k, s.m[2]);
        }
        for (int i = 0; i < 14; i++) {
            turn_and_kick(&s, x, &table[i]);
        }
    }
    turn(&s, x);
    end(&s, h * (double)steps, state);
}
