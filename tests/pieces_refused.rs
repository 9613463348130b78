//! Pieces of a turn: mapping of phases, and refusals.

use std::f64::consts::TAU;

use crate::support::machines::Wave;
use crate::support::rows::Rows;
use crate::support::{budget, config, scale_of};
use jred::machine::{Reducible, Reduction};
use jred::table::TableError;
use jred::tabulate::Part;
use jred::{CurveSet, Domain, Phase, Pieces, Scale, Spline, curves};
use proptest::prelude::*;

const SET: CurveSet = curves::LOAD;

/// A load that grows linearly from 0 to 1 over a stroke of this length, which a spline follows exactly: the torque is minus the position in the
/// piece.
struct Ruler(f64);

impl Reducible for Ruler {
    fn domain(&self) -> Domain {
        Domain::Stroke {
            from: 0.0,
            to: self.0,
        }
    }

    fn reduction(&self, x: f64) -> Result<Reduction, jred::machine::PoseError> {
        Ok(Reduction::new([1.0, 0.0, 0.0]).with_process(x / self.0))
    }
}

/// Compares the position in the piece of every phase with exact arithmetic, in units of 2⁻³² of the piece.
fn maps<const N: usize>(starts: [u32; N], phases: impl Iterator<Item = u32>) {
    const WHOLE: u64 = 1 << 32;
    let length = |k: usize| match starts[(k + 1) % N].wrapping_sub(starts[k]) {
        0 => WHOLE,
        length => u64::from(length),
    };
    let rows: Vec<_> = (0..N)
        .map(|k| {
            let ruler = Ruler(length(k) as f64 / WHOLE as f64);
            Rows::<Spline<f64>>::of(&ruler, SET, 4, &Scale::SI).unwrap()
        })
        .collect();
    let models = std::array::from_fn(|k| {
        let model = rows[k].model::<SET>(&Scale::SI);
        (Phase::from_bits(starts[k]), model)
    });
    // The ruler is as long as a stroke of 1.
    let domain = Domain::stroke(0.0, 1.0).unwrap();
    let turn: Pieces<'_, Spline<f64>, SET, N> = Pieces::new(domain, models).unwrap();
    let ends = starts
        .iter()
        .flat_map(|s| [s.wrapping_sub(1), *s, s.wrapping_add(1)]);
    for bits in phases.chain(ends).chain([0, u32::MAX]) {
        let piece = (0..N)
            .find(|k| u64::from(bits.wrapping_sub(starts[*k])) < length(*k))
            .unwrap();
        let beyond = i128::from(bits.wrapping_sub(starts[piece]));
        let found = -turn.torque(Phase::from_bits(bits), 0.0, 0.0) * WHOLE as f64;
        assert!((found - found.round()).abs() < budget::RULER, "{found}");
        let found = found.round() as i128;
        // found/2³² − beyond/length, times both.
        let length = i128::from(length(piece));
        let apart = found * length - (beyond << 32);
        assert!(
            apart <= length && apart >= -2 * length,
            "{bits:08x} in piece {piece} of {starts:08x?}: {found}, off by {apart} / {length}"
        );
        if beyond == 0 {
            assert_eq!(found, 0, "a piece starts with its model");
        }
    }
}

#[test]
fn phases_at_the_edges_of_pieces() {
    for start in [0, 1, 0x8000_0000, u32::MAX] {
        maps([start], 0..1000);
    }
    maps([0, 0x8000_0000], 0..1000);
    maps([0x4000_0000, 0xc000_0000], 0..1000);
    // The shortest possible piece, at both ends of the turn.
    maps([0, 0x1_0000], 0x8000..0x1_8000);
    maps([0x1234, 0xffff_1234], (0xffff_0000..u32::MAX).step_by(7));
}

proptest! {
    #![proptest_config(config(256, 0x0091))]

    #[test]
    fn phases_are_mapped_to_2_31_of_a_piece(
        starts: [u32; 5],
        phases in prop::collection::vec(any::<u32>(), 64),
    ) {
        let mut starts = starts;
        starts.sort_unstable();
        let short = (0..5).any(|k| starts[(k + 1) % 5].wrapping_sub(starts[k]) < 1 << 16);
        prop_assume!(!short);
        maps([starts[0]], phases.iter().copied());
        maps([starts[0], starts[3]], phases.iter().copied());
        maps(starts, phases.into_iter());
    }
}

