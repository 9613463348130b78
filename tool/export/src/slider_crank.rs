//! A slider-crank in closed form, if the machine is one.

use jred::error::Error;
use jred::harmonic::measure;
use jred::image::image_len;
use jred::machine::{Machine, Mechanism as _};
use jred::mechanism::SliderCrank;
use jred::slider_crank::{form, set_in_use};
use jred::table::{Shape, Table, Usage, words_len};
use jred::tabulate::{Request, TableFigures};
use jred::{Domain, Scale, SliderCrankForm};

use crate::candidate::{RangeTable, SearchResult};
use crate::failure::NoClosedForm;
use crate::search::Search;
use jred_file::model::machine::machine_like;
use jred_file::model::mechanism::AnyMechanism;

type F = SliderCrankForm;

/// Places per turn, besides those of the reference; an odd number.
const PLACES: u32 = 4097;

/// The machine as a slider-crank, if the closed form can represent all of it.
pub(crate) fn plain(
    machine: Option<&Machine<AnyMechanism>>,
) -> Result<Machine<SliderCrank>, NoClosedForm> {
    let machine = machine.ok_or(NoClosedForm::ByDirection)?;
    let any = machine.mechanism();
    if any.kind() == "slider-crank" && any.domain() != Domain::Turn {
        return Err(NoClosedForm::Stroke);
    }
    let Some(mechanism) = any.inner::<SliderCrank>() else {
        return Err(match any.names().get(any.own_links()) {
            Some(curve) if any.kind() == "slider-crank" => NoClosedForm::Curve(curve.clone()),
            _ => NoClosedForm::Mechanism(any.kind()),
        });
    };
    let (loads, elements) = (machine.loads(), machine.elements());
    let copy = machine_like(
        machine,
        mechanism.clone(),
        loads.iter().copied(),
        elements.iter().copied(),
    );
    // Accepted before, so accepted again.
    let copy = copy.map_err(|_| NoClosedForm::Mechanism(any.kind()))?;
    set_in_use(&copy).map(|_| copy).map_err(NoClosedForm::Part)
}

impl Search<'_> {
    /// The closed form of this machine, and the accuracy of its ticks.
    ///
    /// # Errors
    /// Errors of the machine.
    pub(crate) fn slider_crank(
        &self,
        machine: &Machine<SliderCrank>,
    ) -> Result<SearchResult<RangeTable>, Error> {
        let set = set_in_use(machine)?;
        let bytes = 4 * image_len::<F>(0, set);
        if self.goal.max_bytes.is_some_and(|most| bytes > most) {
            return Ok(SearchResult::TooLarge(bytes));
        }
        let mut words = vec![0.0; words_len::<F>(0, set)];
        form(machine, set, &mut words)?;
        let table = Table::<F>::new(&words, Shape::slider_crank(set)).and_then(|table| {
            let usage = Usage::of(&table)?;
            jred::AnyModel::new(table).map(|_| (table, usage))
        });
        let (table, usage) = match table {
            Ok(table) => table,
            Err(error) => return Ok(SearchResult::Refused(error.into())),
        };
        let [omega, alpha] = self.goal.range;
        let request = Request::new(self.goal.torque_error.unwrap_or(f64::INFINITY))
            .with_max_speed(omega)
            .with_max_acceleration(alpha);
        let (measured, worst) = measure(machine, &table, &request, PLACES)?;
        let (looked, _) = self.torque_error(&table, 0, f64::INFINITY);
        let mut found = TableFigures::default();
        found.cells = words.len() as u32;
        (found.torque_error, found.bound, found.worst) = (measured, measured.max(looked), worst);
        let made = Box::new(self.with_image(&table, usage, Scale::SI, found, looked)?);
        Ok(match self.goal.torque_error {
            Some(allowed) if made.error > allowed => SearchResult::Misses(made),
            _ => SearchResult::Meets(made),
        })
    }
}
