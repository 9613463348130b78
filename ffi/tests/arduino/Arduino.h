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

#ifdef MACHINE
// And of the core of STM32duino.
struct TIM_TypeDef {
    volatile uint32_t CNT;
};
extern TIM_TypeDef *const TIM3;
extern TIM_TypeDef *const TIM6;
enum TimerFormat_t { MICROSEC_FORMAT };
struct HardwareTimer {
    explicit HardwareTimer(TIM_TypeDef *);
    void setOverflow(uint32_t, TimerFormat_t);
    void attachInterrupt(void (*)());
    void resume();
};
enum { A2 };
void analogWriteResolution(int);
void analogWrite(uint32_t, int);
#endif

void setup();
void loop();

#endif
