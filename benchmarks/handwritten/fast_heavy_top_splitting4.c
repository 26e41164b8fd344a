/*
 * Fast heavy top by the splitting SRKN_6^b of order 4 (Blanes and Moan 2002), written by hand: kicks by gravity
 * between exact flows of the free top; the last kick of a step and the first of the next are one.
 */
#include "fast_heavy_top.h"

void handwritten_run(double state[static 12], double h, size_t steps)
{
    static const double A[3] = {0.245298957184271, 0.604872665711080, -0.350171622895351};
    static const double B[4]
        = {0.082984406417404872919, 0.396309801498368, -0.039056304922348395277, 0.11952419401315104472};
    const double k = h / inertia, g = h * weight;
    struct top s;
    begin(&s, state);
    kick(&s, B[0] * g);
    const double turns[6] = {A[1], A[2], A[2], A[1], A[0], A[0]}, kicks[6] = {B[1], B[2], B[3], B[2], B[1], 2.0 * B[0]};
    struct kick table[6];
    for (int i = 0; i < 6; i++) {
        table[i] = prepared(kicks[i] * g, turns[i] * k, s.m[2]);
    }
    double x[4] = {A[0] * k * s.m[0], A[0] * k * s.m[1], table[5].c, table[5].cc};
    for (size_t n = 1; n <= steps; n++) {
        if (n == steps) {
            table[5] = prepared(B[0] * g, A[0] * k, s.m[2]);
        }
        for (int i = 0; i < 6; i++) {
            turn_and_kick(&s, x, &table[i]);
        }
    }
    end(&s, h * (double)steps, state);
}
