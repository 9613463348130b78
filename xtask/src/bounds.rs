//! Upper bound of a function's cost for all arguments: the longest path through its code, and the deepest stack.
//!
//! The code is followed from the first instruction through both sides of every branch and into every call. That ends, because a tick has no loop, no
//! recursion and no call through a pointer; otherwise it fails. So the bound is valid for every argument, without running the program. Not every path
//! can be taken: the bound may be larger than any call.

use std::collections::{HashMap, HashSet};

use anyhow::{Context, Result, bail, ensure};

use crate::elf::Program;
use crate::instruction::{Decoder, Kind, Stack};

/// From an instruction to the return of its function, including all calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Bound {
    pub(crate) instructions: u32,
    /// Bytes of stack.
    pub(crate) stack: u32,
}

impl Bound {
    fn or(self, other: Self) -> Self {
        Self {
            instructions: self.instructions.max(other.instructions),
            stack: self.stack.max(other.stack),
        }
    }

    fn then(self, next: Self) -> Self {
        Self {
            instructions: self.instructions + next.instructions,
            stack: self.stack.max(next.stack),
        }
    }
}

/// The bounds of a program's instructions, each computed once.
pub(crate) struct Bounds<'p> {
    program: &'p Program,
    decoder: Decoder<'p>,
    known: HashMap<u32, Bound>,
    /// Instructions being followed: reaching one of them again is a loop.
    open: HashSet<u32>,
}

impl<'p> Bounds<'p> {
    pub(crate) fn new(program: &'p Program) -> Result<Self> {
        Ok(Self {
            program,
            decoder: Decoder::new(program)?,
            known: HashMap::new(),
            open: HashSet::new(),
        })
    }

    /// The bound of the function `name`.
    pub(crate) fn of(&mut self, name: &str) -> Result<Bound> {
        let address = self.program.address(name);
        let address = address.with_context(|| format!("no function {name} in the program"))?;
        self.from(address, 0)
            .with_context(|| format!("{name} has no bound"))
    }

    /// The bound of the only function whose mangled name contains `part`.
    pub(crate) fn containing(&mut self, part: &str) -> Result<Bound> {
        let address = self.program.address_containing(part)?;
        self.from(address, 0)
            .with_context(|| format!("{part} has no bound"))
    }

    /// From `address` on, where an IT block may skip the next `skippable` instructions. The recursion is as deep as the code branches.
    fn from(&mut self, address: u32, skippable: u32) -> Result<Bound> {
        if let Some(known) = self.known.get(&address) {
            return Ok(*known);
        }
        let place = || match self.program.function_at(address) {
            Some((start, function)) => format!("{}+{:#x}", function.name, address - start),
            None => format!("{address:#x}"),
        };
        ensure!(
            self.open.insert(address),
            "a loop or a recursion at {}",
            place()
        );
        let this = self.decoder.at(address).with_context(place)?;
        let next = address + this.size;
        let target = || {
            this.target
                .with_context(|| format!("a branch to nowhere at {}", place()))
        };
        let may_go_on = this.conditional || skippable > 0;
        let left = this.skips.unwrap_or(skippable.saturating_sub(1));
        let after = match this.kind {
            Kind::Branch { link: true } => self.from(target()?, 0)?.then(self.from(next, left)?),
            Kind::Branch { link: false } if may_go_on => {
                self.from(target()?, 0)?.or(self.from(next, left)?)
            }
            Kind::Branch { link: false } => self.from(target()?, 0)?,
            Kind::BranchRegister { link: false } | Kind::PopPc(_) => {
                let popped = matches!(this.stack, Stack::By(bytes) if bytes < 0);
                ensure!(
                    popped || this.reads == LR,
                    "a jump through a register at {}",
                    place()
                );
                if may_go_on {
                    self.from(next, left)?
                } else {
                    Bound::default()
                }
            }
            Kind::BranchRegister { link: true } | Kind::TableBranch => {
                bail!("a call or a jump through a register at {}", place())
            }
            _ => {
                let jumps = this.writes & PC != 0;
                ensure!(!jumps, "a jump through a register at {}", place());
                self.from(next, left)?
            }
        };
        // Where a function restores its stack pointer from a register, the stack is assumed to stay as deep as before.
        let down = match this.stack {
            Stack::By(bytes) => bytes,
            Stack::Restore => 0,
        };
        let executed = after
            .stack
            .saturating_add_signed(down)
            .max(down.max(0).cast_unsigned());
        // Instructions that an IT block skips release no stack.
        let skipped = if skippable > 0 { after.stack } else { 0 };
        let bound = Bound {
            instructions: 1 + after.instructions,
            stack: executed.max(skipped),
        };
        self.open.remove(&address);
        self.known.insert(address, bound);
        Ok(bound)
    }
}

