// Classes of machines whose set of curves is known, and is not; and what only a class of the first has.
#include "jred.hpp"

JRED_MODEL(press, spline_f32, 21);
JRED_CLASS(Press, press, f32);
JRED_MODEL(fixed, rows_q15, 21);
JRED_CLASS(Fixed, fixed, q15);
JRED_ANY_MODEL(any, harmonic_f32);
JRED_CLASS(Any, any, f32);

int main() {
    static Press press;
    static Fixed fixed;
    static Any any;
    static jred_f32_observer observer;
    jred::Tracker tracker;
    const jred_f32_motion_range range = {10.0f, 100.0f};
    const Press::Motion rest = {0, 0.0f, 0.0f};
    const Any::CheckedTorque none = any.at_reference(range, rest, jred_f32_friction_of_speed(0.0f));
    const jred_f32_observed seen = press.observe(observer, jred::Phase(0), 1.0f, jred_f32_friction_of_speed(0.0f));
    const bool beyond = press.at_measured(range, rest, rest, jred_f32_friction_of_speed(0.0f)).speed_beyond;
    jred::Counter<16> counter(65536);
    tracker.largest_step(jred::Phase(1));
    // Nothing was loaded or made: everything says so.
    return counter.extend(65535) == 65535 && beyond && none.speed_beyond && seen.limited && tracker.update(jred::Phase(7)).jumped && fixed.torque(jred::Phase(0), 1, 1) == 0 ? 0 : 1;
}
