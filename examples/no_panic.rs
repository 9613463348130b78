//! A link gate: this program links for a Cortex-M only if the calls below cannot reach a panic.
//!
//! Its panic handler calls a function that does not exist. If the optimiser proves that no call can panic, the handler is removed; after one
//! forgotten index the linker reports `undefined symbol: a_panic_is_reachable`.
//!
//! `scripts/test gates` builds it three times: as it is; with `--cfg gate_panic`, which must not link; and with `--cfg gate_double`, where the search
//! for double-precision routines must find some; otherwise it must find none.
//!
//! Every public function of the layers `number`, `curve` and `tick` is called here by its path, those of `axis` in `no_panic_axis`;
//! `tests/no_panic_list.rs` checks that. `scripts/test` builds it with the feature `micromath`. Functions in double precision are called with `--cfg
//! gate_double`, where no panic can be reached, either. Exceptions:
//!
//! - `Table::cell_curves`: for proofs on a host, with a cell that may not exist
//! - `Transfer`: derivatives of mechanisms, for making tables
//! - `CubicSpline`, `control_points`: curves, for making tables
//! - `fit_periodic`, `fit_bounded`, `fit_quadratic_periodic`, `fit_quadratic_bounded`: for making tables
//! - `Units`: machine units of an image, for the library for C, whose own gate calls it
//! - `$error::cure`: text of an error for people
#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;
use core::num::NonZeroU32;

use jred::curves::{self, width};
use jred::duty::{Curve, Limits, Meter, Verdicts, Window};
use jred::harmonic::{Coefficient, terms};
use jred::image::{encode, identify, image_len};
use jred::machine::motion::{Law, Move};
use jred::number::{Bases, FrictionSign};
use jred::table::{AccelerationOf, Format, Shape, SpeedOf, Table, TorqueOf, Usage, words_len};
use jred::{
    AnyModel, Cubic, CurveSet, Domain, Harmonic, Image, ImageError, Model, Outcome, Phase, Pieces,
    Q15, Q31, Quadratic, Rows16, Scale, Speed, Spline, Spline16, include_image,
};
#[cfg(feature = "micromath")]
use jred::{SliderCrankForm, slider_crank};

#[cfg(target_os = "none")]
#[path = "support/gate.rs"]
mod gate;

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Constant friction.
const CONSTANTS: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// Every curve and term of a slider-crank.
#[cfg(feature = "micromath")]
const CRANK: CurveSet = curves::ALL | CONSTANTS | slider_crank::terms::ALL;
/// Every curve.
const EVERY: CurveSet = curves::ALL | curves::RECIPROCAL;

/// All calls of firmware, with arguments unknown to the optimiser; or only a panic.
fn calls() -> Result<(), ImageError> {
    if cfg!(gate_panic) {
        black_box([1, 2, 3][black_box(1usize)]);
        return Ok(());
    }
    let (float, fixed) = (
        include_image!("data/press_f32.jred"),
        include_image!("data/press_q31.jred"),
    );
    every_tick::<Spline<f32>, PRESS>(float)?;
    every_tick::<Spline<Q31>, PRESS>(fixed)?;
    // Refused, because the images have other layouts and sets, which the linker does not know.
    let other = || {
        [
            every_tick::<Cubic<f32>, { curves::ALL }>(float),
            every_tick::<Quadratic<f32>, CONSTANTS>(float),
            every_tick::<Harmonic<f32>, { curves::ALL | terms::ALL }>(float),
            every_tick::<Harmonic<f32>, { CONSTANTS | terms::SYMMETRIC }>(float),
            // Its tick is long where single precision is software: there only the calls of `every_crank`.
            #[cfg(all(feature = "micromath", not(short_multiply)))]
            every_tick::<SliderCrankForm, CRANK>(float),
            every_tick::<Spline<Q31>, EVERY>(fixed),
            every_tick::<Cubic<Q31>, EVERY>(fixed),
            every_tick::<Quadratic<Q31>, { curves::LOAD | curves::RECIPROCAL }>(fixed),
            every_tick::<Spline16, EVERY>(fixed),
            every_tick::<Rows16, { curves::ALL }>(fixed),
            every_tick::<Rows16, EVERY>(fixed),
            every_tick::<Rows16, { CONSTANTS | curves::RECIPROCAL }>(fixed),
        ]
    };
    // Without these calls double precision fits into the flash of the smallest board.
    if !cfg!(gate_double) {
        let _ = black_box(other());
    }
    every_format::<Spline<f32>>(float)?;
    every_format::<Spline<Q31>>(fixed)?;
    let other = [
        every_format::<Cubic<f32>>(float),
        every_format::<Quadratic<f32>>(float),
        every_format::<Harmonic<f32>>(float),
        #[cfg(all(feature = "micromath", not(short_multiply)))]
        every_format::<SliderCrankForm>(float),
        every_format::<Cubic<Q31>>(fixed),
        every_format::<Quadratic<Q31>>(fixed),
        every_format::<Spline16>(fixed),
        every_format::<Rows16>(fixed),
    ];
    let _ = black_box(other);
    every_term(float)?;
    #[cfg(feature = "micromath")]
    let _ = black_box(every_crank(float));
    every_number();
    every_meter(Window::SinceStart);
    every_meter(Window::Exponential(600.0));

    Ok(())
}

