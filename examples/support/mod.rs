//! Parts of every example that firmware does not need: printing, and an exit code. One source for host and target.

use core::fmt;

use jred::axis::AxisError;
use jred::axis::plan::PlanError;
use jred::duty::LimitError;
use jred::number::RangeError;
use jred::table::TableError;
use jred::{FirmwareError, ImageError};

#[cfg(target_os = "none")]
pub(crate) use cortex_m_semihosting::hprintln as println;
#[cfg(target_os = "none")]
use panic_semihosting as _;
#[cfg(not(target_os = "none"))]
pub(crate) use std::println;

/// Why an example fails.
pub(crate) enum Failure {
    /// An image, a table, or a figure beside them was refused.
    Firmware(FirmwareError),
    /// A claim of the example is false.
    Claim(&'static str),
}

macro_rules! failures {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::Firmware(error.into())
            }
        })*
    };
}

failures!(ImageError, TableError, AxisError, PlanError, LimitError);

/// Of a move: without its figures, whose printing would need double precision.
impl From<RangeError> for Failure {
    fn from(_: RangeError) -> Self {
        Self::Claim("a figure of the motion is out of range")
    }
}

impl From<&'static str> for Failure {
    fn from(claim: &'static str) -> Self {
        Self::Claim(claim)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Firmware(error) => error.fmt(f),
            Self::Claim(claim) => f.write_str(claim),
        }
    }
}

/// `x` in thousandths of its unit, rounded.
///
/// Printed numbers are integers: `core::fmt` for floats would be most of the program, and would need double precision.
pub(crate) fn milli(x: f32) -> i32 {
    let scaled = x * 1000.0;
    (if scaled < 0.0 {
        scaled - 0.5
    } else {
        scaled + 0.5
    }) as i32
}

/// Makes `run` the program: `main` on the host, the reset handler on the target. A failure is printed and gives exit code 1, which QEMU passes on.
macro_rules! program {
    ($run:ident) => {
        #[cfg(not(target_os = "none"))]
        fn main() -> std::process::ExitCode {
            match $run() {
                Ok(()) => std::process::ExitCode::SUCCESS,
                Err(failure) => {
                    $crate::support::println!("FAILED: {failure}");
                    std::process::ExitCode::FAILURE
                }
            }
        }

        #[cfg(target_os = "none")]
        #[cortex_m_rt::entry]
        fn main() -> ! {
            use cortex_m_semihosting::debug;
            let status = match $run() {
                Ok(()) => debug::EXIT_SUCCESS,
                Err(failure) => {
                    $crate::support::println!("FAILED: {}", failure);
                    debug::EXIT_FAILURE
                }
            };
            loop {
                debug::exit(status);
            }
        }
    };
}
pub(crate) use program;
