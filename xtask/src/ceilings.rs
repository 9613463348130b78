//! `benches/ceilings.txt`: upper limits.

#[path = "../../benches/support/ceilings.rs"]
mod shared;

pub(crate) use shared::judge;

#[cfg(test)]
mod tests {
    use super::shared::{Verdict, judge_by as judge};

    #[test]
    fn a_figure_is_judged_from_both_sides() {
        let text = "# cortex-m4 a 1\ncortex-m4  a  100\ncortex-m4 a-bytes 256\n";
        for (found, verdict) in [
            (101, Verdict::Above(100)),
            (100, Verdict::Within(100)),
            (50, Verdict::Within(100)),
            (49, Verdict::Slack(100)),
        ] {
            assert_eq!(judge(text, "cortex-m4", "a", found), verdict);
        }
        assert_eq!(judge(text, "cortex-m4", "b", 1), Verdict::Missing);
        assert_eq!(
            judge(text, "cortex-m4", "a-bytes", 200),
            Verdict::Within(256)
        );
    }
}
