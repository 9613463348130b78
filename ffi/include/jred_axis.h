/* The axis in C: what stands between an encoder's phase and a motor's torque, as jred::axis in Rust with the same bits. Part of jred.h, which
 * includes it. docs/c.md has a program.
 *
 *     encoder's phase -> tracker -> period: speed -> period: lead time -> feed-forward -> transmission -> torque limits
 *
 * Each part is made once, of the jred_info of its model's image, and answers JRED_FIGURE to a figure that does not fit and JRED_NULL to a null
 * pointer; then, and if it is zeros, its ticks give 0. A tick wants parts that are not null. `limited` says, in fixed point, that a number did not
 * fit and the nearest end was taken. n is f32, q31 or q15.
 */
#ifndef JRED_AXIS_H
#define JRED_AXIS_H

#include "jred.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- numbers ----------------------------------------------------------------------------------------------------- */

/* A factor of any magnitude, for floating point and for fixed point. */
typedef struct {
    float ratio;
    uint32_t shift;
    int32_t mantissa;
} jred_factor;

#define JRED_OUTCOME_(n)  \
    typedef struct {      \
        jred_##n value;   \
        bool limited;     \
    } jred_##n##_outcome;
JRED_OUTCOME_(f32)
JRED_OUTCOME_(q31)
JRED_OUTCOME_(q15)

/* A product is rounded before it is added to something, as in Rust: a compiler that fuses both would change the last bit. On Arm cores this says so,
 * without an instruction; for others compile with -ffp-contract=off. */
#if defined(__GNUC__) && defined(__arm__) && defined(__ARM_FP)
#define JRED_ARM_FLOAT_ 1
#else
#define JRED_ARM_FLOAT_ 0
#endif
#if JRED_ARM_FLOAT_
#define JRED_ROUNDED_(product) __asm__("" : "+t"(product))
#else
#define JRED_ROUNDED_(product) ((void)(product))
#endif

/* Towards 0, limited to 32 bits; 0 for NaN. */
static inline int32_t jred_whole_(float x) {
#if JRED_ARM_FLOAT_
    int32_t whole;
    __asm__("vcvt.s32.f32 %0, %1" : "=t"(whole) : "t"(x));
    return whole;
#else
    return x >= 2147483648.0f ? INT32_MAX : x >= -2147483648.0f ? (int32_t)x : x < 0.0f ? INT32_MIN : 0;
#endif
}

/* The upper half of a product. */
static inline int32_t jred_high_(int32_t a, int32_t b) {
#if JRED_SHORT_MULTIPLY_
    const int32_t a1 = a >> 16, a0 = a & 0xffff, b1 = b >> 16, b0 = b & 0xffff;
    const int32_t middle = a0 * b1 + (int32_t)(((uint32_t)a0 * (uint32_t)b0) >> 16);
    const int32_t other = a1 * b0 + (middle & 0xffff);
    return a1 * b1 + (middle >> 16) + (other >> 16);
#else
    return (int32_t)(((int64_t)a * b) >> 32);
#endif
}

static inline jred_f32_outcome jred_f32_times_(jred_f32 x, const jred_factor *factor) {
    jred_f32_outcome found = {x * factor->ratio, false};
    JRED_ROUNDED_(found.value);
    return found;
}
static inline jred_q31_outcome jred_q31_times_(jred_q31 x, const jred_factor *factor) {
    const uint32_t shift = factor->shift & 31u;
    const int32_t shifted = (int32_t)((uint32_t)x << shift);
    const int32_t quarter = jred_high_(shifted, factor->mantissa);
    jred_q31_outcome found;
    found.value = (int32_t)((uint32_t)quarter << 2);
    found.limited = shifted >> shift != x || found.value >> 2 != quarter;
    if (found.limited) found.value = (x >> 31) ^ INT32_MAX;
    return found;
}
static inline jred_q15_outcome jred_q15_times_(jred_q15 x, const jred_factor *factor) {
    const jred_q31_outcome wide = jred_q31_times_((int32_t)x * 65536, factor);
    const jred_q15_outcome found = {(int16_t)(wide.value >= 0x7fff8000 ? INT16_MAX : (wide.value + 0x8000) >> 16), wide.limited};
    return found;
}

