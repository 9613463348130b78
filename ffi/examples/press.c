/* The tick in C: what torque does the press need now, and what acceleration will a torque give?
 *
 * The same as examples/01_tick.rs, on a host or on a Cortex-M, and the same output: docs/c.md has the commands. */
#include <stdio.h>

#include "jred.h"
#include "press.h"

#define COUNTS 4096

/* In thousandths, rounded: printing integers takes a tenth of the flash that printing floats takes. */
static long milli(float x) { return (long)(x * 1000.0f + (x < 0.0f ? -0.5f : 0.5f)); }

static press_model press;
/* On the crank, counting up from phi = 0. */
static const jred_encoder encoder = JRED_ENCODER(COUNTS, 1, 1, false, 0);

int main(void) {
    /* Once, at start-up. The image stays where it is, in flash. Any fault of it shows here. */
    jred_info info;
    jred_status status = jred_image_info(press_words, sizeof press_words / sizeof press_words[0], &info);
    if (status == JRED_OK) status = press_load(&press);
    if (status != JRED_OK) {
        printf("FAILED: %s\n", jred_status_name(status));
        return 1;
    }
    printf("%lu cells, torque exact to %ld mN m\n", (unsigned long)info.cells, milli(info.torque_error));
    printf("up to %ld mrad/s and %ld mrad/s2\n", milli(info.max_speed), milli(info.max_acceleration));

    /* Every tick: a phase from the encoder's count, then one call. */
    printf("count   torque for 10 rad/s, 50 rad/s2   acceleration from 100 N m at 10 rad/s\n");
    for (int32_t count = 0; count < COUNTS; count += 256) {
        uint32_t phase = jred_encoder_phase(&encoder, count);
        float needed = press_torque(&press, phase, 10.0f, 50.0f);
        float gained = press_acceleration(&press, phase, 10.0f, 100.0f);
        printf("%5ld %10ld mN m %31ld mrad/s2\n", (long)count, milli(needed), milli(gained));
    }
    return 0;
}
