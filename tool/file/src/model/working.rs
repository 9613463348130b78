//! Motion-opposing loads that do process work: a press force, a cut. A load that acts all the time is friction.

use jred::error::Error;
use jred::machine::{Action, Load, Machine, Mechanism as _};

use crate::model::machine::MachineFile;
use crate::model::mechanism::AnyMechanism;

impl MachineFile {
    /// Whether a motion-opposing load belongs to the process: it acts in a part of the range or of the motion, or its size comes from a table.
    fn is_working(&self, number: usize, load: &Load) -> bool {
        let opposes = match load.action() {
            Action::Force(_) | Action::Moment(_) => false,
            Action::OpposingForce(_)
            | Action::OpposingMoment(_)
            | Action::ViscousForce(_)
            | Action::ViscousMoment(_) => true,
        };
        let mechanism = self.machine.mechanism();
        // In measured curves of a whole machine friction cannot be separated.
        let measured = mechanism.kind() == "reduced-curves";
        let from_table = || !measured && load.link() >= mechanism.own_links();
        let timed = || {
            let mut scheduled = self.schedule.loads().iter();
            scheduled.any(|own| own.load == number && own.when.spans.is_some())
        };
        opposes && (load.window().is_some() || from_table() || timed())
    }

    /// b (N·m·s/rad) and c (N·m) of these loads of one of its machines, in −b·ω and −c·sgn ω.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn working(&self, machine: &Machine<AnyMechanism>, phi: f64) -> Result<[f64; 2], Error> {
        let loads = machine.loads().iter().enumerate();
        let mut loads = loads
            .filter(|(k, load)| self.is_working(*k, load))
            .peekable();
        let mut sum = [0.0; 2];
        if loads.peek().is_none() {
            return Ok(sum);
        }
        let frames = machine.mechanism().frames(phi)?;
        for (_, load) in loads {
            if let Some(frame) = frames.get(load.link()) {
                let curves = load.reduce(frame, phi);
                sum[0] += curves.viscous;
                sum[1] += curves.coulomb;
            }
        }
        Ok(sum)
    }
}
