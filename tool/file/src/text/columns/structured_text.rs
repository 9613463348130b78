//! Points of a cam in structured text, as CODESYS writes them: `(dX := 0, dY := 0, dV := 0, dA := 0), …` of the type `SMC_CAMXYVA`, with the first and
//! second derivatives of Y by X (SM3_Basic, `SMC_CAM_TYPE.XYVA`).

use crate::text::problem::{Problem, Result};

/// The components of a point.
pub(super) const TITLES: [&str; 4] = ["dX", "dY", "dV", "dA"];

/// The longest point (bytes).
const LONGEST: usize = 1000;

/// The points as rows of cells, each at the place that it has in the text; `None` for a text without points.
pub(super) fn points(text: &str) -> Result<Option<String>> {
    if !text.contains(":=") {
        return Ok(None);
    }
    let mut rows = vec![b' '; text.len()];
    let mut put = |place: usize, cell: &[u8]| {
        if let Some(cells) = rows.get_mut(place..place + cell.len()) {
            cells.copy_from_slice(cell);
        }
    };
    // The declaration above the first point is a comment.
    put(0, b"#");
    let mut found = false;
    for (open, _) in text.match_indices('(') {
        let mut ahead = text.bytes().skip(open + 1).take(LONGEST);
        let length = ahead.position(|byte| byte == b')').unwrap_or_default();
        let inner = text.get(open + 1..open + 1 + length).unwrap_or_default();
        let name = inner.split(":=").next().unwrap_or_default();
        if !inner.contains(":=") || !name.trim().eq_ignore_ascii_case(TITLES[0]) {
            continue;
        }
        found = true;
        put(open, b"\n");
        let parts = inner.split(',').zip(TITLES);
        let complete = inner.split(',').count() == TITLES.len();
        let mut place = open;
        for (k, (part, title)) in parts.enumerate() {
            let (name, value) = part.split_once(":=").unwrap_or((part, ""));
            if !complete || !name.trim().eq_ignore_ascii_case(title) {
                let end = open + 1 + inner.len();
                return Err(Problem::new(
                    "a point of the cam has other components than dX, dY, dV, dA",
                )
                .at(open..end, "this point")
                .help("write each point as (dX := 0, dY := 0, dV := 0, dA := 0)"));
            }
            if k > 0 {
                put(place, b",");
            }
            place += 1 + part.len();
            put(place - value.trim_start().len(), value.trim().as_bytes());
        }
    }
    Ok(found.then(|| String::from_utf8_lossy(&rows).into_owned()))
}
