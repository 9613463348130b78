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
    static Phase from_counts(uint32_t count, uint32_t per_turn) { return Phase(jred_phase_from_counts(count, per_turn)); }
    static Phase from_radians(float phi) { return Phase(jred_phase_from_radians(phi)); }
    constexpr uint32_t bits() const { return bits_; }
    friend constexpr Phase operator+(Phase a, Phase b) { return Phase(a.bits_ + b.bits_); }
    friend constexpr Phase operator-(Phase a, Phase b) { return Phase(a.bits_ - b.bits_); }
    friend constexpr bool operator==(Phase a, Phase b) { return a.bits_ == b.bits_; }

private:
    uint32_t bits_;
};

/// Follows a plan, of a model with this number: jred_f32, jred_q31 or jred_q15. `Class::follow` makes it.
template <typename Number> class Follower;

#define JRED_FOLLOWER_CLASS_(n)                                                                                        \
    template <> class Follower<jred_##n> {                                                                             \
    public:                                                                                                            \
        typedef jred_##n##_planned Planned;                                                                            \
        Follower() : follower_() {}                                                                                    \
        void start() { jred_##n##_follower_start(&follower_); }                                                        \
        void reset() { jred_##n##_follower_reset(&follower_); }                                                        \
        jred_status repeat() { return jred_##n##_follower_repeat(&follower_); }                                        \
        jred_stage next(uint32_t percent, Planned &planned) { return jred_##n##_follower_next(&follower_, percent, &planned); } \
        jred_status plan(jred_plan &plan) { return jred_##n##_follower_plan(&follower_, &plan); }                      \
        jred_##n##_follower *c() { return &follower_; }                                                                \
                                                                                                                       \
    private:                                                                                                           \
        jred_##n##_follower follower_;                                                                                 \
    };
JRED_FOLLOWER_CLASS_(f32)
JRED_FOLLOWER_CLASS_(q31)
JRED_FOLLOWER_CLASS_(q15)
#undef JRED_FOLLOWER_CLASS_

inline const char *name(jred_status status) { return jred_status_name(status); }

}  // namespace jred

/// The class `Class` of a machine that JRED_MODEL or JRED_ANY_MODEL has declared: JRED_CLASS(Press, press, f32).
/// Its numbers are those of the format: f32, q31 or q15.
#define JRED_CLASS(Class, machine, n)                                                                                 \
    class Class {                                                                                                     \
    public:                                                                                                           \
        typedef jred_##n Number;                                                                                      \
        typedef jred_##n##_range Range;                                                                               \
        Class() : model_() {}                                                                                         \
        jred_status load(const uint32_t *words, size_t length) { return machine##_load_words(&model_, words, length); } \
        template <size_t N> jred_status load(const uint32_t (&words)[N]) { return load(words, N); }                   \
        Number torque(jred::Phase phase, Number omega, Number alpha) const {                                          \
            return machine##_torque(&model_, phase.bits(), omega, alpha);                                             \
        }                                                                                                             \
        Number acceleration(jred::Phase phase, Number omega, Number torque) const {                                   \
            return machine##_acceleration(&model_, phase.bits(), omega, torque);                                      \
        }                                                                                                             \
        jred_status follow(jred::Follower<Number> &follower, const uint32_t *plan, size_t length, float period, float ramp) const { \
            return machine##_follow(&model_, follower.c(), plan, length, period, ramp);                               \
        }                                                                                                             \
        template <size_t N>                                                                                           \
        jred_status follow(jred::Follower<Number> &follower, const uint32_t (&plan)[N], float period, float ramp) const { \
            return follow(follower, plan, N, period, ramp);                                                           \
        }                                                                                                             \
        Range acceleration_range(jred::Phase phase, Number omega, Number least, Number greatest) const {              \
            return machine##_acceleration_range(&model_, phase.bits(), omega, least, greatest);                       \
        }                                                                                                             \
                                                                                                                      \
    private:                                                                                                          \
        machine##_model model_;                                                                                       \
    }

#endif
