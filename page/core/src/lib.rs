//! The core of the page: a request as JSON in, an answer as JSON out.
//!
//! `page/src/protocol.ts` describes both. Each request calls what the command calls, so the answers are the command's, bit for bit.

#[cfg(target_family = "wasm")]
mod abi;
mod drawn;
mod drive;
mod fault;
mod machine;
mod quantities;
mod request;

use jred_file::text::problem::{Problem, Result};
use serde_json::{Value, json};

use request::Request;

/// The answer to a request: `{"answer": …, "warnings": […]}`, or `{"error": …}`.
pub fn answer(request: &str) -> String {
    let request = Request::new(serde_json::from_str(request).unwrap_or_default());
    match answered(&request) {
        Ok(answer) => {
            let warnings = Value::from(request.warnings());
            format!("{{\"answer\":{answer},\"warnings\":{warnings}}}")
        }
        Err(problem) => {
            json!({ "error": fault::of(&problem, &request.name(), request.source()) }).to_string()
        }
    }
}

/// The answer as JSON.
fn answered(request: &Request) -> Result<String> {
    match request.text("do").unwrap_or_default() {
        "curves" => machine::curves(request),
        "drawing" => machine::drawing(request),
        "flywheel" => machine::flywheel(request),
        "export" => machine::export(request),
        "size" => drive::size(request),
        "charts" => drive::charts(request),
        "report" => drive::report(request),
        "fastest" => drive::fastest(request),
        "gentlest" => drive::gentlest(request),
        "quantities" => quantities::list(request),
        "complete" => Ok(quantities::complete(request)),
        "set" => quantities::set(request),
        "draw" => drawn::draw(request),
        "linkage" => drawn::linkage(request),
        other => Err(Problem::new(format!("the core has no request {other:?}"))),
    }
}
