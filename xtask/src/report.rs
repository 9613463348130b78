//! Results as tables, on the terminal or in Markdown.

use std::fmt::Write;

use crate::bounds::Bound;
use crate::calls::Call;
use crate::cores::Core;
use crate::kernels::{Kernel, Quantity};

/// Cost of a kernel on a core.
pub(crate) struct Measurement {
    pub(crate) kernel: &'static Kernel,
    pub(crate) core: &'static Core,
    /// The largest of each figure over all points.
    pub(crate) worst: Call,
    /// Upper bound of all calls, for the library's kernels.
    pub(crate) bound: Option<Bound>,
    /// Instructions on average.
    pub(crate) mean: f64,
    /// Bytes of code, including all functions called.
    pub(crate) code: u32,
    /// Bytes of tables.
    pub(crate) table: usize,
    /// Largest error, relative to the largest result.
    pub(crate) error: f64,
}

impl Measurement {
    /// `instructions / ~cycles`, the worst of each.
    fn cost(&self) -> String {
        let Call {
            instructions,
            cycles,
            ..
        } = self.worst;
        if cycles == 0 {
            instructions.to_string()
        } else {
            format!("{instructions} / ~{cycles}")
        }
    }
}

/// All measurements.
#[derive(Default)]
pub(crate) struct Report {
    pub(crate) measurements: Vec<Measurement>,
}

impl Report {
    /// Every figure, a line for each kernel and core.
    pub(crate) fn text(&self) -> String {
        let head = [
            "core", "kernel", "instr.", "mean", "at most", "~cycles", "code B", "stack B",
            "at most", "table B", "error",
        ];
        let lines = self.measurements.iter().map(|m| {
            let bound =
                |of: fn(Bound) -> u32| m.bound.map_or("-".to_owned(), |b| of(b).to_string());
            [
                m.core.name.to_owned(),
                m.kernel.name.to_owned(),
                m.worst.instructions.to_string(),
                format!("{:.1}", m.mean),
                bound(|b| b.instructions),
                if m.worst.cycles == 0 {
                    "-".to_owned()
                } else {
                    m.worst.cycles.to_string()
                },
                m.code.to_string(),
                m.worst.stack.to_string(),
                bound(|b| b.stack),
                m.table.to_string(),
                format!("{:.1e}", m.error),
            ]
        });
        aligned(std::iter::once(head.map(str::to_owned)).chain(lines))
    }

    /// For the documentation: a table for each quantity, then bytes on the smallest core and on the M4F.
    pub(crate) fn markdown(&self) -> String {
        let mut text = String::new();
        for (quantity, title) in [
            (Quantity::Torque, "torque"),
            (Quantity::Acceleration, "acceleration"),
        ] {
            let cores = self.cores();
            let titles: Vec<_> = cores.iter().map(|core| core.title).collect();
            let _ = writeln!(text, "| {title} | {} | error |", titles.join(" | "));
            let _ = writeln!(text, "|---|{}---:|", "---:|".repeat(cores.len()));
            for kernel in self.kernels(quantity) {
                let of = |core: &Core| {
                    self.find(kernel, core)
                        .map_or_else(String::new, Measurement::cost)
                };
                let cells: Vec<_> = cores.iter().map(|core| of(core)).collect();
                let _ = writeln!(
                    text,
                    "| {} | {} | {:.0e} |",
                    kernel.title,
                    cells.join(" | "),
                    self.error(kernel)
                );
            }
            text.push('\n');
        }
        let sized = |core: &&&Core| ["cortex-m0", "cortex-m4"].contains(&core.name);
        for core in self.cores().iter().filter(sized) {
            let _ = writeln!(
                text,
                "| bytes, {} | code, torque | code, acceleration | stack | tables |",
                core.title
            );
            text.push_str("|---|---:|---:|---:|---:|\n");
            for kernel in self.kernels(Quantity::Torque) {
                let other = self
                    .kernels(Quantity::Acceleration)
                    .into_iter()
                    .find(|other| other.data_of(kernel));
                let [torque, acceleration] = [Some(kernel), other]
                    .map(|kernel| kernel.and_then(|kernel| self.find(kernel, core)));
                let code =
                    |m: Option<&Measurement>| m.map_or_else(String::new, |m| m.code.to_string());
                let stack = torque
                    .into_iter()
                    .chain(acceleration)
                    .map(|m| m.worst.stack)
                    .max()
                    .unwrap_or(0);
                let table = torque.map_or(0, |m| m.table);
                let (title, torque, acceleration) =
                    (kernel.title, code(torque), code(acceleration));
                let _ = writeln!(
                    text,
                    "| {title} | {torque} | {acceleration} | {stack} | {table} |"
                );
            }
            text.push('\n');
        }
        text
    }

