// jred in C++: models as classes, over jred.h. C++11; no exceptions, nothing allocated. docs/c.md shows how.
#ifndef JRED_HPP
#define JRED_HPP

#include "jred.h"

namespace jred {

/// An angle of the drive link in units of 2^-32 turns (of the stroke). It wraps.
class Phase {
public:
    constexpr Phase() : bits_(0) {}
    explicit constexpr Phase(uint32_t bits) : bits_(bits) {}
    static Phase from_radians(float phi) { return Phase(jred_phase_from_radians(phi)); }
    constexpr uint32_t bits() const { return bits_; }
    friend constexpr Phase operator+(Phase a, Phase b) { return Phase(a.bits_ + b.bits_); }
    friend constexpr Phase operator-(Phase a, Phase b) { return Phase(a.bits_ - b.bits_); }
    friend constexpr bool operator==(Phase a, Phase b) { return a.bits_ == b.bits_; }

private:
    uint32_t bits_;
};

/// An encoder of a drive link that turns: phases of counts.
class Encoder {
public:
    Encoder() : encoder_() {}
    jred_status make(const jred_mounting &mounting) { return jred_encoder_make(&encoder_, &mounting); }
    Phase phase(int32_t count) const { return Phase(jred_encoder_phase(&encoder_, count)); }
    Phase phase_wide(int64_t count) const { return Phase(jred_encoder_phase_wide(&encoder_, count)); }

private:
    jred_encoder encoder_;
};

/// A phase of a stroke, limited to its ends, and whether it was.
struct Place {
    Phase phase;
    bool limited;
};

/// An encoder of a drive link that has a stroke.
class StrokeEncoder {
public:
    StrokeEncoder() : encoder_() {}
    jred_status make(float from, float to, const jred_stroke_mounting &scaled) { return jred_stroke_encoder_make(&encoder_, from, to, &scaled); }
    Place phase(int32_t count) const { return of(jred_stroke_encoder_phase(&encoder_, count)); }
    Place phase_wide(int64_t count) const { return of(jred_stroke_encoder_phase_wide(&encoder_, count)); }

private:
    static Place of(jred_place place) { return {Phase(place.phase), place.limited}; }
    jred_stroke_encoder encoder_;
};

/// A counter of so many bits, 1 to 32, that overflows, extended to 64.
template <uint32_t BITS> class Counter {
    static_assert(BITS >= 1 && BITS <= 32, "a counter has 1 to 32 bits");

public:
    explicit Counter(int64_t count = 0) : count_(count) {}
    int64_t extend(uint32_t reading) { return jred_counter_extend(&count_, BITS, reading); }

private:
    int64_t count_;
};

/// Phase, speed and acceleration from the phases of an encoder, one in every period.
class Tracker {
public:
    Tracker() : tracker_() {}
    jred_status make(float bandwidth, float period, Phase phase) { return jred_tracker_make(&tracker_, bandwidth, period, phase.bits()); }
    void largest_step(Phase step) { jred_tracker_largest_step(&tracker_, step.bits()); }
    jred_tracked update(Phase measured) { return jred_tracker_update(&tracker_, measured.bits()); }
    jred_tracked update_stroke(Phase measured) { return jred_tracker_update_stroke(&tracker_, measured.bits()); }

private:
    jred_tracker tracker_;
};

/// Follows a plan, of a model with this number: jred_f32, jred_q31 or jred_q15. `Class::follow` makes it.
template <typename Number> class PlanFollower;

#define JRED_PLAN_FOLLOWER_CLASS_(n)                                                                                        \
    template <> class PlanFollower<jred_##n> {                                                                              \
    public:                                                                                                                 \
        typedef jred_##n##_set_point SetPoint;                                                                              \
        PlanFollower() : follower_() {}                                                                                     \
        void start() { jred_##n##_plan_follower_start(&follower_); }                                                        \
        void reset() { jred_##n##_plan_follower_reset(&follower_); }                                                        \
        jred_status repeat() { return jred_##n##_plan_follower_repeat(&follower_); }                                        \
        jred_plan_state next(uint32_t percent, SetPoint &planned) { return jred_##n##_plan_follower_next(&follower_, percent, &planned); } \
        jred_status plan(jred_plan &plan) { return jred_##n##_plan_follower_plan(&follower_, &plan); }                      \
        jred_##n##_plan_follower *c() { return &follower_; }                                                                \
                                                                                                                            \
    private:                                                                                                                \
        jred_##n##_plan_follower follower_;                                                                                 \
    };
JRED_PLAN_FOLLOWER_CLASS_(f32)
JRED_PLAN_FOLLOWER_CLASS_(q31)
JRED_PLAN_FOLLOWER_CLASS_(q15)
#undef JRED_PLAN_FOLLOWER_CLASS_

inline const char *name(jred_status status) { return jred_status_name(status); }

}  // namespace jred

/// The class `Class` of a machine that JRED_MODEL or JRED_ANY_MODEL has declared: JRED_CLASS(Press, press, f32).
/// Its numbers are those of the format: f32, q31 or q15.
#define JRED_CLASS(Class, machine, n)                                                                                         \
    class Class {                                                                                                             \
    public:                                                                                                                   \
        typedef jred_##n Number;                                                                                              \
        typedef jred_##n##_range Range;                                                                                       \
        typedef jred_##n##_friction_sign FrictionSign;                                                                        \
        typedef jred_##n##_motion Motion;                                                                                     \
        typedef jred_##n##_checked_torque CheckedTorque;                                                                      \
        Class() : model_() {}                                                                                                 \
        jred_status load(const uint32_t *words, size_t length) { return machine##_load_words(&model_, words, length); }       \
        template <size_t N> jred_status load(const uint32_t (&words)[N]) { return load(words, N); }                           \
        Number torque(jred::Phase phase, Number omega, Number alpha) const {                                                  \
            return machine##_torque(&model_, phase.bits(), omega, alpha);                                                     \
        }                                                                                                                     \
        Number torque(jred::Phase phase, Number omega, Number alpha, FrictionSign friction) const {                           \
            return machine##_torque_with(&model_, phase.bits(), omega, alpha, friction);                                      \
        }                                                                                                                     \
        CheckedTorque at_reference(const jred_##n##_motion_range &range, const Motion &reference, FrictionSign friction) const { \
            return machine##_at_reference(&model_, &range, reference, friction);                                              \
        }                                                                                                                     \
        CheckedTorque at_measured(const jred_##n##_motion_range &range, const Motion &measured, const Motion &reference, FrictionSign friction) const { \
            return machine##_at_measured(&model_, &range, measured, reference, friction);                                     \
        }                                                                                                                     \
        template <typename Observer> /* of a set that is known: only then is it compiled */                                   \
        jred_##n##_observed observe(Observer &observer, jred::Phase measured, Number torque, FrictionSign friction) const {   \
            return machine##_observe(&model_, &observer, measured.bits(), torque, friction);                                  \
        }                                                                                                                     \
        Number acceleration(jred::Phase phase, Number omega, Number torque) const {                                           \
            return machine##_acceleration(&model_, phase.bits(), omega, torque);                                              \
        }                                                                                                                     \
        jred_status follow(jred::PlanFollower<Number> &follower, const uint32_t *plan, size_t length, float period, float ramp) const { \
            return machine##_follow(&model_, follower.c(), plan, length, period, ramp);                                       \
        }                                                                                                                     \
        template <size_t N>                                                                                                   \
        jred_status follow(jred::PlanFollower<Number> &follower, const uint32_t (&plan)[N], float period, float ramp) const { \
            return follow(follower, plan, N, period, ramp);                                                                   \
        }                                                                                                                     \
        Range acceleration_range(jred::Phase phase, Number omega, Number least, Number greatest) const {                      \
            return machine##_acceleration_range(&model_, phase.bits(), omega, least, greatest);                               \
        }                                                                                                                     \
                                                                                                                              \
    private:                                                                                                                  \
        machine##_model model_;                                                                                               \
    }

#endif