fn every_tick<F: Format, const SET: CurveSet>(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let image = Image::of_machine(image, black_box(Image::machine(&image)))?;
    let model = Image::model::<F, SET>(&image)?;
    let scale = Image::scale(&image);
    let phase = Domain::<f32>::phase(Image::domain(&image), black_box(1.0));
    let omega: Outcome<SpeedOf<F>> = Scale::omega(scale, black_box(10.0));
    let alpha: Outcome<AccelerationOf<F>> = Scale::alpha(scale, black_box(50.0));
    let limit: Outcome<TorqueOf<F>> = Scale::to_torque(scale, black_box(100.0));
    let (omega, alpha, limit) = (omega.value, alpha.value, limit.value);
    let torque = Model::torque(&model, phase, omega, alpha);
    let back = Model::acceleration(&model, phase, omega, limit);
    let range = Model::acceleration_range(&model, phase, omega, torque, limit);
    let (phases, omegas, alphas) = black_box(([phase; 3], [omega; 3], [alpha; 3]));
    let mut torques = black_box([TorqueOf::<F>::default(); 3]);
    let done = Model::torques(&model, &phases, &omegas, &alphas, &mut torques);
    let si = (
        Scale::torque_si(scale, torque),
        Scale::alpha_si(scale, back.value),
        Scale::omega_si(scale, omega),
    );
    black_box((si, range, done, torques));

    let half = Phase::from_bits(1 << 31);
    let domain = black_box(Domain::Turn);
    if let Ok(pieces) = Pieces::new(
        domain,
        black_box([(Phase::default(), model), (half, model)]),
    ) {
        black_box(Pieces::torque(&pieces, phase, omega, alpha));
        black_box(Pieces::acceleration(&pieces, phase, omega, torque));
        black_box(Pieces::acceleration_range(
            &pieces, phase, omega, torque, limit,
        ));
    }

    let again: Result<Model<'_, F, SET>, _> = Model::new(*Model::table(&model));
    let _ = black_box(again);
    Ok(())
}

/// As `every_tick`, for a set of curves known only at run time; and the table without a model.
fn every_format<F: Format>(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let any = Image::any_model::<F>(&image)?;
    let (phase, omega, alpha) = black_box(<(Phase, SpeedOf<F>, AccelerationOf<F>)>::default());
    let torque = AnyModel::torque(&any, phase, omega, alpha);
    black_box(AnyModel::acceleration(&any, phase, omega, torque));
    black_box(AnyModel::acceleration_range(
        &any, phase, omega, torque, torque,
    ));
    let mut torques = black_box([torque; 3]);
    black_box(AnyModel::torques(
        &any,
        &[phase; 3],
        &[omega; 3],
        &[alpha; 3],
        &mut torques,
    ));
    let _ = black_box((torques, AnyModel::new(*AnyModel::table(&any))));
    every_table(&image, Image::table::<F>(&image)?);
    if cfg!(gate_double) {
        every_double(Image::table::<F>(&image)?);
    }
    Ok(())
}

/// Information of a table, and its image encoded again.
fn every_table<F: Format>(image: &Image<'_>, table: Table<'_, F>) {
    let (cells, set) = (Table::cells(&table), Table::set(&table));
    black_box((
        width(set),
        words_len::<F>(cells, set),
        image_len::<F>(cells, set),
    ));
    black_box(
        (
            Table::constants(&table),
            Table::scale(&table),
            Usage::of(&table),
        )
            .2
            .is_ok(),
    );
    black_box((
        Domain::span(Table::domain(&table)),
        Table::reciprocal_error(&table),
    ));
    let again = Table::<F>::new(black_box(Table::words(&table)), Table::shape(&table));
    let _ = black_box(again);
    black_box((Image::cells(image), Image::set(image)));
    let mut buffer = black_box([0; 64]);
    let written = encode(&table, Image::validity(image), &mut buffer).unwrap_or_default();
    let _ = black_box(Image::new(written));
    let _ = black_box(identify(&mut buffer, black_box(7)));
}

/// For one format only: more do not fit into the flash of the smallest board.
fn every_term(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let any = Image::any_model::<Spline<f32>>(&image)?;
    let (phase, [omega, alpha], friction) =
        black_box((Phase::default(), [0.0; 2], FrictionSign::Scaled(0.5)));
    black_box(AnyModel::torque_with(&any, phase, omega, alpha, friction));
    black_box(AnyModel::torque_terms(&any, phase, omega, alpha, friction));
    black_box(AnyModel::acceleration_with(
        &any, phase, omega, friction, alpha,
    ));
    black_box(AnyModel::acceleration_range_with(
        &any, phase, omega, friction, omega, alpha,
    ));
    black_box(Image::is_of::<Spline<f32>, PRESS>(black_box(&[0; 30])));
    black_box(Image::bytes_are_of::<Spline<f32>, PRESS>(black_box(bytes)));
    Ok(())
}

