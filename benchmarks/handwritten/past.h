/*
 * The start of an implicit step: the polynomial through the last solutions, continued by a step.
 *
 * Solutions are kept twice in a ring, so that the last ones stand together. The degree is looked at in every fourth
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
    double weights[DEPTH + 1][DEPTH + 1]; /* of the backward differences */
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

/* the size of the difference of order k */
static inline double difference(const struct past *past, size_t k)
{
    double sum[UNKNOWNS] = {0.0}, size = 0.0;
    for (size_t j = 0; j <= k; j++) {
        #pragma GCC unroll 12
        for (size_t i = 0; i < UNKNOWNS; i++) {
            sum[i] += past->weights[k][j] * past->values[past->place + j][i];
        }
    }
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
    if (place % 4 == 0 || past->known < DEPTH) {
        const double size = difference(past, k);
        if (k + 1 < past->known && difference(past, k + 1) < size) {
            k++;
        } else if (k > 0 && size > difference(past, k - 1)) {
            k--;
        }
        past->degree = k;
    }
    /* x_n - x_(n+1) is minus the difference of order k + 1 without its first term */
    const double *weights = past->weights[k + 1] + 1;
    double sum[UNKNOWNS] = {0.0};
    for (size_t j = 0; j <= k; j++) {
        #pragma GCC unroll 12
        for (size_t i = 0; i < UNKNOWNS; i++) {
            sum[i] -= weights[j] * past->values[place + j][i];
        }
    }
    memcpy(w, sum, sizeof sum);
}

#endif
