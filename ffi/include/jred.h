/* jred in C and C++: ticks over a table image. docs/c.md shows how; this is the reference.
 *
 *     #include "jred.h"
 *     #include "press.h"                           written by: jred export press.toml --format c --out press.h
 *
 *     static press_model press;                    memory of yours; nothing is allocated
 *     if (press_load(&press) != JRED_OK) ...       once: every check is made here
 *     float torque = press_torque(&press, phase, omega, alpha);      in every tick
 *
 * Link with libjred_ffi.a and `--gc-sections`: only what is called stays in the program.
 */
#ifndef JRED_H
#define JRED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
#define JRED_C_ extern "C"
extern "C" {
#else
#define JRED_C_ extern
#endif

/* ---- status ------------------------------------------------------------------------------------------------------ */

/* What a function answers; 0 is good. */
typedef int32_t jred_status;
enum {
    JRED_OK = 0,
    JRED_LIMITED = 1,       /* done, but outside the range of the number type: the nearest end was taken */
    JRED_NULL = 2,          /* a pointer is null */
    JRED_MISALIGNED = 3,    /* the words do not lie on a 4-byte boundary */
    JRED_BIG_ENDIAN = 4,    /* images are little-endian, and this processor is not */
    JRED_LENGTH = 5,        /* not the number of words that the image says: truncated, or padded */
    JRED_NOT_AN_IMAGE = 6,  /* the words do not begin with "JRED" */
    JRED_VERSION = 7,       /* another version of the layout: export the table anew */
    JRED_CRC = 8,           /* the image is damaged */
    JRED_HEADER = 9,        /* a word of the header has no meaning */
    JRED_NUMBER_TYPE = 10,  /* the image holds another number type */
    JRED_LAYOUT = 11,       /* the image has another layout */
    JRED_SET = 12,          /* the image has another set of curves */
    JRED_CELLS = 13,        /* too few or too many cells or harmonics */
    JRED_ROWS = 14,         /* not as many rows as cells and curves need */
    JRED_RANGE = 15,        /* a number is not finite or leaves its range */
    JRED_NO_INERTIA = 16,   /* the inertia is not positive everywhere */
    JRED_NOT_CLOSED = 17,   /* a periodic curve does not close */
    JRED_TORQUE_RANGE = 18, /* a torque may leave the number range */
    JRED_UNITS = 19,        /* the machine units are not those of the table */
    JRED_CONSTANT = 20,     /* a constant friction is negative or not finite */
    JRED_RECIPROCAL = 21,   /* the curve of 1/J is not that of J */
    JRED_TABLE = 22,        /* anything else that is wrong with a table */
    JRED_NOT_A_PLAN = 23,   /* the words do not begin with "JRPL" */
    JRED_OTHER_RANGE = 24,  /* the plan was made for another range of the drive link than the model */
    JRED_PLAN_ROW = 25,     /* a row of the plan is out of order, or has a number that does not fit */
    JRED_GAP = 26,          /* a row of the plan does not end where the next begins */
    JRED_STROKE = 27,       /* the plan leaves the stroke */
    JRED_OPEN = 28,         /* the plan does not end as it begins: it cannot be repeated */
    JRED_FIGURE = 29,       /* a figure of an encoder, a period or a ramp does not fit, or a plan is faster than the machine units */
    JRED_NOT_LOADED = 30    /* there is no model, or no follower, in the memory */
};

/* The name of a status, such as "JRED_CRC"; "JRED_UNKNOWN" for another number. */
const char *jred_status_name(int32_t status);

/* ---- phase ------------------------------------------------------------------------------------------------------- */

/* The angle of the drive link in units of 2^-32 turns (of the stroke, if it slides). It wraps by itself. */

/* From radians, 6e-8 of a turn for |phi| <= 2 pi; 0 beyond 6e8 rad, for NaN and for infinity. From counts: an encoder, below. */
uint32_t jred_phase_from_radians(float phi);
/* From a position within a stroke (jred_info), limited to it; its start for NaN, and for a stroke that is none. */
uint32_t jred_phase_from_stroke(float position, float from, float to);

/* ---- encoder ----------------------------------------------------------------------------------------------------- */

/* Made once from its figures; then the phase of a count in the tick, without a division: the multiplications of jred::axis::Encoder in
 * Rust, the same bits, inlined where it is called. Zeros, and an encoder that could not be made, have the phase 0.
 *
 *     static jred_encoder encoder;
 *     const jred_mounting mounting = {10000, {17, 2}, true, 1234};
 *     if (jred_encoder_make(&encoder, &mounting) != JRED_OK) ...            once
 *     uint32_t phase = jred_encoder_phase(&encoder, count);                 in every tick
 *
 * phi/(2 pi) = +-(count - homing_offset)*gear[1]/(counts_per_turn*gear[0]), less than 2^-32 of a turn off at every count of 32 and of 64 bits. */
typedef struct {
    uint32_t counts_per_turn; /* counts of one turn of the encoder's shaft; in quadrature four times its lines */
    uint32_t gear[2];         /* turns of that shaft, and the turns of the drive link that they make: {1, 1} on its own shaft */
    bool counts_down;         /* while phi grows */
    int64_t homing_offset;    /* the count at phi = 0 */
} jred_mounting;

typedef struct {
    int32_t lower;
    uint32_t upper;
    uint64_t start;
    int32_t rest;
} jred_encoder;

/* JRED_FIGURE: no counts a turn, a zero in the gear, or less than two counts a turn of the drive link. */
jred_status jred_encoder_make(jred_encoder *encoder, const jred_mounting *mounting);

/* The same encoder as a constant: it needs no call at the start and no RAM, and wrong figures do not compile. On an M0 a tick takes 11
 * instructions less, on the other cores as many:
 *
 *     static const jred_encoder encoder = JRED_ENCODER(10000, 17, 2, true, 1234);
 *
 * counts_per_turn*gear_0 less than 2^32; what jred_encoder_make refuses does not compile. */
#define JRED_ENCODER(counts_per_turn, gear_0, gear_1, counts_down, home)                                                       \
    JRED_ENCODER_((uint64_t)(counts_per_turn) * (uint64_t)(gear_0), (uint64_t)(gear_1), counts_down, (int64_t)(home))
#define JRED_ENCODER_(per, link, down, home)                                                                                   \
    {JRED_LOWER_(JRED_STEP_(per, link, down)), JRED_UPPER_(JRED_STEP_(per, link, down)),                                       \
     JRED_START_(JRED_HOME_(per, link, home), down) + 0u * sizeof(char[JRED_FIGURES_(per, link) ? 1 : -1]),                    \
     (int32_t)(uint32_t)((down) ? 0u - JRED_DIGIT_3_(per, link) : JRED_DIGIT_3_(per, link))}
#define JRED_FIGURES_(per, link) ((per) <= UINT32_MAX && (link) > 0 && (link) <= UINT32_MAX && (per) / 2u >= (link))
/* link/per of a turn a count to 96 bits, in three digits of 32 bits; the last one is rounded. */
#define JRED_REST_1_(per, link) (((link) << 32) % (per))
#define JRED_REST_2_(per, link) ((JRED_REST_1_(per, link) << 32) % (per))
#define JRED_DIGIT_3_(per, link) (((JRED_REST_2_(per, link) << 32) + (per) / 2u) / (per))
#define JRED_DIGITS_(per, link) (((((link) << 32) / (per)) << 32) + (JRED_REST_1_(per, link) << 32) / (per))
/* To the nearest of 64 bits: of -x where it counts down. */
#define JRED_STEP_(per, link, down)                                                                                            \
    ((down) ? 0u - JRED_DIGITS_(per, link) - (JRED_DIGIT_3_(per, link) > 0x80000000u ? 1u : 0u)                                \
            : JRED_DIGITS_(per, link) + (JRED_DIGIT_3_(per, link) >= 0x80000000u ? 1u : 0u))
#define JRED_LOWER_(step) ((int32_t)(uint32_t)(step))
#define JRED_UPPER_(step) ((uint32_t)((step) >> 32) + ((uint32_t)(step) >> 31))
/* home mod per, without a sign; the phase of it to 64 bits; that of count 0 with half a unit. */
#define JRED_WITHIN_(per, home)                                                                                                \
    ((home) >= 0 ? (uint64_t)(home) % (per) : ((per) - (0u - (uint64_t)(home)) % (per)) % (per))
#define JRED_TURNED_(per, link, home) (JRED_WITHIN_(per, home) * (link) % (per))
#define JRED_HOME_(per, link, home)                                                                                            \
    (((JRED_TURNED_(per, link, home) << 32) / (per) << 32) +                                                                   \
     (((JRED_TURNED_(per, link, home) << 32) % (per)) << 32) / (per))
#define JRED_START_(home, down) (((down) ? (home) : 0u - (home)) + 0x80000000u)

/* A drive link that has a stroke: s = home_position + (count - homing_offset)*resolution. */
typedef struct {
    double resolution; /* m a count, or rad; negative if it counts down while the position grows */
    int64_t homing_offset; /* the count at the position home_position */
    double home_position;    /* m, or rad */
} jred_stroke_mounting;

typedef struct {
    int64_t step;
    int64_t start;
    int64_t start_narrow;
    int64_t middle;
    int64_t reach;
    uint32_t part;
    int32_t rest;
} jred_stroke_encoder;

/* Of the stroke in jred_info. JRED_FIGURE: a stroke of less than 16 or more than 2^53 counts, home 100,000 strokes away, NaN: then
 * every count is limited. One that was never made (zeros) gives phase 0. */
jred_status jred_stroke_encoder_make(jred_stroke_encoder *encoder, float from, float to, const jred_stroke_mounting *scaled);

/* A phase of a stroke; limited to its ends, and whether it was. */
typedef struct {
    uint32_t phase;
    bool limited;
} jred_place;

/* Cores that multiply to 32 bits only: Cortex-M0, M0+, M23. */
#ifndef JRED_SHORT_MULTIPLY_
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__)
#define JRED_SHORT_MULTIPLY_ 1
#else
#define JRED_SHORT_MULTIPLY_ 0
#endif
#endif

