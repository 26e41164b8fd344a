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
    double x[3] = {A[0] * k * s.m[0], A[0] * k * s.m[1], A[0] * k * s.m[2]};
    for (size_t n = 1; n <= steps; n++) {
        turn_and_kick(&s, x, B[0] * g, A[1] * k);
        turn_and_kick(&s, x, B[1] * g, A[2] * k);
        turn_and_kick(&s, x, B[2] * g, A[3] * k);
        turn_and_kick(&s, x, B[3] * g, A[4] * k);
        turn_and_kick(&s, x, B[4] * g, A[5] * k);
        turn_and_kick(&s, x, B[5] * g, A[6] * k);
        turn_and_kick(&s, x, B[6] * g, A[7] * k);
        turn_and_kick(&s, x, B[6] * g, A[6] * k);
        turn_and_kick(&s, x, B[5] * g, A[5] * k);
        turn_and_kick(&s, x, B[4] * g, A[4] * k);
        turn_and_kick(&s, x, B[3] * g, A[3] * k);
        turn_and_kick(&s, x, B[2] * g, A[2] * k);
        turn_and_kick(&s, x, B[1] * g, A[1] * k);
        turn_and_kick(&s, x, B[0] * g, n < steps ? 2.0 * A[0] * k : A[0] * k);
    }
    turn(&s, x);
    end(&s, h * (double)steps, state);
}
