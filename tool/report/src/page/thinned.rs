//! Thinning of long courses for charts.

/// Courses up to this length are drawn in full. A plot is 700 pixels wide; zoomed in ten times it still shows such a course in full.
const WHOLE: usize = 8000;

/// Parts of a longer course; the ends and the extremes of every value are kept in each.
const PARTS: usize = 1500;

/// Rising indices of the points to draw out of `count`: all of them, or a subset that contains the extremes of each of the `values` at an index.
pub(super) fn kept(count: usize, values: &[&dyn Fn(usize) -> f64]) -> Vec<usize> {
    if count <= WHOLE {
        return (0..count).collect();
    }
    let mut kept = Vec::new();
    for part in 0..PARTS {
        let (from, to) = (part * count / PARTS, (part + 1) * count / PARTS);
        let first = kept.len();
        kept.extend([from, to - 1]);
        for value in values {
            let (mut least, mut most) = ((f64::INFINITY, from), (f64::NEG_INFINITY, from));
            for place in from..to {
                let here = value(place);
                if here < least.0 {
                    least = (here, place);
                }
                if here > most.0 {
                    most = (here, place);
                }
            }
            kept.extend([least.1, most.1]);
        }
        kept[first..].sort_unstable();
    }
    kept.dedup();
    kept
}

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use super::*;

    #[test]
    fn a_short_course_is_whole() {
        let level = |_: usize| 1.0;
        assert_eq!(kept(WHOLE, &[&level]), (0..WHOLE).collect::<Vec<_>>());
        assert!(kept(0, &[&level]).is_empty());
    }

    /// A single peak in one value and a single dip in another are both kept, with the ends, out of a million points.
    #[test]
    fn the_extremes_of_every_value_are_kept() {
        const COUNT: usize = 1_000_000;
        let up = |k: usize| if k == 123_457 { 2.0 } else { (k as f64).sin() };
        let down = |k: usize| if k == 765_432 { -9.0 } else { k as f64 };
        let kept = kept(COUNT, &[&up, &down]);
        assert!(kept.is_sorted_by(|a, b| a < b));
        for place in [0, 123_457, 765_432, COUNT - 1] {
            assert!(kept.contains(&place), "{place}");
        }
        assert!(kept.len() <= 6 * PARTS, "{}", kept.len());
        // No gap is wider than a part.
        assert!(
            kept.windows(2)
                .all(|two| two[1] - two[0] <= COUNT / PARTS + 1)
        );
    }

    /// NaN hides no extreme.
    #[test]
    fn gaps_do_not_hide_extremes() {
        let value = |k: usize| {
            if k.is_multiple_of(3) {
                f64::NAN
            } else {
                -((k as f64) - 5000.0).abs()
            }
        };
        assert!(kept(2 * WHOLE, &[&value]).contains(&5000));
    }
}
