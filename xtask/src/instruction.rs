//! Instructions, with the properties that determine timing and use of the stack.

use std::collections::HashMap;

use anyhow::{Context, Result};
use capstone::AccessType;
use capstone::arch::arm::{ArchExtraMode, ArchMode, ArmOperandType};
use capstone::prelude::*;

use crate::elf::Program;
use crate::mnemonic::Operands;

/// The kind of an instruction, as far as timing depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Every instruction with one cycle.
    Plain,
    Multiply,
    MultiplyAdd,
    /// 32 by 32 to 64 bits, `add` with an addition; or its high word (M4).
    MultiplyLong {
        add: bool,
    },
    Divide,
    Load,
    Store,
    /// Several words at once.
    Multiple(u32),
    /// A branch to an address in the instruction.
    Branch {
        link: bool,
    },
    /// A branch to a register's contents.
    BranchRegister {
        link: bool,
    },
    /// Loads several words, the last of them into the program counter.
    PopPc(u32),
    /// `tbb`, `tbh`.
    TableBranch,
    /// Floating point with one cycle.
    Float,
    FloatMultiplyAdd,
    /// Division and root.
    FloatDivide,
    /// `vldr`, `vstr` of several words.
    FloatMemory(u32),
    /// Between two core registers and the floating-point unit.
    FloatMovePair,
    /// Reads or writes a special register.
    System,
}

/// Movement of the stack pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stack {
    /// Down by this number of bytes; up if negative.
    By(i32),
    /// Restored from a register.
    Restore,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    pub(crate) size: u32,
    pub(crate) kind: Kind,
    pub(crate) stack: Stack,
    /// Core registers read and written, one bit each.
    pub(crate) reads: u16,
    pub(crate) writes: u16,
    /// Single-precision registers read and written, one bit each.
    pub(crate) float_reads: u32,
    pub(crate) float_writes: u32,
    /// Whether the address is a register and an immediate.
    pub(crate) immediate_offset: bool,
    /// Target of a branch to an address in the instruction.
    pub(crate) target: Option<u32>,
    /// Whether a branch may not be taken.
    pub(crate) conditional: bool,
    /// For `it`: how many of the next instructions may be skipped.
    pub(crate) skips: Option<u32>,
}

/// Decodes the instructions of a program, each once.
pub(crate) struct Decoder<'p> {
    program: &'p Program,
    capstone: Capstone,
    known: HashMap<u32, Instruction>,
}

impl<'p> Decoder<'p> {
    pub(crate) fn new(program: &'p Program) -> Result<Self> {
        let capstone = Capstone::new()
            .arm()
            .mode(ArchMode::Thumb)
            .extra_mode([ArchExtraMode::MClass, ArchExtraMode::V8].into_iter())
            .detail(true)
            .build()?;
        Ok(Self {
            program,
            capstone,
            known: HashMap::new(),
        })
    }

    /// The instruction at `address`.
    pub(crate) fn at(&mut self, address: u32) -> Result<Instruction> {
        if let Some(known) = self.known.get(&address) {
            return Ok(*known);
        }
        let code = self
            .program
            .code(address)
            .with_context(|| format!("no code at {address:#x}"))?;
        let decoded = self
            .decode(code, address)
            .with_context(|| format!("the instruction at {address:#x}: {code:02x?}"))?;
        self.known.insert(address, decoded);
        Ok(decoded)
    }

