// A plan followed tick by tick in C++, with the output of examples/09_plan.rs; plan.c says where table and plan are from.
#include <cstdio>

#include "jred.hpp"
#include "press_q31.h"
#include "press_plan.h"

JRED_CLASS(Press, press, q31);

static const float TICK = 0.0005f, RAMP = 0.13f;

static uint32_t commanded(unsigned tick) { return tick >= 330 && tick < 600 ? 40 : tick >= 600 && tick < 800 ? 0 : 100; }

static long milli(float x) { return static_cast<long>(x * 1000.0f + (x < 0.0f ? -0.5f : 0.5f)); }

static const char *const names[] = {"waiting", "running", "held", "done"};

static Press press;
static jred::PlanFollower<jred_q31> follower;

int main() {
    jred_info info;
    jred_plan plan;
    jred_status status = jred_image_info(press_words, sizeof press_words / sizeof press_words[0], &info);
    if (status == JRED_OK) status = press.load(press_words);
    if (status == JRED_OK) status = press.follow(follower, press_plan_words, TICK, RAMP);
    if (status == JRED_OK) status = follower.plan(plan);
    if (status != JRED_OK || plan.machine != info.machine) {
        std::printf("FAILED: %s\n", jred::name(status));
        return 1;
    }
    std::printf("%lu rows, %ld ms, up to %ld mrad/s\n", static_cast<unsigned long>(plan.rows), milli(plan.duration), milli(plan.max_speed));
    std::printf("tick   stage        at        speed     torque\n");
    follower.start();
    float most = 0.0f;
    uint32_t checksum = 0;
    for (unsigned tick = 0; tick < 2000; tick++) {
        jred::PlanFollower<jred_q31>::SetPoint planned;
        jred_plan_state state = follower.next(commanded(tick), planned);
        jred_q31 needed = press.torque(jred::Phase(planned.phase), planned.omega, planned.alpha);

        float torque = jred_q31_to_si(needed, info.torque_base);
        most = torque > most ? torque : -torque > most ? -torque : most;
        checksum = (checksum ^ planned.phase ^ static_cast<uint32_t>(needed)) * 16777619u;
        if (planned.limited) return 1;
        if (tick % 50 == 0 || state == JRED_DONE) {
            unsigned tenths = static_cast<unsigned>((static_cast<uint64_t>(planned.phase) * 3600) >> 32);
            std::printf("%4u   %-7s %ld turn %3u.%u deg %6ld mrad/s %4ld N m\n", tick, names[state], static_cast<long>(planned.turns),
                        tenths / 10, tenths % 10, milli(jred_q31_to_si(planned.omega, info.speed_base)), milli(torque) / 1000);
        }
        if (state == JRED_DONE) {
            std::printf("checksum %08lx, up to %ld N m\n", static_cast<unsigned long>(checksum), milli(most) / 1000);
            return planned.turns == 1 && planned.phase == 0x80000000u ? 0 : 1;
        }
    }
    return 1;
}
