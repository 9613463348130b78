//! Play at the tool: the tool moved through the play by hand.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;

use super::{Stand, near, press_text};
use jred_report::list::rule_words::note;

/// x of the press's ram, from its triangle.
fn ram(phi: f64) -> f64 {
    let (r, l) = (0.03f64, 0.18f64);
    r * phi.cos() + (l * l - (r * phi.sin()).powi(2)).sqrt()
}

#[test]
fn the_ram_has_play() {
    let arcmin = std::f64::consts::PI / 10_800.0;
    for (section, own) in [
        ("", 0.0),
        ("[stiffness]\nbacklash = \"6 arcmin\"", 6.0 * arcmin / 3.0),
        (
            "[stiffness]\nbacklash = \"0.05 deg\"\nat = \"drive-link\"",
            0.05f64.to_radians(),
        ),
    ] {
        let text = format!(
            "{}\n[tool]\npoint = \"slider\"\nplay = \"0.05 mm\"\n{section}\n",
            press_text()
        );
        let mut stand = Stand::new(&text);
        stand.gearbox.backlash = Some(8.0 * arcmin);
        // The belt makes a third of it at the crank; the ram moves by the difference over the play, everywhere in the stroke.
        let play = 8.0 * arcmin / 3.0 + own;
        let most = (0..36_000)
            .map(|k| f64::from(k).to_radians() / 100.0)
            .map(|phi| (ram(phi + 0.5 * play) - ram(phi - 0.5 * play)).abs())
            .fold(0.0, f64::max);
        let found = stand.found(true, Rule::Backlash);
        near("play", found.value, most, 1e-5);
        assert_eq!(found.rating, 5e-5);
        let check = stand.check(true, &stand.file.rules, Rule::Backlash);
        near("in mm", check.value.unwrap(), 1e3 * most, 1e-5);
        assert_eq!((check.unit, check.limit), ("mm", Some(0.05)));
        assert_eq!(check.verdict == RuleVerdict::Fail, most > 5e-5);
        let assumed = "; backlash of the drive train not given; using none";
        assert_eq!(
            note(&check).contains(assumed),
            own == 0.0,
            "{}",
            note(&check)
        );
        // Without a gearbox only the drive train's own.
        near(
            "direct",
            stand.found(false, Rule::Backlash).value,
            most * own / play,
            1e-5,
        );
        stand.gearbox.backlash = None;
        assert_eq!(
            stand.check(true, &stand.file.rules, Rule::Backlash).verdict,
            RuleVerdict::NotChecked
        );
    }
    // Without a tool the rule does not apply.
    let stand = Stand::press();
    assert!(
        stand
            .finding(true, &stand.file.rules, Rule::Backlash)
            .is_none()
    );
}

/// A turning link: its angle has the play.
#[test]
fn the_rod_has_play() {
    let text = format!(
        "{}\n[tool]\nlink = \"rod\"\nplay = \"0.1 deg\"\n",
        press_text()
    );
    let mut stand = Stand::new(&text);
    stand.gearbox.backlash = Some(1e-3);
    // sin ψ = −r/l·sin φ: |ψ′| is largest, r/l, at the dead centres.
    let found = stand.found(true, Rule::Backlash);
    near("play", found.value, 1e-3 / 3.0 * 30.0 / 180.0, 1e-6);
    let check = stand.check(true, &stand.file.rules, Rule::Backlash);
    assert_eq!(check.unit, "deg");
    near("limit", check.limit.unwrap(), 0.1, 1e-12);
}
