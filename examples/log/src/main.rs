//! The press's ticks in the log: `jred` with its feature `defmt` implements `defmt::Format` on its public types.
//!
//! ```text
//! cargo run -p jred-log-example --profile firmware --target thumbv7em-none-eabihf
//! ```
//!
//! The texts stay in the program file; only numbers are sent, and `defmt-print` combines both on the host. `DEFMT_LOG` sets the level at compile time
//! (see .cargo/config.toml).
#![cfg_attr(target_os = "none", no_std, no_main)]
#![forbid(unsafe_code)]

#[cfg(not(target_os = "none"))]
fn main() {
    println!("This program is for a Cortex-M: --target thumbv7em-none-eabihf");
}

#[cfg(target_os = "none")]
mod target {
    use core::f32::consts::{PI, TAU};

    use cortex_m as _; // its critical section guards the log
    use cortex_m_semihosting::debug;
    use defmt_semihosting as _;
    use jred::machine::motion::{Law, Move};
    use jred::{CurveSet, Image, ImageError, Model, Q31, Spline, curves, include_image};

    /// The curves of the press, as `jred export` prints them.
    const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

    fn run() -> Result<(), ImageError> {
        let bytes = include_image!("../../data/press_f32.jred");
        let image = Image::from_bytes(bytes)?;
        let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
        defmt::info!("{=u32} cells, {}", image.cells(), image.validity());

        if let Ok(stroke) = Move::new(Law::Polynomial345, PI, TAU, 0.4_f32) {
            for tick in (0..=400u32).step_by(80) {
                let wanted = stroke.at(tick as f32 * 0.001);
                let torque =
                    press.torque(image.domain().phase(wanted.phi), wanted.omega, wanted.alpha);
                defmt::info!("{=u32} ms: {}, torque {}", tick, wanted, torque);
            }
        }

        // Errors are data, and can be logged as data.
        if let Err(error) = Image::from_bytes(bytes.get(..256).unwrap_or_default()) {
            defmt::warn!("cut off: {}", error);
        }
        if let Err(error) = image.model::<Spline<Q31>, PRESS>() {
            defmt::warn!("not fixed point: {}", error);
        }
        Ok(())
    }

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let result = run();
        if let Err(error) = result {
            defmt::error!("{}", error);
        }
        exit(result.is_ok())
    }

    #[panic_handler]
    fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
        defmt::error!("{}", defmt::Display2Format(info));
        exit(false)
    }

    fn exit(success: bool) -> ! {
        let status = if success {
            debug::EXIT_SUCCESS
        } else {
            debug::EXIT_FAILURE
        };
        loop {
            debug::exit(status);
        }
    }
}
