// The tick in C++, with the output of examples/01_tick.rs. An Arduino sketch does the same in setup() and loop().
#include <cstdio>

#include "jred.hpp"
#include "press.h"

JRED_CLASS(Press, press, f32);

static const int32_t COUNTS = 4096;

static long milli(float x) { return static_cast<long>(x * 1000.0f + (x < 0.0f ? -0.5f : 0.5f)); }

static Press press;
static jred::Encoder encoder;

int main() {
    jred_info info;
    jred_status status = jred_image_info(press_words, sizeof press_words / sizeof press_words[0], &info);
    if (status == JRED_OK) status = press.load(press_words);
    if (status == JRED_OK) status = encoder.make({COUNTS, {1, 1}, false, 0});
    if (status != JRED_OK) {
        std::printf("FAILED: %s\n", jred::name(status));
        return 1;
    }
    std::printf("%lu cells, torque exact to %ld mN m\n", static_cast<unsigned long>(info.cells), milli(info.torque_error));
    std::printf("up to %ld mrad/s and %ld mrad/s2\n", milli(info.max_speed), milli(info.max_acceleration));
    std::printf("count   torque for 10 rad/s, 50 rad/s2   acceleration from 100 N m at 10 rad/s\n");
    for (int32_t count = 0; count < COUNTS; count += 256) {
        jred::Phase phase = encoder.phase(count);
        float needed = press.torque(phase, 10.0f, 50.0f);
        float gained = press.acceleration(phase, 10.0f, 100.0f);
        std::printf("%5ld %10ld mN m %31ld mrad/s2\n", static_cast<long>(count), milli(needed), milli(gained));
    }
    return 0;
}
