/* From an encoder's count to the torque command of the motor: the interrupt of a drive, as examples/07_axis.rs. axis.c prints what it does, on a host;
   a sketch for Arduino on its board. press.h is the table of jred export machines/press.toml --torque-error "1 N m" --layout spline --format c */
#include <stdio.h>

#include "jred.h"
#include "press.h"

#define TAU 6.28318530717958647692f
/* On the motor, behind a gearbox of 20, counting down; 1234 where the crank is at 0. A wrong figure does not compile. */
static const jred_encoder encoder = JRED_ENCODER(10000, 20, 1, true, 1234);
#define COUNTS 200000.0f
#define START 1234

static const jred_gearbox gearbox = {20.0f, 0.95f, 0.0003f};
/* Time of a tick, and from a command to its torque (s). */
#define TICK 0.0005f
#define LEAD 0.0002f
#define TICKS 1000

static struct {
    int64_t count;
    jred_tracker tracker;
    jred_f32_period tick, lead;
    jred_f32_friction_ramp ramp;
    press_model press;
    jred_f32_motion_range range;
    jred_f32_transmission gearbox;
    jred_f32_torque_limits limits;
} axis;

typedef struct {
    float speed;
    jred_f32_checked_torque needed;
    jred_f32_limited motor;
} found;

/* Once. */
static jred_status start(void) {
    jred_info info;
    jred_status status = jred_image_info(press_words, sizeof press_words / sizeof press_words[0], &info);
    axis.count = START;
    /* The filter starts where the machine is, or it would start with a jump. */
    if (status == JRED_OK) status = jred_tracker_make(&axis.tracker, 60.0f, TICK, jred_encoder_phase_wide(&encoder, START));
    if (status == JRED_OK) status = press_load(&axis.press);
    if (status == JRED_OK) status = jred_f32_motion_range_of(&info, &axis.range);
    if (status == JRED_OK) status = jred_f32_period_make(&axis.tick, &info, TICK);
    if (status == JRED_OK) status = jred_f32_period_make(&axis.lead, &info, LEAD);
    if (status == JRED_OK) status = jred_f32_friction_ramp_make(&axis.ramp, &info, 0.05f);
    if (status == JRED_OK) status = jred_f32_transmission_make(&axis.gearbox, &info, &gearbox);
    if (status == JRED_OK) status = jred_f32_torque_limits_make(&axis.limits, -6.0f, 6.0f);
    return status;
}

/* Every tick, with the timer's register and the set-points of the crank's speed and acceleration. */
static found interrupt(uint16_t reading, float omega, float alpha) {
    const uint32_t phase = jred_encoder_phase_wide(&encoder, jred_counter_extend(&axis.count, 16, reading));
    const jred_tracked tracked = jred_tracker_update(&axis.tracker, phase);
    const float speed = jred_f32_period_omega(&axis.tick, tracked).value;
    const jred_f32_motion reference = {tracked.phase, omega, alpha}, measured = {tracked.phase, speed, alpha};
    /* Where the machine is when the torque acts; friction by the set-point. */
    const jred_f32_motion later = jred_f32_period_later(&axis.lead, measured).motion;
    const jred_f32_friction_sign friction = jred_f32_friction_ramp_at(&axis.ramp, omega);
    const jred_f32_checked_torque needed = press_at_measured(&axis.press, &axis.range, later, reference, friction);
    const float motor = jred_f32_transmission_motor(&axis.gearbox, needed.torque, omega, alpha).value;
    /* Its torque goes to the current controller. */
    const found tick = {speed, needed, jred_f32_torque_limits_limited(&axis.limits, motor)};
    return tick;
}

static long milli(float x) { return (long)(x * 1000.0f + (x < 0.0f ? -0.5f : 0.5f)); }

static uint32_t bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static struct {
    uint32_t limited, checksum;
    float worst;
    char line[128];
} shown;

#define HEADING "tick   count     speed  of crank  set-point    needed    motor   clipped"

/* Tick k of a turn in half a second, which the machine follows; a line to print, if there is one. After the last tick, what became of them. */
static const char *show(int k) {
    if (k == TICKS) {
        snprintf(shown.line, sizeof shown.line, "checksum %08lx, %lu of %d ticks limited\nlargest error of the speed %ld mrad/s",
                 (unsigned long)shown.checksum, (unsigned long)shown.limited, TICKS, milli(shown.worst));
        return shown.line;
    }
    const float z = (float)k * TICK / 0.5f, pace = TAU / 0.5f;
    const float phi = TAU * (z * z * z * (10.0f + z * (6.0f * z - 15.0f)));
    const float omega = pace * (30.0f * z * z * (z - 1.0f) * (z - 1.0f));
    const float alpha = pace / 0.5f * (60.0f * z * (2.0f * z - 1.0f) * (z - 1.0f));
    /* The value of the timer's register. */
    const found tick = interrupt((uint16_t)(START - (int32_t)(phi / TAU * COUNTS)), omega, alpha);
    const float off = tick.speed > omega ? tick.speed - omega : omega - tick.speed;
    shown.limited += tick.motor.clipped != 0.0f || tick.needed.speed_beyond || tick.needed.acceleration_beyond;
    shown.worst = off > shown.worst ? off : shown.worst;
    shown.checksum = (shown.checksum ^ bits(tick.speed)) * 16777619u;
    shown.checksum = (shown.checksum ^ bits(tick.motor.torque)) * 16777619u;
    if (k % 50 != 0) return 0;
    snprintf(shown.line, sizeof shown.line, "%4d %7ld %9ld mrad/s %9ld %9ld N m %5ld mN m %5ld", k, (long)axis.count, milli(tick.speed),
             milli(omega), milli(tick.needed.torque) / 1000, milli(tick.motor.torque), milli(tick.motor.clipped));
    return shown.line;
}
