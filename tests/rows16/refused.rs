//! Invalid tables, and machines beyond 16 bits.

use jred::error::Error;
use jred::machine::{PoseError, Reducible, Reduction};
use jred::number::RangeError;
use jred::table::{MAX_CELLS, RowConstants, TableError, words_len};
use jred::tabulate::{Request, fill, scratch_len, tabulate};
use jred::{CurveSet, Domain, Rows16, Scale, curves};

use super::{CONSTANT, Short, model, row_words};
use crate::support::machines::Wave;
use crate::support::scale_of;

const SET: CurveSet = super::EVERY;

/// J = 0.5, 1/J = 2, all else 0.
fn good() -> Short {
    let word = |upper: u32, lower: u32| upper << 16 | lower;
    let row = [0, 0, 0, word(0x8000, 0), 0, 0, word(2 << 13, 0)];
    assert_eq!(row.len(), row_words(SET));
    Short {
        words: row.repeat(4),
        constants: RowConstants {
            viscous: 0,
            coulomb: 0,
            shift: 13,
        },
        set: SET,
        cells: 4,
        domain: Domain::Turn,
        scale: scale_of(1.0, 1.0, 1.0),
    }
}

#[track_caller]
fn refused(change: impl Fn(&mut Short)) -> TableError {
    let mut rows = good();
    change(&mut rows);
    rows.try_table().map(|_| ()).unwrap_err()
}

/// With another word in cell 2.
#[track_caller]
fn with(index: usize, word: u32) -> TableError {
    refused(|rows| rows.words[14 + index] = word)
}

#[test]
fn sizes_and_sets() {
    assert!(good().try_table().is_ok());
    model::<SET>(&good());
    for set in [64, 128, 255, 18, 36, 63] {
        assert_eq!(refused(|rows| rows.set = set), TableError::Curves(set));
    }
    for cells in [0, 3, MAX_CELLS + 1, u32::MAX] {
        assert_eq!(refused(|rows| rows.cells = cells), TableError::Cells(cells));
    }
    for given in [0u32, 27, 29] {
        assert_eq!(
            refused(|rows| rows.words.resize(given as usize, 0)),
            TableError::Length { needed: 28, given }
        );
    }
}

#[test]
fn lines_that_leave_their_range() {
    for index in [0, 1, 2, 4, 5] {
        let curve = index as u8;
        let expected = TableError::Range { curve, cell: 2 };
        // Above the end of the range by the rise, and below the other end.
        assert_eq!(with(index, 0x7fff_0001), expected);
        assert_eq!(with(index, 0x8000_8000), expected);
    }
    // A J of 1 or more at the end of the cell.
    let beyond = refused(|rows| {
        rows.words[14 + 1] = 0x0002_0000;
        rows.words[14 + 3] = 0xffff_0000;
    });
    assert_eq!(beyond, TableError::Range { curve: 1, cell: 2 });
}

#[test]
fn no_inertia() {
    assert_eq!(with(3, 0), TableError::NoInertia { cell: 2 });
    assert_eq!(with(3, 1 << 16), TableError::NoInertia { cell: 2 });
    // Down to zero at the end of the cell, and below it only in its middle.
    assert_eq!(with(1, 0x8000_0000), TableError::NoInertia { cell: 2 });
    let dips = refused(|rows| {
        rows.words[14 + 1] = 0x8300_7d00;
        rows.words[14 + 3] = 0x1000_0000;
    });
    assert_eq!(dips, TableError::NoInertia { cell: 2 });
}

