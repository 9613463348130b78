// Arduino calls a sketch like this without end; here for a while.
#include "Arduino.h"

int main() {
    setup();
    for (int k = 0; k < 1100; k++) loop();
    return 0;
}
