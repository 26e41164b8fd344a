/*
 * The fast heavy top with its exact flows, shared by the hand-written splittings.
 *
 * The free top turns the body by exp(t mu/I1) from the left, mu standing still, and by exp(t s P) about its axis X
 * from the right, s = 1/I3 - 1/I1 and P = mu.gX. Gravity depends on d = gX alone, so the second turn commutes with
 * everything, and P is kept: all of it is made in one at the very end. What is carried along is d, one more column a
 * of the attitude, and mu; the third column is a x d. A turn and the kick after it are one, and give the rotation
 * vector x of the next turn: it is linear in c1 and c2, and all else that it needs is ready before them. That
 * shortens the only chain that the processor waits for, from one angle to the next.
 */
#ifndef HANDWRITTEN_FAST_HEAVY_TOP_H
#define HANDWRITTEN_FAST_HEAVY_TOP_H

#include "rotation.h"
#include <stddef.h>

static const double inertia = 15.234375, weight = 147.15; /* I1, and m g |X| */
static const double excess = 1.0 / 0.46875 - 1.0 / 15.234375;

struct top {
    double m[3], d[3], a[3];
};

static inline void turn_column(double x, double y, double z, double c1, double c2, double c[static 3])
{
    const double u = y * c[2] - z * c[1], v = z * c[0] - x * c[2], w = x * c[1] - y * c[0];
    const double p = y * w - z * v, q = z * u - x * w, r = x * v - y * u;
    c[0] += c1 * u + c2 * p;
    c[1] += c1 * v + c2 * q;
    c[2] += c1 * w + c2 * r;
}

/* a kick and the turn after it: mu_2 stands still, so that much is the same in every step */
struct kick {
    double g, k, kg, c, cc; /* g, k, k g, k mu_2 and its square */
};

static inline struct kick prepared(double g, double k, double m2)
{
    return (struct kick){g, k, k * g, k * m2, k * m2 * (k * m2)};
}

/* turn by exp(x), kick by mu += g gX x -e3, and make x = k mu for the turn that follows; x[3] is x[2] squared */
static inline void turn_and_kick(struct top *s, double x[static 4], const struct kick *kick)
{
    const double *d = s->d, a = x[0], b = x[1], c = x[2];
    const double u = b * d[2] - c * d[1], v = c * d[0] - a * d[2], w = a * d[1] - b * d[0];
    const double p = b * w - c * v, q = c * u - a * w, r = a * v - b * u;
    const double x0 = kick->k * s->m[0] - kick->kg * d[1], x1 = kick->k * s->m[1] + kick->kg * d[0];
    const double ku = kick->kg * u, kv = kick->kg * v, kp = kick->kg * p, kq = kick->kg * q;
    double c1, c2;
    sinc_cosc((a * a + x[3]) + b * b, &c1, &c2);
    x[0] = (x0 - c1 * kv) - c2 * kq;
    x[1] = (x1 + c1 * ku) + c2 * kp;
    x[2] = kick->c;
    x[3] = kick->cc;
    s->d[0] += c1 * u + c2 * p;
    s->d[1] += c1 * v + c2 * q;
    s->d[2] += c1 * w + c2 * r;
    s->m[0] -= kick->g * s->d[1];
    s->m[1] += kick->g * s->d[0];
    turn_column(a, b, c, c1, c2, s->a);
}

static inline void turn(struct top *s, const double x[static 3])
{
    double c1, c2;
    sinc_cosc(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], &c1, &c2);
    turn_column(x[0], x[1], x[2], c1, c2, s->d);
    turn_column(x[0], x[1], x[2], c1, c2, s->a);
}

static inline void kick(struct top *s, double g)
{
    s->m[0] -= g * s->d[1];
    s->m[1] += g * s->d[0];
}

static inline void begin(struct top *s, const double state[static 12])
{
    for (int i = 0; i < 3; i++) {
        s->a[i] = state[3 * i];
        s->d[i] = state[3 * i + 1];
        s->m[i] = state[9 + i];
    }
}

static inline void end(const struct top *s, double time, double state[static 12])
{
    const double *a = s->a, *d = s->d;
    const double angle = time * excess * (s->m[0] * d[0] + s->m[1] * d[1] + s->m[2] * d[2]);
    const double c = cos(angle), t = sin(angle);
    const double b[3] = {a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2], a[0] * d[1] - a[1] * d[0]};
    for (int i = 0; i < 3; i++) {
        state[3 * i] = c * a[i] - t * b[i];
        state[3 * i + 1] = d[i];
        state[3 * i + 2] = t * a[i] + c * b[i];
        state[9 + i] = s->m[i];
    }
}

#endif