/* The phase at a count of 32 bits. A register that overflows while the machine goes on turning keeps its angle only if 2^32 counts are
 * whole turns of the drive link: take jred_counter_extend and jred_encoder_phase_wide. */
static inline uint32_t jred_encoder_phase(const jred_encoder *encoder, int32_t count) {
    const int32_t lower = encoder->lower;
    const uint32_t upper = encoder->upper;
#if JRED_SHORT_MULTIPLY_
    const int32_t a1 = count >> 16, a0 = count & 0xffff, b1 = lower >> 16, b0 = lower & 0xffff;
    const uint32_t low = (uint32_t)a0 * (uint32_t)b0, start = (uint32_t)encoder->start;
    const int32_t middle = a0 * b1 + (int32_t)(low >> 16), other = a1 * b0 + (middle & 0xffff);
    const uint32_t sum = ((uint32_t)other << 16 | (low & 0xffffu)) + start;
    const uint32_t high = (uint32_t)(a1 * b1 + (middle >> 16) + (other >> 16));
    return high + (uint32_t)(encoder->start >> 32) + (uint32_t)(sum < start) + (uint32_t)count * upper;
#else
    return (uint32_t)(((uint64_t)((int64_t)count * lower) + encoder->start) >> 32) + (uint32_t)count * upper;
#endif
}

