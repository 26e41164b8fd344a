/*
 * The start of an implicit step: the polynomial through the last solutions, continued by a step.
 *
 * Solutions are kept twice in a ring, so that the last ones stand together. The degree is looked at in every eighth
 * step: it grows while backward differences fall. UNKNOWNS is defined by who includes this.
 */
#ifndef HANDWRITTEN_PAST_H
#define HANDWRITTEN_PAST_H

#include <math.h>
#include <stddef.h>
#include <string.h>

#define DEPTH 16

struct past {
    double values[2 * DEPTH][UNKNOWNS];
    double weights[DEPTH + 1][DEPTH + 2]; /* of the backward differences */
    size_t known, degree, place;
};

static inline void forget(struct past *past)
{
    memset(past, 0, sizeof *past);
    for (size_t k = 0; k <= DEPTH; k++) {
        past->weights[k][0] = 1.0;
        for (size_t j = 1; j <= k; j++) {
            past->weights[k][j] = past->weights[k - 1][j] - past->weights[k - 1][j - 1];
        }
    }
}

/* the difference of order k without its first terms, which were of later solutions */
static inline void difference(const struct past *past, size_t k, size_t first, double sum[static UNKNOWNS])
{
    const double *weights = past->weights[k];
    #pragma GCC unroll 12
    for (size_t i = 0; i < UNKNOWNS; i++) {
        sum[i] = 0.0;
    }
    for (size_t j = first; j <= k; j += 2) {
        const double *x = past->values[past->place + j - first], *y = x + UNKNOWNS;
        #pragma GCC unroll 12
        for (size_t i = 0; i < UNKNOWNS; i++) {
            sum[i] += weights[j] * x[i] + weights[j + 1] * y[i];
        }
    }
}

static double size_of(const struct past *past, size_t k)
{
    double sum[UNKNOWNS], size = 0.0;
    difference(past, k, 0, sum);
    for (size_t i = 0; i < UNKNOWNS; i++) {
        size += fabs(sum[i]);
    }
    return size;
}

/* Take up the solution in w and put the next start there. */
static inline void extrapolate(struct past *past, double w[static UNKNOWNS])
{
    const size_t place = past->place = past->place > 0 ? past->place - 1 : DEPTH - 1;
    memcpy(past->values[place], w, sizeof past->values[0]);
    memcpy(past->values[place + DEPTH], w, sizeof past->values[0]);
    past->known += past->known < DEPTH;
    size_t k = past->degree;
    if (place % 8 == 0 || past->known < DEPTH) {
        const double size = size_of(past, k);
        if (k + 1 < past->known && size_of(past, k + 1) < size) {
            k++;
        } else if (k > 0 && size > size_of(past, k - 1)) {
            k--;
        }
        past->degree = k;
    }
    /* the difference that follows would vanish */
    difference(past, k + 1, 1, w);
    for (size_t i = 0; i < UNKNOWNS; i++) {
        w[i] = -w[i];
    }
}

#endif
