/* Every image that is no image of the model is refused with its own status; a model without an image ticks to 0. */
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
    CLAIM(crank_torque(&crank, 0x40000000u, 10.0f, 50.0f) == 0.0f && crank_torque(NULL, 0, 10.0f, 50.0f) == 0.0f);
    CLAIM(crank_acceleration_range(NULL, 0, 10.0f, -50.0f, 50.0f).greatest == 0.0f);

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
    CLAIM(info.most_speed > 29.45f && info.most_acceleration > 226.7f && info.torque_error < 0.78f);
    int32_t number;
    EXPECT(jred_q31_from_si(5.0f, 20.0f, &number), JRED_OK);
    CLAIM(number == 1 << 29 && jred_q31_to_si(number, 20.0f) == 5.0f);
    EXPECT(jred_q31_from_si(25.0f, 20.0f, &number), JRED_LIMITED);
    CLAIM(number == INT32_MAX);
    int16_t half;
    EXPECT(jred_q15_from_si(5.0f, 20.0f, &half), JRED_OK);
    CLAIM(half == 1 << 13 && jred_q15_to_si(half, 20.0f) == 5.0f);
    CLAIM(jred_phase_from_counts(1024 + 4096, 4096) == 0x40000000u && jred_phase_from_counts(1, 0) == 0);

    /* What is no plan is not followed; no follower waits. */
    static jred_f32_follower follower;
    jred_f32_planned planned = {1, 1, 1.0f, 1.0f, true};
    jred_plan plan;
    press_model none = {{0, {0}}};
    CLAIM(jred_f32_follower_next(&follower, 100, &planned) == JRED_NO_FOLLOWER && planned.phase == 0 && planned.omega == 0.0f && !planned.limited);
    CLAIM(jred_f32_follower_next(NULL, 100, NULL) == JRED_NO_FOLLOWER);
    EXPECT(jred_f32_follower_repeat(NULL), JRED_NULL);
    EXPECT(jred_f32_follower_repeat(&follower), JRED_NOT_LOADED);
    EXPECT(jred_f32_follower_plan(&follower, &plan), JRED_NOT_LOADED);
    EXPECT(press_follow(NULL, &follower, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_NULL);
    EXPECT(press_follow(&press, NULL, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_NULL);
    EXPECT(press_follow(&press, &follower, NULL, PLAN_WORDS, 0.001f, 0.1f), JRED_NULL);
    EXPECT(press_follow(&none, &follower, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_NOT_LOADED);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS - 1, 0.001f, 0.1f), JRED_LENGTH);
    EXPECT(press_follow(&press, &follower, press_words, WORDS, 0.001f, 0.1f), JRED_NOT_A_PLAN);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS, 0.0f, 0.1f), JRED_FIGURE);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS, 0.001f, -0.1f), JRED_FIGURE);
    EXPECT(press_follow(&press, &follower, press_plan_words, PLAN_WORDS, 0.001f, 0.1f), JRED_OK);
    EXPECT(jred_f32_follower_plan(&follower, &plan), JRED_OK);
    CLAIM(plan.rows == 10 && plan.machine == PRESS_PLAN_MACHINE && plan.machine == info.machine && plan.acceleration_error < 0.23f);
    EXPECT(jred_f32_follower_repeat(&follower), JRED_OK);
    jred_f32_follower_start(&follower);
    for (int tick = 0; tick < 1000; tick++) CLAIM(jred_f32_follower_next(&follower, 100, &planned) == JRED_RUNNING);
    jred_f32_follower_reset(&follower);
    CLAIM(jred_f32_follower_next(&follower, 100, &planned) == JRED_WAITING && planned.phase == 0x80000000u);
    printf("%d failures\n", failures);
    return failures != 0;
}
