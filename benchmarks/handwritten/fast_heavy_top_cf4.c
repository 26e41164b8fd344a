/*
 * Fast heavy top on T*SO(3) by the commutator-free method of order 4 (Celledoni, Marthinsen and Owren 2003),
 * written by hand: the fourth stage starts from the second.
 */
#include "fast_heavy_top_field.h"

void handwritten_run(double state[static 12], double h, size_t steps)
{
    struct place y, Y2, Y;
    struct rate k1, k2, k3, k4, u, w;
    double a[3], c[2];
    const struct body top = body(h);
    begin(state, &y, a);
    for (size_t step = 0; step < steps; step++) {
        field(&top, &y, &k1);
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            u.x[i] = 0.5 * k1.x[i];
            u.n[i] = 0.5 * k1.n[i];
        }
        move(&u, &y, &Y2, c);
        field(&top, &Y2, &k2);
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            u.x[i] = 0.5 * k2.x[i];
            u.n[i] = 0.5 * k2.n[i];
        }
        move(&u, &y, &Y, c);
        field(&top, &Y, &k3);
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            u.x[i] = k3.x[i] - 0.5 * k1.x[i];
            u.n[i] = k3.n[i] - 0.5 * k1.n[i];
        }
        move(&u, &Y2, &Y, c);
        field(&top, &Y, &k4);
        const double f = 1.0 / 12.0;
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            const double s = 2.0 * (k2.x[i] + k3.x[i]), r = 2.0 * (k2.n[i] + k3.n[i]);
            u.x[i] = f * (s + (3.0 * k1.x[i] - k4.x[i]));
            u.n[i] = f * (r + (3.0 * k1.n[i] - k4.n[i]));
            w.x[i] = f * (s + (3.0 * k4.x[i] - k1.x[i]));
            w.n[i] = f * (r + (3.0 * k4.n[i] - k1.n[i]));
        }
        move(&u, &y, &Y, c);
        turn(u.x, c[0], c[1], a, a);
        move(&w, &Y, &y, c);
        turn(w.x, c[0], c[1], a, a);
    }
    end(&y, a, state);
}
