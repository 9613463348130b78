//! From a mnemonic and its operands to the properties of an instruction.

use anyhow::{Result, bail};

use crate::instruction::{Instruction, Kind, Stack};

/// The operands of an instruction.
#[derive(Default)]
pub(crate) struct Operands {
    /// Names of the registers, in order.
    registers: Vec<String>,
    reads: u16,
    writes: u16,
    float_reads: u32,
    float_writes: u32,
    pub(crate) immediate: Option<i32>,
    base: Option<String>,
    indexed: bool,
    offset: i32,
}

const SP: &str = "sp";

/// Bit of a core register.
fn core_bit(name: &str) -> u16 {
    let number = match name {
        "sb" => 9,
        "sl" => 10,
        "fp" => 11,
        "ip" => 12,
        SP => 13,
        "lr" => 14,
        "pc" => 15,
        _ => match name.strip_prefix('r').and_then(|n| n.parse::<u32>().ok()) {
            Some(number) => number,
            None => return 0,
        },
    };
    1 << number
}

/// Bits of a floating-point register: a double is two singles.
fn float_bits(name: &str) -> u32 {
    let number = |prefix| {
        name.strip_prefix(prefix)
            .and_then(|n: &str| n.parse::<u32>().ok())
    };
    match (number('s'), number('d')) {
        (Some(single), _) => 1u32.checked_shl(single).unwrap_or(0),
        (_, Some(double)) => 3u32.checked_shl(2 * double).unwrap_or(0),
        _ => 0,
    }
}

impl Operands {
    pub(crate) fn register(&mut self, name: &str, reads: bool, writes: bool) {
        if reads {
            self.reads |= core_bit(name);
            self.float_reads |= float_bits(name);
        }
        if writes {
            self.writes |= core_bit(name);
            self.float_writes |= float_bits(name);
        }
        self.registers.push(name.to_owned());
    }

    pub(crate) fn memory(&mut self, base: &str, index: &str, offset: i32) {
        self.reads |= core_bit(base) | core_bit(index);
        self.base = Some(base.to_owned());
        self.indexed = core_bit(index) != 0;
        self.offset = offset;
    }

    /// Words of a register list from the operand `from` on.
    fn words(&self, from: usize) -> u32 {
        self.registers
            .iter()
            .skip(from)
            .map(|name| if name.starts_with('d') { 2 } else { 1 })
            .sum()
    }

    pub(crate) fn instruction(
        self,
        mnemonic: &str,
        size: u32,
        writeback: bool,
    ) -> Result<Instruction> {
        let (name, suffix) = mnemonic.split_once('.').unwrap_or((mnemonic, ""));
        let (kind, stack) = self.classify(name, suffix, writeback)?;
        let branches = matches!(kind, Kind::Branch { .. });
        Ok(Instruction {
            target: self.immediate.filter(|_| branches).map(i32::cast_unsigned),
            conditional: branches && !matches!(name, "b" | "bl"),
            skips: is_it(name).then(|| name.len() as u32 - 1),
            size,
            kind,
            stack,
            reads: self.reads,
            writes: self.writes,
            float_reads: self.float_reads,
            float_writes: self.float_writes,
            immediate_offset: !self.indexed,
        })
    }