static inline jred_f32_outcome jred_f32_of_count_(int32_t count, const jred_factor *factor) {
    return jred_f32_times_((float)count, factor);
}
static inline jred_q31_outcome jred_q31_of_count_(int32_t count, const jred_factor *factor) { return jred_q31_times_(count, factor); }
static inline jred_q15_outcome jred_q15_of_count_(int32_t count, const jred_factor *factor) {
    const jred_q31_outcome wide = jred_q31_times_(count, factor);
    const jred_q15_outcome found = {(int16_t)(wide.value >> 16), wide.limited};
    return found;
}

static inline int32_t jred_f32_to_count_(jred_f32 x, const jred_factor *factor) { return jred_whole_(x * factor->ratio); }
static inline int32_t jred_q31_to_count_(jred_q31 x, const jred_factor *factor) { return jred_q31_times_(x, factor).value; }
static inline int32_t jred_q15_to_count_(jred_q15 x, const jred_factor *factor) {
    return jred_q31_times_((int32_t)x * 65536, factor).value;
}

static inline jred_f32_outcome jred_f32_plus_(jred_f32 a, jred_f32 b) {
    const jred_f32_outcome found = {a + b, false};
    return found;
}
static inline jred_q31_outcome jred_q31_plus_(jred_q31 a, jred_q31 b) {
    jred_q31_outcome found;
    found.value = (int32_t)((uint32_t)a + (uint32_t)b);
    found.limited = ((a ^ found.value) & (b ^ found.value)) < 0;
    if (found.limited) found.value = (a >> 31) ^ INT32_MAX;
    return found;
}
static inline jred_q15_outcome jred_q15_plus_(jred_q15 a, jred_q15 b) {
    const int32_t sum = (int32_t)a + (int32_t)b;
    jred_q15_outcome found;
    found.limited = sum != (int16_t)sum;
    found.value = (int16_t)(found.limited ? (sum >> 31) ^ INT16_MAX : sum);
    return found;
}

static inline jred_f32 jred_f32_minus_(jred_f32 a, jred_f32 b) { return a - b; }
static inline jred_q31 jred_q31_minus_(jred_q31 a, jred_q31 b) {
    const int32_t rest = (int32_t)((uint32_t)a - (uint32_t)b);
    return ((a ^ b) & (a ^ rest)) < 0 ? (a >> 31) ^ INT32_MAX : rest;
}
static inline jred_q15 jred_q15_minus_(jred_q15 a, jred_q15 b) {
    const int32_t rest = (int32_t)a - (int32_t)b;
    return (int16_t)(rest > INT16_MAX ? INT16_MAX : rest < INT16_MIN ? INT16_MIN : rest);
}

/* ---- tracker ----------------------------------------------------------------------------------------------------- */

/* Phase, speed and acceleration from one phase of the encoder in every period: jred::axis::Tracker. */
typedef struct {
    int64_t phase;
    int64_t speed;
    int64_t acceleration;
    uint32_t gains[3];
    uint32_t largest;
} jred_tracker;

typedef struct {
    uint32_t phase;
    int32_t speed;        /* 2^-32 of the range a period */
    int32_t acceleration; /* 2^-40 of the range a period squared, limited to 32 bits */
    int32_t residual;     /* reading minus prediction, 2^-32 of the range */
    bool jumped;          /* farther than the largest step, or no motion of this machine */
} jred_tracked;

/* With its poles at the corner frequency `bandwidth` (Hz), called in every `period` (s), at rest at `phase`: that of the encoder now. */
jred_status jred_tracker_make(jred_tracker *tracker, float bandwidth, float period, uint32_t phase);

/* A reading farther from the prediction has jumped; a quarter of the range without it. A step is a distance such as jred_f32_period_moved. */
static inline void jred_tracker_largest_step(jred_tracker *tracker, uint32_t step) {
    tracker->largest = step > 0x80000000u ? 0u - step : step;
}

static inline int32_t jred_upper_(int64_t acceleration) {
    const int64_t wide = acceleration >> 24;
    const int32_t upper = (int32_t)(wide >> 32), lower = (int32_t)(uint32_t)wide;
    return upper == lower >> 31 ? lower : (upper >> 31) ^ INT32_MAX;
}

