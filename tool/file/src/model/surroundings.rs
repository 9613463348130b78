//! Ambient conditions of the motor.

/// Ambient temperature for which S1 torques are given, and up to which they are not reduced (°C): IEC 60034-1.
pub const REFERENCE: f64 = 40.0;

/// Altitude up to which the full rise is allowed (m): IEC 60034-1.
pub const LOW: f64 = 1000.0;

/// The surroundings of the motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// Temperature (°C).
    pub ambient: f64,
    /// Temperature around the amplifier, for example in its cabinet (°C); `None`: that of the motor.
    pub cabinet: Option<f64>,
    /// Altitude above sea level (m).
    pub altitude: f64,
    /// Temperature for the copper's resistance (°C); `None`: that of the winding at every instant.
    pub resistance_at: Option<f64>,
    /// Highest temperature of the housing (°C), for example for touch; `None`: no limit.
    pub housing: Option<f64>,
}

impl Default for Surroundings {
    fn default() -> Self {
        Self {
            ambient: REFERENCE,
            cabinet: None,
            altitude: 0.0,
            resistance_at: None,
            housing: None,
        }
    }
}

impl Surroundings {
    /// Temperature around the amplifier (°C).
    pub fn around_amplifier(&self) -> f64 {
        self.cabinet.unwrap_or(self.ambient)
    }

    /// Factor of a rise in thin air: 1 % less for every 100 m above 1000 m.
    pub fn altitude_factor(&self) -> f64 {
        1.0 - (self.altitude - LOW).max(0.0) / 1e4
    }
}
