// As much of Arduino as the sketch needs, for the test that compiles it.
#ifndef ARDUINO_H
#define ARDUINO_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct Stream {
    void begin(unsigned long) {}
    void println(const char *text) { puts(text); }
};
static Stream Serial;

void setup();
void loop();

#endif
