//! Instructions of mechanisms on a Cortex-M4F and a Cortex-M7, counted in QEMU: per position, on average over a turn.
//!
//! ```text
//! scripts/test counts
//! ```
//!
//! runs it for both cores, the M7 with its double precision (`-Ctarget-cpu=cortex-m7`). With `-icount shift=0` QEMU executes one instruction per 1
//! ns, so that SysTick, at 25 MHz, counts 40 of them. The counts are the same on every run; they are not cycles. `ceilings.txt` bounds them from
//! above and, by half of that, from below. docs/performance.md has the results.
#![cfg_attr(target_os = "none", no_std, no_main)]
#![allow(
    unsafe_code,
    reason = "reads a register of the core, runs a loop of known length"
)]

#[cfg(target_os = "none")]
#[path = "support/ceilings.rs"]
mod ceilings;
#[cfg(target_os = "none")]
mod support;

#[cfg(not(target_os = "none"))]
fn main() {
    println!("on_target counts instructions on a Cortex-M in QEMU: scripts/test counts");
}

#[cfg(target_os = "none")]
mod target {
    use core::hint::black_box;

    use cortex_m::peripheral::syst::SystClkSource;
    use cortex_m::peripheral::{CPUID, SYST};
    use cortex_m_rt::entry;
    use cortex_m_semihosting::{debug, hprintln};
    use jred::axis::monitor::{Monitor, Watch};
    use jred::axis::plan::{Errors, Knot, encode, image_len};
    use jred::axis::{
        Identification, IdentificationSettings, Observer, Override, Payload, Plan, PlanFollower,
    };
    use jred::duty::{Curve, Limits, Meter, Window};
    use jred::error::Error;
    use jred::harmonic::terms;
    use jred::machine::{Machine, Mechanism, Reducible};
    use jred::number::FrictionSign;
    use jred::table::{Format, TorqueOf};
    use jred::tabulate::{fill, scratch_len};
    use jred::{CurveSet, Domain, Image, Model, Phase, Q31, Scale, Spline, curves, include_image};
    use panic_semihosting as _;

    use crate::ceilings::judge;
    use crate::support;

    /// Instructions per tick of SysTick: 1 ns each, at 25 MHz.
    const PER_TICK: u32 = 40;
    const RELOAD: u32 = 0x00ff_ffff;
    /// Positions per turn.
    const POSITIONS: u32 = 64;
    /// Ticks of the duty meter.
    const TICKS: u32 = 1024;
    /// Cells of the table.
    const CELLS: u32 = 64;

    struct Counter(SYST);

    impl Counter {
        fn new(mut syst: SYST) -> Self {
            syst.set_clock_source(SystClkSource::Core);
            syst.set_reload(RELOAD);
            syst.clear_current();
            syst.enable_counter();
            Self(syst)
        }

        /// Instructions of `run`, to a resolution of 40.
        fn count(&mut self, run: impl FnOnce()) -> u32 {
            self.0.clear_current();
            self.0.has_wrapped();
            let start = SYST::get_current();
            run();
            let ticks = start.wrapping_sub(SYST::get_current()) & RELOAD;
            assert!(!self.0.has_wrapped() || start == 0, "counted too far");
            ticks * PER_TICK
        }
    }

