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

static const uint32_t *words;
static size_t length;

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
        jred_status status = kernel##_##quantity##_load_words(&model, words, length);                                     \
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
        jred_status status = kernel##_counts_load_words(&model, words, length);                                              \
        for (point *p = points; status == JRED_OK && p < points + count; p++)                                                \
            p->phase = n##_bits(c_##kernel##_counts(&model, (int32_t)p->phase, n##_of(p->omega), n##_of(p->third)));         \
        return status;                                                                                                       \
    }

#define COUNTED_KERNELS(DO)               \
    DO(f32, cubic_f32, f32, 49)           \
    DO(q31_quadratic, quadratic_q31, q31, 49) \
    DO(q15, rows_q15, q15, 49)

COUNTED_KERNELS(COUNTED)

#define COUNTED_LINE(kernel, format, n, set) {"jred_" #kernel "_counts", run_##kernel##_counts},
#define LINE(kernel, quantity, format, n, set) {"jred_" #kernel "_" #quantity, run_##kernel##_##quantity},
static const struct {
    const char *name;
    jred_status (*run)(point *, size_t);
} kernels[] = {KERNELS(LINE) COUNTED_KERNELS(COUNTED_LINE)};

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
        length = buffer[0];
        words = buffer + 2;
        size_t count = buffer[1];
        point *points = (point *)(buffer + 2 + length);
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