/* The phase at a count of 64 bits. Here, above and below a negative number is shifted to the right as all compilers for these cores do it. */
static inline uint32_t jred_encoder_phase_wide(const jred_encoder *encoder, int64_t count) {
    const uint64_t step = ((uint64_t)encoder->upper << 32) + (uint64_t)(int64_t)encoder->lower;
    const int64_t upper = (count >> 32) * encoder->rest;
    const int64_t lower = ((int64_t)(uint32_t)count * encoder->rest) >> 32;
    return (uint32_t)(((uint64_t)count * step + (uint64_t)(upper + lower) + encoder->start) >> 32);
}

static inline jred_place jred_place_(int64_t place) {
    const int64_t end = (int64_t)1 << 32;
    jred_place found;
    found.phase = place < 0 ? 0 : place < end ? (uint32_t)place : UINT32_MAX;
    found.limited = place < 0 || place > end;
    return found;
}

/* The phase of a stroke at a count of 32 bits; the register may overflow within the stroke. One of more than 2^32 counts is flagged. */
static inline jred_place jred_stroke_encoder_phase(const jred_stroke_encoder *encoder, int32_t count) {
    const int64_t from_middle = (int32_t)((uint32_t)count - (uint32_t)encoder->middle);
    const int64_t lower = (from_middle * (int64_t)(uint32_t)encoder->step + (int64_t)encoder->part) >> 32;
    return jred_place_(from_middle * (encoder->step >> 32) + lower + encoder->start_narrow);
}