    fn classify(&self, name: &str, suffix: &str, writeback: bool) -> Result<(Kind, Stack)> {
        let still = Stack::By(0);
        let to_pc = self.registers.iter().any(|r| r == "pc");
        let on_stack =
            self.base.as_deref() == Some(SP) || self.registers.first().is_some_and(|r| r == SP);
        let moved = |words: u32, down: bool| {
            let bytes = 4 * words as i32;
            Stack::By(if down { bytes } else { -bytes })
        };
        let double =
            self.registers.first().is_some_and(|r| r.starts_with('d')) || suffix.contains("f64");
        Ok(match name {
            "push" | "vpush" => (Kind::Multiple(self.words(0)), moved(self.words(0), true)),
            "pop" if to_pc => (Kind::PopPc(self.words(0)), moved(self.words(0), false)),
            "pop" | "vpop" => (Kind::Multiple(self.words(0)), moved(self.words(0), false)),
            "ldm" | "ldmdb" | "stm" | "stmdb" | "vldmia" | "vldmdb" | "vstmia" | "vstmdb" => {
                let words = self.words(1);
                let kind = if to_pc {
                    Kind::PopPc(words)
                } else {
                    Kind::Multiple(words)
                };
                let pushes = writeback && on_stack;
                (
                    kind,
                    if pushes {
                        moved(words, name.ends_with("db"))
                    } else {
                        still
                    },
                )
            }
            "ldrd" | "strd" => (Kind::Multiple(2), self.moved_base(writeback)),
            _ if name.starts_with("ldr") && to_pc => (Kind::PopPc(1), self.moved_base(writeback)),
            _ if name.starts_with("ldr") => (Kind::Load, self.moved_base(writeback)),
            _ if name.starts_with("str") => (Kind::Store, self.moved_base(writeback)),
            "vldr" | "vstr" => (Kind::FloatMemory(if double { 2 } else { 1 }), still),
            "mul" | "muls" | "smulbb" | "smulbt" | "smultb" | "smultt" | "smulwb" | "smulwt" => {
                (Kind::Multiply, still)
            }
            "mla" | "mls" => (Kind::MultiplyAdd, still),
            "smull" | "umull" | "smmul" | "smmulr" => (Kind::MultiplyLong { add: false }, still),
            "smlal" | "umlal" | "umaal" | "smmla" | "smmlar" | "smmls" | "smmlsr" => {
                (Kind::MultiplyLong { add: true }, still)
            }
            "sdiv" | "udiv" => (Kind::Divide, still),
            "b" | "cbz" | "cbnz" => (Kind::Branch { link: false }, still),
            "bl" => (Kind::Branch { link: true }, still),
            "bx" => (Kind::BranchRegister { link: false }, still),
            "blx" => (Kind::BranchRegister { link: true }, still),
            "tbb" | "tbh" => (Kind::TableBranch, still),
            "mrs" | "msr" | "dmb" | "dsb" | "isb" | "cpsid" | "cpsie" | "bkpt" | "svc" => {
                (Kind::System, still)
            }
            _ if name.len() == 3 && name.starts_with('b') && is_condition(&name[1..]) => {
                (Kind::Branch { link: false }, still)
            }
            "vmla" | "vmls" | "vnmla" | "vnmls" | "vfma" | "vfms" | "vfnma" | "vfnms" => {
                (Kind::FloatMultiplyAdd, still)
            }
            "vdiv" | "vsqrt" => (Kind::FloatDivide, still),
            "vmov" if self.registers.len() > 2 => (Kind::FloatMovePair, still),
            "vadd" | "vsub" | "vmul" | "vnmul" | "vneg" | "vabs" | "vcmp" | "vcmpe" | "vcvt"
            | "vcvtr" | "vmov" | "vmrs" | "vmsr" | "vrintz" | "vrintr" | "vrintx" | "vrinta"
            | "vrintn" | "vrintp" | "vrintm" | "vcvta" | "vcvtn" | "vcvtp" | "vcvtm" | "vmaxnm"
            | "vminnm" => (Kind::Float, still),
            _ if name.starts_with("vsel") => (Kind::Float, still),
            _ if name.starts_with('v') => bail!("no timing for {name}"),
            _ if self.registers.first().is_some_and(|r| r == SP)
                && self.writes & core_bit(SP) != 0 =>
            {
                (Kind::Plain, self.moved_pointer(name))
            }
            _ => (Kind::Plain, still),
        })
    }

    /// Movement of the stack pointer by the offset of a load or store.
    fn moved_base(&self, writeback: bool) -> Stack {
        let by = if self.offset != 0 {
            self.offset
        } else {
            self.immediate.unwrap_or(0)
        };
        let moves = writeback && self.base.as_deref() == Some(SP);
        Stack::By(if moves { -by } else { 0 })
    }

    /// `sub sp, …`, `add sp, …`, `mov sp, …`.
    fn moved_pointer(&self, name: &str) -> Stack {
        let own = self.registers.get(1).is_none_or(|r| r == SP);
        match (name, self.immediate) {
            ("sub" | "subw", Some(bytes)) if own => Stack::By(bytes),
            ("add" | "addw", Some(bytes)) if own => Stack::By(-bytes),
            _ => Stack::Restore,
        }
    }
}

/// `it`, `itt`, `ite`, …
fn is_it(name: &str) -> bool {
    name.strip_prefix("it")
        .is_some_and(|rest| rest.chars().all(|c| c == 't' || c == 'e'))
}

fn is_condition(name: &str) -> bool {
    matches!(
        name,
        "eq" | "ne"
            | "hs"
            | "cs"
            | "lo"
            | "cc"
            | "mi"
            | "pl"
            | "vs"
            | "vc"
            | "hi"
            | "ls"
            | "ge"
            | "lt"
            | "gt"
            | "le"
    )
}
