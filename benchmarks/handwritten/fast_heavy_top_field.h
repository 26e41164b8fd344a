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

static const double slowness = 1.0 / 15.234375, weight = 147.15; /* 1/I1, and m g |X| */
static const double excess = 1.0 / 0.46875 - 1.0 / 15.234375;

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

static inline void field(const struct place *s, struct rate *f)
{
    const double *d = s->d, *m = s->m;
    const double speed = excess * (m[0] * d[0] + m[1] * d[1] + m[2] * d[2]);
    double v[3];
    cross(m, d, v);
    for (int i = 0; i < 3; i++) {
        f->x[i] = slowness * m[i] + speed * d[i];
        f->n[i] = speed * v[i];
    }
    f->n[0] -= weight * d[1];
    f->n[1] += weight * d[0];
}

/* c += c1 x cross c + c2 x cross (x cross c) */
static inline void turn(const double x[static 3], double c1, double c2, const double c[static 3],
    double y[static 3])
{
    double v[3], w[3];
    cross(x, c, v);
    cross(x, v, w);
    for (int i = 0; i < 3; i++) {
        y[i] = c[i] + (c1 * v[i] + c2 * w[i]);
    }
}

/*
 * exp(u) acting on d and mu: mu' = exp(x) mu + dexp_x n, all cross products made while c1, c2 and c3 are on their way
 */
static inline void move(const struct rate *u, const struct place *s, struct place *y, double c[static 2])
{
    const double *x = u->x, *n = u->n, *m = s->m;
    double c1, c2, p[3], q[3], v[3], w[3];
    const double z = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    sinc_cosc(z, &c1, &c2);
    const double c3 = sinc_defect(z);
    cross(x, m, p);
    cross(x, n, v);
    cross(x, p, q);
    cross(x, v, w);
    turn(x, c1, c2, s->d, y->d);
    for (int i = 0; i < 3; i++) {
        y->m[i] = (m[i] + n[i]) + ((c1 * p[i] + c2 * (q[i] + v[i])) + c3 * w[i]);
    }
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
    for (int i = 0; i < 3; i++) {
        b->n[i] -= v[i];
    }
}

static inline void begin(const double state[static 12], struct place *s, double a[static 3])
{
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
    for (int i = 0; i < 3; i++) {
        state[3 * i] = a[i];
        state[3 * i + 1] = s->d[i];
        state[3 * i + 2] = b[i];
        state[9 + i] = s->m[i];
    }
}

#endif
