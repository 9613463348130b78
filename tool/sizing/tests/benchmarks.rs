//! Examples of makers' handbooks that select a motor: the selected motor, judged by the rules.
//!
//! The handbooks add the load torque and the torque of the whole inertia, so the machine is given by both: see docs/evidence.md.

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_report::list::rule_words::sentence;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::check::Check;
use jred_sizing::judge::{Assessment, Context};

use crate::direct;
use crate::support::{Folder, near, within};

/// 3000 rpm in rad/s.
const TOP: f64 = 100.0 * std::f64::consts::PI;

/// The handbook's data of load and motor, in N m and kg m².
struct Example {
    load_torque: f64,
    load_inertia: f64,
    rated: f64,
    peak: f64,
    rotor: f64,
    /// Allowed ratio of load inertia to rotor inertia.
    ratio: f64,
    /// Time of acceleration (s).
    accelerate: f64,
}

/// Yaskawa, Σ-II series, user's manual, 11.1.2, page 11-5 (easymanua.ls/yaskawa/e-ii-series/manual?p=308): SGMPH-02A for a screw with
/// 80 kg at 15 m/min.
const SCREW: Example = Example {
    load_torque: 0.139,
    load_inertia: 1.25e-4,
    rated: 0.637,
    peak: 1.91,
    rotor: 0.209e-4,
    ratio: 3.69 / 0.209,
    accelerate: 0.1,
};

/// Yaskawa, E-S series, product manual, 2.4.1, page 2-13 (manualarchiveguide.com, YASKAWA-E-S-Series-Product-Manual-4781210,
/// page 43): SGMSL-A3C.
const SMALL: Example = Example {
    load_torque: 0.035,
    load_inertia: 0.474e-4,
    rated: 0.0955,
    peak: 0.286,
    rotor: 0.00629e-4,
    ratio: 30.0,
    accelerate: 0.1,
};

impl Example {
    /// 25 turns up to 3000 rpm and back to rest, then a pause up to 1.5 s.
    fn file(&self) -> String {
        format!(
            r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = {{ inertia = "{} kg m^2" }}
[[load]]
on = "table"
opposing_moment = "{} N m"
[motion]
type = "cycle"
[[motion.segment]]
law = "trapezoid"
move = "{} rad"
max_speed = "3000 rpm"
max_acceleration = "{} rad/s^2"
[[motion.segment]]
dwell = "{} s"
[rules]
rms_torque = "100 %"
peak_torque = "100 %"
speed = "100 %"
inertia_ratio = {ratio}
inertia_ratio_warning = {ratio}
"#,
            self.load_inertia,
            self.load_torque,
            TOP * (self.accelerate + STEADY),
            TOP / self.accelerate,
            CYCLE - STEADY - 2.0 * self.accelerate,
            ratio = self.ratio
        )
    }

    /// The rules of the chosen motor.
    fn checks(&self) -> Vec<Check> {
        let file = checked::parse("m.toml", &self.file(), Path::new("")).unwrap();
        let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 2000).unwrap();
        let folder = Folder::new();
        let header = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],max_speed [rpm],\
                      peak_corner_speed [rpm],rotor_inertia [kg m^2],source,figures_from";
        let row = format!(
            "m,Yaskawa,m,{},3000,{},3000,3000,{},Handbook,maker",
            self.rated, self.peak, self.rotor
        );
        let path = folder.file("motors.csv", format!("{header}\n{row}\n"));
        let catalogue = Catalogue::load(Some(&path), None).unwrap();
        let prepared = catalogue.prepare(&file.site);
        let cycle = Cycle::new(&duty);
        let drive = direct(&catalogue.motors[0]);
        let context = Context::new(&cycle, &file.site, drive, &prepared[0]);
        Assessment::new(&context, &file.rules).checks
    }

    /// The handbook's torques of acceleration and deceleration, and its effective torque.
    fn torques(&self) -> [f64; 3] {
        let inertia = (self.rotor + self.load_inertia) * TOP / self.accelerate;
        let (up, down) = (inertia + self.load_torque, inertia - self.load_torque);
        let heat = (up * up + down * down) * self.accelerate;
        let heat = heat + self.load_torque * self.load_torque * STEADY;
        [up, down, (heat / CYCLE).sqrt()]
    }
}

/// Time at 3000 rpm and length of the cycle (s).
const STEADY: f64 = 0.9;
const CYCLE: f64 = 1.5;

fn of(checks: &[Check], rule: Rule) -> &Check {
    checks.iter().find(|check| check.id == rule).unwrap()
}

/// The motor that the handbook accepts satisfies the rules, with the handbook's figures.
#[test]
fn yaskawa_screw_with_its_motor() {
    let checks = SCREW.checks();
    let [up, _, effective] = SCREW.torques();
    // From figures of three digits: 0.1 s of acceleration.
    near("T_P", up, 0.597, 1e-3);
    let peak = of(&checks, Rule::PeakTorque);
    near("peak", peak.value.unwrap(), up, 1e-9);
    near("limit", peak.limit.unwrap(), 1.91, 1e-12);
    near(
        "RMS",
        of(&checks, Rule::RmsTorque).value.unwrap(),
        effective,
        1e-6,
    );
    near(
        "limit",
        of(&checks, Rule::RmsTorque).limit.unwrap(),
        0.637,
        1e-12,
    );
    let ratio = of(&checks, Rule::InertiaRatio);
    near("λ", ratio.value.unwrap(), 1.25 / 0.209, 1e-9);
    let speed = of(&checks, Rule::Speed);
    near("speed", speed.value.unwrap(), 3000.0, 1e-9);
    for check in [peak, ratio, speed, of(&checks, Rule::RmsTorque)] {
        assert_eq!(check.verdict, RuleVerdict::Pass, "{}", sentence(check));
    }
    // At five times the acceleration it is too small: T_P = 2.43 N m against 1.91 N m.
    let hasty = Example {
        accelerate: 0.02,
        ..SCREW
    };
    let checks = hasty.checks();
    let peak = of(&checks, Rule::PeakTorque);
    near("peak", peak.value.unwrap(), hasty.torques()[0], 1e-9);
    assert_eq!(peak.verdict, RuleVerdict::Fail);
    assert!(hasty.torques()[0] > 1.91);
}

/// The handbook prints T_P = 0.186 N m, less than 0.286 N m. Its load inertia is 75 times the rotor's, above its own limit of 30, which the rule
/// reports.
#[test]
fn yaskawa_small_motor() {
    let checks = SMALL.checks();
    let peak = of(&checks, Rule::PeakTorque);
    within("T_P", peak.value.unwrap(), 0.186, 5e-4);
    assert_eq!(peak.verdict, RuleVerdict::Pass);
    near("used", peak.used, 0.186 / 0.286, 3e-3);
    let ratio = of(&checks, Rule::InertiaRatio);
    near("λ", ratio.value.unwrap(), 0.474 / 0.00629, 1e-9);
    assert_eq!(ratio.verdict, RuleVerdict::Fail);
}
