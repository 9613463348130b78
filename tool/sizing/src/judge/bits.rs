//! A set of rules, one bit each.

use jred_file::model::rule::Rule;

/// A set of rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RuleBits(u64);

const _: () = assert!(Rule::COUNT <= u64::BITS as usize, "a bit for each rule");

impl RuleBits {
    /// No rule.
    pub const NONE: Self = Self(0);

    /// Adds a rule.
    pub const fn add(&mut self, rule: Rule) {
        self.0 |= 1 << rule as u64;
    }

    /// Whether it contains a rule.
    pub const fn has(self, rule: Rule) -> bool {
        self.0 & 1 << rule as u64 != 0
    }

    /// Whether it contains no rule.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Number of rules.
    pub const fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The rules, in the order of reports.
    pub fn iter(self) -> impl Iterator<Item = Rule> {
        let mut rest = self.0;
        std::iter::from_fn(move || {
            let place = rest.trailing_zeros() as usize;
            rest &= rest.wrapping_sub(1);
            Rule::ALL.get(place).copied()
        })
    }
}
