//! A subset of a catalogue: some of its motors and gearboxes, with their pairing.

use super::{Catalogue, Gearbox, Motor};

impl Catalogue {
    /// Keeps only the motors and gearboxes that pass the tests.
    pub fn keep(&mut self, motor: impl Fn(&Motor) -> bool, gearbox: impl Fn(&Gearbox) -> bool) {
        let mut next = 0;
        let places: Vec<Option<u32>> = (self.gearboxes.iter())
            .map(|g| {
                let place = next;
                next += u32::from(gearbox(g));
                (next > place).then_some(place)
            })
            .collect();
        let place = |old: u32| places.get(old as usize).copied().flatten();
        let built_in = self.pairing.built_in.iter().zip(&places);
        self.pairing.built_in = built_in
            .filter(|(_, place)| place.is_some())
            .map(|(b, _)| *b)
            .collect();
        let mut of_motor = self.motors.iter().map(&motor);
        self.pairing
            .motors
            .retain(|_| of_motor.next() == Some(true));
        for partners in &mut self.pairing.motors {
            if let Some(these) = &mut partners.gearboxes {
                *these = these.iter().filter_map(|old| place(*old)).collect();
            }
        }
        self.motors.retain(motor);
        self.gearboxes.retain(gearbox);
    }
}
