/* The reader in plain C99 beside the library: the same bits, on this processor and with this compiler. */
#include <stdio.h>

#include "jred.h"
#include "jred99.h"
#include "../examples/press.h"

static press_model press;
static jred99_table table;

static uint32_t bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

int main(void) {
    const size_t length = sizeof press_words / sizeof press_words[0];
    uint32_t phase = 0, failures = 0;
    if (press_load(&press) != JRED_OK || jred99_load(&table, press_words, length) != JRED99_OK || table.machine != PRESS_MACHINE) return 1;
    for (int32_t k = 0; k < 4000; k++, phase += 0x9e3779b9u) {
        const float omega = (float)(k % 601 - 300) * 0.1f, alpha = (float)(k % 499 - 249), sign = (float)(k % 3 - 1);
        const float torque = jred99_f32_torque(&table, phase, omega, alpha, sign);
        const float gained = jred99_f32_acceleration(&table, phase, omega, alpha, omega);
        failures += bits(torque) != bits(press_torque_with(&press, phase, omega, alpha, jred_f32_friction_of_speed(sign)));
        failures += bits(gained) != bits(press_acceleration(&press, phase, omega, alpha));
    }
    printf("%lu failures\n", (unsigned long)failures);
    return failures != 0;
}
