// The drive of axis.h on any board: the sketch moves a press, generates the counts of its encoder, and from them alone gets the speed and the motor's
// torque. In a drive the count comes from a timer and the torque goes to the current controller.
#include <jred.h>

#include "axis.h"

static jred_status status;
static int tick = 0;

void setup() {
    Serial.begin(115200);
    status = start();
    Serial.println(status == JRED_OK ? HEADING : jred_status_name(status));
}

void loop() {
    if (status != JRED_OK || tick > TICKS) return;
    const char *line = show(tick++);
    if (line) Serial.println(line);
}
