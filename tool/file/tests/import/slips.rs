//! Files as programs and people leave them: read where they can be meant in one way only, else refused with the line to write.

use super::forms::{read, refused, worst};
use crate::reader;
use crate::reading::rendered;

/// Rows of a steady turn, 1 deg in each s.
fn steady(header: &str, separator: char) -> String {
    let rows = (0..6).map(|k| format!("{k}{separator}{k}\n"));
    format!("{header}\n{}", rows.collect::<String>())
}

#[track_caller]
fn is_steady(csv: &str, keys: &str) {
    let motion = read(csv, &format!("cyclic = false\n{keys}")).unwrap_or_else(|e| panic!("{e}"));
    assert!((motion.duration() - 5.0).abs() < 1e-12);
    for k in 0..=10 {
        let (t, state) = (0.5 * f64::from(k), motion.at(0.5 * f64::from(k)));
        assert!((state.phi - t.to_radians()).abs() < 1e-12);
        assert!((state.omega - 1_f64.to_radians()).abs() < 1e-12);
    }
}

#[test]
fn what_a_spreadsheet_adds() {
    let plain = steady("t [s];phi [deg]", ';');
    is_steady(&plain, "");
    // The line that names the separator, an empty column, empty rows, a row of separators between.
    is_steady(&format!("sep=;\n{plain}"), "");
    is_steady(
        &format!("\u{feff}sep=;\r\n{}", plain.replace('\n', "\r\n")),
        "",
    );
    is_steady(&plain.replace('\n', ";\n"), "");
    is_steady(&format!("{plain};\n;\n"), "");
    is_steady(&plain.replace("3;3", ";\n3;3"), "");
    // Whatever is measured otherwise is passed over.
    let more = steady("t [s];phi [deg]", ';').replace('\n', ";0,5;x\n");
    let more = more
        .replacen("0,5;x", "torque [N m];current [A rms]", 1)
        .replace(";x", ";1");
    is_steady(&more, "");
    let bare = more.replacen("torque [N m]", "torque", 1);
    refused(
        &bare,
        "",
        &[
            "unknown column \"torque\"",
            "columns = { time = \"t [s]\", position = \"phi [deg]\" }",
        ],
    );
    refused(
        &plain.replace('\n', ";\n").replace("2;2;", "2;2;7"),
        "",
        &["column 3 has no title", "label at line 4, column 5"],
    );
}

/// A column that is passed over is named where one is missing.
#[test]
fn columns_of_other_units_are_named() {
    refused(
        &steady("t [s];Weg [mm]", ';'),
        "",
        &[
            "must have a column for the position",
            "not read: \"Weg [mm]\"",
        ],
    );
}

/// Latin-1, as a spreadsheet saves "CSV", and UTF-16, as it saves "Unicode text".
#[test]
fn other_encodings_are_read() {
    let text = steady("t [s]\tphi [°]", '\t');
    let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
    let wide = |bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        let marked = format!("\u{feff}{text}");
        marked.encode_utf16().flat_map(bytes).collect()
    };
    let parsed = |bytes: &[u8]| {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("record.csv"), bytes).unwrap();
        let machine = format!("{}cyclic = false\n", super::forms::MACHINE);
        reader::parse("machine.toml", &machine, folder.path()).map_err(|report| rendered(&report))
    };
    for bytes in [
        latin.clone(),
        wide(u16::to_le_bytes),
        wide(u16::to_be_bytes),
    ] {
        let motion = parsed(&bytes).unwrap().motion.unwrap();
        assert!((motion.at(2.5).phi - 2.5_f64.to_radians()).abs() < 1e-12);
    }
    let mut other = latin;
    other.push(0x81);
    let report = parsed(&other).map(|_| ()).unwrap_err();
    assert!(report.contains("not UTF-8 text: line 1"), "{report}");
    let half = [0xff, 0xfe, 0x00, 0xd8, b't', 0];
    let report = parsed(&half).map(|_| ()).unwrap_err();
    assert!(report.contains("begins as UTF-16"), "{report}");
}

#[test]
fn titles_below_other_lines() {
    for above in [
        "Plot 1\n",
        "Plot 1\nmade by, x\n\n",
        "Plot,\nmade by, someone\n",
        "Plot 1\n# a comment\n\n",
    ] {
        let csv = format!("{above}{}", steady("Time (s),Angle (deg)", ','));
        let lines = above.lines().count();
        let asked = format!("skip_rows = {lines}");
        refused(
            &csv,
            "",
            &[
                "the titles of the columns are not in the first line",
                &asked,
                "[motion]",
            ],
        );
        is_steady(&csv, &asked);
    }
    let units = format!("Plot 1\n{}", steady("Time,Angle\n[s],[deg]", ','));
    refused(&units, "", &["but in line 2", "skip_rows = 1"]);
    is_steady(&units, "skip_rows = 1");
    refused(
        &steady("t [s]   phi [deg]", ' '),
        "",
        &["separated by spaces", "semicolons, commas or tabs"],
    );
}

