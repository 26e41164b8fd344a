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
    double x[3] = {A[0] * k * s.m[0], A[0] * k * s.m[1], A[0] * k * s.m[2]};
    for (size_t n = 1; n <= steps; n++) {
        turn_and_kick(&s, x, B[1] * g, A[1] * k);
        turn_and_kick(&s, x, B[2] * g, A[2] * k);
        turn_and_kick(&s, x, B[3] * g, A[2] * k);
        turn_and_kick(&s, x, B[2] * g, A[1] * k);
        turn_and_kick(&s, x, B[1] * g, A[0] * k);
        turn_and_kick(&s, x, n < steps ? 2.0 * B[0] * g : B[0] * g, A[0] * k);
    }
    end(&s, h * (double)steps, state);
}
