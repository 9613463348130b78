//! The limits as Rust source, for the firmware to include.

use std::fmt::Write as _;

use super::{Bound, Field, MeterLimit, MeterLimits, lower_curve};

impl MeterLimits<'_> {
    /// The source. `machine`: description of the machine that the drive was sized for; `assumed`: the assumptions about the drive.
    pub fn source(&self, machine: &str, assumed: &[String]) -> String {
        let mut text = self.provenance(machine, assumed);
        for entry in &self.entries {
            self.constant(entry, &mut text);
        }
        self.times(&mut text);
        self.sized(&mut text);
        self.limits(&mut text);
        text
    }

    fn provenance(&self, machine: &str, assumed: &[String]) -> String {
        let drive = self.drive();
        let mut lines = vec![
            format!(
                "Limits of {} for the duty meter `jred::duty`.",
                drive.name()
            ),
            "Written by `jred size --meter`. Do not edit: run it again.".to_owned(),
            String::new(),
        ];
        let broken = self.broken();
        if !broken.is_empty() {
            lines.push(
                "THIS DRIVE VIOLATES RULES in this machine: these limits do not make it acceptable."
                    .to_owned(),
            );
            lines.extend(broken.iter().map(|rule| format!("violated: {rule}")));
            lines.push(String::new());
        }
        lines.push(format!("machine: {machine}"));
        lines.push(format!(
            "motor: {} {}",
            drive.motor.maker, drive.motor.model
        ));
        if let Some(gearbox) = drive.gearbox {
            lines.push(format!("gearbox: {} {}", gearbox.maker, gearbox.model));
        }
        lines.push(format!("rules: {} ({})", self.rules.name, self.rules.title));
        lines.extend(assumed.iter().map(|a| format!("assumed: {a}")));
        let unseen = self.unseen();
        if !unseen.is_empty() {
            let words = self.context.vocabulary();
            let names: Vec<&str> = unseen.iter().map(|rule| rule.named(words)).collect();
            lines.push(format!("not monitored by the meter: {}", names.join(", ")));
        }
        lines.push(String::new());
        lines.push(format!(
            "SI units. Speed and {} are those of the motor; output is that of the gearbox.",
            self.context.vocabulary().torque
        ));
        let mut text = String::new();
        for line in lines {
            // Names from a catalogue may contain anything, but must not end the comment.
            let line = line.replace(|c: char| c.is_control(), " ");
            let _ = writeln!(text, "{}", format!("// {line}").trim_end());
        }
        text
    }

    /// A limit's constant, or a comment with the reason why there is no limit.
    fn constant(&self, entry: &MeterLimit, text: &mut String) {
        let (name, words) = (entry.field.word().to_uppercase(), &entry.words);
        let unit = self.unit(entry.field);
        let _ = match &entry.bound {
            Bound::Open => writeln!(text, "\n// No limit `{}`: {words}.", entry.field),
            Bound::Figure(limit) => writeln!(
                text,
                "\n/// {words} ({unit}).\npub const {name}: f32 = {};",
                literal(*limit)
            ),
            Bound::Curve(curve) => writeln!(
                text,
                "\n/// {words} ({unit}).\npub const {name}: [[f32; 2]; {}] = {};",
                curve.points.len(),
                array(&curve.points)
            ),
        };
    }

    fn unit(&self, field: Field) -> String {
        let words = self.context.vocabulary();
        let (torque, speed) = (words.torque.unit, words.speed_si);
        match field {
            Field::Continuous | Field::Peak => format!("{torque} over {speed}"),
            Field::Speed | Field::MeanSpeed => speed.to_owned(),
            Field::RegenerativePower => "W".to_owned(),
            Field::CyclesPerHour => "1/h".to_owned(),
            Field::OutputPeak | Field::OutputMean => torque.to_owned(),
        }
    }

    /// Times that help to choose a window.
    fn times(&self, text: &mut String) {
        let thermal = &self.drive().motor.thermal;
        let times = [
            (
                "CYCLE_TIME",
                "The cycle",
                Some(self.context.cycle.duration()),
            ),
            (
                "WINDING_TIME",
                "Thermal time constant of the winding",
                thermal.winding_time,
            ),
            (
                "HOUSING_TIME",
                "Thermal time constant of the housing",
                thermal.housing_time,
            ),
        ];
        for (name, words, time) in times {
            if let Some(time) = time.filter(|time| time.is_finite() && *time > 0.0) {
                let value = literal(time as f32);
                let _ = writeln!(text, "\n/// {words} (s).\npub const {name}: f32 = {value};");
            }
        }
    }

    /// The figures of the cycle, as the meter would have them after one cycle.
    fn sized(&self, text: &mut String) {
        let context = self.context;
        let (cycle, c, ratio) = (context.cycle, &context.coefficients, context.ratio);
        let time = cycle.duration();
        let [motoring, back] = cycle.energies(c, ratio);
        let figures = [
            ("rms_torque", cycle.rms_torque(c)),
            ("mean_speed", cycle.mean_speed() * ratio),
            ("output_mean", cycle.mean_output_torque(3.0)),
            ("motoring_power", motoring / time),
            ("regenerative_power", back / time),
            ("motoring_energy", motoring),
            ("regenerative_energy", back),
            ("duration", time),
            ("peak_torque", cycle.peak_torque(c)),
            ("peak_speed", cycle.peak_speed() * ratio),
            ("output_peak", cycle.peak_output_torque()),
        ];
        text.push_str(
            "\n/// Values the cycle was sized with: those of the meter after one cycle, if each move of the drive link counts as a\n\
             /// cycle of the gearbox.\n\
             pub const SIZED: jred::duty::Figures<f32> = jred::duty::Figures {\n",
        );
        for (name, value) in figures {
            let _ = writeln!(text, "    {name}: {},", literal(value as f32));
        }
        let share = match self.peak_share() {
            Some(share) => format!("Some({})", literal(share as f32)),
            None => "None".to_owned(),
        };
        let moves = cycle.mechanics().moves;
        let an_hour = literal((3600.0 * f64::from(moves) / time) as f32);
        let _ = write!(
            text,
            "    peak_share: {share},\n    cycles_per_hour: {an_hour},\n    cycles: {moves},\n    ticks: 0,\n    invalid: 0,\n}};\n"
        );
    }

    /// The cycle's largest torque as a share of the exported curve.
    fn peak_share(&self) -> Option<f64> {
        let peak = self
            .entries
            .iter()
            .find(|entry| entry.field == Field::Peak)?;
        let Bound::Curve(curve) = &peak.bound else {
            return None;
        };
        let context = self.context;
        let shares = context.cycle.samples().iter().map(|sample| {
            let torque = context.coefficients.torque(&sample.loads()).abs();
            let limit = lower_curve::at(&curve.points, sample.speed().abs() * context.ratio);
            if torque == 0.0 { 0.0 } else { torque / limit }
        });
        Some(shares.fold(0.0, f64::max))
    }

    fn limits(&self, text: &mut String) {
        text.push_str(
            "\n/// The limits, for `jred::duty::Meter::new`.\n///\n/// # Errors\n/// None: the curves are in order.\n\
             pub fn limits() -> Result<jred::duty::Limits<f32>, jred::duty::LimitError> {\n    \
             Ok(jred::duty::Limits::new()",
        );
        for entry in &self.entries {
            let (field, name) = (entry.field, entry.field.word().to_uppercase());
            let limit = match &entry.bound {
                Bound::Open => continue,
                Bound::Figure(_) => name,
                Bound::Curve(_) => format!("jred::duty::Curve::new(&{name})?"),
            };
            let _ = write!(text, "\n        .with_{field}({limit})");
        }
        text.push_str(")\n}\n");
    }
}

