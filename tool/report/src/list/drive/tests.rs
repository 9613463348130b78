use super::*;

const ALL: [&str; 5] = ["cia402", "ax8000", "sigma-7", "akd", "ax5000"];

#[test]
fn every_maker_is_read_by_its_word() {
    let all = makers(None).unwrap();
    let keys: Vec<&str> = all.iter().map(|maker| maker.key.as_str()).collect();
    assert_eq!(keys, ALL);
    for key in ALL {
        assert_eq!(makers(Some(key)).unwrap().len(), 1);
    }
    let fault = makers(Some("nobody")).unwrap_err().to_string();
    assert!(fault.contains("there is no maker \"nobody\""), "{fault}");
}

/// Every maker has a source, every parameter an ordered range; no parameter is there twice.
#[test]
fn parameters_are_complete() {
    for maker in makers(None).unwrap() {
        assert!(!maker.source.is_empty());
        let mut numbers: Vec<_> = maker.parameters.iter().map(|p| &p.number).collect();
        numbers.sort();
        numbers.dedup();
        assert_eq!(numbers.len(), maker.parameters.len(), "{}", maker.name);
        for p in &maker.parameters {
            assert!(p.limits.is_sorted() && p.limits.len() <= 2, "{}", p.number);
        }
    }
}

#[test]
fn a_word_that_no_parameter_has_is_refused() {
    let wrong = format!("{PARAMETERS}\n[[maker]]\nkey = 1\n");
    assert!(toml::from_str::<Makers>(&wrong).is_err());
    let wrong = PARAMETERS.replacen("setting = \"rated-torque\"", "setting = \"wrong\"", 1);
    assert!(toml::from_str::<Makers>(&wrong).is_err());
}

#[test]
fn values_are_rounded_as_typed() {
    assert_eq!(typed(3269.23, Some(0), false).to_string(), "3269");
    assert_eq!(typed(2072.86, Some(0), true).to_string(), "2072");
    assert_eq!(typed(0.3 * 1e4, Some(0), true).to_string(), "3000");
    assert_eq!(typed(0.012_345_6, None, false).to_string(), "0.01235");
    assert_eq!(typed(-0.2, Some(0), false).to_string(), "0");
}

/// 0.0955 N m are typed as 96 mN m, of which 0.2865 N m are 2984.4 per mille.
#[test]
fn limits_are_never_above_their_figure() {
    assert_eq!(typed(16.968, None, true).to_string(), "16.96");
    assert_eq!(typed(12_346.0, None, true).to_string(), "12340");
    assert_eq!(typed(16.968, None, false).to_string(), "16.97");
    for maker in ["cia402", "ax8000"] {
        let Maker { parameters, .. } = makers(Some(maker)).unwrap().remove(0);
        let limit = parameters.iter().find(|p| p.number == "0x6072").unwrap();
        let base = limit.base_of(0.0955, true, &parameters);
        assert_eq!(
            typed(0.2865 / base * 1e3, Some(0), true).to_string(),
            "2984"
        );
    }
}