static inline int64_t jred_share_(int32_t residual, uint32_t gain) { return (int64_t)((uint64_t)((int64_t)residual * (int64_t)gain) << 1); }

/* Corrects speed and acceleration by a residual; whether the motion was impossible. */
static inline bool jred_correct_(jred_tracker *tracker, int32_t residual) {
    const uint64_t acceleration = (uint64_t)tracker->acceleration;
    const uint64_t speed = (uint64_t)tracker->speed + acceleration + (uint64_t)jred_share_(residual, tracker->gains[1]);
    const bool lost = (int64_t)(speed ^ speed << 1) < 0;
    tracker->speed = lost ? 0 : (int64_t)speed;
    tracker->acceleration = lost ? 0 : (int64_t)(acceleration + (uint64_t)jred_share_(residual, tracker->gains[2]));
    return lost;
}

static inline jred_tracked jred_tracked_(const jred_tracker *tracker, int32_t residual, bool lost) {
    const uint32_t size = residual < 0 ? 0u - (uint32_t)residual : (uint32_t)residual;
    const jred_tracked tracked = {(uint32_t)((uint64_t)tracker->phase >> 32), (int32_t)(tracker->speed >> 32),
                                  jred_upper_(tracker->acceleration), residual, lost || size > tracker->largest};
    return tracked;
}

/* A period later, with the encoder's phase now, on a turn. */
static inline jred_tracked jred_tracker_update(jred_tracker *tracker, uint32_t measured) {
    const uint64_t phase = (uint64_t)tracker->phase + (uint64_t)tracker->speed + (uint64_t)(tracker->acceleration >> 1);
    const int32_t residual = (int32_t)(measured - (uint32_t)(phase >> 32));
    const bool lost = jred_correct_(tracker, residual);
    tracker->phase = (int64_t)(phase + (uint64_t)jred_share_(residual, tracker->gains[0]));
    return jred_tracked_(tracker, residual, lost);
}

/* The same on a stroke: phases stay at its ends. */
static inline jred_tracked jred_tracker_update_stroke(jred_tracker *tracker, uint32_t measured) {
    const int64_t half = tracker->acceleration >> 1;
    uint64_t lower = (uint64_t)(uint32_t)tracker->phase + (uint32_t)tracker->speed + (uint32_t)half;
    int64_t upper = (int64_t)((uint64_t)tracker->phase >> 32) + (tracker->speed >> 32) + (half >> 32) + (int64_t)(lower >> 32);
    const int64_t off = (int64_t)measured - upper;
    const int32_t residual = (int32_t)(off > INT32_MAX ? INT32_MAX : off < INT32_MIN ? INT32_MIN : off);
    const bool lost = jred_correct_(tracker, residual);
    const int64_t correction = jred_share_(residual, tracker->gains[0]);
    lower = (uint64_t)(uint32_t)lower + (uint32_t)correction;
    upper += (correction >> 32) + (int64_t)(lower >> 32);
    tracker->phase = upper < 0 ? 0 : upper >> 32 != 0 ? -1 : (int64_t)((uint64_t)upper << 32 | (uint32_t)lower);
    return jred_tracked_(tracker, residual, lost);
}

/* A phase advanced on a stroke: it stays at the ends. */
static inline uint32_t jred_within_stroke_(uint32_t phase, int32_t moved) {
    const uint32_t sum = phase + (uint32_t)moved;
    if (moved < 0) return sum < phase ? sum : 0;
    return sum >= phase ? sum : UINT32_MAX;
}

/* ---- the parts in each number type ------------------------------------------------------------------------------- */

/* A gearbox between motor and drive link; the rotor is then not in the table. */
typedef struct {
    float ratio;      /* > 0: turns of the motor for a turn of the drive link (of a stroke rad/m); if it reverses, change the sign of the motor's torque */
    float efficiency; /* 0.01 to 1 */
    float rotor;      /* kg m^2 */
} jred_gearbox;

#define JRED_OBSERVER_WORDS 28

