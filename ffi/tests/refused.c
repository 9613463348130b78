/* Every image that is no image of the model is refused with its own status; a model without an image ticks to 0. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "jred.h"
#include "../examples/press.h"
#include "../examples/press_plan.h"

JRED_MODEL(other, spline_f32, 1);
JRED_MODEL(cubic, cubic_f32, 21);
JRED_MODEL(fixed, spline_q31, 21);
JRED_MODEL(halves, rows_q15, 21);
JRED_MODEL(crank, slider_crank_f32, 49);
JRED_ANY_MODEL(any, spline_f32);

#define WORDS (sizeof press_words / sizeof press_words[0])
#define PLAN_WORDS (sizeof press_plan_words / sizeof press_plan_words[0])

static int failures;

static void expect(int line, int32_t found, int32_t expected) {
    if (found == expected) return;
    printf("line %d: %s instead of %s\n", line, jred_status_name(found), jred_status_name(expected));
    failures++;
}
#define EXPECT(call, expected) expect(__LINE__, call, expected)
#define CLAIM(claim) (void)((claim) || (printf("line %d: not %s\n", __LINE__, #claim), failures++))

static uint32_t copy[WORDS];

/* The status of the image with a bit of a word turned. */
static int32_t damaged(size_t word) {
    press_model model;
    memcpy(copy, press_words, sizeof copy);
    copy[word] ^= 1;
    return press_load_words(&model, copy, WORDS);
}

/* An encoder of a quarter turn: 1024 counts behind a ratio of 2:1 that count down. */
static void encoders(void) {
    jred_encoder encoder;
    jred_mounting mounting = {1024, {2, 1}, true, -5};
    EXPECT(jred_encoder_make(&encoder, &mounting), JRED_OK);
    CLAIM(jred_encoder_phase(&encoder, -5) == 0 && jred_encoder_phase(&encoder, -5 - 512) == 0x40000000u);
    CLAIM(jred_encoder_phase(&encoder, -5 + 512) == 0xc0000000u && jred_encoder_phase_wide(&encoder, -5 - 3 * 2048) == 0);
    CLAIM(jred_encoder_phase_wide(&encoder, -5 - ((int64_t)1 << 40) - 1024) == 0x80000000u);
    mounting.gear[1] = 0;
    EXPECT(jred_encoder_make(&encoder, &mounting), JRED_FIGURE);
    CLAIM(jred_encoder_phase(&encoder, 77) == 0 && jred_encoder_phase_wide(&encoder, 77) == 0);
    EXPECT(jred_encoder_make(NULL, &mounting), JRED_NULL);
#define SAME(counts, gear_0, gear_1, down, home)                                                                             \
    do {                                                                                                                     \
        static const jred_encoder known = JRED_ENCODER(counts, gear_0, gear_1, down, home);                                  \
        const jred_mounting figures = {counts, {gear_0, gear_1}, down, home};                                                \
        jred_encoder made;                                                                                                   \
        EXPECT(jred_encoder_make(&made, &figures), JRED_OK);                                                                 \
        CLAIM(known.lower == made.lower && known.upper == made.upper && known.start == made.start && known.rest == made.rest); \
    } while (0)
    SAME(10000, 17, 2, true, 1234);
    SAME(10000, 1, 1, false, 0);
    SAME(4096, 101, 7, false, -98765432109);
    SAME(8388608, 511, 1, true, -5);
    SAME(2, 1, 1, true, 1);
    SAME(65535, 65537, 2147483647, false, INT64_MIN);
    SAME(3, 1, 1, false, INT64_MAX);
    SAME(1000003, 4093, 977, true, INT64_MIN + 1);
    EXPECT(jred_encoder_make(&encoder, NULL), JRED_NULL);

    /* 24 bits a turn of a screw of 10 mm: 800 mm are 80 turns. The register begins below 2^31 and passes it. */
    const int64_t home = 0x7fff0000, turn = (int64_t)1 << 24;
    const jred_stroke_mounting scaled = {0.010 / 16777216.0, home, 0.0};
    jred_stroke_encoder stroke;
    EXPECT(jred_stroke_encoder_make(&stroke, 0.0f, 0.5f, &scaled), JRED_OK);
    for (int32_t k = 0; k <= 50; k++) {
        /* k turns are k/50 of the stroke. */
        const uint32_t exact = k == 50 ? UINT32_MAX : (uint32_t)((((uint64_t)k << 32) + 25) / 50);
        const int64_t count = home + k * turn;
        jred_place narrow = jred_stroke_encoder_phase(&stroke, (int32_t)(uint32_t)count), wide = jred_stroke_encoder_phase_wide(&stroke, count);
        CLAIM(!narrow.limited && narrow.phase - exact + 1 <= 2 && !wide.limited && wide.phase - exact + 1 <= 2);
    }
    CLAIM(jred_stroke_encoder_phase(&stroke, (int32_t)(uint32_t)(home - 1)).limited && jred_stroke_encoder_phase_wide(&stroke, home - 1).limited);
    EXPECT(jred_stroke_encoder_make(&stroke, 0.0f, 0.8f, &scaled), JRED_OK);
    CLAIM(jred_stroke_encoder_phase_wide(&stroke, home + 40 * turn).phase - 0x80000000u + 100 <= 200); /* 0.8 in single precision is 1.2e-8 more */
    EXPECT(jred_stroke_encoder_make(&stroke, 0.5f, 0.5f, &scaled), JRED_FIGURE);
    CLAIM(jred_stroke_encoder_phase(&stroke, 77).limited && jred_stroke_encoder_phase_wide(&stroke, 77).limited);
    EXPECT(jred_stroke_encoder_make(&stroke, 0.0f, 0.5f, NULL), JRED_NULL);

    int64_t count = 65000;
    CLAIM(jred_counter_extend(&count, 16, 100) == 65636 && jred_counter_extend(&count, 16, 65000) == 65000 && count == 65000);
}

