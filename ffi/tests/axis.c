/* The results of jred_axis.h for parts that it reads: src/tests/axis.rs compares the bits with those of Rust. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "jred.h"

/* The next words of the input, into memory. */
static bool read_words(void *memory, size_t count) {
    for (size_t k = 0; k < count; k++) {
        uint32_t word;
        if (scanf("%" SCNx32, &word) != 1) return false;
        memcpy((char *)memory + k * sizeof word, &word, sizeof word);
    }
    return true;
}

static void write_f32(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    if (x != x) bits = 0x7fc00000u;
    printf("%" PRIx32 " ", bits);
}
static void write_q31(int32_t x) { printf("%" PRIx32 " ", (uint32_t)x); }
static void write_q15(int16_t x) { write_q31(x); }

static float next_f32(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
static int32_t next_q31(uint32_t bits) { return (int32_t)bits; }
static int16_t next_q15(uint32_t bits) { return (int16_t)(uint16_t)bits; }

#define PARTS(n)                                                                                                           \
    static bool parts_##n(void) {                                                                                          \
        jred_##n##_period period;                                                                                          \
        jred_##n##_friction_ramp ramp;                                                                                     \
        jred_##n##_transmission gearbox;                                                                                   \
        jred_tracked tracked = {0, 0, 0, 0, false};                                                                        \
        uint32_t in[8];                                                                                                    \
        if (!read_words(&period, 16) || !read_words(&ramp, 3) || !read_words(&gearbox, 10) || !read_words(in, 8)) return false; \
        tracked.speed = (int32_t)in[0];                                                                                    \
        tracked.acceleration = (int32_t)in[1];                                                                             \
        const jred_##n##_motion motion = {in[2], next_##n(in[3]), next_##n(in[4])};                                        \
        const jred_##n torque = next_##n(in[5]);                                                                           \
        const jred_##n##_torque_limits limits = {next_##n(in[6]), next_##n(in[7])};                                        \
        const jred_##n##_outcome omega = jred_##n##_period_omega(&period, tracked);                                        \
        const jred_##n##_outcome alpha = jred_##n##_period_alpha(&period, tracked);                                        \
        const jred_##n##_later later = jred_##n##_period_later(&period, motion);                                           \
        const jred_##n##_friction_sign friction = jred_##n##_friction_ramp_at(&ramp, motion.omega);                        \
        const jred_##n##_outcome motor = jred_##n##_transmission_motor(&gearbox, torque, motion.omega, motion.alpha);      \
        const jred_##n##_limited limited = jred_##n##_torque_limits_limited(&limits, torque);                              \
        write_##n(omega.value), write_##n(alpha.value);                                                                    \
        write_q31((int32_t)jred_##n##_period_moved(&period, motion.omega));                                                \
        write_q31((int32_t)later.motion.phase), write_##n(later.motion.omega), write_##n(later.motion.alpha);              \
        write_##n(friction.number), write_##n(motor.value), write_##n(limited.torque), write_##n(limited.clipped);         \
        printf("%d%d%d%d%d\n", omega.limited, alpha.limited, later.limited, friction.is_share, motor.limited);             \
        return true;                                                                                                       \
    }
PARTS(f32)
PARTS(q31)
PARTS(q15)

/* A tracker, the number of readings and whether it is on a stroke, and each reading. */
static bool tracker(void) {
    jred_tracker tracker;
    uint32_t in[2], measured;
    if (!read_words(&tracker, 10) || !read_words(in, 2)) return false;
    for (uint32_t k = 0; k < in[0]; k++) {
        if (!read_words(&measured, 1)) return false;
        const jred_tracked found = in[1] != 0 ? jred_tracker_update_stroke(&tracker, measured) : jred_tracker_update(&tracker, measured);
        printf("%" PRIx32 " %" PRId32 " %" PRId32 " %" PRId32 " %d ", found.phase, found.speed, found.acceleration, found.residual, found.jumped);
    }
    printf("\n");
    return true;
}

int main(void) {
    char kind;
    while (scanf(" %c", &kind) == 1)
        if (!(kind == 'f' ? parts_f32() : kind == 'l' ? parts_q31() : kind == 's' ? parts_q15() : tracker())) return 1;
    return 0;
}
