//! Charts of the drive: the torque-speed plane, the course over time, λ over the range, and every rule over the ratio.

use jred::error::Error;
use jred::machine::Reducible as _;
use jred_file::math;

use super::chart::{Chart, ChartKind};
use super::figures::{dashed, line};
use super::thinned::kept;
use crate::plot::{Axes, Axis, Series, Style};
use jred_analysis::duty::{Duty, Instant};
use jred_file::model::coordinate::whole_range;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::units::Vocabulary;
use jred_sizing::cycle::form::MotorPoint;
use jred_sizing::explain::{Contributions, Effect, ratio_course};
use jred_sizing::judge::Assessment;
use jred_sizing::judge::Context;
use jred_sizing::motor::envelope::Envelope;

/// Index of the duty among the curves of the torque-speed plane.
const DUTY: usize = 4;

/// Use of a limit beyond which the curves over the gear ratio are not drawn (%).
pub(super) const TOP: f64 = 200.0;

/// Intervals of a curve.
const INTERVALS: u32 = 200;

/// The drive that a report is about, its duty and its limits.
pub(super) struct Subject<'a> {
    pub(super) context: Context<'a>,
    pub(super) judged: &'a Assessment<'a>,
    pub(super) duty: &'a Duty,
    pub(super) rules: &'a RuleSet,
}