#[cfg(feature = "micromath")]
fn every_crank(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let model = Image::model::<SliderCrankForm, CRANK>(&image)?;
    let (phase, [omega, alpha]) = black_box((Phase::default(), [0.0; 2]));
    let torque = Model::torque(&model, phase, omega, alpha);
    black_box(Model::acceleration(&model, phase, omega, torque));
    let shape = Shape::<SliderCrankForm>::slider_crank(black_box(0));
    let table = Table::new(black_box(&[0.25, 0.0, 0.1, 0.1, 0.0]), shape);
    black_box(table.is_ok());
    Ok(())
}

fn every_number() {
    let stroke = Move::new(
        Law::Polynomial345,
        black_box(0.0f32),
        black_box(core::f32::consts::TAU),
        black_box(0.4),
    );
    if let Ok(stroke) = stroke {
        black_box(stroke.at(black_box(0.1)));
    }
    if let Some(per_turn) = NonZeroU32::new(black_box(4096)) {
        let sum = Phase::from_counts(black_box(1), per_turn) + Phase::from_bits(black_box(2));
        let difference = sum - Phase::from_radians_f32(black_box(1.0));
        black_box((Phase::cell(difference, black_box(100)), Phase::to_bits(sum)));
    }
    black_box(Q31::to_bits(Q31::from_bits(black_box(1))));
    black_box(Q15::to_bits(Q15::from_bits(black_box(1))));
    // Accelerations and torques have the same functions, from one macro.
    let speeds = [1, 2].map(|bits| Speed::<Q31>::from_bits(black_box(bits)));
    let sum = Speed::saturating_add(speeds[0], speeds[1]);
    let difference = Speed::saturating_sub(sum, Speed::saturating_neg(speeds[0]));
    black_box(Speed::<Q31>::to_bits(difference));
    black_box(Speed::<Q15>::to_bits(Speed::<Q15>::from_bits(black_box(1))));
    let scale = black_box(Scale::SI);
    black_box((Scale::torque(&scale), Scale::speed(&scale)));
    black_box((Scale::inertia(&scale), Scale::acceleration(&scale)));
    black_box(Domain::to::<f32>(black_box(Domain::<f32>::Turn)));
    let shape = Shape::harmonics(black_box(1), black_box(terms::ALL));
    let series: Result<Table<'_, Harmonic<f32>>, _> = Table::new(black_box(&[1.0, 0.5]), shape);
    black_box(series.is_ok());
    black_box(Coefficient::of_word(black_box(1), black_box(terms::ALL)));
}

fn every_meter(window: Window<f32>) {
    let point = |most| Curve::new(black_box(&[[0.0, most], [300.0, 2.0]]));
    let mut limits = Limits::with_speed(Limits::new(), black_box(300.0));
    if let (Ok(continuous), Ok(peak)) = (point(3.0), point(9.0)) {
        black_box(Curve::at(&peak, black_box(100.0)));
        limits = Limits::with_peak(Limits::with_continuous(limits, continuous), peak);
    }
    limits = Limits::with_mean_speed(limits, black_box(200.0));
    limits = Limits::with_output_peak(limits, black_box(9.0));
    limits = Limits::with_output_mean(limits, black_box(5.0));
    limits = Limits::with_regenerative_power(limits, black_box(50.0));
    limits = Limits::with_cycles_per_hour(limits, black_box(1000.0));
    if let Ok(mut meter) = Meter::new(limits, black_box(1e-3), black_box(window)) {
        for _ in 0..black_box(3) {
            Meter::tick(&mut meter, black_box(1.0), black_box(100.0), black_box(5.0));
        }
        Meter::count_cycle(&mut meter);
        let verdicts = Meter::verdicts(&meter);
        black_box((Verdicts::all(&verdicts), Verdicts::satisfied(&verdicts)));
        black_box((Meter::figures(&meter), Meter::limits(&meter)));
        Meter::restart(&mut meter);
        black_box(&meter);
    }
}

/// Functions in double precision.
fn every_double<F: Format>(table: Table<'_, F>) {
    let phase = Phase::from_radians(black_box(1.0));
    black_box(Phase::radians(phase));
    if let Ok(stroke) = Domain::<f64>::stroke(black_box(0.0), black_box(1.0)) {
        black_box((
            Domain::<f64>::phase(stroke, black_box(0.5)),
            Domain::<f64>::position(stroke, 0.5),
        ));
    }
    let bases = Bases {
        torque: 1.0,
        speed: 1.0,
        inertia: 1.0,
    };
    if let Ok(scale) = Scale::new(black_box(bases)) {
        black_box(Scale::for_cells(scale, black_box(64), black_box(1.0)));
    }
    black_box((Table::at(&table, phase), Table::reciprocal(&table, phase)));
    black_box(Table::si(&table, phase, Domain::Turn));
}

#[cfg(not(target_os = "none"))]
fn main() -> Result<(), ImageError> {
    calls()
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    gate::end(calls().is_ok())
}
