//! `benches/ceilings.txt`: upper limits of figures, which must not fall far below them either.
#![allow(dead_code, reason = "every program uses its own part")]

use core::fmt;

/// A figure compared with the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Not above the ceiling, and not far below.
    Within(u64),
    /// Above the ceiling.
    Above(u64),
    /// Below half of the ceiling, which is then useless.
    Slack(u64),
    /// There is no ceiling for it.
    Missing,
}

impl Verdict {
    /// Whether the figure is acceptable.
    pub(crate) const fn holds(self) -> bool {
        matches!(self, Self::Within(_))
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Within(ceiling) => write!(f, "within its ceiling, {ceiling}"),
            Self::Above(ceiling) => write!(f, "FAILED: above its ceiling, {ceiling}"),
            Self::Slack(ceiling) => write!(
                f,
                "FAILED: less than half of its ceiling, {ceiling}: lower the ceiling"
            ),
            Self::Missing => write!(f, "FAILED: without a ceiling in benches/ceilings.txt"),
        }
    }
}

/// Compares a figure with the file's ceiling for this `core` and `name`.
pub(crate) fn judge(core: &str, name: &str, found: u64) -> Verdict {
    judge_by(include_str!("../ceilings.txt"), core, name, found)
}

/// Compares a figure with the `text` of the file: lines of core, name, ceiling.
pub(crate) fn judge_by(text: &str, core: &str, name: &str, found: u64) -> Verdict {
    let ceiling = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .find_map(|line| {
            let mut words = line.split_whitespace();
            let matches = words.next() == Some(core) && words.next() == Some(name);
            matches.then(|| words.next()?.parse::<u64>().ok())?
        });
    match ceiling {
        None => Verdict::Missing,
        Some(ceiling) if found > ceiling => Verdict::Above(ceiling),
        Some(ceiling) if 2 * found < ceiling => Verdict::Slack(ceiling),
        Some(ceiling) => Verdict::Within(ceiling),
    }
}
