/* A plan followed tick by tick at a rate that an operator changes: the same as examples/09_plan.rs, and the same output.
 *
 * Table and plan are what these commands write (`scripts/test images`):
 *
 *     jred export machines/press.toml --type i32 --torque-error "1 N m" --layout spline --format c --out press_q31.h
 *     jred fastest machines/press.toml --torque "50 N m" --motor-speed "3000 rpm" --max-speed "28 rad/s" \
 *         --max-acceleration "220 rad/s^2" --plan press_plan.h
 */
#include <stdio.h>

#include "jred.h"
#include "press_q31.h"
#include "press_plan.h"

#define WORDS(array) (array), sizeof(array) / sizeof(array)[0]

/* Time of a tick, and of a change of the rate from 0 to 100 % (s). */
#define TICK 0.0005f
#define RAMP 0.13f

static uint32_t commanded(unsigned tick) { return tick >= 330 && tick < 600 ? 40 : tick >= 600 && tick < 800 ? 0 : 100; }

static long milli(float x) { return (long)(x * 1000.0f + (x < 0.0f ? -0.5f : 0.5f)); }

static const char *const names[] = {"waiting", "running", "held", "done"};

static press_model press;
static jred_q31_plan_follower follower;

int main(void) {
    /* Once. */
    jred_info info;
    jred_plan plan;
    jred_status status = jred_image_info(WORDS(press_words), &info);
    if (status == JRED_OK) status = press_load(&press);
    if (status == JRED_OK) status = press_follow(&press, &follower, WORDS(press_plan_words), TICK, RAMP);
    if (status == JRED_OK) status = jred_q31_plan_follower_plan(&follower, &plan);
    if (status != JRED_OK || plan.machine != info.machine) {
        printf("FAILED: %s\n", jred_status_name(status));
        return 1;
    }
    printf("%lu rows, %ld ms, up to %ld mrad/s\n", (unsigned long)plan.rows, milli(plan.duration), milli(plan.max_speed));
    printf("tick   stage        at        speed     torque\n");
    jred_q31_plan_follower_start(&follower);
    float most = 0.0f;
    uint32_t checksum = 0;
    for (unsigned tick = 0; tick < 2000; tick++) {
        /* Every tick. */
        jred_q31_set_point planned;
        jred_plan_state state = jred_q31_plan_follower_next(&follower, commanded(tick), &planned);
        jred_q31 needed = press_torque(&press, planned.phase, planned.omega, planned.alpha);

        float torque = jred_q31_to_si(needed, info.torque_base);
        most = torque > most ? torque : -torque > most ? -torque : most;
        checksum = (checksum ^ planned.phase ^ (uint32_t)needed) * 16777619u;
        if (planned.limited) return 1;
        if (tick % 50 == 0 || state == JRED_DONE) {
            unsigned tenths = (unsigned)(((uint64_t)planned.phase * 3600) >> 32);
            printf("%4u   %-7s %ld turn %3u.%u deg %6ld mrad/s %4ld N m\n", tick, names[state], (long)planned.turns, tenths / 10,
                   tenths % 10, milli(jred_q31_to_si(planned.omega, info.speed_base)), milli(torque) / 1000);
        }
        if (state == JRED_DONE) {
            printf("checksum %08lx, up to %ld N m\n", (unsigned long)checksum, milli(most) / 1000);
            return planned.turns == 1 && planned.phase == 0x80000000u ? 0 : 1;
        }
    }
    return 1;
}