/* The phase of a stroke at a count of 64 bits. */
static inline jred_place jred_stroke_encoder_phase_wide(const jred_stroke_encoder *encoder, int64_t count) {
    const int64_t reach = encoder->reach, middle = encoder->middle;
    const int64_t from_middle = count > middle + reach ? reach : count < middle - reach ? -reach : count - middle;
    const int64_t upper = from_middle >> 32;
    const uint64_t lower = (uint32_t)from_middle, low = lower * (uint32_t)encoder->step;
    const int64_t rest = upper * encoder->rest + (((int64_t)lower * encoder->rest) >> 32);
    const int64_t rests = (rest >> 2) + (int64_t)(encoder->part >> 2);
    const int64_t parts = ((int64_t)(low >> 2) + rests) >> 30;
    return jred_place_(upper * encoder->step + (int64_t)lower * (encoder->step >> 32) + parts + encoder->start);
}

/* Extends the reading of a counter of so many bits, 1 to 32 (others are not refused), that overflows: the count nearest to the last one,
 * *count. The machine must move less than half of the counter's range between two readings. */
static inline int64_t jred_counter_extend(int64_t *count, uint32_t bits, uint32_t reading) {
    const uint32_t shift = (32u - bits) & 31u;
    const int32_t moved = (int32_t)((reading << shift) - ((uint32_t)*count << shift)) >> shift;
    *count = (int64_t)((uint64_t)*count + (uint64_t)(int64_t)moved);
    return *count;
}

/* ---- image ------------------------------------------------------------------------------------------------------- */

/* What an image says of itself. For a drive link that slides read force, speed, mass. */
typedef struct {
    uint32_t set;            /* curves, as docs/table-image.md has them */
    uint32_t cells;          /* or harmonics */
    uint32_t stroke;         /* 0: a turn; 1: a stroke */
    float from;              /* start and end of the stroke (m, or rad) */
    float to;
    float torque_base;       /* machine units: what the number 1 is (N m); 1 in single precision */
    float speed_base;        /* rad/s */
    float inertia_base;      /* kg m^2 */
    float acceleration_base; /* rad/s^2 */
    float max_speed;        /* the table was made up to this speed (rad/s) */
    float max_acceleration; /* and this acceleration (rad/s^2) */
    float torque_error;      /* the largest error of the torque within them (N m) */
    uint32_t machine;        /* identifier of the machine; 0 if it has none */
} jred_info;

/* Checks header and CRC and fills info. */
jred_status jred_image_info(const uint32_t *words, size_t length, jred_info *info);

/* ---- machine units ----------------------------------------------------------------------------------------------- */

/* Fixed point is per unit: INT32_MAX, or INT16_MAX, is just below 1, the base. A number in units of a base of jred_info: JRED_OK, or
 * JRED_LIMITED if it did not fit; of no number (NaN, or 0 of a base of 0) it is 0 and JRED_LIMITED. */
jred_status jred_q31_from_si(float si, float base, int32_t *number);
jred_status jred_q15_from_si(float si, float base, int16_t *number);
/* And back. */
float jred_q31_to_si(int32_t number, float base);
float jred_q15_to_si(int16_t number, float base);

/* ---- model ------------------------------------------------------------------------------------------------------- */

/* Memory of a model, anywhere; zeros are no model. A model is not copied to another machine, but may be moved or copied as bytes. */
#define JRED_MEMORY_POINTERS 37
typedef struct {
    uintptr_t tag; /* the set of curves and 1; 0: no model */
    void *opaque[JRED_MEMORY_POINTERS];
} jred_memory;

/* Any set of curves. */
#define JRED_ANY 0xffff

/* A tick looks whether the model, which is not null, was loaded: three instructions in its caller. Define JRED_UNCHECKED before this header where the status
 * of every load is looked at, to leave that out. */
#ifdef JRED_UNCHECKED
#define JRED_IS_LOADED_(model, set) true
#else
#define JRED_IS_LOADED_(model, set) \
    ((set) == JRED_ANY ? (model)->memory.tag != 0 : (model)->memory.tag == (uintptr_t)(set) + 1)
#endif

