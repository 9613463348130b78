//! From a sequence of executed addresses to calls of kernels: instructions, cycles, stack, functions.

use std::collections::{BTreeSet, HashMap};

use anyhow::{Context, Result, bail};

use crate::elf::Program;
use crate::instruction::{Decoder, Instruction, Kind, Stack};
use crate::timing::{Step, Timing};

/// The function of the on-target program that reads the clock, before and after the calls of a kernel.
const CLOCK: &str = "tick_clock";

/// Cost of a call.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Call {
    /// Executed instructions, from the first of the kernel to its return, including all functions that it called.
    pub(crate) instructions: u32,
    /// Estimated cycles; 0 without timings.
    pub(crate) cycles: u32,
    /// Bytes of stack.
    pub(crate) stack: u32,
}

/// Costs of the calls of a kernel.
#[derive(Debug, Default)]
pub(crate) struct Calls {
    /// In order.
    pub(crate) each: Vec<Call>,
    /// Addresses of the executed functions.
    functions: BTreeSet<u32>,
    /// Instructions between two readings of the clock.
    pub(crate) between_clocks: u64,
}

impl Calls {
    /// Bytes of code: the kernel, and every function that it called.
    pub(crate) fn bytes(&self, program: &Program) -> u32 {
        self.functions
            .iter()
            .filter_map(|at| program.function_at(*at))
            .map(|(_, function)| function.size)
            .sum()
    }
}

/// An unfinished call.
struct Open {
    kernel: usize,
    return_to: u32,
    call: Call,
    depth: i32,
    /// Return address and stack depth of the unfinished functions.
    callers: Vec<(u32, i32)>,
    before: Option<Instruction>,
    this: Option<(u32, Instruction)>,
}

/// Splits a trace into calls.
pub(crate) struct Splitter<'p> {
    program: &'p Program,
    decoder: Decoder<'p>,
    timing: Option<Timing>,
    entries: HashMap<u32, usize>,
    kernels: Vec<Calls>,
    clock: u32,
    /// Number of instructions so far, and at the last reading of the clock.
    count: u64,
    started: Option<u64>,
    /// The last kernel called.
    last: Option<usize>,
    previous: u32,
    open: Option<Open>,
}

impl<'p> Splitter<'p> {
    /// A splitter for kernels with these symbols.
    pub(crate) fn new(
        program: &'p Program,
        timing: Option<Timing>,
        kernels: &[impl AsRef<str>],
    ) -> Result<Self> {
        let find = |name: &str| {
            program
                .address(name)
                .with_context(|| format!("no function {name} in the program"))
        };
        let mut entries = HashMap::new();
        for (index, name) in kernels.iter().map(AsRef::as_ref).enumerate() {
            if let Some(other) = entries.insert(find(name)?, index) {
                bail!("{name} and {} are the same code", kernels[other].as_ref());
            }
        }
        Ok(Self {
            program,
            decoder: Decoder::new(program)?,
            timing,
            entries,
            kernels: kernels.iter().map(|_| Calls::default()).collect(),
            clock: find(CLOCK)?,
            count: 0,
            started: None,
            last: None,
            previous: 0,
            open: None,
        })
    }

    /// The next executed address.
    pub(crate) fn step(&mut self, address: u32) -> Result<()> {
        self.count += 1;
        if let Some(mut open) = self.open.take() {
            if address == open.return_to {
                Self::charge(self.timing, &mut open, None, address);
                self.kernels[open.kernel].each.push(open.call);
                self.last = Some(open.kernel);
            } else {
                let next = self.decoder.at(address)?;
                self.kernels[open.kernel].enter(self.program, address);
                Self::charge(self.timing, &mut open, Some((address, next)), address);
                self.open = Some(open);
            }
        }
        if self.open.is_none() {
            if let Some(kernel) = self.entries.get(&address) {
                self.open = Some(self.open(*kernel, address)?);
            } else if address == self.clock {
                self.read_clock();
            }
        }
        self.previous = address;
        Ok(())
    }

    /// The calls of each kernel.
    pub(crate) fn finish(self) -> Result<Vec<Calls>> {
        if let Some(open) = self.open {
            bail!(
                "the program ended within a kernel that returns to {:#x}",
                open.return_to
            );
        }
        Ok(self.kernels)
    }

    fn open(&mut self, kernel: usize, address: u32) -> Result<Open> {
        let calling = self.decoder.at(self.previous)?;
        if !matches!(
            calling.kind,
            Kind::Branch { link: true } | Kind::BranchRegister { link: true }
        ) {
            bail!(
                "a kernel was not called, but jumped to, from {:#x}",
                self.previous
            );
        }
        let this = self.decoder.at(address)?;
        self.kernels[kernel].enter(self.program, address);
        let mut open = Open {
            kernel,
            return_to: self.previous + calling.size,
            call: Call::default(),
            depth: 0,
            callers: Vec::new(),
            before: None,
            this: None,
        };
        Self::charge(self.timing, &mut open, Some((address, this)), address);
        Ok(open)
    }

