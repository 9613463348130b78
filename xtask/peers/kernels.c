/* The tick as it is put together from CMSIS-DSP's functions, and as a careful engineer writes it in C: what
 * `cargo xtask perf --peers` compares with. The data are those of xtask/src/data.rs. */

#include <math.h>
#include <stdint.h>

#include "dsp/fast_math_functions.h"
#include "dsp/interpolation_functions.h"

#define CELLS 256
#define VALUES (CELLS + 1)
#define PI_F 3.14159265358979f

/* ---- single precision, linear tables --------------------------------------------------------------------------- */

typedef struct {
    float per_radian, viscous, coulomb;
    float inertia[VALUES], half_slope[VALUES], load[VALUES];
} linear_f32;

/* What the C by hand gets. */
const void *peer_tables_f32(const uint32_t *data) {
    return data + 1;
}

/* What the library's functions get: an instance for each curve. */
typedef struct {
    arm_linear_interp_instance_f32 inertia, half_slope, load;
    float viscous, coulomb;
} machine_f32;

const void *peer_linear_f32(const uint32_t *data) {
    static machine_f32 machine;
    const linear_f32 *tables = (const linear_f32 *)(data + 1);
    const arm_linear_interp_instance_f32 of = {VALUES, 0.0f, 2.0f * PI_F / CELLS, 0};
    machine = (machine_f32){of, of, of, tables->viscous, tables->coulomb};
    machine.inertia.pYData = tables->inertia;
    machine.half_slope.pYData = tables->half_slope;
    machine.load.pYData = tables->load;
    return &machine;
}

static inline float friction_f32(float coulomb, float omega) {
    return omega > 0.0f ? coulomb : omega < 0.0f ? -coulomb : 0.0f;
}

float cmsis_f32_torque(const machine_f32 *m, float phi, float omega, float alpha) {
    float inertia = arm_linear_interp_f32(&m->inertia, phi);
    float half_slope = arm_linear_interp_f32(&m->half_slope, phi);
    float load = arm_linear_interp_f32(&m->load, phi);
    return inertia * alpha + half_slope * omega * omega + load + m->viscous * omega + friction_f32(m->coulomb, omega);
}

float cmsis_f32_acceleration(const machine_f32 *m, float phi, float omega, float torque) {
    float inertia = arm_linear_interp_f32(&m->inertia, phi);
    float half_slope = arm_linear_interp_f32(&m->half_slope, phi);
    return (torque - half_slope * omega * omega) / inertia;
}

/* One index and one fraction for all curves. */

typedef struct {
    int32_t cell;
    float u;
} place;

static inline place place_of(const linear_f32 *m, float phi) {
    float at = phi * m->per_radian;
    int32_t cell = (int32_t)at;
    return (place){cell < CELLS ? cell : CELLS - 1, at - (float)cell};
}

static inline float at(const float *table, place p) {
    return table[p.cell] + p.u * (table[p.cell + 1] - table[p.cell]);
}

float hand_c_f32_torque(const linear_f32 *m, float phi, float omega, float alpha) {
    place p = place_of(m, phi);
    return at(m->inertia, p) * alpha + at(m->half_slope, p) * omega * omega + at(m->load, p) + m->viscous * omega +
           friction_f32(m->coulomb, omega);
}

float hand_c_f32_acceleration(const linear_f32 *m, float phi, float omega, float torque) {
    place p = place_of(m, phi);
    return (torque - at(m->half_slope, p) * omega * omega) / at(m->inertia, p);
}

/* ---- single precision, no table --------------------------------------------------------------------------------- */

typedef struct {
    float radius, ratio, mass, rotating, weight, viscous, coulomb;
} dimensions;

const void *peer_dimensions(const uint32_t *data) {
    return data;
}

typedef struct {
    float first, second;
} transfer;

static inline transfer transfer_of(const dimensions *m, float phi) {
    float sine = arm_sin_f32(phi), cosine = arm_cos_f32(phi);
    float s = m->ratio * sine, c = m->ratio * cosine;
    float inverse = 1.0f / sqrtf(1.0f - s * s);
    float tilt = s * inverse;
    float first = -(sine + tilt * cosine);
    float second = -(cosine + (c * cosine - s * sine + tilt * tilt * c * cosine) * inverse);
    return (transfer){m->radius * first, m->radius * second};
}