/// J takes ½; the remainder is exactly sufficient, or one unit too small.
#[test]
fn torque_beyond_the_range() {
    let beyond = TableError::TorqueRange { cell: 2 };
    let sound = |index: usize, word: u32| {
        let mut rows = good();
        rows.words[14 + index] = word;
        rows.try_table().is_ok()
    };
    let load = |units: u32| 0x8000_0000 | units;
    assert!(sound(3, load(0x3ffa)));
    assert_eq!(with(3, load(0x4000)), beyond);
    assert!(sound(2, 0x3ffa << 16));
    assert_eq!(with(2, 0x4000 << 16), beyond);
    assert_eq!(with(2, 0xc000 << 16), beyond);
    assert_eq!(with(4, 0x4000 << 16), beyond);
    assert_eq!(with(5, 0x4000 << 16), beyond);
    assert_eq!(with(5, 0xc000 << 16), beyond);
    let first = TableError::TorqueRange { cell: 0 };
    let constant = |change: fn(&mut RowConstants)| {
        let mut rows = good();
        rows.set = CONSTANT;
        let row = [0, 0, 0, 0x8000_0000, 2 << 29];
        rows.words = row.repeat(4);
        assert!(rows.try_table().is_ok());
        change(&mut rows.constants);
        rows.try_table().map(|_| ()).unwrap_err()
    };
    assert_eq!(constant(|constants| constants.viscous = 1 << 29), first);
    assert_eq!(constant(|constants| constants.viscous = i32::MIN), first);
    assert_eq!(constant(|constants| constants.coulomb = 1 << 30), first);
    assert_eq!(constant(|constants| constants.coulomb = i32::MIN), first);
    // Constants outside the set do not count.
    let mut rows = good();
    rows.constants.viscous = i32::MIN;
    rows.constants.coulomb = i32::MIN;
    assert!(rows.try_table().is_ok());
}

#[test]
fn another_reciprocal() {
    let refusal = TableError::Reciprocal { cell: 2 };
    for units in [0u32, 0x3f00, 0x4100, 0x8000, 0xffff] {
        let word = (units & 0xffff) << 16;
        // 2 % off: 2¹⁴·1.02 = 0x4148
        let within = (0x3f00..=0x4100).contains(&units);
        let mut rows = good();
        rows.words[14 + 6] = word;
        assert_eq!(rows.try_table().is_ok(), within, "{units:#x}");
    }
    assert_eq!(with(6, 0x4150 << 16), refusal);
    assert_eq!(with(6, 0x3eb0 << 16), refusal);
    // A line that leaves its range.
    assert_eq!(with(6, 0x4000_7fff), refusal);
    for shift in [12, 14, 16, u32::MAX] {
        assert_eq!(
            refused(|rows| rows.constants.shift = shift),
            TableError::Reciprocal { cell: 0 }
        );
    }
}

#[test]
fn a_model_of_another_set_span_or_scale() {
    let rows = good();
    let error = rows.try_model::<{ curves::LOAD }>(&rows.scale).map(|_| ());
    assert_eq!(error.unwrap_err(), TableError::Curves(SET));
    for to in [0.0, -1.0, f64::NAN] {
        let domain = Domain::Stroke { from: 0.0, to };
        let rows = Short { domain, ..good() };
        let error = rows.try_model::<SET>(&rows.scale).map(|_| ());
        assert_eq!(error.unwrap_err(), TableError::SpeedBase, "{to}");
    }
    let scale = scale_of(60.0, 11.0, 2.0);
    let wave = Wave {
        load: 3.0,
        ..Wave::bare(1.0, 0.25)
    };
    let rows = Short::of(&wave, curves::LOAD, 40, &scale).unwrap();
    let model = |domain: Domain, scale: &Scale| {
        let rows = Short {
            domain,
            ..rows.clone()
        };
        rows.try_model::<{ curves::LOAD }>(scale).map(|_| ())
    };
    assert!(model(Domain::Turn, &scale).is_ok());
    let longer = Domain::stroke(0.0, 1.1 * std::f64::consts::TAU).unwrap();
    let Err(TableError::Slope { cell }) = model(longer, &scale) else {
        panic!("accepted");
    };
    assert!(cell < 40);
    let faster = scale_of(60.0, 12.0, 2.0);
    let error = model(Domain::Turn, &faster).unwrap_err();
    assert!(matches!(error, TableError::Slope { .. }), "{error:?}");
    assert!(
        error
            .cure()
            .to_string()
            .contains("take the span and the scale"),
        "{error}"
    );
}

fn filled(machine: &impl Reducible, set: CurveSet, cells: u32, scale: &Scale) -> Error {
    Short::of(machine, set, cells, scale)
        .map(|_| ())
        .unwrap_err()
}