    fn cores(&self) -> Vec<&'static Core> {
        let mut cores: Vec<&Core> = Vec::new();
        for m in &self.measurements {
            if !cores.iter().any(|core| core.name == m.core.name) {
                cores.push(m.core);
            }
        }
        cores
    }

    fn kernels(&self, quantity: Quantity) -> Vec<&'static Kernel> {
        let mut kernels: Vec<&Kernel> = Vec::new();
        for m in self
            .measurements
            .iter()
            .filter(|m| m.kernel.quantity == quantity)
        {
            if !kernels.iter().any(|kernel| kernel.name == m.kernel.name) {
                kernels.push(m.kernel);
            }
        }
        kernels
    }

    fn find(&self, kernel: &Kernel, core: &Core) -> Option<&Measurement> {
        self.measurements
            .iter()
            .find(|m| m.kernel.name == kernel.name && m.core.name == core.name)
    }

    /// The largest error on any core.
    fn error(&self, kernel: &Kernel) -> f64 {
        let of = self
            .measurements
            .iter()
            .filter(|m| m.kernel.name == kernel.name);
        of.map(|m| m.error).fold(0.0, f64::max)
    }
}

/// Columns of equal width; the first two left-aligned.
fn aligned<const N: usize>(lines: impl Iterator<Item = [String; N]>) -> String {
    let lines: Vec<_> = lines.collect();
    let width = |column: usize| {
        lines
            .iter()
            .map(|line| line[column].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for line in &lines {
        for (column, (cell, width)) in line.iter().zip(widths).enumerate() {
            let _ = if column < 2 {
                write!(text, "{cell:width$}  ")
            } else {
                write!(text, "{cell:>width$}  ")
            };
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cores::CORES;
    use crate::kernels::KERNELS;

    fn report() -> Report {
        let kernel = |name: &str| KERNELS.iter().find(|kernel| kernel.name == name).unwrap();
        let kernels = [kernel("hand_f32_torque"), kernel("hand_f32_acceleration")];
        let measurement = |core: &'static Core, kernel, cycles| Measurement {
            kernel,
            core,
            worst: Call {
                instructions: 50,
                cycles,
                stack: 8,
            },
            bound: Some(Bound {
                instructions: 60,
                stack: 16,
            }),
            mean: 48.0,
            code: 192,
            table: 3084,
            error: 1.2e-4,
        };
        let [m4, m7] = [&CORES[2], &CORES[3]];
        let of = |core, cycles| kernels.map(|kernel| measurement(core, kernel, cycles));
        Report {
            measurements: of(m4, 80).into_iter().chain(of(m7, 0)).collect(),
        }
    }

    #[test]
    fn markdown_has_a_row_for_each_kernel_and_a_column_for_each_core() {
        let text = report().markdown();
        assert!(text.contains("| torque | M4F | M7 | error |\n|---|---:|---:|---:|\n"));
        let row = "| by hand, f32, one index (Rust) | 50 / ~80 | 50 | 1e-4 |\n";
        assert_eq!(text.matches(row).count(), 2);
        assert!(text.contains("| by hand, f32, one index (Rust) | 192 | 192 | 8 | 3084 |\n"));
    }

    #[test]
    fn the_text_has_a_line_for_each_measurement() {
        let text = report().text();
        assert_eq!(text.lines().count(), 1 + 4);
        // Without timings there are no cycles.
        assert_eq!(text.lines().filter(|line| line.contains(" - ")).count(), 2);
    }
}
