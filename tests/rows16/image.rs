//! Images of tables of 16-bit rows: word by word, round trip, and refusals.

use jred::image::{HEADER_WORDS, encode, image_len};
use jred::table::TableError;
use jred::{CurveSet, Domain, Image, ImageError, Phase, Rows16, Spline, curves};

use super::{Short, model, q15};
use crate::support::images::{VALIDITY, sealed, small};
use crate::support::machines::Wave;
use crate::support::scale_of;

const SET: CurveSet = super::CONSTANT;

fn wave(domain: Domain) -> Wave {
    Wave {
        mean: 1.0,
        swing: 0.25,
        load: 3.0,
        viscous: 0.1,
        coulomb: 0.5,
        domain,
    }
}

fn rows(domain: Domain) -> Short {
    let scale = scale_of(60.0, 11.0, 2.0);
    Short::of(&wave(domain), SET, 40, &scale).unwrap()
}

fn stroke() -> Domain {
    Domain::stroke(-0.5, 1.5).unwrap()
}

fn encoded(rows: &Short) -> Vec<u32> {
    let mut buffer = vec![u32::MAX; image_len::<Rows16>(rows.cells, rows.set) + 3];
    encode(&rows.table(), VALIDITY, &mut buffer)
        .unwrap()
        .to_vec()
}

#[test]
fn words_are_where_the_document_says() {
    let rows = rows(stroke());
    let image = encoded(&rows);
    assert_eq!(image.len(), HEADER_WORDS + rows.words.len() + 1);
    assert_eq!(image[3].to_le_bytes(), [3, SET as u8, 5, 1]);
    assert_eq!(image[4], 40);
    let constants = [
        rows.constants.shift,
        rows.constants.viscous.cast_unsigned(),
        rows.constants.coulomb.cast_unsigned(),
    ];
    assert_eq!(image[13..16], constants);
    assert_eq!(image[16..HEADER_WORDS], [0; HEADER_WORDS - 16]);
    assert_eq!(image[HEADER_WORDS..image.len() - 1], rows.words);
    assert_eq!(image, sealed(image.clone()));
    // Constants other than zero.
    assert!(constants.iter().all(|word| *word != 0), "{constants:?}");
}

#[test]
fn an_image_gives_the_same_bits() {
    for domain in [Domain::Turn, stroke()] {
        let rows = rows(domain);
        let image = encoded(&rows);
        let image = Image::new(&image).unwrap();
        assert_eq!(*image.scale(), rows.scale);
        assert_eq!((image.set(), image.cells()), (SET, 40));
        let [before, after] = [model::<SET>(&rows), image.model::<Rows16, SET>().unwrap()];
        assert_eq!(after.table().words(), rows.words);
        assert_eq!(*after.table().constants(), rows.constants);
        for k in 0..1000u32 {
            let phase = Phase::from_bits(k.wrapping_mul(0x9E37_79B9));
            let [omega, alpha] = [0x3C6E_F372, 0xDAA6_6D2B].map(|m: u32| k.wrapping_mul(m) as i16);
            let (omega, alpha) = (q15(omega), q15(alpha));
            let torque = before.torque(phase, omega, alpha);
            assert_eq!(after.torque(phase, omega, alpha), torque);
            assert_eq!(
                after.acceleration(phase, omega, torque),
                before.acceleration(phase, omega, torque)
            );
        }
    }
}

#[test]
fn other_images_are_refused() {
    let f32_image = small();
    let other = Image::new(&f32_image).unwrap();
    assert_eq!(
        other.table::<Rows16>().unwrap_err(),
        ImageError::NumberType(1)
    );
    let image = encoded(&rows(stroke()));
    let read = Image::new(&image).unwrap();
    assert_eq!(
        read.model::<Spline<f32>, SET>().unwrap_err(),
        ImageError::NumberType(3)
    );
    assert_eq!(
        read.model::<Rows16, { curves::LOAD }>().unwrap_err(),
        ImageError::Table(TableError::Curves(SET))
    );
    let with = |word: usize, value: u32| {
        let mut image = image.clone();
        image[word] = value;
        let image = sealed(image);
        Image::new(&image)
            .unwrap()
            .model::<Rows16, SET>()
            .unwrap_err()
    };
    assert_eq!(
        with(3, u32::from_le_bytes([3, SET as u8, 3, 1])),
        ImageError::Layout(3)
    );
    let table = ImageError::Table;
    assert_eq!(with(13, 16), table(TableError::Reciprocal { cell: 0 }));
    assert_eq!(
        with(15, 1 << 30),
        table(TableError::TorqueRange { cell: 0 })
    );
    assert_eq!(
        with(4, 39),
        table(TableError::Length {
            needed: 39 * 5,
            given: 40 * 5
        })
    );
    // With another speed base V is not the slope of J.
    assert!(matches!(
        with(8, 20f32.to_bits()),
        ImageError::Table(TableError::Slope { .. })
    ));
}

#[test]
fn a_buffer_too_short_is_refused() {
    let rows = rows(Domain::Turn);
    let needed = image_len::<Rows16>(rows.cells, rows.set);
    let mut buffer = vec![0; needed - 1];
    let found = encode(&rows.table(), VALIDITY, &mut buffer);
    let given = needed - 1;
    assert_eq!(
        found.unwrap_err(),
        ImageError::BufferTooShort { needed, given }
    );
}