/* Wrong figures, null pointers, and parts that were not made. */
static void parts(const press_model *press, const press_model *unloaded, const jred_info *info) {
    static jred_f32_period period;
    static jred_f32_transmission transmission;
    static jred_f32_torque_limits limits;
    static jred_f32_observer observer;
    static jred_tracker tracker;
    const jred_f32_friction_sign friction = jred_f32_friction_of_speed(1.0f);
    const jred_gearbox wrong_gearbox = {20.0f, 0.0f, 0.0f};
    CLAIM(!press_observe(press, &observer, 1u << 30, 5.0f, friction).load && press_observe(press, &observer, 0, 5.0f, friction).limited);
    EXPECT(jred_f32_period_make(&period, info, -1.0f), JRED_FIGURE);
    EXPECT(jred_f32_period_make(&period, NULL, 0.001f), JRED_NULL);
    EXPECT(jred_f32_transmission_make(&transmission, info, &wrong_gearbox), JRED_FIGURE);
    EXPECT(jred_f32_torque_limits_make(&limits, 1.0f, 2.0f), JRED_FIGURE);
    EXPECT(jred_tracker_make(&tracker, NAN, 0.001f, 0), JRED_FIGURE);
    CLAIM(jred_f32_period_moved(&period, 1e6f) == 0 && jred_f32_transmission_motor(&transmission, 5.0f, 1.0f, 1.0f).value == 0.0f);
    CLAIM(jred_f32_torque_limits_limited(&limits, 5.0f).torque == 0.0f && jred_f32_torque_limits_limited(&limits, NAN).torque == 0.0f);
    EXPECT(jred_f32_observer_make(&observer, info, 60.0f, 0.0f, 0), JRED_FIGURE);
    /* A machine that stands still under a torque: something balances it, and the weight. */
    const float still = press_torque(press, 0x20000000u, 0.0f, 0.0f);
    jred_f32_observed seen = {{0, 0.0f, 0.0f}, 0.0f, 0, false, false};
    EXPECT(jred_f32_observer_make(&observer, info, 60.0f, 0.001f, 0x20000000u), JRED_OK);
    for (int tick = 0; tick < 200; tick++) seen = press_observe(press, &observer, 0x20000000u, 5.0f, jred_f32_friction_scaled(0.0f));
    CLAIM(seen.load > still - 5.01f && seen.load < still - 4.99f && !seen.limited && !seen.jumped);
    CLAIM(press_observe(unloaded, &observer, 0, 5.0f, friction).limited);
    CLAIM(!press_observe(press, &observer, 0x20000000u, 0.0f, friction).limited && press_observe(press, &observer, 0, NAN, friction).limited);
}

