//! `benches/ceilings.txt`: what may not be exceeded.

use std::fmt;

/// What the file says about a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Not above the ceiling, and not far below.
    Within,
    Above(u32),
    /// Below half of the ceiling, which is of no use any more.
    Slack(u32),
    Missing,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Within => write!(f, "within its ceiling"),
            Self::Above(ceiling) => write!(f, "above its ceiling, {ceiling}"),
            Self::Slack(ceiling) => write!(
                f,
                "less than half of its ceiling, {ceiling}: lower the ceiling"
            ),
            Self::Missing => write!(f, "without a ceiling in benches/ceilings.txt"),
        }
    }
}

/// Judges a figure by the `text` of the file: lines of core, name, ceiling.
pub(crate) fn judge(text: &str, core: &str, name: &str, found: u32) -> Verdict {
    let ceiling = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .find_map(|line| {
            let mut words = line.split_whitespace();
            let matches = words.next() == Some(core) && words.next() == Some(name);
            matches.then(|| words.next()?.parse::<u32>().ok())?
        });
    match ceiling {
        None => Verdict::Missing,
        Some(ceiling) if found > ceiling => Verdict::Above(ceiling),
        Some(ceiling) if 2 * found < ceiling => Verdict::Slack(ceiling),
        Some(_) => Verdict::Within,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_is_judged_from_both_sides() {
        let text = "# cortex-m4 a 1\ncortex-m4  a  100\ncortex-m4 a-bytes 256\n";
        for (found, verdict) in [
            (101, Verdict::Above(100)),
            (100, Verdict::Within),
            (50, Verdict::Within),
            (49, Verdict::Slack(100)),
        ] {
            assert_eq!(judge(text, "cortex-m4", "a", found), verdict);
        }
        assert_eq!(judge(text, "cortex-m4", "b", 1), Verdict::Missing);
        assert_eq!(judge(text, "cortex-m4", "a-bytes", 200), Verdict::Within);
    }
}