/* A machine by its name, format and set of curves, as `jred export --format c` writes them:
 *
 *     JRED_MODEL(press, spline_f32, 21)
 *
 * declares the type press_model and
 *
 *     jred_status press_load_words(press_model *, const uint32_t *words, size_t length);
 *     number      press_torque(const press_model *, uint32_t phase, number omega, number alpha);
 *     number      press_torque_with(const press_model *, uint32_t phase, number omega, number alpha, friction);
 *     checked     press_at_reference(const press_model *, const motion_range *, motion reference, friction);
 *     checked     press_at_measured(const press_model *, const motion_range *, motion measured, motion reference, friction);
 *     number      press_acceleration(const press_model *, uint32_t phase, number omega, number torque);
 *     range       press_acceleration_range(const press_model *, uint32_t phase, number omega, number least, number greatest);
 *     observed    press_observe(const press_model *, observer *, uint32_t phase, number torque, friction);        not of JRED_ANY_MODEL
 *
 * where number is float, int32_t or int16_t, as the format ends in f32, q31 or q15, and the others jred_f32_range, jred_f32_friction_sign, ...:
 * see below. Of a number that is NaN or infinite, the torque or the acceleration is NaN or infinite; press_at_reference and press_at_measured say so and give
 * a torque that is neither. The words must live and stay the same as long as the model is ticked: exchange a table between two ticks, not in an
 * interrupt between the load and the end of a tick. A tick of a model that was not loaded gives 0, and is flagged. An
 * acceleration that does not fit is the nearest end of the range; press_acceleration_range says so of each.
 *
 * Formats: spline_f32, cubic_f32, quadratic_f32, spline_q31, cubic_q31, quadratic_q31, spline16_q31, rows_q15, harmonic_f32,
 * slider_crank_f32.
 */
#define JRED_MODEL(name, format, set)                               \
    JRED_MODEL_(name, format, JRED_NUMBER_##format, s##set, set);   \
    JRED_OBSERVE_(name, format, JRED_NUMBER_##format, s##set, set)
/* The same for whatever set of curves an image has: a tick looks which they are, and takes longer. */
#define JRED_ANY_MODEL(name, format) JRED_MODEL_(name, format, JRED_NUMBER_##format, any, JRED_ANY)

#define JRED_NUMBER_spline_f32 f32
#define JRED_NUMBER_cubic_f32 f32
#define JRED_NUMBER_quadratic_f32 f32
#define JRED_NUMBER_harmonic_f32 f32
#define JRED_NUMBER_slider_crank_f32 f32
#define JRED_NUMBER_spline_q31 q31
#define JRED_NUMBER_cubic_q31 q31
#define JRED_NUMBER_quadratic_q31 q31
#define JRED_NUMBER_spline16_q31 q31
#define JRED_NUMBER_rows_q15 q15

typedef float jred_f32;
typedef int32_t jred_q31;
typedef int16_t jred_q15;

#define JRED_RANGE_(n)         \
    typedef struct {           \
        jred_##n least;        \
        jred_##n greatest;     \
        bool least_limited;    \
        bool greatest_limited; \
    } jred_##n##_range;
/* The accelerations at the least and at the greatest torque, and whether each was limited to the number range: never in single
 * precision. */
JRED_RANGE_(f32)
JRED_RANGE_(q31)
JRED_RANGE_(q15)

/* The sign of Coulomb friction: all of c with the sign of a speed, or a share of c from -1 to 1. press_torque has the sign of its
 * own omega, which chatters at standstill if it is measured: take that of the set-point. */
#define JRED_FRICTION_SIGN_(n)                                                            \
    typedef struct {                                                                      \
        jred_##n number;                                                                  \
        bool is_share;                                                                    \
    } jred_##n##_friction_sign;                                                           \
    static inline jred_##n##_friction_sign jred_##n##_friction_of_speed(jred_##n omega) { \
        jred_##n##_friction_sign friction = {omega, false};                               \
        return friction;                                                                  \
    }                                                                                     \
    static inline jred_##n##_friction_sign jred_##n##_friction_scaled(jred_##n share) {   \
        jred_##n##_friction_sign friction = {share, true};                                \
        return friction;                                                                  \
    }
JRED_FRICTION_SIGN_(f32)
JRED_FRICTION_SIGN_(q31)
JRED_FRICTION_SIGN_(q15)

/* The greatest speed and acceleration that a table was made for, and a hundredth more, in the numbers of its model: made once of jred_info.
 * press_at_reference gives the torque, and whether the motion is beyond; NaN and infinity are, and in fixed point a number that was limited to
 * its range. press_at_measured takes phase and speed of the first motion, acceleration of the second, and looks at both speeds. speed_beyond is of
 * the speeds and of the friction. What is beyond gets the torque of the nearest motion that the table
 * was made for, so that the weight of an axis stays held. The bits are those of jred::axis::FeedForward. */
