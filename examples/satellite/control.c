/* A controller that slows the satellite down to the rate of its orbit, with one torque for each step. */
#include "out/satellite.h"
#include <math.h>
#include <stdio.h>

static const double inertia[3] = {1.2, 1.0, 0.8};

/* Write the rates of the body relative to the orbit, in the body frame: I^-1 q^T mu - q^T e3. */
static void rates(const double state[12], double w[3])
{
    for (int i = 0; i < 3; i++) {
        const double p = state[i] * state[9] + state[3 + i] * state[10] + state[6 + i] * state[11];
        w[i] = p / inertia[i] - state[6 + i];
    }
}

int main(void)
{
    double state[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, -0.25, 1};
    const double h = 0.05;
    double w[3];
    for (int n = 0; n <= 600; n++) {
        rates(state, w);
        if (n % 150 == 0) {
            printf("t = %4.1f  rate %.6f\n", n * h, sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
        }
        const double torque[3] = {-w[0] / 2, -w[1] / 2, -w[2] / 2};
        const int status = satellite_step(state, n * h, h, torque);
        if (status != SATELLITE_OK) {
            return status;
        }
    }
    return 0;
}