#[test]
fn machines_out_of_range() {
    let scale = scale_of(60.0, 11.0, 2.0);
    let wave = Wave::bare(1.0, 0.25);
    let base = |wave: &Wave, set: CurveSet| match filled(wave, set, 40, &scale) {
        Error::Table(TableError::Overflow { base, .. }) => base,
        other => panic!("{other}"),
    };
    assert_eq!(base(&Wave::bare(2.5, 0.25), 0), "inertia");
    let loaded = Wave { load: 70.0, ..wave };
    assert_eq!(base(&loaded, curves::LOAD), "torque");
    let viscous = Wave {
        viscous: 6.0,
        ..wave
    };
    assert_eq!(base(&viscous, curves::VISCOUS), "torque");
    let coulomb = Wave {
        coulomb: 150.0,
        ..wave
    };
    assert_eq!(base(&coulomb, curves::CONSTANT_COULOMB), "torque");
    // Each fits, but not all together.
    let loaded = Wave { load: 40.0, ..wave };
    assert!(matches!(
        filled(&loaded, curves::LOAD, 40, &scale),
        Error::Table(TableError::TorqueRange { .. })
    ));
    // J of less than two units.
    let light = Wave::bare(2e-5, 0.0);
    assert!(matches!(
        filled(&light, 0, 40, &scale),
        Error::Pose(PoseError::NoInertia { .. })
    ));
    assert!(matches!(
        filled(&light, curves::RECIPROCAL, 40, &scale),
        Error::Table(TableError::Reciprocal { .. }) | Error::Pose(PoseError::NoInertia { .. })
    ));
    assert_eq!(
        filled(&wave, 64, 40, &scale),
        Error::Table(TableError::Curves(64))
    );
    assert_eq!(
        filled(&wave, 0, 3, &scale),
        Error::Table(TableError::Cells(3))
    );
}

#[test]
fn buffers_and_requests() {
    let scale = scale_of(60.0, 11.0, 2.0);
    let wave = Wave::bare(1.0, 0.25);
    let (scratch, words) = (scratch_len(40, SET), words_len::<Rows16>(40, SET));
    for (scratch, words, needed, given) in [
        (scratch - 1, words, scratch, scratch - 1),
        (scratch, words - 1, words, words - 1),
    ] {
        let (mut scratch, mut words) = (vec![0.0; scratch], vec![0; words]);
        let error = fill::<Rows16>(&wave, SET, 40, &scale, &mut scratch, &mut words).map(|_| ());
        assert_eq!(
            error.unwrap_err(),
            Error::Range(RangeError::BufferTooShort { needed, given })
        );
    }
    let request = Request::new(0.0)
        .with_max_speed(10.0)
        .with_max_acceleration(20.0)
        .with_max_cells(40);
    let (mut scratch, mut words) = (vec![0.0; scratch], vec![0; words]);
    let error = tabulate::<Rows16>(&wave, SET, &request, &scale, &mut scratch, &mut words);
    assert_eq!(
        error.unwrap_err(),
        Error::Range(RangeError::NotPositive("torque error", 0.0))
    );
    // Checks of a table, for a table of its own.
    assert!(
        Short::plain(vec![0; 12], 0, 4, Domain::Turn)
            .try_table()
            .is_err()
    );
}

/// If 1/J is largest at the end of a stroke, the last cell is named.
#[test]
fn too_small_an_inertia_is_placed() {
    let scale = scale_of(60.0, 11.0, 2.0);
    for (slope, cell) in [(1.0, 0), (-1.0, 39)] {
        // J from 2e-5 to 1 kg·m² over the stroke, or back.
        let domain = Domain::stroke(0.0, 1.0).unwrap();
        let machine = Ramp { domain, slope };
        let error = filled(&machine, curves::RECIPROCAL, 40, &scale);
        assert_eq!(error, Error::Table(TableError::Reciprocal { cell }));
    }
}

struct Ramp {
    domain: Domain,
    slope: f64,
}

impl Reducible for Ramp {
    fn domain(&self) -> Domain {
        self.domain
    }
    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let along = if self.slope > 0.0 { phi } else { 1.0 - phi };
        Ok(Reduction::new([2e-5 + along, self.slope, 0.0]))
    }
}