/// The link register and the program counter, as bits of the core registers.
const LR: u16 = 1 << 14;
const PC: u16 = 1 << 15;

#[cfg(test)]
mod tests {
    use super::*;

    fn bound(code: &[u8]) -> Result<Bound> {
        let program = Program::of(0x100, code, &[(0x100, "f", code.len() as u32)]);
        Bounds::new(&program)?.of("f")
    }

    #[test]
    fn the_longer_side_of_a_branch_counts() {
        // cmp r0, r1; beq +4; movs; movs; bx lr
        let found = bound(&[0x88, 0x42, 0x01, 0xd0, 0x00, 0x20, 0x00, 0x20, 0x70, 0x47]);
        assert_eq!(
            found.unwrap(),
            Bound {
                instructions: 5,
                stack: 0
            }
        );
        // An instruction that an IT block may skip does not end the function: it eq; bx(eq) lr; movs; bx lr
        let found = bound(&[0x08, 0xbf, 0x70, 0x47, 0x00, 0x20, 0x70, 0x47]);
        assert_eq!(
            found.unwrap(),
            Bound {
                instructions: 4,
                stack: 0
            }
        );
    }

    #[test]
    fn a_call_counts_with_its_stack() {
        // push {r7, lr}; bl +4 (the function below); pop {r7, pc}; sub sp, #8; add sp, #8; bx lr
        let code = [
            0x80, 0xb5, 0x00, 0xf0, 0x01, 0xf8, 0x80, 0xbd, 0x82, 0xb0, 0x02, 0xb0, 0x70, 0x47,
        ];
        assert_eq!(
            bound(&code).unwrap(),
            Bound {
                instructions: 6,
                stack: 16
            }
        );
    }

    #[test]
    fn what_is_skipped_gives_no_stack_back() {
        // push {r7, lr}; it eq; pop(eq) {r7, pc}; bl +6 (the function below); pop {r7, pc}; sub sp, #20; add sp, #20; bx lr
        let code = [
            0x80, 0xb5, 0x08, 0xbf, 0x80, 0xbd, 0x00, 0xf0, 0x01, 0xf8, 0x80, 0xbd, 0x85, 0xb0,
            0x05, 0xb0, 0x70, 0x47,
        ];
        assert_eq!(
            bound(&code).unwrap(),
            Bound {
                instructions: 8,
                stack: 28
            }
        );
    }

    #[test]
    fn what_has_no_bound_is_refused() {
        for (code, what) in [
            (&[0x00, 0x20, 0xfd, 0xe7][..], "a loop"), // movs; b -2
            (
                &[0x00, 0xb5, 0xff, 0xf7, 0xfd, 0xff, 0x00, 0xbd],
                "recursion",
            ), // push {lr}; bl f
            (&[0x98, 0x47, 0x70, 0x47], "a register"), // blx r3
            (&[0x18, 0x47], "a register"),             // bx r3
            (&[0x87, 0x44], "a register"),             // add pc, r0
            (&[0x50, 0xf8, 0x21, 0xf0], "a register"), // ldr pc, [r0, r1, lsl #2]
        ] {
            let error = format!("{:#}", bound(code).unwrap_err());
            assert!(error.contains(what), "{error}");
        }
    }
}