/// Points, formatted like rustfmt.
fn array(points: &[[f32; 2]]) -> String {
    const ARRAY_WIDTH: usize = 60;
    let point = |[speed, torque]: &[f32; 2]| format!("[{}, {}]", literal(*speed), literal(*torque));
    let points: Vec<String> = points.iter().map(point).collect();
    let line = points.join(", ");
    if line.len() <= ARRAY_WIDTH {
        format!("[{line}]")
    } else {
        format!("[\n    {},\n]", points.join(",\n    "))
    }
}

/// A single-precision number as Rust writes it: all significant digits, in groups of three.
fn literal(x: f32) -> String {
    let text = format!("{x:?}");
    let (number, exponent) = match text.split_once('e') {
        Some((number, exponent)) => (number, format!("e{exponent}")),
        None => (&*text, String::new()),
    };
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let (sign, whole) = match whole.strip_prefix('-') {
        Some(whole) => ("-", whole),
        None => ("", whole),
    };
    let digits: Vec<char> = whole.chars().collect();
    let grouped: Vec<String> = digits
        .rchunks(3)
        .rev()
        .map(|g| g.iter().collect())
        .collect();
    let mut text = format!("{sign}{}", grouped.join("_"));
    let digits: Vec<char> = fraction.chars().collect();
    if !digits.is_empty() {
        let grouped: Vec<String> = digits.chunks(3).map(|g| g.iter().collect()).collect();
        let _ = write!(text, ".{}", grouped.join("_"));
    }
    text + &exponent
}
