//! Catalogues with broken rows: all are found in one pass, the first few shown, the other rows usable.

use jred_sizing::catalogue::{Catalogue, CatalogueError, SHOWN, Sources};

use crate::support::Folder;
use crate::support::catalogue::{FIRST, HEADER};

const ROWS: usize = 100_000;

/// A large table, every seventh row broken in one of several ways.
fn large() -> (String, usize) {
    let mut text = format!("{HEADER}\n");
    let mut broken = 0;
    for row in 0..ROWS {
        let good = format!("m{row},Maker,Model,8,2000,36,8.5,\"Sheet, page {row}\"\n");
        if row % 7 != 3 {
            text += &good;
            continue;
        }
        broken += 1;
        let bad = match broken % 5 {
            0 => good.replace(",8,", ",eight,"),
            1 => good.replace(",36,", ",3,"),
            2 => good.replace(",Maker,", ",,"),
            3 => good.replace(",8.5,", ",-8.5,"),
            _ => good.replace(",8.5,", ","),
        };
        text += &bad;
    }
    (text, broken)
}

#[test]
fn a_large_catalogue_with_broken_rows() {
    let (text, broken) = large();
    let folder = Folder::new();
    folder.file("motors.csv", text);
    let mut sources = Sources {
        catalogues: vec![folder.path("")],
        ..Sources::default()
    };
    let start = std::time::Instant::now();
    let Err(CatalogueError::Several(several)) = Catalogue::open(&sources) else {
        panic!("several faults were expected");
    };
    println!("refused after {:?}", start.elapsed());
    assert_eq!(several.rows, broken);
    assert_eq!(several.shown.len(), SHOWN);
    sources.skip_broken_rows = true;
    let start = std::time::Instant::now();
    let catalogue = Catalogue::open(&sources).unwrap();
    println!("read in {:?}", start.elapsed());
    assert_eq!(catalogue.left_out, broken);
    assert_eq!(catalogue.motors.len(), ROWS - broken);
    assert!(
        catalogue
            .warnings
            .iter()
            .any(|w| w.contains(&format!("{broken} broken rows")))
    );
    assert!(catalogue.motors.iter().all(|m| m.rated_torque == Some(8.0)));
}

/// A list may still name skipped rows; a name that was never there is a fault.
#[test]
fn lists_that_name_broken_rows() {
    let folder = Folder::new();
    let gearbox = "key,maker,model,ratio,rated_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source\n\
                   g1,M,G,3,50,6000,1,97,S\ng2,M,G,0,50,6000,1,97,S\n";
    folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    folder.file("gearboxes.csv", gearbox);
    folder.file("compatibility.csv", "motor,gearboxes\nm1,g1;g2;g3\n");
    let catalogue = Catalogue::open(&Sources {
        catalogues: vec![folder.path("")],
        skip_broken_rows: true,
        ..Sources::default()
    })
    .unwrap();
    assert_eq!(catalogue.count(), 2);
    assert_eq!(catalogue.left_out, 2);
}

/// Tables that are too large together are refused before any is read, because checking takes time.
#[test]
fn a_folder_of_too_many_bytes_is_refused() {
    let folder = Folder::new();
    for k in 0..2 {
        let table = folder.file(&format!("a{k}_motors.csv"), HEADER);
        let table = std::fs::File::options().write(true).open(table).unwrap();
        table.set_len(60 << 20).unwrap();
    }
    let sources = Sources {
        catalogues: vec![folder.path("")],
        ..Sources::default()
    };
    let error = Catalogue::open(&sources).unwrap_err();
    assert!(error.to_string().contains("more than 64 MiB"), "{error}");
}
