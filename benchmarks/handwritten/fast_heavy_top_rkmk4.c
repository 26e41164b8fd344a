/*
 * Fast heavy top on T*SO(3) by RKMK4 with two brackets, written by hand.
 */
#include "fast_heavy_top_field.h"

static inline void combine(double a, const struct rate *x, double b, const struct rate *y, struct rate *r)
{
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        r->x[i] = a * x->x[i] + b * y->x[i];
        r->n[i] = a * x->n[i] + b * y->n[i];
    }
}

void handwritten_run(double state[static 12], double h, size_t steps)
{
    struct place y, Y;
    struct rate k1, k2, k3, k4, u, b;
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
        move(&u, &y, &Y, c);
        field(&top, &Y, &k2);
        bracket(&k1, &k2, &b);
        combine(0.5, &k2, -0.125, &b, &u);
        move(&u, &y, &Y, c);
        field(&top, &Y, &k3);
        move(&k3, &y, &Y, c);
        field(&top, &Y, &k4);
        bracket(&k1, &k4, &b);
        const double e = -1.0 / 12.0, f = 1.0 / 6.0;
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            u.x[i] = f * ((k1.x[i] + 2.0 * (k2.x[i] + k3.x[i])) + k4.x[i]) + e * b.x[i];
            u.n[i] = f * ((k1.n[i] + 2.0 * (k2.n[i] + k3.n[i])) + k4.n[i]) + e * b.n[i];
        }
        move(&u, &y, &Y, c);
        turn(u.x, c[0], c[1], a, a);
        y = Y;
    }
    end(&y, a, state);
}
