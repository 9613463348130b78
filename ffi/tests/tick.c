/* The kernels of benches/tick/library.rs through the C interface, for `cargo xtask c`: the same files, so that instructions and bits of
 * both are compared. The trace finds the functions of the library by their names. */
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "jred.h"

typedef struct {
    uint32_t phase, omega, third;
} point;

static const uint32_t *image;
static size_t image_length;

static float f32_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
static uint32_t f32_bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
static int32_t q31_of(uint32_t bits) { return (int32_t)bits; }
static uint32_t q31_bits(int32_t x) { return (uint32_t)x; }
static int16_t q15_of(uint32_t bits) { return (int16_t)bits; }
static uint32_t q15_bits(int16_t x) { return (uint32_t)(int32_t)x; }

/* Calls a kernel at every point. */
#define KERNEL(kernel, quantity, format, n, set)                                                                          \
    JRED_MODEL(kernel##_##quantity, format, set);                                                                         \
    static jred_status run_##kernel##_##quantity(point *points, size_t count) {                                           \
        kernel##_##quantity##_model model;                                                                                \
        jred_status status = kernel##_##quantity##_load_words(&model, image, image_length);                                     \
        for (point *p = points; status == JRED_OK && p < points + count; p++)                                             \
            p->phase = n##_bits(kernel##_##quantity##_##quantity(&model, p->phase, n##_of(p->omega), n##_of(p->third)));   \
        return status;                                                                                                    \
    }

#define KERNELS(DO)                                        \
    DO(f32, torque, cubic_f32, f32, 49)                    \
    DO(f32, acceleration, cubic_f32, f32, 0)               \
    DO(f32_spline, torque, spline_f32, f32, 49)            \
    DO(f32_spline, acceleration, spline_f32, f32, 0)       \
    DO(f32_slider_crank, torque, slider_crank_f32, f32, 49) \
    DO(f32_slider_crank, acceleration, slider_crank_f32, f32, 0) \
    DO(q31, torque, cubic_q31, q31, 49)                    \
    DO(q31, acceleration, cubic_q31, q31, 8)               \
    DO(q31_quadratic, torque, quadratic_q31, q31, 49)      \
    DO(q31_quadratic, acceleration, quadratic_q31, q31, 8) \
    DO(q31_spline16, torque, spline16_q31, q31, 49)        \
    DO(q31_spline16, acceleration, spline16_q31, q31, 8)   \
    DO(q15, torque, rows_q15, q15, 49)                     \
    DO(q15, acceleration, rows_q15, q15, 8)

KERNELS(KERNEL)

/* From a count to a torque, as a program calls it: with the look whether there is a model. */
static const jred_encoder encoder = JRED_ENCODER(10000, 1, 1, false, 0);

#define COUNTED(kernel, format, n, set)                                                                                      \
    JRED_MODEL(kernel##_counts, format, set);                                                                                \
    __attribute__((noinline)) jred_##n c_##kernel##_counts(const kernel##_counts_model *model, int32_t count, jred_##n omega,  \
                                                           jred_##n alpha) {                                                   \
        return kernel##_counts_torque(model, jred_encoder_phase(&encoder, count), omega, alpha);                               \
    }                                                                                                                        \
    static jred_status run_##kernel##_counts(point *points, size_t count) {                                                  \
        kernel##_counts_model model;                                                                                         \
        jred_status status = kernel##_counts_load_words(&model, image, image_length);                                              \
        for (point *p = points; status == JRED_OK && p < points + count; p++)                                                \
            p->phase = n##_bits(c_##kernel##_counts(&model, (int32_t)p->phase, n##_of(p->omega), n##_of(p->third)));         \
        return status;                                                                                                       \
    }

#define COUNTED_KERNELS(DO)               \
    DO(f32, cubic_f32, f32, 49)           \
    DO(q31_quadratic, quadratic_q31, q31, 49) \
    DO(q15, rows_q15, q15, 49)

COUNTED_KERNELS(COUNTED)

