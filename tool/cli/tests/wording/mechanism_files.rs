//! Messages about mistakes in mechanisms, linkages and tables in machine files.

use super::machine_files::mistakes;

#[test]
fn mechanisms() {
    let edits = r#"
        180 mm => 25 mm
        offset = "0 mm" => offset = "-200 mm"
        type = "belt" => type = "ball-screw"\nlead = "10 mm"
        offset = "0 mm" => offset = "0 mm"\nstroke = ["90 deg", "10 deg"]
        offset = "0 mm" => offset = "0 mm"\nstroke = ["0 deg", "90 deg"]
    "#;
    mistakes("machine-mechanisms", "press.toml", "reduce", edits);
    let edits = r#"
        type = "disc-cam" => type = "disc-cam"\nstroke = ["0 deg", "90 deg"]
        rise = "30 mm" => rise = "20 mm"
        rise = "30 mm" => rise = "30 mm"\nreturn = "30 mm"
        dwell = "80 deg" => dwell = "60 deg"
        dwell = "80 deg" => dwell = "80 deg"\nlaw = "cycloidal"
        law = "modified-sine" => law = "polynomial-5"\nend_velocity = "20 mm/rad"
        base_radius = "45 mm" => base_radius = "5 mm"
        base_radius = "45 mm" => base_radius = "20 mm"
    "#;
    mistakes("machine-cams", "cam-translating.toml", "reduce", edits);
    let edits = r#"
        length = "60 mm" => length = "160 mm"
        pivot = ["210 mm", "-40 mm"] => pivot = ["210 mm", "-40 mm"]\nstroke = ["0 deg", "0 deg"]
        length = "220 mm" => length = "20 mm"
    "#;
    mistakes("machine-four-bars", "four-bar.toml", "reduce", edits);
    let edits = r#"
        at = "driver" => at = "output"
        ratio = -2.5 => ratio = "1:2"
        opposing_moment = "0.6 N m" => moment = "0.6 N m"
    "#;
    mistakes("machine-branches", "line-shaft.toml", "size", edits);
    let edits = r#"
        fixed = "ring" => fixed = "sun"
        teeth = 27 => teeth = 28
        count = 3 => count = 4
        count = 3 => count = 7
        teeth = 18 => teeth = 0
    "#;
    mistakes("machine-planetary-gears", "planetary.toml", "reduce", edits);
    let edits = r#"
        power_flow = "input-drives" =>
        slip = "1.5 %" => slip = "100 %"
        ratio = -1.5 => ratio = 0.0
    "#;
    mistakes(
        "machine-friction-drives",
        "friction-fan.toml",
        "reduce",
        edits,
    );
}

#[test]
fn change_points() {
    let edits = r#"
        keep_branch = true␣ => keep_branch = false
        ["240 mm", "0 mm"] }\nbody => ["260 mm", "0 mm"] }\nbody
        drawn_at = "90 deg" => drawn_at = "180 deg"
    "#;
    mistakes(
        "linkage-change-points",
        "elliptic-drive.toml",
        "check",
        edits,
    );
    let edits = r#"
        keep_branch = true␣ => keep_branch = false
        ["900 mm", "0 mm"] => ["890 mm", "0 mm"]
        keep_branch = true␣ => keep_branch = true\nstroke = ["10 deg", "10 deg"]␣
    "#;
    mistakes(
        "machine-change-points",
        "parallel-lift.toml",
        "reduce",
        edits,
    );
}

#[test]
fn linkages() {
    let edits = r#"
        ["crank.A" => ["krank.A"
        ["crank.A" => ["crank.X"
        ["ground.C", "rocker"] => ["rocker.B", "rocker"]
        ["ground.C", "rocker"] => ["rocker"]
        name = "coupler" => name = "crank"
        name = "ram" => name = "ground"
        angle = "65 deg" =>
        angle = "65 deg" => angle = "20 deg"
        inertia = "0.18 kg m^2" =>
        drive = "crank bearing" => drive = "crank"
        type = "prismatic" => type = "fixed"
        type = "prismatic" => type = "pin-in-slot"
        direction = "90 deg" =>
        { A = ["60 mm", "0 mm"] } => { A = ["360 mm", "0 mm"] }
        name = "ram"␣ => length = "1 m"\nname = "ram"␣
    "#;
    mistakes("machine-linkages", "linkage-press.toml", "reduce", edits);
}

#[test]
fn load_tables() {
    let edits = r#"
        table = "load-table.csv" => table = "none.csv"
        table = "load-table.csv" => table = "short.csv"
        table = "load-table.csv" => table = "twice.csv"
        table = "load-table.csv" => table = "unknown.csv"
        table = "load-table.csv" => table = "bare.csv"
        table = "load-table.csv" => table = "back.csv"
        table = "load-table.csv" => table = "word.csv"
        table = "load-table.csv" => table = "load-table.csv"\nforce = ["1 N", "0 N"]
    "#;
    mistakes("machine-load-tables", "load-table.toml", "reduce", edits);
    let edits = r#"
        outside = "zero" =>
        outside = "zero" => outside = "hold"
        outside = "zero" => outside = "zero"\ncurve = "straight"
        angle = "0 deg"\n =>
        angle = "0 deg" => angle = "0 deg"\nangle_on_link = "0 deg"
        on = "slider"\nangle => angle
        over = { point = "slider", along = "x", zero = "340 mm" } => over = { point = "slider", along = "y" }
        over = { point = "slider", along = "x", zero = "340 mm" } => over = { point = "slider" }
        over = { point = "slider", along = "x", zero = "340 mm" } => over = { point = "slider", along = "x" }
        over = { point = "slider", along = "x", zero = "340 mm" } =>
        table = "force-over-stroke.csv" => table = "load-table.csv"
        table = "force-over-stroke.csv" => table = "jump.csv"
        table = "force-over-stroke.csv" => table = "gap.csv"
        table = "force-over-stroke.csv" => table = "steps.csv"
        table = "force-over-stroke.csv" => table = "moment.csv"
        table = "force-over-stroke.csv" => table = "unsorted.csv"
    "#;
    mistakes(
        "machine-link-tables",
        "force-over-stroke.toml",
        "reduce",
        edits,
    );
}

#[test]
fn reduced_curves() {
    let edits = r#"
        range = "turn" => range = "stroke"
        range = "turn" =>
        file = "reduced-curves.csv" => file = "load-table.csv"
        close_within = "1 deg" =>
        smoothing = "20 Hz" => smoothing = "20 kHz"
    "#;
    mistakes("machine-curves", "reduced-curves.toml", "reduce", edits);
}