#[test]
fn parts_that_are_not_possible() {
    let wave = Wave::bare(1.0, 0.25);
    for (from, to, words) in [
        (f64::NAN, 1.0, "start of the part is not a finite number"),
        (0.0, f64::INFINITY, "end of the part is not a finite number"),
        (1.0, 1.0, "length of the part is 0"),
        (2.0, 1.0, "length of the part is -1"),
        (0.0, 6.3, "length of the part is 6.3"),
    ] {
        let error = Part::new(&wave, from, to).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    let turn = Part::new(&wave, 1.0, 1.0 + TAU).unwrap();
    assert!(turn.turns());
    assert_eq!(turn.start().to_bits(), 1f64.to_bits());
}

/// A quarter of a turn.
const QUARTER: u32 = 1 << 30;

#[test]
fn pieces_that_do_not_belong_together() {
    let part = |k: f64, length: f64| {
        let wave = Wave::bare(1.0, 0.25);
        let part = Part::new(&wave, k, k + length).unwrap();
        Rows::<Spline<f64>>::of(&part, curves::INERTIA, 8, &Scale::SI).unwrap()
    };
    let quarters = [0.0, 0.25, 0.5, 0.75].map(|k| part(k * TAU, 0.25 * TAU));
    let models = quarters.each_ref().map(|rows| rows.model::<0>(&Scale::SI));
    let pieces = |starts: [u32; 4]| {
        let models = std::array::from_fn(|k| (Phase::from_bits(starts[k]), models[k]));
        Pieces::<_, 0, 4>::new(Domain::Turn, models)
    };
    let right = [0, QUARTER, 2 * QUARTER, 3 * QUARTER];
    assert!(pieces(right).is_ok());
    assert!(pieces(right.map(|start| start + 77)).is_ok());
    for wrong in [
        [0, QUARTER, QUARTER, 3 * QUARTER],
        [QUARTER, 0, 2 * QUARTER, 3 * QUARTER],
        [3 * QUARTER, 0, QUARTER, 2 * QUARTER],
        [0, 0xffff, 2 * QUARTER, 3 * QUARTER],
        [0, QUARTER, 2 * QUARTER, u32::MAX - 0xfffe],
    ] {
        assert_eq!(pieces(wrong).unwrap_err(), TableError::Pieces, "{wrong:x?}");
    }
    // Models whose length differs from their pieces.
    for wrong in [
        [0, QUARTER + QUARTER / 1000, 2 * QUARTER, 3 * QUARTER],
        [0, QUARTER, 2 * QUARTER, 3 * QUARTER + QUARTER / 2],
    ] {
        assert_eq!(
            pieces(wrong).unwrap_err(),
            TableError::PieceUnits,
            "{wrong:x?}"
        );
    }
    // One with other units.
    let halves = [part(0.0, 0.5 * TAU), part(0.5 * TAU, 0.5 * TAU)];
    let doubled = scale_of(1.0, 2.0, 1.0);
    let together = |domain, scale| {
        let models = [
            (Phase::from_bits(0), halves[0].model::<0>(&Scale::SI)),
            (Phase::from_bits(1 << 31), halves[1].model::<0>(scale)),
        ];
        Pieces::new(domain, models)
    };
    let error = together(Domain::Turn, &doubled).unwrap_err();
    assert_eq!(error, TableError::PieceUnits);
    assert!(
        error.cure().to_string().contains("same machine units"),
        "{error}"
    );
    // With another range than the whole.
    assert!(together(Domain::Turn, &Scale::SI).is_ok());
    let shorter = Domain::stroke(0.0, 6.0).unwrap();
    assert_eq!(
        together(shorter, &Scale::SI).unwrap_err(),
        TableError::PieceUnits
    );
    let none: [(Phase, jred::Model<'_, Spline<f64>, 0>); 0] = [];
    assert_eq!(
        Pieces::<_, 0, 0>::new(Domain::Turn, none).unwrap_err(),
        TableError::Pieces
    );
}