    /// Adds the cost of the instruction before `next`.
    fn charge(
        timing: Option<Timing>,
        open: &mut Open,
        next: Option<(u32, Instruction)>,
        address: u32,
    ) {
        if let Some((at, this)) = open.this {
            let follows = at + this.size;
            open.call.instructions += 1;
            if let Some(timing) = timing {
                open.call.cycles += timing.cycles(&Step {
                    before: open.before.as_ref(),
                    this: &this,
                    after: next.as_ref().map(|(_, after)| after),
                    taken: address != follows,
                });
            }
            if let Stack::By(bytes) = this.stack {
                open.depth += bytes;
            }
            open.call.stack = open.call.stack.max(open.depth.max(0).cast_unsigned());
            if matches!(
                this.kind,
                Kind::Branch { link: true } | Kind::BranchRegister { link: true }
            ) {
                open.callers.push((follows, open.depth));
            } else if open
                .callers
                .last()
                .is_some_and(|(back, _)| *back == address)
                && let Some((_, depth)) = open.callers.pop()
            {
                // A function restores the stack pointer, whatever it did with it.
                open.depth = depth;
            }
            open.before = Some(this);
        }
        open.this = next;
    }

    fn read_clock(&mut self) {
        match (self.started.take(), self.last.take()) {
            (Some(started), Some(kernel)) => {
                self.kernels[kernel].between_clocks = self.count - started;
            }
            _ => self.started = Some(self.count),
        }
    }
}

impl Calls {
    fn enter(&mut self, program: &Program, address: u32) {
        if let Some((start, _)) = program.function_at(address) {
            self.functions.insert(start);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A kernel at 0x100 that calls a helper at 0x110; a driver at 0x120 that calls the kernel; a clock at 0x130.
    fn program() -> Program {
        let mut code = vec![0; 0x40];
        let mut put =
            |at: usize, bytes: &[u8]| code[at - 0x100..][..bytes.len()].copy_from_slice(bytes);
        put(0x100, &[0x80, 0xb5]); // push {r7, lr}
        put(0x102, &[0x00, 0xf0, 0x05, 0xf8]); // bl 0x110
        put(0x106, &[0x80, 0xbd]); // pop {r7, pc}
        put(0x110, &[0xf0, 0xb5]); // push {r4-r7, lr}
        put(0x112, &[0xa5, 0x46]); // mov sp, r4
        put(0x114, &[0xf0, 0xbd]); // pop {r4-r7, pc}
        put(0x120, &[0x98, 0x47]); // blx r3
        put(0x122, &[0x00, 0xbf]); // nop
        put(0x130, &[0x70, 0x47]); // bx lr
        Program::of(
            0x100,
            &code,
            &[
                (0x100, "kernel", 8),
                (0x110, "helper", 6),
                (0x120, "driver", 4),
                (0x130, CLOCK, 2),
            ],
        )
    }

    const CALL: [u32; 6] = [0x100, 0x102, 0x110, 0x112, 0x114, 0x106];

    #[test]
    fn a_call_runs_from_the_first_instruction_to_the_return() {
        let program = program();
        let mut splitter = Splitter::new(&program, Some(Timing::M4), &["kernel"]).unwrap();
        for call in 0..3 {
            splitter.step(0x130).unwrap();
            for address in [0x120].iter().chain(&CALL).chain(&[0x122]) {
                splitter.step(*address).unwrap();
            }
            if call == 2 {
                splitter.step(0x130).unwrap();
            }
        }
        let kernel = splitter.finish().unwrap().remove(0);
        // push 3, bl 2, push 6, mov 1, pop 3 + 5, pop 3 + 2.
        let expected = Call {
            instructions: 6,
            cycles: 25,
            stack: 28,
        };
        assert_eq!(kernel.each, vec![expected; 3]);
        assert_eq!(kernel.bytes(&program), 8 + 6);
    }

    #[test]
    fn the_clock_spans_the_calls_of_a_kernel() {
        let program = program();
        let mut splitter = Splitter::new(&program, None, &["kernel"]).unwrap();
        let span = [0x130, 0x120].iter().chain(&CALL).chain(&[0x122, 0x130]);
        for address in [0x122].iter().chain(span) {
            splitter.step(*address).unwrap();
        }
        let kernel = splitter.finish().unwrap().remove(0);
        assert_eq!(kernel.between_clocks, 9);
        assert_eq!(kernel.each[0].cycles, 0);
    }

    #[test]
    fn a_trace_that_ends_within_a_call_is_an_error() {
        let program = program();
        let mut splitter = Splitter::new(&program, None, &["kernel"]).unwrap();
        for address in [0x120, 0x100, 0x102] {
            splitter.step(address).unwrap();
        }
        assert!(splitter.finish().is_err());
        assert!(Splitter::new(&program, None, &["missing"]).is_err());
    }
}