#define JRED_MOTION_RANGE_(n)                                                                                      \
    typedef struct {                                                                                               \
        jred_##n max_speed;                                                                                        \
        jred_##n max_acceleration;                                                                                 \
    } jred_##n##_motion_range;                                                                                     \
    typedef struct {                                                                                               \
        jred_##n torque;                                                                                           \
        bool speed_beyond;                                                                                         \
        bool acceleration_beyond;                                                                                  \
    } jred_##n##_checked_torque;                                                                                   \
    jred_status jred_##n##_motion_range_of(const jred_info *info, jred_##n##_motion_range *range);                 \
    static inline jred_##n jred_##n##_within_(jred_##n x, jred_##n most) {                                         \
        return x > most ? most : x >= -most ? x : x < -most ? (jred_##n)-most : 0;                                 \
    }
JRED_MOTION_RANGE_(f32)
JRED_MOTION_RANGE_(q31)
JRED_MOTION_RANGE_(q15)
/* Magnitudes compare as their bits, with NaN above all. */
static inline bool jred_f32_exceeds_(jred_f32 x, jred_f32 most) {
    uint32_t bits, limit;
    (void)memcpy(&bits, &x, sizeof bits);
    (void)memcpy(&limit, &most, sizeof limit);
    return bits << 1 > limit << 1;
}
static inline bool jred_q31_exceeds_(jred_q31 x, jred_q31 most) { return x > most || x < -most; }
static inline bool jred_q15_exceeds_(jred_q15 x, jred_q15 most) { return x > most || x < -most; }
/* The other branch is the one to be fast. */
#ifdef __GNUC__
#define JRED_RARE_(condition) (__builtin_expect((condition) ? 1 : 0, 0) != 0)
#else
#define JRED_RARE_(condition) (condition)
#endif
/* In fixed point every share is one from -1 to 1. */
static inline bool jred_f32_no_share_(jred_f32 share) { return jred_f32_exceeds_(share, 1.0f); }
static inline bool jred_q31_no_share_(jred_q31 share) { return (void)share, false; }
static inline bool jred_q15_no_share_(jred_q15 share) { return (void)share, false; }
static inline jred_f32 jred_f32_to_share_(jred_f32 share) { return jred_f32_within_(share, 1.0f); }
static inline jred_q31 jred_q31_to_share_(jred_q31 share) { return share; }
static inline jred_q15 jred_q15_to_share_(jred_q15 share) { return share; }

#ifdef __cplusplus
}
#endif
#include "jred_axis.h"
#ifdef __cplusplus
extern "C" {
#endif

/* ---- plan -------------------------------------------------------------------------------------------------------- */

/* A motion that `jred fastest --plan` or `jred gentlest --plan` wrote, followed tick by tick at its own pace or slower. Of a machine that
 * JRED_MODEL has declared,
 *
 *     jred_status press_follow(const press_model *, jred_f32_plan_follower *, const uint32_t *plan, size_t length, float period, float ramp);
 *
 * checks the plan and makes a follower that waits at its start: `period` is the time of a tick, `ramp` that of a change of the rate from 0 to 100 % (s). The
 * plan's words must live and stay the same as long as the follower is ticked; the model need not. With n of the model's format:
 *
 *     void        jred_n_plan_follower_start(jred_n_plan_follower *);      begins with the next tick, after the end once more from the start
 *     void        jred_n_plan_follower_reset(jred_n_plan_follower *);      back to the start, where it waits
 *     jred_status jred_n_plan_follower_repeat(jred_n_plan_follower *);     from now on again and again, if the plan ends as it begins
 *     jred_plan_state  jred_n_plan_follower_next(jred_n_plan_follower *, uint32_t percent, jred_n_set_point *);       in every tick, with the rate wanted
 *     jred_status jred_n_plan_follower_plan(jred_n_plan_follower *, jred_plan *);                              what the plan says of itself
 *
 * A null pointer, or zeros, is no follower: its set-point is 0, which no drive should go to, and its state JRED_NO_FOLLOWER.
 */
typedef int32_t jred_plan_state;
enum {
    JRED_NO_FOLLOWER = -1,
    JRED_WAITING = 0, /* not started: at the start */
    JRED_RUNNING = 1,
    JRED_HELD = 2, /* on the way, with the rate 0 */
    JRED_DONE = 3  /* at the end, where it stays */
};

typedef struct {
    uint32_t rows;
    float duration;           /* s */
    float max_speed;         /* rad/s, or m/s */
    float max_acceleration;  /* rad/s^2, or m/s^2 */
    float position_error;     /* what the plan is off by at most, beside the motion that it was made of */
    float speed_error;
    float acceleration_error;
    uint32_t machine;         /* identifier of the machine; 0 if it has none: compare it with that of jred_info */
} jred_plan;

#define JRED_PLAN_FOLLOWER_WORDS 28
#define JRED_PLAN_FOLLOWER_(n)                                                                                             \
    typedef struct {                                                                                                       \
        uint64_t tag; /* 0: no follower */                                                                                 \
        uint64_t opaque[JRED_PLAN_FOLLOWER_WORDS];                                                                         \
    } jred_##n##_plan_follower;                                                                                            \
    typedef struct {                                                                                                       \
        uint32_t phase;                                                                                                    \
        int32_t turns; /* whole turns since phi = 0; 0 on a stroke */                                                      \
        jred_##n omega;                                                                                                    \
        jred_##n alpha;                                                                                                    \
        bool limited; /* in fixed point the acceleration is beyond its base, with that of a change of the rate */          \
    } jred_##n##_set_point;                                                                                                \
    void jred_##n##_plan_follower_start(jred_##n##_plan_follower *follower);                                               \
    void jred_##n##_plan_follower_reset(jred_##n##_plan_follower *follower);                                               \
    jred_status jred_##n##_plan_follower_repeat(jred_##n##_plan_follower *follower);                                       \
    jred_plan_state jred_##n##_plan_follower_next(jred_##n##_plan_follower *follower, uint32_t percent, jred_##n##_set_point *planned); \
    jred_status jred_##n##_plan_follower_plan(jred_##n##_plan_follower *follower, jred_plan *plan);
JRED_PLAN_FOLLOWER_(f32)
JRED_PLAN_FOLLOWER_(q31)
JRED_PLAN_FOLLOWER_(q15)

#ifdef __cplusplus
}
#endif