    fn decode(&self, code: &[u8], address: u32) -> Result<Instruction> {
        let found = self.capstone.disasm_count(code, u64::from(address), 1)?;
        let one = found.iter().next().context("not decoded")?;
        let mnemonic = one.mnemonic().context("no mnemonic")?;
        let detail = self.capstone.insn_detail(one)?;
        let arch = detail.arch_detail();
        let arm = arch.arm().context("not an Arm instruction")?;
        let mut operands = Operands::default();
        for operand in arm.operands() {
            let access = operand.access;
            match operand.op_type {
                ArmOperandType::Reg(register) => {
                    let name = self.capstone.reg_name(register).unwrap_or_default();
                    let reads = access.is_none_or(AccessType::is_readable);
                    operands.register(&name, reads, access.is_some_and(AccessType::is_writable));
                }
                ArmOperandType::Mem(memory) => {
                    let base = self.capstone.reg_name(memory.base()).unwrap_or_default();
                    let index = self.capstone.reg_name(memory.index()).unwrap_or_default();
                    operands.memory(&base, &index, memory.disp());
                }
                ArmOperandType::Imm(value) => operands.immediate = Some(value),
                _ => {}
            }
        }
        operands.instruction(mnemonic, one.len() as u32, arm.writeback())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decode(code: &[u8]) -> Instruction {
        let program = Program::of(0x100, code, &[]);
        Decoder::new(&program).unwrap().at(0x100).unwrap()
    }

    #[test]
    fn instructions_are_told_apart() {
        for (code, size, kind) in [
            (&[0x80, 0xb5][..], 2, Kind::Multiple(2)), // push {r7, lr}
            (&[0x80, 0xbd], 2, Kind::PopPc(2)),        // pop {r7, pc}
            (&[0x88, 0x42], 2, Kind::Plain),           // cmp r0, r1
            (&[0x48, 0x43], 2, Kind::Multiply),        // muls r0, r1, r0
            (&[0x70, 0x47], 2, Kind::BranchRegister { link: false }), // bx lr
            (&[0x98, 0x47], 2, Kind::BranchRegister { link: true }), // blx r3
            (&[0x08, 0xd0], 2, Kind::Branch { link: false }), // beq
            (
                &[0xa1, 0xfb, 0x02, 0x01],
                4,
                Kind::MultiplyLong { add: false },
            ), // umull r0, r1, r1, r2
            (&[0x90, 0xfb, 0xf1, 0xf0], 4, Kind::Divide), // sdiv r0, r0, r1
            (&[0x88, 0x69], 2, Kind::Load),            // ldr r0, [r1, #24]
            (&[0xd0, 0xe9, 0x01, 0x32], 4, Kind::Multiple(2)), // ldrd r3, r2, [r0, #4]
            (&[0x30, 0xee, 0x21, 0x0a], 4, Kind::Float), // vadd.f32 s0, s0, s3
            (&[0x81, 0xee, 0x00, 0x0a], 4, Kind::FloatDivide), // vdiv.f32 s0, s2, s0
            (&[0x00, 0xee, 0x81, 0x0a], 4, Kind::FloatMultiplyAdd), // vmla.f32 s0, s1, s2
            (&[0x91, 0xed, 0x03, 0x7a], 4, Kind::FloatMemory(1)), // vldr s14, [r1, #12]
            (&[0x91, 0xec, 0x06, 0x0a], 4, Kind::Multiple(6)), // vldmia r1, {s0-s5}
        ] {
            let found = decode(code);
            assert_eq!((found.size, found.kind), (size, kind), "{code:02x?}");
        }
    }

    #[test]
    fn the_stack_pointer_is_followed() {
        for (code, stack) in [
            (&[0xf0, 0xb5][..], Stack::By(20)),         // push {r4-r7, lr}
            (&[0x82, 0xb0], Stack::By(8)),              // sub sp, #8
            (&[0x02, 0xb0], Stack::By(-8)),             // add sp, #8
            (&[0x2d, 0xed, 0x04, 0x8b], Stack::By(16)), // vpush {d8, d9}
            (&[0x4d, 0xf8, 0x04, 0xbd], Stack::By(4)),  // str r11, [sp, #-4]!
            (&[0x5d, 0xf8, 0x04, 0xbb], Stack::By(-4)), // ldr r11, [sp], #4
            (&[0x2d, 0xe9, 0xf0, 0x0f], Stack::By(32)), // push.w {r4-r11}
            (&[0xa5, 0x46], Stack::Restore),            // mov sp, r4
            (&[0x01, 0x98], Stack::By(0)),              // ldr r0, [sp, #4]
        ] {
            assert_eq!(decode(code).stack, stack, "{code:02x?}");
        }
    }

    #[test]
    fn registers_are_read_and_written() {
        let add = decode(&[0x30, 0xee, 0x21, 0x0a]); // vadd.f32 s0, s0, s3
        assert_eq!((add.float_reads, add.float_writes), (0b1001, 0b1));
        let load = decode(&[0x88, 0x69]); // ldr r0, [r1, #24]
        assert_eq!((load.reads, load.writes), (0b10, 0b1));
    }
}