static const float wrong[] = {NAN, -NAN, INFINITY, -INFINITY, 1e30f, -1e30f};

/* A set-point that is no number, or beyond the table, is said to be, and its torque is that of the nearest motion: the weight stays held. */
static void set_points(const press_model *press, const jred_info *info) {
    jred_f32_motion_range range;
    EXPECT(jred_f32_motion_range_of(info, &range), JRED_OK);
    CLAIM(range.max_speed > info->max_speed && range.max_speed < 1.011f * info->max_speed && range.max_acceleration > info->max_acceleration);
    const uint32_t phase = 0x20000000u;
    const float still = press_torque(press, phase, 0.0f, 0.0f);
    jred_f32_checked_torque checked = press_at_reference(press, &range, (jred_f32_motion){phase, 10.0f, 50.0f}, jred_f32_friction_of_speed(10.0f));
    CLAIM(!checked.speed_beyond && !checked.acceleration_beyond && checked.torque == press_torque(press, phase, 10.0f, 50.0f));
    CLAIM(press_torque_with(press, phase, 10.0f, 50.0f, jred_f32_friction_of_speed(-1.0f)) == press_torque_with(press, phase, 10.0f, 50.0f, jred_f32_friction_scaled(-1.0f)));
    CLAIM(press_torque_with(press, phase, 10.0f, 50.0f, jred_f32_friction_of_speed(-1.0f)) < checked.torque);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        const float x = wrong[k], side = x > 0.0f ? 1.0f : x < 0.0f ? -1.0f : 0.0f;
        checked = press_at_reference(press, &range, (jred_f32_motion){phase, x, 50.0f}, jred_f32_friction_of_speed(10.0f));
        CLAIM(checked.speed_beyond && !checked.acceleration_beyond);
        CLAIM(checked.torque == press_torque_with(press, phase, side * range.max_speed, 50.0f, jred_f32_friction_of_speed(10.0f)));
        checked = press_at_reference(press, &range, (jred_f32_motion){phase, 10.0f, x}, jred_f32_friction_of_speed(10.0f));
        CLAIM(!checked.speed_beyond && checked.acceleration_beyond);
        CLAIM(checked.torque == press_torque_with(press, phase, 10.0f, side * range.max_acceleration, jred_f32_friction_of_speed(10.0f)));
        checked = press_at_reference(press, &range, (jred_f32_motion){phase, 0.0f, 0.0f}, jred_f32_friction_of_speed(x));
        CLAIM(checked.speed_beyond && checked.torque == press_torque_with(press, phase, 0.0f, 0.0f, jred_f32_friction_of_speed(side)));
        checked = press_at_reference(press, &range, (jred_f32_motion){phase, 0.0f, 0.0f}, jred_f32_friction_scaled(x));
        CLAIM(checked.speed_beyond && checked.torque == press_torque_with(press, phase, 0.0f, 0.0f, jred_f32_friction_scaled(side)));
        checked = press_at_measured(press, &range, (jred_f32_motion){phase, 10.0f, x}, (jred_f32_motion){0, x, 50.0f}, jred_f32_friction_of_speed(10.0f));
        CLAIM(checked.speed_beyond && !checked.acceleration_beyond && checked.torque == press_torque(press, phase, 10.0f, 50.0f));
        checked = press_at_measured(press, &range, (jred_f32_motion){phase, x, 0.0f}, (jred_f32_motion){0, 10.0f, 50.0f}, jred_f32_friction_of_speed(10.0f));
        CLAIM(checked.speed_beyond && checked.torque == press_torque_with(press, phase, side * range.max_speed, 50.0f, jred_f32_friction_of_speed(10.0f)));
        checked = press_at_reference(press, &range, (jred_f32_motion){phase, x, x}, jred_f32_friction_of_speed(x));
        CLAIM(checked.speed_beyond && checked.acceleration_beyond && (x == x || checked.torque == still));
        CLAIM(jred_phase_from_radians(x) == 0 && jred_phase_from_stroke(x, 0.0f, 1.0f) == (x > 0.0f ? UINT32_MAX : 0));
        /* A bare tick does not judge: NaN stays NaN, for who looks. */
        const float bare = press_torque(press, phase, x, 0.0f), reached = press_acceleration(press, phase, 10.0f, x);
        CLAIM(!(bare - bare == 0.0f && bare < 1e6f && bare > -1e6f) && !(reached < 1e6f && reached > -1e6f));
    }
}