/* Period: speeds and accelerations of a tracker, and motions later. The tick, or a lead time, of `seconds`.
 *
 *     jred_status       jred_n_period_make(jred_n_period *, const jred_info *, float seconds);
 *     outcome           jred_n_period_omega(const jred_n_period *, jred_tracked);
 *     outcome           jred_n_period_alpha(const jred_n_period *, jred_tracked);
 *     uint32_t          jred_n_period_moved(const jred_n_period *, omega);        a distance, in phases
 *     jred_n_later      jred_n_period_later(const jred_n_period *, jred_n_motion);
 *
 * Friction ramp: Coulomb friction by the set-point, linear up to a speed `width`, all of it above.
 *
 *     jred_status       jred_n_friction_ramp_make(jred_n_friction_ramp *, const jred_info *, float width);
 *     friction          jred_n_friction_ramp_at(const jred_n_friction_ramp *, omega);
 *
 * Transmission: torque of the motor. In fixed point its base is `base` (N m).
 *
 *     jred_status       jred_n_transmission_make(jred_n_transmission *, const jred_info *, const jred_gearbox *);
 *     outcome           jred_n_transmission_motor(const jred_n_transmission *, torque, omega, alpha);
 *
 * Torque limits: last of all. NaN becomes torque 0.
 *
 *     jred_status       jred_n_torque_limits_make(jred_n_torque_limits *, least, greatest);      JRED_FIGURE: 0 is not between them
 *     jred_n_limited    jred_n_torque_limits_limited(const jred_n_torque_limits *, torque);
 *
 * Observer: phase, speed and the torque that the table does not contain; its tick is NAME_observe of a JRED_MODEL. A torque that is NaN is flagged.
 *
 *     jred_status       jred_n_observer_make(jred_n_observer *, const jred_info *, float bandwidth, float period, uint32_t phase);
 */