impl Subject<'_> {
    pub(super) const fn words(&self) -> &'static Vocabulary {
        self.context.vocabulary()
    }

    fn torque_axis(&self, what: &str) -> String {
        let torque = self.words().torque;
        format!("{what} {torque} [{}]", dotted(torque.unit))
    }

    /// (time, value) over the cycle, for values that share their times.
    fn over_time<const N: usize>(
        &self,
        values: [&dyn Fn(&Instant) -> f64; N],
    ) -> [Vec<(f64, f64)>; N] {
        let instants = &self.duty.instants;
        let at = values.map(|value| move |k: usize| value(&instants[k]));
        let kept = kept(
            instants.len(),
            &at.each_ref().map(|at| at as &dyn Fn(usize) -> f64),
        );
        let course = |value: &dyn Fn(&Instant) -> f64| {
            let drawn = kept.iter().map(|&k| &instants[k]);
            drawn.map(|i| (i.t, value(i))).collect()
        };
        values.map(course)
    }

    fn motor_point(&self, instant: &Instant) -> MotorPoint {
        self.judged.drive.motor_point(instant)
    }

    fn level(&self, value: f64) -> Vec<(f64, f64)> {
        vec![(0.0, value), (self.duty.duration, value)]
    }

    /// The torque-speed plane in all four quadrants: peak and S1 torque, the shares that the rules allow, the duty, its RMS point, and the point
    /// closest to the peak torque.
    pub(super) fn plane(&self) -> Chart {
        let words = self.words();
        let envelope = &self.context.motor.envelope;
        let scale = words.speed.scale;
        let at = |k: usize| self.motor_point(&self.duty.instants[k]);
        let drawn = kept(
            self.duty.instants.len(),
            &[&|k| at(k).speed, &|k| at(k).torque],
        );
        let points = drawn.iter().map(|&k| (at(k).speed / scale, at(k).torque));
        let duty = &self.judged.duty;
        let top = match envelope.max_speed() {
            top if top.is_finite() => top,
            _ => 1.2 * duty.speed.peak(),
        };
        let share = |rule: Rule| self.rules.limit(rule).fail.unwrap_or(f64::NAN);
        let peak = |part: f64| {
            outline(top, scale, |torque, n| {
                part * envelope.peak_torque(torque, n)
            })
        };
        let steady = |part: f64| outline(top, scale, |_, n| part * envelope.continuous_torque(n));
        let (n, rms) = (duty.mean_speed / scale, duty.torque.rms);
        let cross = |x: f64, y: f64| {
            let (dx, dy) = (0.015 * top / scale, 0.025 * self.height(envelope));
            let gap = (f64::NAN, f64::NAN);
            vec![(x - dx, y), (x + dx, y), gap, (x, y - dy), (x, y + dy)]
        };
        let closest =
            self.context
                .cycle
                .peak(&self.context.coefficients, self.context.ratio, envelope);
        let speed = format!("motor speed [{}]", words.speed.unit);
        let axes = Axes {
            title: "",
            x: Axis::new(&speed),
            y: &self.torque_axis("motor"),
        };
        let torque = words.torque;
        let names = [
            format!("peak {torque}"),
            format!("S1 {torque}"),
            format!("allowed peak {torque}"),
            format!("allowed RMS {torque}"),
            "RMS at mean speed".to_owned(),
            "closest to the peak".to_owned(),
        ];
        let chart = Chart::new(
            ChartKind::Plane,
            &axes,
            &[
                line(&names[0], peak(1.0)),
                line(&names[1], steady(1.0)),
                dashed(&names[2], peak(share(Rule::PeakTorque))),
                dashed(&names[3], steady(share(Rule::RmsTorque))),
                Series {
                    name: "duty",
                    points: points.collect(),
                    style: Style::Dots,
                },
                line(&names[4], cross(n, rms)),
                line(&names[5], cross(closest.speed / scale, closest.torque)),
            ],
        );
        chart.with_times(DUTY, drawn.iter().map(|&k| self.duty.instants[k].t))
    }

    /// Size of the plane's vertical axis.
    fn height(&self, envelope: &Envelope) -> f64 {
        let peak = envelope.peak_torque(1.0, 0.0);
        if peak.is_finite() {
            peak
        } else {
            self.judged.duty.torque.peak()
        }
    }

    /// Motor torque, the rotor's part of it, and the RMS.
    pub(super) fn torque(&self) -> Chart {
        let motor = self.judged.drive.motor;
        let ratio = self.context.ratio;
        let [torque, rotor] = self.over_time([&|i| self.motor_point(i).torque, &|i| {
            motor.rotor_inertia * i.input_alpha * ratio
        }]);
        let words = self.words();
        let own = format!("of which the {} itself", words.rotor);
        let axis = self.torque_axis("motor");
        let series = [
            line(words.torque.word, torque),
            line(&own, rotor),
            dashed("RMS", self.level(self.judged.duty.torque.rms)),
        ];
        Chart::new(ChartKind::Time, &time_axes(&axis), &series)
    }

    /// Motor torque, effect by effect.
    pub(super) fn effects(&self, contributions: &Contributions) -> Chart {
        let mut sums: Vec<(Effect, Vec<f64>)> = Vec::new();
        for cell in &contributions.torques {
            match sums.iter_mut().find(|(name, _)| *name == cell.effect) {
                Some((_, sum)) => {
                    for (sum, torque) in sum.iter_mut().zip(&cell.torque) {
                        *sum += torque;
                    }
                }
                None => sums.push((cell.effect, cell.torque.clone())),
            }
        }
        sums.retain(|(_, values)| values.iter().any(|value| *value != 0.0));
        let named: Vec<(String, Vec<f64>)> = sums
            .into_iter()
            .map(|(effect, values)| (effect.name(self.words()), values))
            .collect();
        let at: Vec<_> = named
            .iter()
            .map(|(_, values)| |k: usize| values[k])
            .collect();
        let at: Vec<&dyn Fn(usize) -> f64> = at.iter().map(|at| at as _).collect();
        let instants = &self.duty.instants;
        let drawn = kept(instants.len(), &at);
        let course = |values: &[f64]| drawn.iter().map(|&k| (instants[k].t, values[k])).collect();
        let series: Vec<Series> = named
            .iter()
            .map(|(name, values)| line(name, course(values)))
            .collect();
        Chart::new(
            ChartKind::Time,
            &time_axes(&self.torque_axis("motor")),
            &series,
        )
    }

    /// Motor speed.
    pub(super) fn speed(&self) -> Chart {
        let words = self.words();
        let scale = words.speed.scale;
        let axis = format!("motor speed [{}]", words.speed.unit);
        let [speed] = self.over_time([&|i| self.motor_point(i).speed / scale]);
        Chart::new(ChartKind::Time, &time_axes(&axis), &[line("speed", speed)])
    }

    /// Mechanical power at the motor shaft.
    pub(super) fn power(&self) -> Chart {
        let mean = self.judged.duty.power.mean;
        let [power] = self.over_time([&|i| {
            let point = self.motor_point(i);
            point.torque * point.speed
        }]);
        let series = [line("power", power), dashed("mean", self.level(mean))];
        Chart::new(
            ChartKind::Time,
            &time_axes("power at the motor shaft [W]"),
            &series,
        )
    }

    /// Temperature rises of winding and housing over the cycle, if they are known.
    pub(super) fn rises(&self) -> Option<Chart> {
        let course = self.context.rises()?;
        let drawn = kept(course.len(), &[&|k| course[k].1[0], &|k| course[k].1[1]]);
        let body = |body: usize| {
            let drawn = drawn.iter().map(|&k| course[k]);
            drawn.map(|(t, rise)| (t, rise[body])).collect()
        };
        let mut series = vec![line("winding", body(0))];
        if course.iter().any(|(_, rise)| rise[1] != 0.0) {
            series.push(line("housing", body(1)));
        }
        let axes = time_axes("temperature rise above ambient [K]");
        Some(Chart::new(ChartKind::Time, &axes, &series))
    }

    /// Voltage of the DC bus over the cycle, if it is known.
    pub(super) fn bus_voltage(&self) -> Option<Chart> {
        let trace = self.context.bus_voltage();
        let drawn = kept(trace.len(), &[&|k| trace[k][1]]);
        let points: Vec<(f64, f64)> = drawn.iter().map(|&k| trace[k].into()).collect();
        let axes = time_axes("voltage of the DC bus [V]");
        (!points.is_empty()).then(|| Chart::new(ChartKind::Time, &axes, &[line("bus", points)]))
    }

    /// λ over the range of the drive link, and the checked value.
    pub(super) fn inertia_ratio(&self, file: &MachineFile) -> Result<Chart, Error> {
        let machine = file.with_drive_train()?;
        let coordinate = machine.mechanism().coordinate();
        let ratio = file.drive_train.ratio();
        let mut points = Vec::new();
        for phi in whole_range(machine.domain(), 360) {
            let inertia = machine.bare_reduction(phi)?.inertia / (ratio * ratio);
            let lambda = self.judged.drive.inertia_ratio(inertia);
            points.push((coordinate.shown(phi), lambda));
        }
        let ends = [points.first(), points.last()].map(|p| p.map_or(0.0, |p| p.0));
        let level = |value: f64| ends.map(|x| (x, value)).to_vec();
        let mut series = vec![line("λ", points)];
        let check = self
            .judged
            .checks
            .iter()
            .find(|c| c.id == Rule::InertiaRatio);
        if let Some(value) = check.and_then(|c| c.value) {
            series.push(dashed("judged", level(value)));
        }
        if let Some(limit) = check.and_then(|c| c.limit) {
            series.push(dashed("limit", level(limit)));
        }
        let axes = Axes {
            title: "",
            x: Axis::of(coordinate),
            y: &format!("{} ratio λ", self.words().inertia),
        };
        Ok(Chart::new(ChartKind::Course, &axes, &series))
    }

    /// Use of every rule's limit over the gear ratio, all else unchanged; without the rules over time.
    pub(super) fn ratios(&self, from: f64, to: f64) -> Chart {
        let step = |k: u32| from * math::pow(to / from, f64::from(k) / f64::from(INTERVALS));
        let ratios: Vec<f64> = (0..=INTERVALS).map(step).collect();
        let courses = ratio_course(&self.context, self.rules, &ratios);
        let words = self.words();
        let mut series: Vec<Series> = courses
            .iter()
            .map(|(rule, uses)| {
                let shown = |used: f64| Some(used * 100.0).filter(|used| *used <= TOP);
                let uses = uses.iter().map(|used| shown(*used).unwrap_or(f64::NAN));
                line(
                    rule.named(words),
                    ratios.iter().copied().zip(uses).collect(),
                )
            })
            .collect();
        series.push(dashed("limit", vec![(from, 100.0), (to, 100.0)]));
        let now = self.context.ratio;
        // Slightly tilted: the page's script needs rising abscissae.
        let upright = vec![(now * (1.0 - 1e-4), 0.0), (now * (1.0 + 1e-4), TOP)];
        series.push(dashed("this drive", upright));
        let axes = Axes {
            title: "",
            x: Axis::new("gear ratio i"),
            y: "share of the limit [%]",
        };
        Chart::new(ChartKind::Course, &axes, &series)
    }
}

fn time_axes(y: &str) -> Axes<'_> {
    Axes {
        title: "",
        x: Axis::new("time [s]"),
        y,
    }
}

/// A unit with the multiplication dot.
fn dotted(unit: &str) -> String {
    unit.replace(' ', "·")
}

/// A torque limit around all four quadrants; `limit` is its magnitude for a direction of torque and a speed (rad/s).
fn outline(top: f64, scale: f64, limit: impl Fn(f64, f64) -> f64) -> Vec<(f64, f64)> {
    let half = f64::from(INTERVALS) / 2.0;
    let speed = |k: u32| top * (f64::from(k) - half) / half;
    let upper = (0..=INTERVALS).map(|k| (speed(k) / scale, limit(1.0, speed(k))));
    let lower = (0..=INTERVALS)
        .rev()
        .map(|k| (speed(k) / scale, -limit(-1.0, speed(k))));
    let mut points: Vec<(f64, f64)> = upper.chain(lower).collect();
    points.extend(points.first().copied());
    points
}
