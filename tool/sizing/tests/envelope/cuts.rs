//! Cuts of a winding's voltage limit: at its kinks, at the maximum of braking, and within concave ranges, however small their share of the speed
//! range. The limit itself is solved here from the quadratic of docs/motor-limits.md by bisection.

use jred_sizing::catalogue::{Commutation, Motor, Winding};
use jred_sizing::motor::envelope::{Curvature, Envelope, LimitPiece};

use super::{bare, budget, near};

/// A three-phase motor without field weakening, in line-to-line figures.
#[derive(Clone, Copy)]
struct Line {
    voltage: f64,
    flux: f64,
    drop: f64,
    /// x/n
    reactance: f64,
    peak_torque: f64,
    peak_current: f64,
    /// S1 torque, up to which k_t is valid.
    knee: f64,
}

const BUS: f64 = 325.0;
const PAIRS: f64 = 4.0;

impl Line {
    /// With k_t (N·m/A), R (Ω) and p·L (H), and no effective limit of the current.
    fn of(constant: f64, resistance: f64, inductance: f64) -> Self {
        let per_phase = 0.5 * 3f64.sqrt();
        Self {
            voltage: BUS / 2f64.sqrt(),
            flux: constant / 3f64.sqrt(),
            drop: per_phase * resistance,
            reactance: per_phase * inductance,
            peak_torque: 1e6 * constant,
            peak_current: 1e6,
            knee: constant,
        }
    }

    /// With a peak torque that takes more current than by k_t: the iron saturates from the S1 torque `knee` on.
    const fn saturated(self, peak_torque: f64, peak_current: f64, knee: f64) -> Self {
        Self {
            peak_torque,
            peak_current,
            knee,
            ..self
        }
    }

    fn constant(&self) -> f64 {
        self.flux * 3f64.sqrt()
    }

    fn envelope(&self) -> Envelope {
        let per_phase = 0.5 * 3f64.sqrt();
        Envelope::of(&Motor {
            rated_torque: Some(self.knee),
            peak_torque: Some(self.peak_torque),
            bus_voltage: Some(BUS),
            winding: Winding {
                commutation: Commutation::Sine,
                torque_constant: Some(self.constant()),
                voltage_constant: Some(self.flux),
                resistance: Some(self.drop / per_phase),
                inductance: Some(self.reactance / per_phase / PAIRS),
                pole_pairs: Some(PAIRS),
                peak_current: Some(self.peak_current),
                ..Winding::default()
            },
            ..bare()
        })
    }

    /// k_e·n = V.
    fn no_load_speed(&self) -> f64 {
        self.voltage / self.flux
    }

    /// The largest i with (r·i ± k_e·n)² + (x·i)² ≤ V², below the no-load speed, where no current is allowed.
    fn current(&self, speed: f64, braking: bool) -> f64 {
        let back = if braking { -1.0 } else { 1.0 } * self.flux * speed;
        let allowed =
            |i: f64| (self.drop * i + back).hypot(self.reactance * speed * i) <= self.voltage;
        halved(0.0, 2.0 * self.voltage / self.drop, allowed)
    }

    /// The torque of a current: k_t up to the knee, then linear to the peak.
    fn torque(&self, current: f64) -> f64 {
        let knee = self.knee / self.constant();
        if current <= knee || self.peak_current >= 1e6 {
            return current * self.constant();
        }
        let share = (current.min(self.peak_current) - knee) / (self.peak_current - knee);
        self.knee + share * (self.peak_torque - self.knee)
    }

    /// The speed up to which the falling limit of driving leaves a current.
    fn speed_of(&self, current: f64) -> f64 {
        halved(0.0, self.no_load_speed(), |speed| {
            self.current(speed, false) >= current
        })
    }

    /// The speed at which braking reaches its largest current, by ternary search.
    fn top(&self) -> f64 {
        let (mut low, mut high) = (0.0, self.no_load_speed());
        for _ in 0..100 {
            let third = (high - low) / 3.0;
            let [a, b] = [low + third, high - third].map(|speed| self.current(speed, true));
            if a < b { low += third } else { high -= third }
        }
        0.5 * (low + high)
    }
}

