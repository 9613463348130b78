//! A plan as Rust source.

use crate::form::rust_table;

/// The words of a plan as a `static` array, with the identifier of its machine; `title` describes it.
pub fn plan_source(title: &str, machine: u32, words: &[u32]) -> String {
    format!(
        "// {}\n\n\
         /// Identifier of the machine: `Plan::of_machine` refuses the plan of another.\n\
         #[allow(dead_code)]\n\
         pub const MACHINE: u32 = 0x{machine:08x};\n\n\
         /// The plan: `jred::axis::Plan::new(&PLAN, &model)`.\n{}",
        title.replace(['\n', '\r'], " "),
        rust_table("PLAN", words)
    )
}