#define JRED_AXIS_(n)                                                                                                              \
    typedef struct {                                                                                                               \
        uint32_t phase;                                                                                                            \
        jred_##n omega;                                                                                                            \
        jred_##n alpha;                                                                                                            \
    } jred_##n##_motion;                                                                                                           \
    typedef struct {                                                                                                               \
        jred_##n##_motion motion;                                                                                                  \
        bool limited;                                                                                                              \
    } jred_##n##_later;                                                                                                            \
    typedef struct {                                                                                                               \
        jred_factor speed;                                                                                                         \
        jred_factor moved;                                                                                                         \
        jred_factor acceleration;                                                                                                  \
        jred_factor gained;                                                                                                        \
        jred_factor needed;                                                                                                        \
        bool stroke;                                                                                                               \
    } jred_##n##_period;                                                                                                           \
    typedef struct {                                                                                                               \
        jred_factor share;                                                                                                         \
    } jred_##n##_friction_ramp;                                                                                                    \
    typedef struct {                                                                                                               \
        float base;                                                                                                                \
        jred_factor driving;                                                                                                       \
        jred_factor driven;                                                                                                        \
        jred_factor rotor;                                                                                                         \
    } jred_##n##_transmission;                                                                                                     \
    typedef struct {                                                                                                               \
        jred_##n least;                                                                                                            \
        jred_##n greatest;                                                                                                         \
    } jred_##n##_torque_limits;                                                                                                    \
    typedef struct {                                                                                                               \
        jred_##n torque;                                                                                                           \
        jred_##n clipped; /* the part cut off */                                                                                   \
    } jred_##n##_limited;                                                                                                          \
    typedef struct {                                                                                                               \
        uint64_t tag; /* 0: no observer */                                                                                         \
        uint64_t opaque[JRED_OBSERVER_WORDS];                                                                                      \
    } jred_##n##_observer;                                                                                                         \
    typedef struct {                                                                                                               \
        jred_##n##_motion motion; /* now */                                                                                        \
        jred_##n load;            /* the torque that the model does not contain, in +phi */                                        \
        int32_t residual;         /* as in jred_tracked */                                                                         \
        bool jumped;                                                                                                               \
        bool limited; /* the load is wrong until it has settled */                                                                 \
    } jred_##n##_observed;                                                                                                         \
    jred_status jred_##n##_period_make(jred_##n##_period *period, const jred_info *info, float seconds);                           \
    jred_status jred_##n##_friction_ramp_make(jred_##n##_friction_ramp *ramp, const jred_info *info, float width);                 \
    jred_status jred_##n##_transmission_make(jred_##n##_transmission *transmission, const jred_info *info, const jred_gearbox *gearbox); \
    jred_status jred_##n##_torque_limits_make(jred_##n##_torque_limits *limits, jred_##n least, jred_##n greatest);                \
    jred_status jred_##n##_observer_make(jred_##n##_observer *observer, const jred_info *info, float bandwidth, float period,      \
                                         uint32_t phase);                                                                          \
                                                                                                                                   \
    static inline jred_##n##_outcome jred_##n##_period_omega(const jred_##n##_period *period, jred_tracked tracked) {              \
        return jred_##n##_of_count_(tracked.speed, &period->speed);                                                                \
    }                                                                                                                              \
    static inline jred_##n##_outcome jred_##n##_period_alpha(const jred_##n##_period *period, jred_tracked tracked) {              \
        jred_##n##_outcome found = jred_##n##_of_count_(tracked.acceleration, &period->acceleration);                              \
        found.limited = found.limited || tracked.acceleration == INT32_MIN || tracked.acceleration == INT32_MAX;                   \
        return found;                                                                                                              \
    }                                                                                                                              \
    static inline uint32_t jred_##n##_period_moved(const jred_##n##_period *period, jred_##n omega) {                              \
        return (uint32_t)jred_##n##_to_count_(omega, &period->moved);                                                              \
    }                                                                                                                              \
    static inline jred_##n##_later jred_##n##_period_later(const jred_##n##_period *period, jred_##n##_motion motion) {            \
        const jred_##n##_outcome gained = jred_##n##_times_(motion.alpha, &period->gained);                                        \
        const jred_##n##_outcome omega = jred_##n##_plus_(motion.omega, gained.value);                                             \
        const int32_t moved = (jred_##n##_to_count_(motion.omega, &period->moved) >> 1) +                                          \
                              (jred_##n##_to_count_(omega.value, &period->moved) >> 1);                                            \
        jred_##n##_later later;                                                                                                    \
        later.motion.phase = motion.phase + (uint32_t)moved;                                                                       \
        if (period->stroke) later.motion.phase = jred_within_stroke_(motion.phase, moved);                                         \
        later.motion.omega = omega.value;                                                                                          \
        later.motion.alpha = motion.alpha;                                                                                         \
        later.limited = gained.limited || omega.limited;                                                                           \
        return later;                                                                                                              \
    }                                                                                                                              \
    static inline jred_##n##_friction_sign jred_##n##_friction_ramp_at(const jred_##n##_friction_ramp *ramp, jred_##n omega) {     \
        return jred_##n##_friction_scaled(jred_##n##_to_share_(jred_##n##_times_(omega, &ramp->share).value));                     \
    }                                                                                                                              \
    static inline jred_##n##_outcome jred_##n##_transmission_motor(const jred_##n##_transmission *transmission, jred_##n torque,   \
                                                                   jred_##n omega, jred_##n alpha) {                               \
        const bool driven = (torque < 0 && omega > 0) || (torque > 0 && omega < 0);                                                \
        const jred_##n##_outcome through = jred_##n##_times_(torque, driven ? &transmission->driven : &transmission->driving);     \
        const jred_##n##_outcome rotor = jred_##n##_times_(alpha, &transmission->rotor);                                           \
        jred_##n##_outcome motor = jred_##n##_plus_(through.value, rotor.value);                                                   \
        motor.limited = motor.limited || through.limited || rotor.limited;                                                         \
        return motor;                                                                                                              \
    }                                                                                                                              \
    static inline jred_##n##_limited jred_##n##_torque_limits_limited(const jred_##n##_torque_limits *limits, jred_##n torque) {   \
        const jred_##n least = limits->least, greatest = limits->greatest;                                                         \
        const jred_##n within = torque > greatest ? greatest : torque >= least ? torque : torque < least ? least : 0;              \
        const jred_##n##_limited limited = {within, jred_##n##_minus_(torque, within)};                                            \
        return limited;                                                                                                            \
    }
JRED_AXIS_(f32)
JRED_AXIS_(q31)
JRED_AXIS_(q15)

#ifdef __cplusplus
}
#endif

#endif