/// The largest argument that satisfies a condition, which is true at `low` and false at `high`.
fn halved(low: f64, high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The same motor, `factor` times slower with as much more torque.
fn slower(line: Line, factor: f64) -> Line {
    Line {
        flux: line.flux * factor,
        reactance: line.reactance * factor,
        peak_torque: line.peak_torque * factor,
        knee: line.knee * factor,
        ..line
    }
}

/// Servo motors with high and low resistance relative to their reactance, with and without a current limited by the supply; a torque motor of a few
/// rpm.
fn lines() -> [Line; 5] {
    let servo = Line::of(1.0, 4.0, 0.08).saturated(18.0, 30.0, 5.0);
    [
        Line::of(1.0, 0.05, 0.08),
        Line::of(1.0, 12.0, 0.04),
        Line::of(1.0, 30.0, 0.02),
        servo,
        slower(servo, 300.0),
    ]
}

fn at_cut(pieces: &[LimitPiece], speed: f64, within: f64) -> bool {
    pieces
        .iter()
        .any(|piece| (piece.from - speed).abs() <= within)
}

#[test]
fn the_limit_is_the_voltage_equations() {
    for line in lines() {
        let (envelope, end) = (line.envelope(), line.no_load_speed());
        near(envelope.max_speed(), end, 1e-12);
        for braking in [false, true] {
            let limit = envelope.limit(braking);
            let most = limit.torque(0.0);
            let shares = (1..400).map(|k| f64::from(k) / 400.0);
            // Also near standstill, where the resistance dominates.
            for share in shares.chain((1..200).map(|k| 1e-5 * f64::from(k))) {
                let speed = share * end;
                let expected = line.torque(line.current(speed, braking).min(line.peak_current));
                let found = limit.torque(speed);
                assert!(
                    (found - expected).abs() <= budget::PIECE_JOINT * most,
                    "{found} and {expected} N·m at {share} of {end} rad/s, {braking}"
                );
            }
        }
    }
}

#[test]
fn it_is_cut_where_it_leaves_the_current_limit_and_where_saturation_begins() {
    for line in &lines()[3..] {
        let envelope = line.envelope();
        let pieces = envelope.limit(false).pieces();
        let (level, knee) = (
            line.speed_of(line.peak_current),
            line.speed_of(line.knee / line.constant()),
        );
        assert!(level > 0.0 && knee > 1.1 * level && knee < 0.99 * line.no_load_speed());
        assert_eq!(pieces[0].shape, Curvature::Straight);
        near(pieces[0].to, level, budget::PIECE_JOINT);
        near(pieces[0].torque(0.0), line.peak_torque, budget::PIECE_JOINT);
        assert!(
            pieces[1..]
                .iter()
                .all(|piece| piece.shape != Curvature::Straight)
        );
        assert!(at_cut(pieces, knee, budget::PIECE_JOINT * knee));
    }
}

/// While k_e·n is small against V, i = V/√(r² + x²): concave up to x = r/√2, convex beyond, and concave again near the no-load speed.
#[test]
fn it_is_concave_where_the_resistance_decides_and_near_no_load() {
    let line = lines()[0];
    let end = line.no_load_speed();
    let turning = line.drop / line.reactance / 2f64.sqrt();
    assert!(turning < 2e-3 * end);
    let envelope = line.envelope();
    let pieces = envelope.limit(false).pieces();
    let first = pieces[0];
    assert_eq!(first.shape, Curvature::Concave);
    // Two of 128 steps up to 2·r/x′; the effect of k_e·n is less than 1 %.
    near(first.to, turning, 0.06);
    let shape_at = |speed: f64| {
        let piece = pieces.iter().find(|piece| speed <= piece.to).unwrap();
        piece.shape
    };
    assert_eq!(shape_at(3.0 * turning), Curvature::Monotone);
    assert_eq!(shape_at(0.1 * end), Curvature::Monotone);
    assert_eq!(shape_at(0.98 * end), Curvature::Concave);
}

/// There is a cut at the maximum of braking, within the step of the search; on either side the limit is monotonic.
#[test]
fn it_is_cut_at_the_top_of_braking() {
    for line in [lines()[1], slower(lines()[1], 300.0)] {
        let (envelope, end, top) = (line.envelope(), line.no_load_speed(), line.top());
        assert!((0.02..0.9).contains(&(top / end)), "{}", top / end);
        let limit = envelope.limit(true);
        let step = end / 128.0;
        assert!(at_cut(limit.pieces(), top, step), "{:?}", limit.pieces());
        for k in 0..100 {
            let rising = |share: f64| limit.torque(share * (top - step));
            assert!(rising(0.01 * f64::from(k)) < rising(0.01 * f64::from(k + 1)));
            let falling = |share: f64| limit.torque(top + step + share * (end - top - step));
            assert!(falling(0.01 * f64::from(k)) > falling(0.01 * f64::from(k + 1)));
        }
    }
}
