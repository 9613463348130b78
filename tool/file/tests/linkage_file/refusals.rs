//! Linkages that cannot work, and the words that tell the user which part and what to do.

use super::{FOUR_BAR, refuses, refuses_edit, refuses_edits};

#[test]
fn bodies_and_points() {
    let edits = r#"
        ["crank.A" => ["krank.A" => there is no such body | did you mean "crank"? | "ground", "crank", "coupler"
        ["crank.A" => ["crank.X" =>
            refers to the point "X", which "crank" does not have | points of "crank": A | "crank" alone is the origin
        "ground.C" => "ground.D" => which "ground" does not have | points of "ground": O, C
        ["ground.C", "rocker"] => ["rocker.B", "rocker"] => joins "rocker" to itself | two different bodies
        ["ground.C", "rocker"] => ["rocker"] => must have two ends, but has 1 | two joints
    "#;
    refuses_edits(FOUR_BAR, edits);
}

#[test]
fn names_and_keys() {
    let edits = r#"
        name = "coupler" => name = "crank" => two bodies have the name "crank" | the first | the second
        name = "coupler" => name = "ground" => is "ground", the name of the fixed frame
        name = "coupler" => name = "coup.ler" => contains a point
        name = "coupler pin" => name = "crank pin" => two joints have the name "crank pin"
        { O = ["0 mm", "0 mm"], C => { O = ["0 mm", "0 mm"], O => duplicate | remove or rename
        points = { A = ["80 mm", "0 mm"] } => length = "80 mm" =>
            unknown key `length` in [[mechanism.body]] number 1 | give its points
        angle = "50 deg"\n => => `angle` of body "coupler" is missing | angle = "30 deg"
        inertia = "0.006 kg m^2"\n => => `inertia` of body "coupler" is missing, and the body turns
        mass = "0.9 kg"\n => => `mass` in [[mechanism.body]] number 2 is missing
        between = ["crank.A", "coupler"] => type = "revolut"\nbetween = ["crank.A", "coupler"] =>
            did you mean "revolute"? | "pin-in-slot"
        between = ["crank.A", "coupler"] => between = ["crank.A", "coupler"]\nradius = "1 mm" =>
            unknown key `radius` in [[mechanism.joint]] number 2 | a rack has the radius
    "#;
    refuses_edits(FOUR_BAR, edits);
    let edits = r#"
        [[mechanism.joint]] => [[mechanism.body]]\nname = "strut"\nmass = "1 kg"\nangle = "0 deg"\n\n[[mechanism.joint]] =>
            no joint connects body "strut" | never used
    "#;
    refuses_edits(FOUR_BAR, edits);
    let two = "[[mechanism.body]]\nname = \"a\"\nmass = \"1 kg\"\nangle = \"0 deg\"\n\n[[mechanism.body]]\nname = \"b\"\nmass = \"1 kg\"\n\
               angle = \"0 deg\"\n\n[[mechanism.joint]]\nbetween = [\"a\", \"b\"]\n\n[[mechanism.joint]]";
    refuses_edit(
        FOUR_BAR,
        "[[mechanism.joint]]",
        two,
        &[
            "nothing connects body \"a\" with the ground",
            "floats freely",
        ],
    );
}

#[test]
fn drives() {
    let edits = r#"
        drive = "crank bearing" => drive = ["crank bearing", "rocker bearing"] => is a list, but a linkage has only one drive
        drive = "crank bearing" => drive = "crank bearing"\ndrive = "rocker bearing" => duplicate key
        drive = "crank bearing" => drive = "crank" =>
            "crank", which is not a valid choice here | "crank bearing", "crank pin"
        drive = "crank bearing" => => `drive` in [mechanism] is missing | drive = "crank bearing"
        between = ["ground.O", "crank"] => between = ["ground.O", "crank"]\ntype = "fixed" =>
            is "crank bearing", of type "fixed" | cannot be driven
        drive = "crank bearing" => drive = "crank bearing"\nstroke = ["60 deg", "-30 deg"] =>
            runs from 60 deg to -30 deg | the second end must be the larger one
        drive = "crank bearing" => drive = "crank bearing"\nstroke = ["10 mm", "30 mm"] =>
            must be an angle, but "10 mm" is a length
    "#;
    refuses_edits(FOUR_BAR, edits);
}

#[test]
fn freedoms_are_counted_joint_by_joint() {
    let last =
        "[[mechanism.joint]]\nname = \"rocker bearing\"\nbetween = [\"ground.C\", \"rocker\"]\n";
    let edits = r#"
        [[mechanism.joint]]\nname = "rocker bearing"\nbetween = ["ground.C", "rocker"]\n => =>
            3 degrees of freedom, not one: 3·3 − 6 = 3 | "crank bearing" 2, "crank pin" 2, "coupler pin" 2 |
            can still move independently
    "#;
    refuses_edits(FOUR_BAR, edits);
    let twice = format!(
        "{last}\n[[mechanism.joint]]\nname = \"stay\"\nbetween = [\"ground.O\", \"rocker.B\"]\n"
    );
    refuses_edit(
        FOUR_BAR,
        last,
        &twice,
        &[
            "-1 degrees of freedom, not one: 3·3 − 10 = -1",
            "\"stay\" 2",
            "remove one",
        ],
    );
    // As many equations as coordinates, but badly shared out.
    let strut = FOUR_BAR.replace(
        last,
        &format!(
            "{last}\n[[mechanism.joint]]\nname = \"strut pin\"\nbetween = [\"ground.O\", \"strut\"]\n\n[[mechanism.joint]]\n\
             name = \"peg\"\ntype = \"pin-in-slot\"\nbetween = [\"crank.A\", \"rocker\"]\ndirection = \"0 deg\"\n"
        ),
    );
    let strut = strut.replacen(
        "[[mechanism.joint]]",
        "[[mechanism.body]]\nname = \"strut\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\nangle = \"0 deg\"\n\n[[mechanism.joint]]",
        1,
    );
    refuses(
        &strut,
        &[
            "joint \"crank bearing\" is driven, but the other joints leave it no degree of freedom, while \"strut\" can still move",
            "one that constrains \"strut\"",
        ],
    );
}

#[test]
fn what_cannot_be_assembled_or_driven_round() {
    // The rocker is too short to reach the coupler.
    let edits = r#"
        points = { B = ["180 mm", "0 mm"] } => points = { B = ["18 mm", "0 mm"] } =>
            cannot be assembled at φ = 0 deg | a gap of | ␣mm | check the angles of "coupler" and "rocker" in the drawing |
            the largest gap in the drawing is
    "#;
    refuses_edits(FOUR_BAR, edits);
    // A crank of 200 mm: |OC|² + a² − 2·a·|OC|·cos φ = (b + c)² at φ = acos(−0.4575).
    let edits = r#"
        points = { A = ["80 mm", "0 mm"] } => points = { A = ["200 mm", "0 mm"] } =>
            the drive "crank bearing" reaches a dead point at φ = 117.22 | can move from -117.23 deg to 117.23 deg |
            stroke = ["-94 deg", "94 deg"]
    "#;
    refuses_edits(FOUR_BAR, edits);
    // With the stroke that the message proposes it works.
    let driven = FOUR_BAR
        .replace(
            "{ A = [\"80 mm\", \"0 mm\"] }",
            "{ A = [\"200 mm\", \"0 mm\"] }",
        )
        .replace(
            "drive = \"crank bearing\"",
            "drive = \"crank bearing\"\nstroke = [\"-94 deg\", \"94 deg\"]",
        );
    assert!(crate::linkage_file::parse(&driven).is_ok());
}

#[test]
fn a_parallelogram_changes_its_branch() {
    let text = FOUR_BAR
        .replace("B = [\"250 mm\", \"0 mm\"]", "B = [\"300 mm\", \"0 mm\"]")
        .replace("B = [\"180 mm\", \"0 mm\"]", "B = [\"80 mm\", \"0 mm\"]")
        .replace("angle = \"50 deg\"", "angle = \"2 deg\"")
        .replace("angle = \"0 deg\"", "angle = \"90 deg\"")
        .replace("angle = \"100 deg\"", "angle = \"88 deg\"");
    let report = match crate::linkage_file::parse(&text) {
        Err(report) => crate::reading::rendered(&report),
        Ok(_) => panic!("accepted"),
    };
    let named = report.contains("φ = 0 deg and φ = 180 deg, a change point");
    assert!(named && report.contains("keep_branch = true"), "{report}");
}