int main(void) {
    static press_model press, unloaded;
    other_model other;
    cubic_model cubic;
    fixed_model fixed;
    halves_model halves;
    crank_model crank;
    any_model any;
    jred_info info;

    EXPECT(press_load(NULL), JRED_NULL);
    EXPECT(press_load_words(&press, NULL, WORDS), JRED_NULL);
    EXPECT(jred_image_info(NULL, 0, &info), JRED_NULL);
    EXPECT(jred_image_info(press_words, WORDS, NULL), JRED_NULL);
    EXPECT(press_load_words(&press, (const uint32_t *)(const void *)((const char *)press_words + 2), WORDS - 1), JRED_MISALIGNED);
    EXPECT(press_load_words(&press, press_words, 0), JRED_LENGTH);
    EXPECT(press_load_words(&press, press_words, WORDS - 1), JRED_LENGTH);
    EXPECT(press_load_words(&press, press_words, (size_t)-1), JRED_LENGTH);
    EXPECT(damaged(0), JRED_NOT_AN_IMAGE);
    EXPECT(damaged(1), JRED_VERSION);
    EXPECT(damaged(40), JRED_CRC);
    EXPECT(damaged(WORDS - 1), JRED_CRC);
    EXPECT(other_load_words(&other, press_words, WORDS), JRED_SET);
    EXPECT(cubic_load_words(&cubic, press_words, WORDS), JRED_LAYOUT);
    EXPECT(fixed_load_words(&fixed, press_words, WORDS), JRED_NUMBER_TYPE);
    EXPECT(halves_load_words(&halves, press_words, WORDS), JRED_NUMBER_TYPE);
    EXPECT(crank_load_words(&crank, press_words, WORDS), JRED_LAYOUT);
    EXPECT(crank_load_words(&crank, press_words, 3), JRED_LENGTH);
    EXPECT(crank_load_words(&crank, NULL, WORDS), JRED_NULL);
    EXPECT(crank_load_words(NULL, press_words, WORDS), JRED_NULL);
    CLAIM(strcmp(jred_status_name(JRED_CRC), "JRED_CRC") == 0 && strcmp(jred_status_name(-1), "JRED_UNKNOWN") == 0);

    /* No model: no torque. */
    CLAIM(press_torque(&unloaded, 0x40000000u, 10.0f, 50.0f) == 0.0f);
    CLAIM(press_torque(&press, 0x40000000u, 10.0f, 50.0f) == 0.0f);
    CLAIM(fixed_torque(&fixed, 0x40000000u, 1 << 20, 1 << 20) == 0 && halves_torque(&halves, 0x40000000u, 100, 100) == 0);
    CLAIM(cubic_acceleration(&cubic, 0x40000000u, 10.0f, 50.0f) == 0.0f);
    CLAIM(crank_torque(&crank, 0x40000000u, 10.0f, 50.0f) == 0.0f);
    CLAIM(crank_acceleration_range(&crank, 0, 10.0f, -50.0f, 50.0f).greatest == 0.0f);

    EXPECT(press_load(&press), JRED_OK);
    EXPECT(any_load_words(&any, press_words, WORDS), JRED_OK);
    for (uint32_t phase = 0, k = 0; k < 100; k++, phase += 0x02f3a7b1u) {
        float torque = press_torque(&press, phase, 10.0f, 50.0f);
        CLAIM(torque != 0.0f && torque == any_torque(&any, phase, 10.0f, 50.0f));
        jred_f32_range range = press_acceleration_range(&press, phase, 10.0f, -100.0f, torque);
        CLAIM(range.least == press_acceleration(&press, phase, 10.0f, -100.0f) && !range.least_limited);
        CLAIM(range.greatest > 49.99f && range.greatest < 50.01f && !range.greatest_limited);
    }
    press_model moved = press;
    CLAIM(press_torque(&moved, 0x40000000u, 10.0f, 50.0f) == press_torque(&press, 0x40000000u, 10.0f, 50.0f));

    EXPECT(jred_image_info(press_words, WORDS, &info), JRED_OK);
    CLAIM(info.set == 21 && info.cells == 86 && info.stroke == 0 && info.torque_base == 1.0f && info.acceleration_base == 1.0f);
    CLAIM(info.max_speed > 29.45f && info.max_acceleration > 226.7f && info.torque_error < 0.78f);
    int32_t number;
    EXPECT(jred_q31_from_si(5.0f, 20.0f, &number), JRED_OK);
    CLAIM(number == 1 << 29 && jred_q31_to_si(number, 20.0f) == 5.0f);
    EXPECT(jred_q31_from_si(25.0f, 20.0f, &number), JRED_LIMITED);
    CLAIM(number == INT32_MAX);
    int16_t half;
    EXPECT(jred_q15_from_si(5.0f, 20.0f, &half), JRED_OK);
    CLAIM(half == 1 << 13 && jred_q15_to_si(half, 20.0f) == 5.0f);
    encoders();
    set_points(&press, &info);
    parts(&press, &unloaded, &info);
    const jred_f32_checked_torque nothing = press_at_reference(&unloaded, &(jred_f32_motion_range){10.0f, 10.0f}, (jred_f32_motion){0, 1.0f, 1.0f}, jred_f32_friction_of_speed(1.0f));
    CLAIM(nothing.torque == 0.0f && nothing.speed_beyond && nothing.acceleration_beyond);
    CLAIM(fixed_at_reference(&fixed, &(jred_q31_motion_range){1 << 30, 1 << 30}, (jred_q31_motion){0, INT32_MIN, INT32_MAX}, jred_q31_friction_scaled(INT32_MIN)).speed_beyond);

    /* What is no plan is not followed; no follower waits. */
    static jred_f32_plan_follower follower;
    jred_f32_set_point planned = {1, 1, 1.0f, 1.0f, true};
    jred_plan plan;
    press_model none = {{0, {0}}};
    CLAIM(jred_f32_plan_follower_next(&follower, 100, &planned) == JRED_NO_FOLLOWER && planned.phase == 0 && planned.omega == 0.0f && !planned.limited);
    CLAIM(jred_f32_plan_follower_next(NULL, 100, NULL) == JRED_NO_FOLLOWER);
    EXPECT(jred_f32_plan_follower_repeat(NULL), JRED_NULL);
    EXPECT(jred_f32_plan_follower_repeat(&follower), JRED_NOT_LOADED);
    EXPECT(jred_f32_plan_follower_plan(&follower, &plan), JRED_NOT_LOADED);
    EXPECT(press_follow(NULL, &follower, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_NULL);
    EXPECT(press_follow(&press, NULL, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_NULL);
    EXPECT(press_follow(&press, &follower, NULL, PLAN_WORDS, 0.001f, 0.1f), JRED_NULL);
    EXPECT(press_follow(&none, &follower, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_NOT_LOADED);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS - 1, 0.001f, 0.1f), JRED_LENGTH);
    EXPECT(press_follow(&press, &follower, press_words, WORDS, 0.001f, 0.1f), JRED_NOT_A_PLAN);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS, 0.0f, 0.1f), JRED_FIGURE);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS, 0.001f, -0.1f), JRED_FIGURE);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_OK);
    EXPECT(jred_f32_plan_follower_plan(&follower, &plan), JRED_OK);
    CLAIM(plan.rows == 10 && plan.machine == PRESS_PLAN_MACHINE && plan.machine == info.machine && plan.acceleration_error < 0.23f);
    EXPECT(jred_f32_plan_follower_repeat(&follower), JRED_OK);
    jred_f32_plan_follower_start(&follower);
    for (int tick = 0; tick < 1000; tick++) CLAIM(jred_f32_plan_follower_next(&follower, 100, &planned) == JRED_RUNNING);
    jred_f32_plan_follower_reset(&follower);
    CLAIM(jred_f32_plan_follower_next(&follower, 100, &planned) == JRED_WAITING && planned.phase == 0x80000000u);
    printf("%d failures\n", failures);
    return failures != 0;
}
