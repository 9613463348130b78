// The drive of axis.h on any board: the sketch moves a press, generates the counts of its encoder, and from them alone gets the speed and the motor's
// torque. Define MACHINE for a real one: the lines 1, 2 and 3 are those of your board.
#include <jred.h>

#include "axis.h"

static jred_status status;
static int tick = 0;

#ifdef MACHINE
// A Nucleo-F446RE with the core of STM32duino. TIM3 counts the encoder (encoder mode, 16 bits), pin A2 is the torque's input of the amplifier.
static HardwareTimer timer(TIM6);
static volatile float omega, alpha; // set-points of the crank (rad/s, rad/s^2), from your motion

static void every_tick() {
    const uint16_t reading = TIM3->CNT;                       // 1. read the position
    const found now = interrupt(reading, omega, alpha);
    analogWrite(A2, 2048 + (int)(now.motor.torque * 341.0f)); // 2. write the torque: -6 to 6 N m are 2 to 4094 of 12 bits
}
#endif

void setup() {
#ifdef MACHINE
    analogWriteResolution(12);
    analogWrite(A2, 2048); // 0 N m until the timer runs
#endif
    Serial.begin(115200);
    status = start(); // START of axis.h: the counter's reading now, after homing
    Serial.println(status == JRED_OK ? HEADING : jred_status_name(status));
#ifdef MACHINE
    if (status != JRED_OK) return;
    timer.setOverflow((uint32_t)(1e6f * TICK + 0.5f), MICROSEC_FORMAT);
    timer.attachInterrupt(every_tick); // 3. call it from a timer, every TICK
    timer.resume();
#endif
}

void loop() {
#ifndef MACHINE
    if (status != JRED_OK || tick > TICKS) return;
    const char *line = show(tick++);
    if (line) Serial.println(line);
#endif
}
