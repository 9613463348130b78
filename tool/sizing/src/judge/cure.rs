//! The data missing for a rule that is not checked, and where to add them.

use jred_file::model::rule::Rule;

/// Keys with which a rule can be checked: columns of the catalogue (docs/catalogue.md), or keys of the machine file.
pub const fn cure(rule: Rule) -> &'static str {
    match rule {
        Rule::RmsTorque => "the S1 rating of the motor in the catalogue",
        Rule::PeakTorque => "the peak rating of the motor in the catalogue",
        Rule::Speed => "max_speed of the motor in the catalogue",
        Rule::HoldingTorque | Rule::ConstantTorque => {
            "the standstill rating of the motor in the catalogue"
        }
        Rule::BrakeTorque => "the columns of the holding brake of the motor in the catalogue",
        Rule::BrakeWork => {
            "brake_closing_time and brake_work of the motor in the catalogue, with emergency_stops in [duty] brake_stops"
        }
        Rule::AmbientTemperature => "temperature_derating of the motor in the catalogue",
        Rule::CabinetTemperature => "temperature_derating of the amplifier in the catalogue",
        Rule::Altitude => "altitude_derating in the catalogue",
        Rule::InertiaRatio => "inertia_ratio in [rules]",
        Rule::WindingTemperature | Rule::HousingTemperature => {
            "thermal resistances, time constants and winding data of the motor in the catalogue"
        }
        Rule::GearboxPeak => "peak_output_torque of the gearbox in the catalogue",
        Rule::GearboxCubicMean => "rated_output_torque of the gearbox in the catalogue",
        Rule::GearboxEmergency => "emergency_output_torque of the gearbox in the catalogue",
        Rule::GearboxMeanSpeed => "rated_input_speed of the gearbox in the catalogue",
        Rule::GearboxSpeed => "max_input_speed of the gearbox in the catalogue",
        Rule::GearboxCycles => "shock_factors of the gearbox in the catalogue",
        Rule::GearboxRadial => {
            "max_radial_load of the gearbox in the catalogue, and pretension of the belt in the machine file"
        }
        Rule::GearboxAxial => "max_axial_load of the gearbox in the catalogue",
        Rule::BeltTension => "pretension and max_tension of the belt in the machine file",
        Rule::BeltForce => "max_effective_force of the belt in the machine file",
        Rule::BeltPretension => "pretension of the belt in the machine file",
        Rule::ScrewForce => "max_force of the screw in the machine file",
        Rule::ScrewBuckling | Rule::ScrewSpeed => {
            "root_diameter, free_length and ends of the screw in the machine file"
        }
        Rule::PinionForce => "max_force of the pinion in the machine file",
        Rule::RmsCurrent => "amplifiers in the catalogue, and k_t or rated_current of the motor",
        Rule::PeakCurrent => "k_t or rated_current of the motor in the catalogue",
        Rule::Overload => "peak_time of the amplifier and k_t of the motor in the catalogue",
        Rule::MotorVoltage => {
            "mains_voltage or max_bus_voltage of the motor in the catalogue, and mains_voltage in [supply]"
        }
        Rule::AmplifierVoltage => {
            "mains_voltage or bus_voltage of the amplifier in the catalogue, and mains_voltage in [supply]"
        }
        Rule::BusVoltage => {
            "mains_voltage, capacitance, chopper_voltage and max_voltage in [supply], or of the amplifier in the catalogue"
        }
        Rule::BrakeResistance => "min_resistance in [supply], or of the amplifier",
        Rule::ResistorPower | Rule::ResistorPeak | Rule::ResistorPulse => {
            "power, peak_power and pulse_energy of brake_resistor in [supply], and the figures of the DC bus there or of the amplifier"
        }
        Rule::NaturalFrequency => {
            "stiffness of the gearbox in the catalogue; for a direct drive shaft in [stiffness]"
        }
        Rule::Backlash => "backlash of the gearbox in the catalogue",
    }
}