#define JRED_MODEL_(name, format, number, family, set) JRED_MODEL__(name, format, number, family, set)
#define JRED_MODEL__(name, format, n, family, set)                                                                            \
    JRED_C_ jred_status jred_##format##_load(jred_memory *memory, uint16_t set_, const uint32_t *words, size_t length);       \
    JRED_C_ jred_##n jred_##format##_##family##_torque(const jred_memory *memory, uint32_t phase, jred_##n omega,             \
                                                       jred_##n alpha);                                                       \
    JRED_C_ jred_##n jred_##format##_##family##_torque_with(const jred_memory *memory, uint32_t phase, jred_##n omega,        \
                                                            jred_##n alpha, jred_##n number, bool is_share);                  \
    JRED_C_ jred_##n jred_##format##_##family##_acceleration(const jred_memory *memory, uint32_t phase,                       \
                                                                       jred_##n omega, jred_##n torque);                      \
    JRED_C_ void jred_##format##_##family##_acceleration_range(const jred_memory *memory, uint32_t phase, jred_##n omega,     \
                                                               jred_##n least, jred_##n greatest, jred_##n##_range *range);   \
    JRED_C_ jred_status jred_##format##_follow(const jred_memory *memory, jred_##n##_plan_follower *follower, const uint32_t *plan, \
                                               size_t length, float period, float ramp);                                      \
    typedef struct {                                                                                                          \
        jred_memory memory;                                                                                                   \
    } name##_model;                                                                                                           \
    static inline jred_status name##_load_words(name##_model *model, const uint32_t *words, size_t length) {                  \
        return jred_##format##_load((jred_memory *)model, set, words, length);                                                \
    }                                                                                                                         \
    static inline jred_status name##_follow(const name##_model *model, jred_##n##_plan_follower *follower, const uint32_t *plan, \
                                            size_t length, float period, float ramp) {                                        \
        return jred_##format##_follow((const jred_memory *)model, follower, plan, length, period, ramp);                      \
    }                                                                                                                         \
    static inline jred_##n name##_torque(const name##_model *model, uint32_t phase, jred_##n omega, jred_##n alpha) {         \
        return JRED_IS_LOADED_(model, set) ? jred_##format##_##family##_torque(&model->memory, phase, omega, alpha) : 0;      \
    }                                                                                                                         \
    static inline jred_##n name##_torque_with(const name##_model *model, uint32_t phase, jred_##n omega, jred_##n alpha,      \
                                              jred_##n##_friction_sign friction) {                                            \
        return JRED_IS_LOADED_(model, set) ? jred_##format##_##family##_torque_with(&model->memory, phase, omega, alpha,      \
                                                                                    friction.number, friction.is_share)       \
                                           : 0;                                                                               \
    }                                                                                                                         \
    static inline jred_##n##_checked_torque name##_checked_(const name##_model *model, const jred_##n##_motion_range *range,  \
                                                            jred_##n##_motion motion, jred_##n##_friction_sign friction, bool beyond) { \
        jred_##n##_checked_torque checked = {0, true, true};                                                                  \
        if (!JRED_IS_LOADED_(model, set)) return checked;                                                                     \
        const bool too_fast = beyond || jred_##n##_exceeds_(motion.omega, range->max_speed) ||                                \
                              (friction.is_share ? jred_##n##_no_share_(friction.number)                                      \
                                                 : jred_##n##_exceeds_(friction.number, range->max_speed));                   \
        const bool too_steep = jred_##n##_exceeds_(motion.alpha, range->max_acceleration);                                    \
        if (JRED_RARE_(too_fast || too_steep)) {                                                                              \
            motion.omega = jred_##n##_within_(motion.omega, range->max_speed);                                                \
            motion.alpha = jred_##n##_within_(motion.alpha, range->max_acceleration);                                         \
            friction.number = friction.is_share ? jred_##n##_to_share_(friction.number)                                       \
                                                : jred_##n##_within_(friction.number, range->max_speed);                      \
        }                                                                                                                     \
        checked.torque = name##_torque_with(model, motion.phase, motion.omega, motion.alpha, friction);                       \
        checked.speed_beyond = too_fast;                                                                                      \
        checked.acceleration_beyond = too_steep;                                                                              \
        return checked;                                                                                                       \
    }                                                                                                                         \
    static inline jred_##n##_checked_torque name##_at_reference(const name##_model *model, const jred_##n##_motion_range *range, \
                                                                jred_##n##_motion reference, jred_##n##_friction_sign friction) { \
        return name##_checked_(model, range, reference, friction, false);                                                     \
    }                                                                                                                         \
    static inline jred_##n##_checked_torque name##_at_measured(const name##_model *model, const jred_##n##_motion_range *range, \
                                                               jred_##n##_motion measured, jred_##n##_motion reference,       \
                                                               jred_##n##_friction_sign friction) {                           \
        measured.alpha = reference.alpha;                                                                                     \
        return name##_checked_(model, range, measured, friction, jred_##n##_exceeds_(reference.omega, range->max_speed));     \
    }                                                                                                                         \
    static inline jred_##n name##_acceleration(const name##_model *model, uint32_t phase, jred_##n omega,                     \
                                                         jred_##n torque) {                                                   \
        return JRED_IS_LOADED_(model, set) ? jred_##format##_##family##_acceleration(&model->memory, phase, omega, torque) : 0; \
    }                                                                                                                         \
    static inline jred_##n##_range name##_acceleration_range(const name##_model *model, uint32_t phase, jred_##n omega,       \
                                                             jred_##n least, jred_##n greatest) {                             \
        jred_##n##_range range = {0, 0, false, false};                                                                        \
        if (JRED_IS_LOADED_(model, set))                                                                                      \
            jred_##format##_##family##_acceleration_range(&model->memory, phase, omega, least, greatest, &range);             \
        return range;                                                                                                         \
    }                                                                                                                         \
    struct jred_semicolon_ /* takes the semicolon behind the macro */

#define JRED_OBSERVE_(name, format, number, family, set) JRED_OBSERVE__(name, format, number, family, set)
#define JRED_OBSERVE__(name, format, n, family, set)                                                                          \
    JRED_C_ void jred_##format##_##family##_observe(const jred_memory *memory, jred_##n##_observer *observer, uint32_t measured, \
                                                    jred_##n torque, jred_##n number, bool is_share, jred_##n##_observed *seen); \
    static inline jred_##n##_observed name##_observe(const name##_model *model, jred_##n##_observer *observer, uint32_t measured, \
                                                     jred_##n torque, jred_##n##_friction_sign friction) {                    \
        jred_##n##_observed seen = {{0, 0, 0}, 0, 0, true, true};                                                             \
        if (JRED_IS_LOADED_(model, set) && observer->tag == 1)                                                                \
            jred_##format##_##family##_observe(&model->memory, observer, measured, torque, friction.number, friction.is_share, &seen); \
        return seen;                                                                                                          \
    }                                                                                                                         \
    struct jred_semicolon_

#endif
