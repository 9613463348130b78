// From an encoder's count to the torque command of the motor, on any board: the sketch moves a press, generates the counts of its encoder, and from
// them alone gets the speed and the motor's torque. In a drive the count comes from a timer and the torque goes to the current controller.
//
// press.h is the table of the example press: jred export machines/press.toml --torque-error "1 N m" --layout spline --format c --out press.h
#include <jred.hpp>

#include "press.h"

JRED_CLASS(Press, press, f32);

// On the motor, behind a gearbox of 20, counting down; 1234 where the crank is at 0.
static const jred_encoder encoder = JRED_ENCODER(10000, 20, 1, true, 1234);
static const long START = 1234;
static const float TICK = 0.0005f, LEAD = 0.0002f; // s

static Press press;
static jred::Counter<16> counter(START);
static jred::Tracker tracker;
static jred_f32_motion_range range;
static jred_f32_period tick, lead;
static jred_f32_friction_ramp ramp;
static jred_f32_transmission gearbox;
static jred_f32_torque_limits limits;

static jred_status status;
static int ticks = 0;
static uint32_t checksum = 0;
static unsigned long limited = 0;
static float worst = 0.0f;

static long milli(float x) { return static_cast<long>(x * 1000.0f + (x < 0.0f ? -0.5f : 0.5f)); }

static void add(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    checksum = (checksum ^ bits) * 16777619u;
}

static jred_status start() {
    const jred_gearbox figures = {20.0f, 0.95f, 0.0003f};
    jred_info info;
    jred_status made = jred_image_info(press_words, sizeof press_words / sizeof press_words[0], &info);
    if (made == JRED_OK) made = press.load(press_words);
    if (made == JRED_OK) made = tracker.make(60.0f, TICK, jred::Phase(jred_encoder_phase_wide(&encoder, START)));
    if (made == JRED_OK) made = jred_f32_motion_range_of(&info, &range);
    if (made == JRED_OK) made = jred_f32_period_make(&tick, &info, TICK);
    if (made == JRED_OK) made = jred_f32_period_make(&lead, &info, LEAD);
    if (made == JRED_OK) made = jred_f32_friction_ramp_make(&ramp, &info, 0.05f);
    if (made == JRED_OK) made = jred_f32_transmission_make(&gearbox, &info, &figures);
    if (made == JRED_OK) made = jred_f32_torque_limits_make(&limits, -6.0f, 6.0f);
    return made;
}

void setup() {
    Serial.begin(115200);
    status = start();
    Serial.println(status == JRED_OK ? "tick   count     speed  of crank  set-point    needed    motor   clipped" : jred::name(status));
}

void loop() {
    if (status != JRED_OK || ticks > 1000) return;
    char line[96];
    if (ticks == 1000) {
        snprintf(line, sizeof line, "checksum %08lx, %lu of 1000 ticks limited", static_cast<unsigned long>(checksum), limited);
        Serial.println(line);
        snprintf(line, sizeof line, "largest error of the speed %ld mrad/s", milli(worst));
        Serial.println(line);
        ticks++;
        return;
    }
    // A turn in half a second: the set-point, and the machine, which follows it.
    const float tau = 6.28318530717958647692f, pace = tau / 0.5f, z = static_cast<float>(ticks) * TICK / 0.5f;
    const float phi = tau * (z * z * z * (10.0f + z * (6.0f * z - 15.0f)));
    const float omega = pace * (30.0f * z * z * (z - 1.0f) * (z - 1.0f));
    const float alpha = pace / 0.5f * (60.0f * z * (2.0f * z - 1.0f) * (z - 1.0f));
    // The value of the timer's register.
    const uint16_t reading = static_cast<uint16_t>(START - static_cast<int32_t>(phi / tau * 200000.0f));

    const int64_t count = counter.extend(reading);
    const jred_tracked tracked = tracker.update(jred::Phase(jred_encoder_phase_wide(&encoder, count)));
    const float speed = jred_f32_period_omega(&tick, tracked).value;
    const Press::Motion reference = {tracked.phase, omega, alpha}, measured = {tracked.phase, speed, alpha};
    const Press::Motion later = jred_f32_period_later(&lead, measured).motion;
    const Press::CheckedTorque needed = press.at_measured(range, later, reference, jred_f32_friction_ramp_at(&ramp, omega));
    const float motor = jred_f32_transmission_motor(&gearbox, needed.torque, omega, alpha).value;
    const jred_f32_limited command = jred_f32_torque_limits_limited(&limits, motor);

    const float off = speed > omega ? speed - omega : omega - speed;
    worst = off > worst ? off : worst;
    limited += command.clipped != 0.0f || needed.speed_beyond || needed.acceleration_beyond;
    add(speed);
    add(command.torque);
    if (ticks % 50 == 0) {
        snprintf(line, sizeof line, "%4d %7ld %9ld mrad/s %9ld %9ld N m %5ld mN m %5ld", ticks, static_cast<long>(count), milli(speed),
                 milli(omega), milli(needed.torque) / 1000, milli(command.torque), milli(command.clipped));
        Serial.println(line);
    }
    ticks++;
}