float cmsis_analytic_torque(const dimensions *m, float phi, float omega, float alpha) {
    transfer x = transfer_of(m, phi);
    return (m->rotating + m->mass * x.first * x.first) * alpha + m->mass * x.first * x.second * omega * omega +
           m->weight * x.first + m->viscous * omega + friction_f32(m->coulomb, omega);
}

float cmsis_analytic_acceleration(const dimensions *m, float phi, float omega, float torque) {
    transfer x = transfer_of(m, phi);
    return (torque - m->mass * x.first * x.second * omega * omega) / (m->rotating + m->mass * x.first * x.first);
}

/* ---- fixed point, linear tables --------------------------------------------------------------------------------- */

/* The library wants 12 bits of index and 20 of fraction; a turn of 256 cells has 8 of index. */
#define PLACE(phase) ((q31_t)((phase) >> 4))

typedef struct {
    int32_t cells, viscous, coulomb;
    q31_t inertia[VALUES], half_slope[VALUES], load[VALUES];
} linear_q31;

const void *peer_linear_q31(const uint32_t *data) {
    return data;
}

static inline int32_t limited(int64_t sum) {
    return sum > INT32_MAX ? INT32_MAX : sum < INT32_MIN ? INT32_MIN : (int32_t)sum;
}

static inline int32_t product(int32_t a, int32_t b) {
    return (int32_t)(((int64_t)a * b) >> 31);
}

static inline int32_t friction(int32_t coulomb, int32_t omega) {
    return omega > 0 ? coulomb : omega < 0 ? -coulomb : 0;
}

/* The terms are smaller than half of the base each: the sum is limited once. */
int32_t cmsis_q31_torque(const linear_q31 *m, uint32_t phase, int32_t omega, int32_t alpha) {
    int32_t inertia = arm_linear_interp_q31(m->inertia, PLACE(phase), VALUES);
    int32_t half_slope = arm_linear_interp_q31(m->half_slope, PLACE(phase), VALUES);
    int32_t load = arm_linear_interp_q31(m->load, PLACE(phase), VALUES);
    return limited((int64_t)product(inertia, alpha) + product(half_slope, product(omega, omega)) + load +
                   product(m->viscous, omega) + friction(m->coulomb, omega));
}

int32_t cmsis_q31_acceleration(const linear_q31 *m, uint32_t phase, int32_t omega, int32_t torque) {
    int32_t inertia = arm_linear_interp_q31(m->inertia, PLACE(phase), VALUES);
    int32_t half_slope = arm_linear_interp_q31(m->half_slope, PLACE(phase), VALUES);
    int64_t net = (int64_t)torque - product(half_slope, product(omega, omega));
    return limited(net * INT64_C(0x80000000) / inertia);
}

typedef struct {
    int32_t cells, viscous, coulomb;
    q15_t inertia[VALUES + 1], half_slope[VALUES + 1], load[VALUES + 1];
} linear_q15;

const void *peer_linear_q15(const uint32_t *data) {
    return data;
}

static inline int32_t limited15(int32_t sum) {
    return sum > INT16_MAX ? INT16_MAX : sum < INT16_MIN ? INT16_MIN : sum;
}

static inline int32_t product15(int32_t a, int32_t b) {
    return (a * b) >> 15;
}

int32_t cmsis_q15_torque(const linear_q15 *m, uint32_t phase, int32_t omega, int32_t alpha) {
    int32_t inertia = arm_linear_interp_q15(m->inertia, PLACE(phase), VALUES);
    int32_t half_slope = arm_linear_interp_q15(m->half_slope, PLACE(phase), VALUES);
    int32_t load = arm_linear_interp_q15(m->load, PLACE(phase), VALUES);
    return limited15(product15(inertia, alpha) + product15(half_slope, product15(omega, omega)) + load +
                     product15(m->viscous, omega) + friction(m->coulomb, omega));
}

int32_t cmsis_q15_acceleration(const linear_q15 *m, uint32_t phase, int32_t omega, int32_t torque) {
    int32_t inertia = arm_linear_interp_q15(m->inertia, PLACE(phase), VALUES);
    int32_t half_slope = arm_linear_interp_q15(m->half_slope, PLACE(phase), VALUES);
    int32_t net = limited15(torque - product15(half_slope, product15(omega, omega)));
    return limited15(net * 32768 / inertia);
}