/* From a count to the motor's torque, with every part of an axis: the same figures as in benches/tick/library.rs. */
#define AXIS(kernel, format, n, set)                                                                                         \
    JRED_MODEL(kernel##_axis, format, set);                                                                                  \
    typedef struct {                                                                                                         \
        int64_t count;                                                                                                       \
        jred_tracker tracker;                                                                                                \
        jred_##n##_period tick, lead;                                                                                        \
        jred_##n##_friction_ramp ramp;                                                                                       \
        kernel##_axis_model press;                                                                                           \
        jred_##n##_motion_range range;                                                                                       \
        jred_##n##_transmission gearbox;                                                                                     \
        jred_##n##_torque_limits limits;                                                                                     \
        jred_##n speed, clipped;                                                                                             \
    } kernel##_axis;                                                                                                         \
    __attribute__((noinline)) jred_##n c_##kernel##_axis(kernel##_axis *axis, uint32_t count, jred_##n omega, jred_##n alpha) { \
        const uint32_t phase = jred_encoder_phase_wide(&encoder, jred_counter_extend(&axis->count, 32, count));              \
        const jred_tracked tracked = jred_tracker_update(&axis->tracker, phase);                                             \
        axis->speed = jred_##n##_period_omega(&axis->tick, tracked).value;                                                   \
        const jred_##n##_motion reference = {tracked.phase, omega, alpha};                                                   \
        const jred_##n##_motion later = jred_##n##_period_later(&axis->lead, reference).motion;                              \
        const jred_##n##_friction_sign friction = jred_##n##_friction_ramp_at(&axis->ramp, omega);                           \
        const jred_##n##_checked_torque needed = kernel##_axis_at_measured(&axis->press, &axis->range, later, reference, friction); \
        const jred_##n motor = jred_##n##_transmission_motor(&axis->gearbox, needed.torque, omega, alpha).value;             \
        const jred_##n##_limited limited = jred_##n##_torque_limits_limited(&axis->limits, motor);                           \
        axis->clipped = limited.clipped;                                                                                     \
        return limited.torque;                                                                                               \
    }                                                                                                                        \
    static jred_status run_##kernel##_axis(point *points, size_t count) {                                                    \
        static const jred_gearbox gearbox = {1.0f, 1.0f, 1e-9f};                                                             \
        kernel##_axis axis = {0};                                                                                            \
        jred_info info;                                                                                                      \
        jred_status status = jred_image_info(image, image_length, &info);                                                          \
        /* No smoothing: the gains of the memory 0. */                                                                       \
        axis.tracker = (jred_tracker){0, 0, 0, {1u << 31, 3u << 30, 1u << 31}, 1u << 30};                                    \
        axis.limits = (jred_##n##_torque_limits){n##_LEAST, n##_GREATEST};                                                   \
        if (status == JRED_OK) status = kernel##_axis_load_words(&axis.press, image, image_length);                                \
        if (status == JRED_OK) status = jred_##n##_motion_range_of(&info, &axis.range);                                      \
        if (status == JRED_OK) status = jred_##n##_period_make(&axis.tick, &info, 1e-3f);                                    \
        if (status == JRED_OK) status = jred_##n##_period_make(&axis.lead, &info, 4e-6f);                                    \
        if (status == JRED_OK) status = jred_##n##_friction_ramp_make(&axis.ramp, &info, 1e-5f * info.speed_base);           \
        if (status == JRED_OK) status = jred_##n##_transmission_make(&axis.gearbox, &info, &gearbox);                        \
        for (point *p = points; status == JRED_OK && p < points + count; p++) {                                              \
            p->phase = n##_bits(c_##kernel##_axis(&axis, p->phase, n##_of(p->omega), n##_of(p->third)));                     \
            p->omega = n##_bits(axis.speed);                                                                                 \
            p->third = n##_bits(axis.clipped);                                                                               \
        }                                                                                                                    \
        return status;                                                                                                       \
    }
#define f32_LEAST -1e6f
#define f32_GREATEST 1e6f
#define q31_LEAST INT32_MIN
#define q31_GREATEST INT32_MAX
#define q15_LEAST INT16_MIN
#define q15_GREATEST INT16_MAX

COUNTED_KERNELS(AXIS)

#define AXIS_LINE(kernel, format, n, set) {"jred_" #kernel "_axis", run_##kernel##_axis},
#define COUNTED_LINE(kernel, format, n, set) {"jred_" #kernel "_counts", run_##kernel##_counts},
#define LINE(kernel, quantity, format, n, set) {"jred_" #kernel "_" #quantity, run_##kernel##_##quantity},
static const struct {
    const char *name;
    jred_status (*run)(point *, size_t);
} kernels[] = {KERNELS(LINE) COUNTED_KERNELS(COUNTED_LINE) COUNTED_KERNELS(AXIS_LINE)};

/* The microbit has 16 KiB of RAM. */
static uint32_t buffer[2700];

#define SYSTICK ((volatile uint32_t *)0xe000e010) /* control, reload, value */
#define RELOAD 0x00ffffffu

__attribute__((noinline)) uint32_t tick_clock(void) { return SYSTICK[2]; }

static int file(const char *name, const char *ending, int flags) {
    static char path[64];
    strcpy(path, name);
    strcat(path, ending);
    return open(path, flags, 0644);
}

int main(void) {
    SYSTICK[1] = RELOAD;
    SYSTICK[2] = 0;
    SYSTICK[0] = 5; /* the core's clock */
    for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++) {
        int in = file(kernels[k].name, ".in", O_RDONLY);
        if (in < 0) continue;
        read(in, buffer, sizeof buffer);
        close(in);
        image_length = buffer[0];
        image = buffer + 2;
        size_t count = buffer[1];
        point *points = (point *)(buffer + 2 + image_length);
        uint32_t start = tick_clock();
        jred_status status = kernels[k].run(points, count);
        uint32_t ticks = (start - tick_clock()) & RELOAD;
        if (status != JRED_OK) {
            printf("%s: %s\n", kernels[k].name, jred_status_name(status));
            return 1;
        }
        int out = file(kernels[k].name, ".out", O_WRONLY | O_CREAT | O_TRUNC);
        write(out, points, count * sizeof *points);
        write(out, &ticks, sizeof ticks);
        close(out);
    }
    return 0;
}
