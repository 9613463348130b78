//! The bill of materials of a drive.

use schemars::JsonSchema;
use serde::Serialize;

use super::table;
use crate::answer::Answer;
use crate::list::marks;
use crate::table::reading::ColumnKind::{Quantity, Share, Words};
use jred_file::model::rule::Rule;
use jred_file::number::rounding::short;
use jred_sizing::judge::Assessment;
use jred_sizing::judge::bill::{BillItem, Part};
use jred_sizing::judge::check::Check;

/// A part as it is ordered.
#[derive(Serialize, JsonSchema)]
pub(crate) struct BillData<'a> {
    part: Part,
    maker: &'a str,
    /// The maker's type designation.
    order: &'a str,
    /// Key in the catalogue.
    key: &'a str,
    /// Null: not given; a brake is contained in its motor.
    #[serde(rename = "mass [kg]")]
    mass: Option<f64>,
    /// In the currency of the catalogue; null: not given.
    price: Option<f64>,
    /// The rule on this part that uses most of its limit; null: no rule is checked.
    #[serde(rename = "decided by")]
    decided: Option<Rule>,
    /// Source of its figures.
    source: &'a str,
}

impl<'c> From<&BillItem<'c, '_>> for BillData<'c> {
    fn from(item: &BillItem<'c, '_>) -> Self {
        Self {
            part: item.part,
            maker: item.maker,
            order: item.model,
            key: item.key,
            mass: item.mass,
            price: item.price,
            decided: item.decided.map(|check| check.id),
            source: item.source,
        }
    }
}

/// The parts with mass, price and the rule that decided each, and their sums.
pub(crate) fn bill(answer: &mut Answer, judged: &Assessment) {
    let bill = judged.bill();
    let figure = |value: Option<f64>| value.map_or("–".to_owned(), short);
    let row = |item: &BillItem| {
        let is_own = item.part != Part::Brake;
        let own = |text: String| if is_own { text } else { String::new() };
        let [mass, price] = [item.mass, item.price].map(|value| own(figure(value)));
        let order = if is_own {
            format!("{} {}", item.maker, item.model)
        } else {
            "with the motor".to_owned()
        };
        let key = own(marks::key(item.key, item.from_maker));
        let decided = item
            .decided
            .map_or("no rule is checked".to_owned(), |check| {
                format!("{} {}", check.rule, check.against())
            });
        let used = item.decided.map_or(String::new(), Check::used);
        let part = item.part.name().to_owned();
        [part, order, key, mass, price, decided, used]
    };
    let sum = |of: fn(&BillItem) -> Option<f64>| figure(bill.iter().map(of).sum());
    let total = [
        "sum".to_owned(),
        String::new(),
        String::new(),
        sum(|item| item.mass),
        sum(|item| item.price),
        String::new(),
        String::new(),
    ];
    let header = [
        ("part", Words),
        ("order", Words),
        ("key", Words),
        ("mass [kg]", Quantity),
        ("price", Quantity),
        ("decided by", Words),
        ("used", Share),
    ];
    answer.table(table(header, bill.iter().map(row).chain([total]), 2));
}
