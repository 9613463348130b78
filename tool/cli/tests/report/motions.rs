//! Pages about motions: fastest, gentlest, steady.

use super::{check_nesting, check_plots, check_self_contained, plots};
use crate::support::{Folder, jred_with, press_file, typed};

/// The page that a command writes.
fn page(arguments: &[&str]) -> String {
    let folder = Folder::new();
    let path = folder.path("page.html");
    let press = press_file();
    let mut all = vec![arguments[0], press.to_str().unwrap()];
    all.extend(&arguments[1..]);
    all.extend(["--report", path.to_str().unwrap()]);
    let code = jred_with(&all).code;
    assert!(code < 2, "{code}");
    let page = std::fs::read_to_string(&path).unwrap();
    check_self_contained(&page);
    check_nesting(&page);
    assert!(page.len() < 1_500_000, "{}", page.len());
    assert!(page.contains("size: A4; margin"));
    page
}

/// The phase plane names every active limit, in a colour of its own, and the speeds that cannot be exceeded.
#[test]
fn the_phase_plane_names_the_limits() {
    let page = page(&typed(
        "fastest --torque '50 N m' --motor-speed '3000 rpm' --max-speed '28 rad/s' --max-acceleration '220 rad/s^2'",
    ));
    check_plots(&page, 5);
    let plane = plots(&page)[0];
    let limits = [
        "acceleration limit",
        "speed limit",
        "motor torque (driving)",
        "deceleration limit",
    ];
    for name in limits {
        assert!(plane.contains(name), "{name}");
        assert!(
            page.matches(name).count() >= 2,
            "{name} in the list as well"
        );
    }
    assert!(!plane.contains("motor torque (braking)"));
    assert!(plane.contains("largest speed"));
    // A legend key and a curve each.
    for colour in ["#0072B2", "#D55E00", "#009E73", "#CC79A7"] {
        assert!(plane.matches(colour).count() >= 2, "{colour}");
    }
    assert!(page.contains("without the acceleration limit"));
}

/// The gentlest motion is shown with that of the file and the laws.
#[test]
fn the_gentlest_motion_stands_beside_the_laws() {
    let page = page(&["gentlest"]);
    check_plots(&page, 4);
    for plot in plots(&page) {
        for name in ["gentlest", "as in the file", "modified-trapezoid"] {
            assert!(plot.contains(name), "{name}");
        }
    }
}

/// The course without and with the flywheel.
#[test]
fn a_steady_cycle_is_drawn_with_its_flywheel() {
    let with = page(&["steady", "--delta", "0.05"]);
    // Speed, torque, and the energies of each.
    check_plots(&with, 4);
    assert!(plots(&with)[0].contains("with the flywheel"));
    let without = page(&["steady"]);
    check_plots(&without, 3);
    assert!(!without.contains("with the flywheel"));
}
