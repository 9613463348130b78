//! A limit in bytes, and the tables of the example press in docs/performance.md.

use jred::Image;

use super::{KINDS, export, export_of, images_of, words_of};
use crate::support::{Folder, press_file};

#[test]
#[ignore = "more than five seconds of a processor"]
fn the_best_table_of_so_many_bytes() {
    let folder = Folder::new();
    let sizes = [800, 1500, 3000];
    let [omega, alpha] = [29.4524, 226.725];
    let images = sizes.map(|bytes| images_of(&press_file(), bytes, [omega, alpha]));
    let range = [omega, alpha].map(|most| most.to_string());
    let range = [
        format!("{} rad/s", range[0]),
        format!("{} rad/s^2", range[1]),
    ];
    for (k, (number, layout)) in KINDS.into_iter().enumerate() {
        let of = |bytes: &str, more: &[&str]| {
            let kind = ["--type", number, "--layout", layout, "--max-bytes", bytes];
            let range = ["--omega", &range[0], "--alpha", &range[1]];
            export(&folder, &[&kind[..], &range, more].concat())
        };
        let mut before = f64::INFINITY;
        for (bytes, images) in sizes.into_iter().zip(&images) {
            let words = &images[k];
            if bytes == 1500 {
                let (run, path) = of("1500", &[]);
                run.ends(0);
                assert_eq!(words_of(&path), *words, "{number} {layout}");
            }
            assert!(
                4 * words.len() <= bytes as usize,
                "{} of {bytes}",
                words.len()
            );
            let error = f64::from(Image::new(words).unwrap().validity().torque_error);
            assert!(error < before, "more bytes, and no less error");
            before = error;
            // The stated error can be reached; a slightly smaller one cannot.
            let bytes = bytes.to_string();
            let exact = format!("{} N m", error * (1.0 + 1e-6));
            of(&bytes, &["--torque-error", &exact]).0.ends(0);
            let less = format!("{} N m", error * 0.999);
            let (run, _) = of(&bytes, &["--torque-error", &less]);
            run.ends(2).says(&[
                &format!("no {number} table of {bytes} bytes meets a torque error of"),
                "the smallest error found in that size is",
                &format!("with layout {layout} and "),
                "allow more bytes, or a larger error",
            ]);
        }
    }
}

#[test]
fn the_layout_is_the_fastest_the_smallest_or_the_most_exact() {
    let json = |more: &[&str]| {
        let more = [more, &["--format", "json"]].concat();
        export_of(&press_file(), &more, None).ends(0).json()
    };
    for number in ["f32", "i32"] {
        // With a given error, by instructions: the smallest of those within a tenth of the fastest.
        let asked = ["--type", number, "--torque-error", "0.5 N m"];
        let value = json(&asked);
        let least = |value: &serde_json::Value, name: &str, most: f64| {
            let all = value["alternatives"].as_array().unwrap().iter();
            let own = all.filter(|a| {
                let fast = a["instructions"].as_f64().is_some_and(|cost| cost <= most);
                a["type"] == number && a["meets"] == true && fast
            });
            own.map(|a| a[name].as_f64().unwrap())
                .fold(f64::INFINITY, f64::min)
        };
        let fastest = least(&value, "instructions", f64::INFINITY);
        let most = fastest + (fastest / 10.0).floor();
        assert!(value["instructions"].as_f64().unwrap() <= most, "{value}");
        assert_eq!(
            value["image_bytes"].as_f64(),
            Some(least(&value, "image_bytes", most))
        );
        // With a limit in bytes, by bytes.
        let value = json(&[&asked[..], &["--max-bytes", "100000"]].concat());
        assert_eq!(
            value["image_bytes"].as_f64(),
            Some(least(&value, "image_bytes", f64::INFINITY))
        );
        // With only a limit in bytes, by error.
        let value = json(&["--type", number, "--max-bytes", "2000"]);
        let all = value["alternatives"].as_array().unwrap().iter();
        let own = all.filter(|a| a["type"] == number);
        let least = own.map(|a| a["torque_error"].as_f64().unwrap());
        assert_eq!(value["torque_error"].as_f64(), least.reduce(f64::min));
    }
}

/// The press for comparing tables: λ = 0.25, J = J₀ + m·x′² with max/min 5.25, the weight of the slider. Its torque is largest at full speed and
/// acceleration; errors are shares of it.
const COMPARED: &str = r#"
title = "Slider-crank, lambda 0.25"
gravity = ["-9.81 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
flywheel = "1 kg m^2"
[mechanism.crank]
length = "1 m"
mass = "0 kg"
inertia = "0 kg m^2"
[mechanism.rod]
length = "4 m"
mass = "0 kg"
inertia = "0 kg m^2"
[mechanism.slider]
mass = "4 kg"
"#;

/// Number type, error as a share of the largest torque, and the limit in bytes for the rows of the smallest table.
const SIZES: [(&str, f64, u64); 5] = [
    ("f32", 1e-3, 256),  // 216
    ("f32", 1e-4, 480),  // 424
    ("f32", 1e-6, 2304), // 1960
    ("i32", 1e-4, 256),  // 220, points of 16 bits
    ("i16", 1e-3, 1600), // 1408
];

#[test]
fn tables_of_the_compared_press_are_small() {
    let folder = Folder::new();
    let file = folder.file("compared.toml", COMPARED);
    let range = ["--omega", "10 rad/s", "--alpha", "100 rad/s^2"];
    let peak = {
        let more = [&range[..], &["--max-bytes", "2000", "--format", "json"]].concat();
        let value = export_of(&file, &more, None).ends(0).json();
        value["peak_torque"].as_f64().unwrap()
    };
    for (number, share, most) in SIZES {
        let layout = match number {
            "f32" => "spline",
            "i32" => "spline16",
            _ => "auto",
        };
        let error = format!("{} N m", share * peak);
        let more = [
            &range[..],
            &[
                "--type",
                number,
                "--layout",
                layout,
                "--torque-error",
                &error,
                "--format",
                "json",
            ],
        ];
        let value = export_of(&file, &more.concat(), None).ends(0).json();
        let bytes = value["row_bytes"].as_u64().unwrap();
        println!(
            "{number} {share:e}: {} {} cells, rows {bytes}, image {}",
            value["layout"], value["cells"], value["image_bytes"]
        );
        assert!(bytes <= most, "{number} {share:e}: {bytes} bytes");
        assert!(
            bytes > most * 3 / 4,
            "{number} {share:e}: {bytes} bytes, the limit is idle"
        );
    }
}
