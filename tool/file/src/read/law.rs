//! `law`: a motion law by its name, for segments of a motion and of a cam.

use jred::machine::motion::Law;

use crate::keys::motion::LAWS;
use crate::number::rounding::figure;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// The law of a segment, with the shares of a trapezoid.
pub(super) fn read(section: &Section) -> Result<Law> {
    let law = section.need("law")?;
    Ok(match law.choice(&LAWS)? {
        0 => {
            let mut shares = [1.0 / 3.0; 2];
            let mut place = law.span();
            for (key, share) in ["accelerate", "decelerate"].into_iter().zip(&mut shares) {
                if let Some(value) = section.given(key)? {
                    (*share, place) = (value.si, value.span());
                }
            }
            let [accelerate, decelerate] = shares;
            let law = Law::Trapezoid {
                accelerate,
                decelerate,
            };
            if law.check().is_err() {
                return Err(Problem::new(format!(
                    "`accelerate` and `decelerate` in {} add up to {} % of the duration",
                    section.title(),
                    figure((accelerate + decelerate) * 100.0)
                ))
                .at(place, "too large")
                .help(format!(
                    "at most 100 % in total: here {} % + {} % (a share not given is 1/3)",
                    figure(accelerate * 100.0),
                    figure(decelerate * 100.0)
                )));
            }
            law
        }
        1 => Law::Polynomial345,
        2 => Law::Cycloidal,
        3 => Law::ModifiedSine,
        4 => Law::ModifiedTrapezoid,
        5 => Law::Polynomial4567,
        6 => Law::SimpleSine,
        7 => Law::Trapezoid {
            accelerate: 0.5,
            decelerate: 0.5,
        },
        8 => Law::Gutman,
        _ => sine_constant_cosine(section, &law)?,
    })
}

/// The shares of sine, constant part and cosine; zero if not given.
fn sine_constant_cosine(section: &Section, law: &Item) -> Result<Law> {
    let (mut shares, mut place) = ([0.0; 3], law.span());
    for (key, share) in ["sine", "constant", "cosine"].into_iter().zip(&mut shares) {
        if let Some(value) = section.given(key)? {
            (*share, place) = (value.si, value.span());
        }
    }
    let [sine, constant, cosine] = shares;
    let made = Law::SineConstantCosine {
        sine,
        constant,
        cosine,
    };
    if made.check().is_ok() {
        return Ok(made);
    }
    let sum = shares.iter().sum::<f64>() * 100.0;
    Err(Problem::new(format!(
        "`sine`, `constant` and `cosine` in {} add up to {} % of the duration",
        section.title(),
        figure(sum)
    ))
    .at(place, if sum > 50.0 { "too large" } else { "too small" })
    .help("write shares that add up to 1 % to 100 %, such as sine = \"25 %\", constant = \"50 %\", cosine = \"25 %\"; over the rest the speed is constant"))
}