    /// The core, named as in `ceilings.txt`.
    fn core() -> &'static str {
        // SAFETY: reads a register that identifies the core.
        match unsafe { (*CPUID::PTR).base.read() } >> 4 & 0xfff {
            0xc24 => "cortex-m4",
            0xc27 => "cortex-m7",
            _ => "unknown",
        }
    }

    fn run(counter: &mut Counter) -> Result<u32, Error> {
        // A known loop checks that instructions are counted at all.
        let known = 100_000;
        let counted = counter.count(|| {
            // SAFETY: counts a register down and changes nothing else.
            unsafe {
                core::arch::asm!("2: subs {0}, {0}, #1", "bne 2b", inout(reg) known / 2 => _);
            }
        });
        if counted.abs_diff(known) > 4 * PER_TICK {
            hprintln!(
                "{} instructions counted as {}: QEMU_ICOUNT=0 is missing",
                known,
                counted
            );
            return Ok(1);
        }
        let gravity = [0.0, -9.81];
        let four_bar = Machine::new(support::four_bar()?).with_gravity(gravity)?;
        let linkage = Machine::new(support::four_bar_linkage::<32>()?).with_gravity(gravity)?;
        let mut scratch = [0.0; scratch_len(CELLS, curves::LOAD)];
        let mut words = [0.0_f32; 2 * (CELLS as usize + 3)];

        let mut failures = 0;
        let mut report = |name: &str, count: u32| {
            let verdict = judge(core(), name, u64::from(count));
            failures += u32::from(!verdict.holds());
            hprintln!("{:10} {:20} {:8}  {}", core(), name, count, verdict);
        };
        let mut each = |run: &mut dyn FnMut(f64) -> bool| {
            let count = counter.count(|| {
                for k in 0..POSITIONS {
                    let phi = f64::from(k) * (core::f64::consts::TAU / f64::from(POSITIONS));
                    assert!(run(black_box(phi)), "a position failed");
                }
            });
            count / POSITIONS
        };
        let frames = each(&mut |phi| black_box(four_bar.mechanism().frames(phi)).is_ok());
        report("four-bar-frames", frames);
        let reduction = each(&mut |phi| black_box(four_bar.reduction(phi)).is_ok());
        report("four-bar-reduction", reduction);
        let forces = each(&mut |phi| black_box(four_bar.forces(phi, 10.0, 5.0)).is_ok());
        report("four-bar-forces", forces);
        let frames = each(&mut |phi| black_box(linkage.mechanism().frames(phi)).is_ok());
        report("linkage-frames", frames);
        let reduction = each(&mut |phi| black_box(linkage.reduction(phi)).is_ok());
        report("linkage-reduction", reduction);

        let mut filled = |machine: &dyn Fn(&mut [f64], &mut [f32]) -> bool| {
            let count = counter.count(|| assert!(machine(&mut scratch, &mut words), "no table"));
            count / CELLS
        };
        let cell = filled(&|scratch, words| {
            fill::<Spline<f32>>(&four_bar, curves::LOAD, CELLS, &Scale::SI, scratch, words).is_ok()
        });
        report("four-bar-fill-cell", cell);
        let cell = filled(&|scratch, words| {
            fill::<Spline<f32>>(&linkage, curves::LOAD, CELLS, &Scale::SI, scratch, words).is_ok()
        });
        report("linkage-fill-cell", cell);

        for (name, window) in [
            ("duty-tick", Window::SinceStart),
            ("duty-tick-forgets", Window::Exponential(600.0)),
        ] {
            let points = black_box([[0.0f32, 9.0], [200.0, 9.0], [300.0, 4.0]]);
            let mut limits = Limits::new();
            limits.peak = Curve::new(&points).ok();
            let Ok(mut meter) = Meter::new(limits, black_box(1e-3), black_box(window)) else {
                return Ok(1);
            };
            let count = counter.count(|| {
                for k in 0..TICKS {
                    // Torques and speeds up to the last line of the curve.
                    let (torque, speed) = ((k % 16) as f32 - 8.0, (k % 64) as f32 * 4.6 - 145.0);
                    meter.tick(black_box(torque), black_box(speed), black_box(5.0 * torque));
                }
            });
            black_box(meter.figures());
            report(name, count / TICKS);
        }
        let float = include_image!("../examples/data/press_f32.jred");
        let fixed = include_image!("../examples/data/press_q31.jred");
        let names = [
            "observer-f32",
            "payload-f32",
            "monitor-f32",
            "monitor-f32-cycle",
        ];
        let in_float = observer::<Spline<f32>>(counter, float, names, &mut report);
        let names = [
            "observer-q31",
            "payload-q31",
            "monitor-q31",
            "monitor-q31-cycle",
        ];
        let in_fixed = observer::<Spline<Q31>>(counter, fixed, names, &mut report);
        let planned = plan(counter, &mut report);
        let identified = identify(counter, &mut report);
        let all = in_float.and(in_fixed).and(planned).and(identified);
        all.map_or(Ok(1), |()| Ok(failures))
    }

    /// The observer, and all that uses its load; the monitor watches.
    fn observer<F: Format>(
        counter: &mut Counter,
        image: &'static [u8],
        [of_observer, of_payload, of_monitor, of_cycle]: [&str; 4],
        report: &mut dyn FnMut(&str, u32),
    ) -> Option<()> {
        const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
        const REFERENCE: u32 = 32;
        let image = Image::from_bytes(image).ok()?;
        let model: Model<'_, F, PRESS> = image.model().ok()?;
        let scale = *model.table().scale();
        let mut observer = Observer::with_bandwidth(60.0, 0.001, &model).ok()?;
        let place = |k: u32| Phase::from_bits(black_box(k << 22));
        let torque: TorqueOf<F> = scale.to_torque(10.0).value;
        let friction = FrictionSign::OfSpeed(scale.omega(5.0).value);
        let count = counter.count(|| {
            for k in 0..TICKS {
                let torque = black_box(torque);
                black_box(observer.update(&model, place(k), torque, friction));
            }
        });
        report(of_observer, count / TICKS);
        let mut payload = Payload::new(200.0, 1 << 16, &observer, &model).ok()?;
        let count = counter.count(|| {
            for _ in 0..TICKS {
                payload.update(black_box(torque), black_box(torque));
            }
        });
        black_box(payload.estimate());
        report(of_payload, count / TICKS);
        let watch = Watch {
            largest: 200.0,
            reference: REFERENCE,
            cycles: 10_000,
            false_alarm: 0.001,
        };
        let carried = |at: Phase| (at.to_bits() >> 26) as f32;
        let mut monitor = Monitor::<F::Number, 64>::new(watch, carried, &model).ok()?;
        for _ in 0..2 * REFERENCE {
            for k in 0..TICKS {
                monitor.tick(place(k), torque);
            }
            monitor.end_cycle();
        }
        let count = counter.count(|| {
            for k in 0..TICKS {
                black_box(monitor.tick(place(k), black_box(torque)));
            }
        });
        report(of_monitor, count / TICKS);
        let count = counter.count(|| {
            black_box(monitor.end_cycle());
        });
        report(of_cycle, count);
        Some(())
    }

    /// A tick of an identification with six harmonics and cogging, on average and the longest one, and the solution in the background.
    fn identify(counter: &mut Counter, report: &mut dyn FnMut(&str, u32)) -> Option<()> {
        const SET: CurveSet =
            curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS | terms::GENERAL;
        let settings = IdentificationSettings {
            period: 1e-3,
            max_speed: 14.0,
            inertia: 0.1,
            torque_delay: 1e-3,
            torque_noise: 0.1,
            angle_noise: 5e-4,
            memory: f32::INFINITY,
        };
        let mut made = Identification::<f32, 30, 256, SET>::new(&settings, &[36]).ok()?;
        // Two turns a second.
        let place = |k: u32| Phase::from_bits(k.wrapping_mul(8_590_000));
        for k in 0..TICKS {
            made.add(place(k), 10.0);
        }
        let mut most = 0;
        let (mut sum, mut k) = (0, TICKS);
        while k < 2 * TICKS {
            let count = counter.count(|| {
                black_box(made.add(place(k), black_box(10.0)));
            });
            (sum, most, k) = (sum + count, most.max(count), k + 1);
        }
        report("identify-f32", sum / TICKS);
        report("identify-f32-most", most);
        let equations = made.equations();
        let count = counter.count(|| {
            black_box(equations.solve());
        });
        report("identify-f32-solve", count);
        Some(())
    }

    /// A set-point of a plan of 256 rows, and of its follower while the rate changes; the model is in single precision.
    fn plan(counter: &mut Counter, report: &mut dyn FnMut(&str, u32)) -> Option<()> {
        const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
        const ROWS: usize = 256;
        let image = Image::from_bytes(include_image!("../examples/data/press_f32.jred")).ok()?;
        let model: Model<'_, Spline<f32>, PRESS> = image.model().ok()?;
        let mut knots = [Knot::default(); ROWS];
        for (k, knot) in (0..).map(f64::from).zip(&mut knots) {
            // A parabola of the position.
            let t = 0.01 * k;
            *knot = Knot {
                t,
                position: 2.0 * t * t,
                omega: 4.0 * t,
                alpha: [4.0; 2],
            };
        }
        let mut words = [0; image_len(ROWS)];
        let none = Errors::default();
        let words = encode(&knots, Domain::Turn, 0, none, &mut words).ok()?;
        let plan = Plan::new(words, &model).ok()?;
        let count = counter.count(|| {
            for k in 0..u64::from(TICKS) {
                black_box(plan.at(black_box((k << 40) / 450)));
            }
        });
        report("plan-at", count / TICKS);
        let mut follower = PlanFollower::new(plan, 0.001, 2.0, &model).ok()?;
        follower.start();
        let count = counter.count(|| {
            for k in 0..TICKS {
                black_box(follower.next(black_box(Override::percent(k & 128))));
            }
        });
        report("plan-next", count / TICKS);
        Some(())
    }

    #[entry]
    fn main() -> ! {
        let peripherals = cortex_m::Peripherals::take().expect("taken once");
        let status = match run(&mut Counter::new(peripherals.SYST)) {
            Ok(0) => debug::EXIT_SUCCESS,
            Ok(failures) => {
                hprintln!("{} counts out of bounds", failures);
                debug::EXIT_FAILURE
            }
            Err(error) => {
                hprintln!("FAILED: {}", error);
                debug::EXIT_FAILURE
            }
        };
        loop {
            debug::exit(status);
        }
    }
}
