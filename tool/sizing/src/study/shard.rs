//! A share of the rows of a study: every n-th row, so that each share has easy and hard machines.

use std::str::FromStr;

/// Share number `index` of `count`, from 0: rows index, index + count, …
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Shard {
    /// Index, from 0.
    pub index: u64,
    /// Number of shares.
    pub count: u64,
}

impl Shard {
    /// All rows.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Row number `k` of the share, as a row of the study.
    pub const fn row(self, k: u64) -> u64 {
        self.index + k * self.count
    }

    /// Number of rows in the share, of `rows` in total.
    pub const fn len(self, rows: u64) -> u64 {
        rows.saturating_sub(self.index).div_ceil(self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let shape = "write INDEX/COUNT, the index from 0: 0/8 to 7/8";
        let parts = text.split_once('/');
        let parsed =
            parts.and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
        let (index, count) = parsed.ok_or_else(|| format!("not a share; {shape}"))?;
        if count == 0 || index >= count {
            return Err(format!("there is no share {index} of {count}; {shape}"));
        }
        Ok(Self { index, count })
    }
}
