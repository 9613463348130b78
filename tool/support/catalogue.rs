//! A table of motors that can be used, for tests that change it.

pub(crate) const HEADER: &str = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source";
pub(crate) const FIRST: &str = "m1,Maker,Model,8,2000,36,8.5,Sheet";
pub(crate) const SECOND: &str = "m2,Maker,Model,9,2000,36,8.5,Sheet";
