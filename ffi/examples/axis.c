/* Prints what the drive of axis.h does in a turn: the output of examples/07_axis.rs. */
#include "axis.h"

int main(void) {
    const jred_status status = start();
    if (status != JRED_OK) {
        printf("FAILED: %s\n", jred_status_name(status));
        return 1;
    }
    puts(HEADING);
    for (int k = 0; k <= TICKS; k++) {
        const char *line = show(k);
        if (line) puts(line);
    }
    return shown.worst < 1.0f ? 0 : 1;
}
