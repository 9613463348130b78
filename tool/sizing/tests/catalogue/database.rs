//! Files of the Motor-Gearbox Database, read as they are. The rows here are invented; the database itself is read where the
//! environment variable `JRED_MGDB` names its folder.

use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Catalogue, Motor, Sources};

use crate::support::{Folder, near};

const UNIT: f64 = crate::support::budget::UNIT_CONVERSION;

const MOTORS: &str = "\
key,manufacturer,ID,type,V,k_t,R,L,mass,inertia,omega_nl,I_nl,I_nom,max_int_torque,max_int_speed,max_cont_speed,max_cont_power,coulomb_friction,viscous_friction,Rth1,Rth2
XX_full,Some_Maker,full,DC,48,0.1,0.5,0.0002,0.5,2e-05,450,0.2,5,2,600,400,150,0.012,1e-05,2,6
XX_bare,Some_Maker,bare,BLDC,24.0,0.05,1.5,0.9-3,0.2,8e-06,,,2,inf,Inf,inf,Inf,NaN,nan,,
XX_idle,Some_Maker,idle,BLDC,24,0.05,1.5,0.0009,0.2,8e-06,400,0.1,inf,inf,inf,inf,inf,NaN,NaN,4,
XX_part,Some_Maker,part,DC,24,0.05,1.5,0.0009,0.2,8e-06,400,0.1,2,,,,,0.003,,4,
";

/// Other columns, in another order.
const MORE_MOTORS: &str = "\
key,manufacturer,ID,type,V,k_t,k_e,R,L,mass,inertia,diameter,length,omega_nl,I_nl,I_nom,max_int_torque,max_int_speed,max_cont_speed,max_cont_power,coulomb_friction,viscous_friction,Rth1,Rth2
YY_1,Other,1,BLDC,24,0.068,0.067,0.262,0.000112,0.315,0.00012,0.076,0.0365,351.8,0.1,7.4,1.66,inf,inf,inf,,,,
";

const GEARBOXES: &str = "\
key,manufacturer,ID,type,stages,ratio,mass,inertia,efficiency,direction,max_int_torque,max_cont_torque
XX_32_R4:1,Some_Maker,32_R4:1,planetary,1,4,0.1,1e-07,0.9,1,1.5,1
XX_32_R16:1,Some_Maker,32_R16:1,planetary,2,16.5,0.1,0.0,0.8,-1.0,3,2
XX_32S_R16:1,Some_Maker,32S_R16:1,spur,3,16,0.1,0,,1.0,inf,inf
XX_40,Some_Maker,40,planetary,NaN,5,0,0,0.7,1,1,2
";

const LIST: &str = "\
XX_full,XX_32_R*,XX_40
XX_bare,XX_32*
XX_full,XX_32S_R16:1
XX_idle
";

fn open(list: &str, skip: bool) -> Result<Catalogue, String> {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("Some_Maker")).unwrap();
    std::fs::create_dir_all(folder.path("Other")).unwrap();
    folder.file("Some_Maker/some_motors.csv", MOTORS);
    folder.file("Some_Maker/some_gearboxes.csv", GEARBOXES);
    folder.file("Some_Maker/some_compatibility.csv", list);
    folder.file("Other/other_motors.csv", MORE_MOTORS);
    folder.file("Other/Notes.txt", "Not a table.");
    let sources = Sources {
        catalogues: vec![folder.path("")],
        skip_broken_rows: skip,
        ..Sources::default()
    };
    Catalogue::open(&sources).map_err(|e| format!("{:?}", miette::Report::new(e)))
}

fn of<'c>(catalogue: &'c Catalogue, key: &str) -> &'c Motor {
    catalogue.motors.iter().find(|m| m.key == key).unwrap()
}

#[test]
fn figures_of_motors() {
    let catalogue = open(LIST, false).unwrap();
    assert_eq!(catalogue.motors.len(), 5);
    let full = of(&catalogue, "XX_full");
    let figures = [
        (full.rated_torque, 0.1 * 5.0),
        (full.rated_speed, 400.0),
        (full.peak_torque, 2.0),
        (full.max_speed, 600.0),
        (full.max_power, 150.0),
        (full.no_load_speed, 450.0),
        (Some(full.rotor_inertia), 2e-5),
        (Some(full.friction[0]), 0.012),
        (Some(full.friction[1]), 1e-5),
        (full.winding.torque_constant, 0.1),
        (full.winding.voltage_constant, 0.1),
        (full.winding.resistance, 0.5),
        (full.winding.inductance, 2e-4),
        (full.winding.rated_current, 5.0),
        (full.winding.no_load_current, 0.2),
        (full.thermal.winding_resistance, 2.0),
        (full.thermal.housing_resistance, 6.0),
        (full.bus_voltage, 48.0),
        (full.mass, 0.5),
    ];
    for (index, (found, expected)) in figures.into_iter().enumerate() {
        near(&format!("figure {index}"), found.unwrap(), expected, UNIT);
    }
    assert_eq!(full.maker, "Some Maker");
    assert_eq!(full.model, "full");
    assert_eq!(full.winding.commutation, Commutation::Block);
    assert!(!full.from_maker);
    assert!(full.source.contains("some_motors.csv"), "{}", full.source);
    // Values that the database marks as not given are read as missing: inf, NaN or empty.
    let bare = of(&catalogue, "XX_bare");
    let nothing = [
        bare.rated_speed,
        bare.peak_torque,
        bare.max_speed,
        bare.max_power,
        bare.no_load_speed,
        bare.winding.no_load_current,
        bare.winding.inductance,
        bare.thermal.winding_resistance,
    ];
    assert_eq!(nothing, [None; 8]);
    assert_eq!(bare.friction, [0.0; 2]);
    assert_eq!(of(&catalogue, "XX_idle").rated_torque, None);
    near(
        "k_e",
        of(&catalogue, "YY_1").winding.voltage_constant.unwrap(),
        0.067,
        UNIT,
    );
    let warning = catalogue
        .warnings
        .iter()
        .find(|w| w.contains("0.9-3"))
        .unwrap();
    assert!(
        warning.contains("some_motors.csv:3: L of \"XX_bare\""),
        "{warning}"
    );
}

