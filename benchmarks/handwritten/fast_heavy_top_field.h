/*
 * The fast heavy top as a field on T*SO(3) and the action of its exponential, shared by hand-written steps.
 *
 * For a symmetric top xi = mu/I1 + s P d with d = gX, P = mu.d, s = 1/I3 - 1/I1, and n = mu x xi + d x (0, 0, -m g):
 * of the attitude the field reads d alone. So stages move d and mu only; a step turns one more column, and the
 * third is its cross product with d, made at the very end.
 */
#ifndef HANDWRITTEN_FAST_HEAVY_TOP_FIELD_H
#define HANDWRITTEN_FAST_HEAVY_TOP_FIELD_H

#include "rotation.h"
#include <stddef.h>

/* h/I1, h (1/I3 - 1/I1) and h m g |X|: the field is multiplied by the step */
struct body {
    double slowness, excess, weight;
};

static inline struct body body(double h)
{
    return (struct body){h / 15.234375, h * (1.0 / 0.46875 - 1.0 / 15.234375), h * 147.15};
}

struct place {
    double d[3], m[3];
};

struct rate {
    double x[3], n[3]; /* xi and n */
};

static inline void cross(const double a[static 3], const double b[static 3], double c[static 3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline __attribute__((always_inline)) void field(const struct body *top, const struct place *s, struct rate *f)
{
    const double *d = s->d, *m = s->m;
    const double speed = top->excess * (m[0] * d[0] + m[1] * d[1] + m[2] * d[2]);
    double v[3];
    cross(m, d, v);
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        f->x[i] = top->slowness * m[i] + speed * d[i];
        f->n[i] = speed * v[i];
    }
    f->n[0] -= top->weight * d[1];
    f->n[1] += top->weight * d[0];
}

/* c += c1 x cross c + c2 x cross (x cross c) */
static inline void turn(const double x[static 3], double c1, double c2, const double c[static 3],
    double y[static 3])
{
    double v[3], w[3];
    cross(x, c, v);
    cross(x, v, w);
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        y[i] = c[i] + (c1 * v[i] + c2 * w[i]);
    }
}

/*
 * exp(u) acting on d and mu: mu' = exp(x) mu + dexp_x n, all cross products made while c1, c2 and c3 are on their way
 */
static inline __attribute__((always_inline)) void move(const struct rate *u, const struct place *s, struct place *y, double c[static 2])
{
    const double a = u->x[0], b = u->x[1], e = u->x[2], k = u->n[0], l = u->n[1], m = u->n[2];
    const double d0 = s->d[0], d1 = s->d[1], d2 = s->d[2], m0 = s->m[0], m1 = s->m[1], m2 = s->m[2];
    const double p0 = b * m2 - e * m1, p1 = e * m0 - a * m2, p2 = a * m1 - b * m0;
    const double v0 = b * m - e * l, v1 = e * k - a * m, v2 = a * l - b * k;
    const double q0 = b * d2 - e * d1, q1 = e * d0 - a * d2, q2 = a * d1 - b * d0;
    double c1, c2, c3;
    sinc_cosc_defect(a * a + b * b + e * e, &c1, &c2, &c3);
    y->d[0] = d0 + (c1 * q0 + c2 * (b * q2 - e * q1));
    y->d[1] = d1 + (c1 * q1 + c2 * (e * q0 - a * q2));
    y->d[2] = d2 + (c1 * q2 + c2 * (a * q1 - b * q0));
    y->m[0] = (m0 + k) + ((c1 * p0 + c2 * ((b * p2 - e * p1) + v0)) + c3 * (b * v2 - e * v1));
    y->m[1] = (m1 + l) + ((c1 * p1 + c2 * ((e * p0 - a * p2) + v1)) + c3 * (e * v0 - a * v2));
    y->m[2] = (m2 + m) + ((c1 * p2 + c2 * ((a * p1 - b * p0) + v2)) + c3 * (a * v1 - b * v0));
    c[0] = c1;
    c[1] = c2;
}

/* [x, y] on T*SO(3): ([x, y], ad*_y m - ad*_x n) = (x cross y, x cross n - y cross m) */
static inline void bracket(const struct rate *x, const struct rate *y, struct rate *b)
{
    double v[3];
    cross(x->x, y->x, b->x);
    cross(x->x, y->n, b->n);
    cross(y->x, x->n, v);
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        b->n[i] -= v[i];
    }
}

static inline void begin(const double state[static 12], struct place *s, double a[static 3])
{
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        a[i] = state[3 * i];
        s->d[i] = state[3 * i + 1];
        s->m[i] = state[9 + i];
    }
}

static inline void end(const struct place *s, const double a[static 3], double state[static 12])
{
    double b[3];
    cross(a, s->d, b);
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        state[3 * i] = a[i];
        state[3 * i + 1] = s->d[i];
        state[3 * i + 2] = b[i];
        state[9 + i] = s->m[i];
    }
}

#endif