/// A title that two columns have, and a quantity that two columns are given for.
#[test]
fn one_column_for_one_quantity() {
    let csv = steady("Time (s),X (deg)", ',').replace('\n', ",0,7\n");
    let csv = csv.replacen(",0,7", ",Time (s),X (deg)", 1);
    let columns = "columns = { time = \"Time (s)\", position = \"X (deg)\" }";
    let cure =
        "skip_rows = 1 and header = [\"Time [s]\", \"X [deg]\", \"Time 2 [s]\", \"X 2 [deg]\"]";
    refused(
        &csv,
        columns,
        &[
            "`time` in [motion.columns] is the title of columns 1 and 3",
            cure,
        ],
    );
    let own = format!(
        "{}\ncolumns = {{ time = \"Time\", position = \"X\" }}",
        cure.replace(" and ", "\n")
    );
    is_steady(&csv, &own);
    refused(
        "a,b,c\n0,0,0\n1,1,1\n2,2,2\n3,3,3\n4,4,4\n",
        "columns = { time = \"a [s]\", phi = \"b [deg]\", position = \"c [deg]\" }",
        &["`position` in [motion.columns] names a second column for its quantity"],
    );
    refused(
        "t [s],phi [deg],angle [deg]\n0,0,0\n",
        "",
        &["duplicate column \"angle\""],
    );
}

/// A unit in the machine file that does not fit is shown there.
#[test]
fn units_that_do_not_fit() {
    let csv = steady("a,b", ',');
    refused(
        &csv,
        "columns = { time = \"a [s]\", position = \"b [N]\" }",
        &[
            "`position` in [motion.columns] must be an angle, but \"N\" is a force",
            "snippet for machine.toml",
        ],
    );
    refused(
        &csv,
        "columns = { time = \"a [s]\", position = \"b [grad]\" }",
        &[
            "`position` in [motion.columns]",
            "unknown unit",
            "snippet for machine.toml",
        ],
    );
    refused(
        &steady("t [s],phi [N m]", ','),
        "",
        &[
            "the column \"phi [N m]\" must be an angle",
            "label at line 1, columns 7 to",
        ],
    );
}

#[test]
fn cells_that_are_no_numbers() {
    let comma = steady("t [s],phi [deg]", ',');
    let semicolon = steady("t [s];phi [deg]", ';');
    for (csv, words) in [
        (
            comma.replace("2,2", "2,two"),
            [
                "row 3: \"two\" in the column \"phi [deg]\"",
                "label at line 4, columns 3 to 5",
            ],
        ),
        (
            comma.replace("2,2", "2"),
            [
                "row 3 has 1 value, but the header has 2 columns",
                "label at line 4, column",
            ],
        ),
        (
            comma.replace("2,2", "2,0,2,0"),
            [
                "row 3 has 4 values",
                "with commas between the cells decimals have a point",
            ],
        ),
        (
            comma.replace("2,2", "2,\"2,0\""),
            [
                "\"2,0\" in the column \"phi [deg]\" is a number with a decimal comma, but commas",
                "semicolons between the cells",
            ],
        ),
        (
            comma.replace("2,2", "1,2"),
            [
                "the time does not increase: row 3 has 1 s after 1 s",
                "label at line 4, column",
            ],
        ),
        (
            comma.replace("4,4\n5,5\n", ""),
            ["the file has 4 rows, but needs at least 5", "ends here"],
        ),
        // A point between thousands, which would be a decimal point.
        (
            semicolon.replace("2;2", "2,0;1.002"),
            [
                "\"1.002\" in the column \"phi [deg]\" is a number with a point, but row 3 has one with a comma",
                "between thousands",
            ],
        ),
        (
            semicolon.replace("2;2", "2;1.002,5"),
            ["row 3: \"1.002,5\"", "none between thousands"],
        ),
    ] {
        refused(&csv, "", &words);
    }
}

/// Counts, turns and milliseconds in one file, with a decimal comma.
#[test]
fn units_of_drives() {
    let mut csv = "Zeit [ms]\tLage [inc]\tDrehzahl [rev/s]\n".to_owned();
    for k in 0..=200 {
        let [phi, omega, _] =
            super::forms::exact(f64::from(k) / 200.0).map(|x| x / std::f64::consts::TAU);
        let row = format!("{}\t{:.6}\t{omega:.9}\n", 5 * k, phi * 16384.0);
        csv += &row.replace('.', ",");
    }
    let columns = "columns = { time = \"Zeit\", position = \"Lage\", speed = \"Drehzahl\" }";
    refused(&csv, columns, &["is in counts", "counts_per_turn = 8192"]);
    let [phi, omega, _] =
        worst(&read(&csv, &format!("{columns}\ncounts_per_turn = 16384")).unwrap());
    assert!(phi < 1e-8 && omega < 1e-5, "{phi:e} {omega:e}");
}