/// Friction is derived from the no-load point: k_t·I_nl = c + b·ω_nl.
#[test]
fn friction_from_the_no_load_point() {
    let catalogue = open(LIST, false).unwrap();
    let idle = of(&catalogue, "XX_idle");
    near("Coulomb", idle.friction[0], 0.05 * 0.1, UNIT);
    assert_eq!(idle.friction[1], 0.0);
    let part = of(&catalogue, "XX_part");
    near("Coulomb", part.friction[0], 0.003, UNIT);
    near(
        "sum",
        part.friction[0] + part.friction[1] * 400.0,
        0.05 * 0.1,
        UNIT,
    );
}

#[test]
fn figures_of_gearboxes() {
    let catalogue = open(LIST, false).unwrap();
    let [first, second, third, fourth] = &catalogue.gearboxes[..] else {
        panic!("{}", catalogue.gearboxes.len());
    };
    assert_eq!(
        (first.ratio, first.efficiency, first.inertia),
        (4.0, 0.9, 1e-7)
    );
    assert_eq!(
        (first.rated_torque, first.peak_torque),
        (Some(1.0), Some(1.5))
    );
    assert_eq!(
        (first.stages, first.reverses, first.mass),
        (Some(1), false, Some(0.1))
    );
    assert_eq!(first.back_efficiency, first.efficiency);
    assert_eq!(
        (second.ratio, second.reverses, second.inertia),
        (16.5, true, 0.0)
    );
    assert_eq!(
        (third.rated_torque, third.peak_torque, third.max_speed),
        (None, None, None)
    );
    near(
        "efficiency assumed",
        third.efficiency,
        0.87 * 0.87 * 0.87,
        UNIT,
    );
    assert!(third.efficiency_assumed && !first.efficiency_assumed);
    assert_eq!((fourth.stages, fourth.mass), (None, None));
    let said = |words: &str| catalogue.warnings.iter().any(|w| w.contains(words));
    assert!(
        said("efficiency of \"XX_32S_R16:1\" not given"),
        "{:?}",
        catalogue.warnings
    );
    assert!(said("peak torque of \"XX_40\""), "{:?}", catalogue.warnings);
}

#[test]
fn combinations_by_the_list() {
    let catalogue = open(LIST, false).unwrap();
    let names: Vec<String> = catalogue
        .drives()
        .map(|(_, d)| format!("{} {}", d.motor.key, d.gearbox.map_or("-", |g| &g.key)))
        .collect();
    let expected = [
        // Files in alphabetical order, folder by folder.
        "YY_1 -",
        "XX_full -",
        "XX_full XX_32_R4:1",
        "XX_full XX_32_R16:1",
        "XX_full XX_32S_R16:1",
        "XX_full XX_40",
        "XX_bare -",
        "XX_bare XX_32_R4:1",
        "XX_bare XX_32_R16:1",
        "XX_bare XX_32S_R16:1",
        "XX_idle -",
        "XX_part -",
    ];
    assert_eq!(names, expected);
    assert_eq!(catalogue.count(), expected.len());
    let error = open(&LIST.replace("XX_40", "XX_41"), false).unwrap_err();
    let flat = error.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains("no gearbox has the key \"XX_41\""), "{error}");
    assert!(error.contains("some_compatibility.csv:1:1"), "{error}");
    let skipped = open(&LIST.replace("XX_40", "XX_41"), true).unwrap();
    assert_eq!(skipped.count(), expected.len() - 1);
    assert_eq!(skipped.left_out, 1);
}

/// The whole database: counts as its own description gives them.
#[test]
fn the_whole_database() {
    let Some(folder) = std::env::var_os("JRED_MGDB") else {
        eprintln!(
            "SKIPPED: set JRED_MGDB to a folder with the Motor-Gearbox Database to read all of it"
        );
        return;
    };
    let sources = Sources {
        catalogues: vec![folder.into()],
        ..Sources::default()
    };
    let start = std::time::Instant::now();
    let catalogue = Catalogue::open(&sources).unwrap();
    println!("read in {:?}", start.elapsed());
    assert_eq!(catalogue.motors.len(), 1037);
    assert_eq!(catalogue.gearboxes.len(), 2543);
    assert_eq!(catalogue.count(), 85_828);
    assert_eq!(catalogue.drives().count(), 85_828);
    assert_eq!(
        catalogue
            .gearboxes
            .iter()
            .filter(|g| g.efficiency_assumed)
            .count(),
        31
    );
    assert_eq!(
        catalogue.gearboxes.iter().filter(|g| g.reverses).count(),
        49
    );
    // No unit is mixed up: warnings concern only missing and contradictory data of the database.
    for warning in &catalogue.warnings {
        let known = [
            "efficiency",
            "below the rated one",
            "below its rated torque",
            "0.85-3",
        ];
        assert!(known.iter().any(|k| warning.contains(k)), "{warning}");
    }
}
