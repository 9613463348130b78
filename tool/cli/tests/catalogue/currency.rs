//! Prices in more than one currency: used, but never compared.

use std::path::Path;

use crate::support::catalogue::{FIRST, HEADER, SECOND};
use crate::support::{Folder, Run, jred, jred_of, press_file};

fn size(folder: &Path, more: [&str; 2]) -> Run {
    let [option, value] = more;
    jred_of(
        "size {} --steps 16 --catalogue built-in --catalogue {} {} {}",
        [&press_file(), &folder, &option, &value],
    )
}

fn priced(header: &str, row: &str, key: &str) -> String {
    format!("{HEADER},{header}\n{},{row}\n", FIRST.replace("m1", key))
}

#[test]
fn prices_in_two_currencies_are_not_compared() {
    let folder = Folder::new();
    folder.file("a-motors.csv", priced("price [EUR]", "300", "m1"));
    let path = folder.path("");
    for more in [
        ["--rank", "price"],
        ["--max-price", "900"],
        ["--pareto", "price,power"],
    ] {
        let run = size(&path, more);
        assert!(!run.message().contains("prices in EUR"), "{}", run.err);
    }
    for (file, second, named) in [
        ("b-motors.csv", priced("price [USD]", "300", "m2"), "USD ("),
        (
            "b-motors.csv",
            priced("price", "300", "m2"),
            "no named currency (",
        ),
        ("b.toml", toml("\"310 CHF\""), "CHF ("),
        ("b.toml", toml("310"), "no named currency ("),
    ] {
        let other = folder.file(file, second);
        for more in [
            ["--rank", "price"],
            ["--max-price", "900"],
            ["--pareto", "power,price"],
        ] {
            size(&path, more).ends(2).says(&[
                "prices in EUR (",
                "a-motors.csv",
                "cannot be compared with prices in",
                named,
                file,
            ]);
        }
        assert_ne!(
            size(&path, ["--rank", "power"]).code,
            2,
            "no price is asked for"
        );
        for command in ["sensitivity", "vary"] {
            let run = jred([
                &command,
                &press_file(),
                &"--steps",
                &"16",
                &"--catalogue",
                &path,
                &"--rank",
                &"price",
                &(if command == "vary" {
                    "--vary=slider.mass=40,42kg"
                } else {
                    "--most=5"
                }),
            ]);
            run.ends(2).says(&["cannot be compared"]);
        }
        std::fs::remove_file(other).unwrap();
    }
    // The same currency, however written; a column of prices without any price.
    for second in [
        priced("price [eur]", "300", "m2"),
        priced("price [USD]", "", "m2"),
    ] {
        folder.file("b-motors.csv", second);
        assert_ne!(size(&path, ["--rank", "price"]).code, 2);
    }
    let both = format!("{HEADER},price\n{FIRST},300\n{SECOND},310\n");
    folder.file("b-motors.csv", both.replace("m1", "m3"));
    std::fs::remove_file(folder.path("a-motors.csv")).unwrap();
    assert_ne!(size(&path, ["--rank", "price"]).code, 2, "none is named");
}

fn toml(price: &str) -> String {
    format!(
        "[[motor]]\nkey = \"m2\"\nmaker = \"M\"\nmodel = \"M\"\nrated_torque = \"8 N m\"\nrated_speed = \"2000 rpm\"\n\
         peak_torque = \"36 N m\"\nrotor_inertia = \"8.5 kg cm^2\"\nsource = \"S\"\nprice = {price}\n"
    )
}
