//! Cycles of an executed instruction, from Arm's published timings. Estimates: see [`Timing::cycles`].
//!
//! Sources: *Cortex-M0+ Technical Reference Manual* (DDI 0484C, table 3-1), *Cortex-M3 Processor TRM* (100165, table 3-1),
//! *Cortex-M4 Processor TRM* (100166, tables 3-1 and 7-1).

use crate::instruction::{Instruction, Kind};

/// A core with published timings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Timing {
    M0Plus,
    M3,
    M4,
}

/// An instruction with its neighbours.
pub(crate) struct Step<'a> {
    /// The previous one in the call.
    pub(crate) before: Option<&'a Instruction>,
    pub(crate) this: &'a Instruction,
    /// The next one.
    pub(crate) after: Option<&'a Instruction>,
    /// Whether the next one does not follow in memory.
    pub(crate) taken: bool,
}

/// Division: 2 to 12 cycles, depending on the operands; uses the largest.
const DIVIDE: u32 = 12;
/// A long multiplication of the M3: 3 to 5 cycles, 4 to 7 with an addition; uses the middle.
const LONG: [u32; 2] = [4, 5];

impl Timing {
    /// Cycles of an instruction without wait states, interrupts or contention.
    ///
    /// Where the manuals leave a choice: a taken branch refills in one cycle, a return or a branch to a register in two; divisions take the most,
    /// long multiplications of the M3 the middle; a load after a load or store that does not compute its address takes one cycle; in an IT block only
    /// a branch is known to be skipped, and the rest counts as executed; no instructions are folded.
    pub(crate) fn cycles(self, step: &Step) -> u32 {
        match self {
            Self::M0Plus => m0plus(step),
            Self::M3 => m3(step),
            Self::M4 => m4(step),
        }
    }
}

fn m0plus(step: &Step) -> u32 {
    match step.this.kind {
        Kind::Load | Kind::Store | Kind::BranchRegister { .. } => 2,
        Kind::Multiple(words) => 1 + words,
        Kind::PopPc(words) => 3 + words,
        Kind::Branch { link: true } | Kind::System => 3,
        Kind::Branch { .. } if step.taken => 2,
        _ => 1,
    }
}

fn m3(step: &Step) -> u32 {
    match step.this.kind {
        Kind::MultiplyAdd => 2,
        Kind::MultiplyLong { add } => LONG[usize::from(add)],
        _ => armv7m(step),
    }
}

fn m4(step: &Step) -> u32 {
    let own = match step.this.kind {
        Kind::FloatMultiplyAdd => 3,
        Kind::FloatDivide => 14,
        Kind::FloatMemory(words) => 1 + words,
        Kind::FloatMovePair => 2,
        _ => armv7m(step),
    };
    let arithmetic = matches!(
        step.this.kind,
        Kind::Float | Kind::FloatMultiplyAdd | Kind::FloatDivide
    );
    let awaited = step
        .after
        .is_some_and(|after| after.float_reads & step.this.float_writes != 0);
    own + u32::from(arithmetic && awaited)
}

/// Common to the M3 and the M4.
fn armv7m(step: &Step) -> u32 {
    match step.this.kind {
        // Skipped in an IT block.
        Kind::BranchRegister { .. } | Kind::PopPc(_) if !step.taken => 1,
        Kind::Load if follows_memory(step) => 1,
        Kind::Store if step.this.immediate_offset => 1,
        Kind::Load | Kind::Store | Kind::System => 2,
        Kind::Multiple(words) => 1 + words,
        Kind::PopPc(words) => 3 + words,
        Kind::Divide => DIVIDE,
        Kind::Branch { .. } if step.taken => 2,
        Kind::BranchRegister { .. } => 3,
        Kind::TableBranch => 4,
        _ => 1,
    }
}

/// Whether a load follows a load or store and does not depend on it.
fn follows_memory(step: &Step) -> bool {
    step.before.is_some_and(|before| {
        matches!(before.kind, Kind::Load | Kind::Store) && before.writes & step.this.reads == 0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elf::Program;
    use crate::instruction::Decoder;

    /// Cycles of straight-line code.
    fn straight(timing: Timing, code: &[u8]) -> Vec<u32> {
        let program = Program::of(0, code, &[]);
        let mut decoder = Decoder::new(&program).unwrap();
        let mut instructions = Vec::new();
        let mut at = 0;
        while (at as usize) < code.len() {
            instructions.push(decoder.at(at).unwrap());
            at += instructions.last().unwrap().size;
        }
        (0..instructions.len())
            .map(|k| {
                timing.cycles(&Step {
                    before: k.checked_sub(1).map(|before| &instructions[before]),
                    this: &instructions[k],
                    after: instructions.get(k + 1),
                    taken: false,
                })
            })
            .collect()
    }

    #[test]
    fn loads_that_follow_each_other_pipeline_unless_they_chain() {
        // ldr r0, [r1, #24]; ldr r2, [r1, #28]; ldr r3, [r2]; adds r0, r0, r3
        let code = [0x88, 0x69, 0xca, 0x69, 0x13, 0x68, 0xc0, 0x18];
        assert_eq!(straight(Timing::M4, &code), [2, 1, 2, 1]);
        assert_eq!(straight(Timing::M3, &code), [2, 1, 2, 1]);
        assert_eq!(straight(Timing::M0Plus, &code), [2, 2, 2, 1]);
    }

    #[test]
    fn a_float_result_used_at_once_costs_one_more() {
        // vadd.f32 s0, s0, s3; vmla.f32 s1, s0, s2; vdiv.f32 s0, s2, s3; vldr s14, [r1, #12]; vadd.f32 s14, s14, s3
        let code = [
            0x30, 0xee, 0x21, 0x0a, 0x40, 0xee, 0x01, 0x0a, 0x81, 0xee, 0x21, 0x0a, 0x91, 0xed,
            0x03, 0x7a, 0x37, 0xee, 0x21, 0x7a,
        ];
        // The load is not arithmetic: no additional cycle.
        assert_eq!(straight(Timing::M4, &code), [2, 3, 14, 2, 1]);
    }

    #[test]
    fn the_long_multiplication_and_the_division() {
        // umull r0, r1, r1, r2; sdiv r0, r0, r1; muls r0, r1, r0
        let code = [0xa1, 0xfb, 0x02, 0x01, 0x90, 0xfb, 0xf1, 0xf0, 0x48, 0x43];
        assert_eq!(straight(Timing::M3, &code), [4, 12, 1]);
        assert_eq!(straight(Timing::M4, &code), [1, 12, 1]);
    }

    #[test]
    fn branches_and_returns() {
        let program = Program::of(0, &[0x08, 0xd0, 0x80, 0xb5, 0x80, 0xbd, 0x70, 0x47], &[]); // beq, push, pop, bx lr
        let mut decoder = Decoder::new(&program).unwrap();
        let mut cycles = |timing: Timing, at, taken| {
            let this = decoder.at(at).unwrap();
            timing.cycles(&Step {
                before: None,
                this: &this,
                after: None,
                taken,
            })
        };
        assert_eq!(
            [0, 2, 4, 6].map(|at| cycles(Timing::M0Plus, at, at != 2)),
            [2, 3, 5, 2]
        );
        assert_eq!(
            [0, 2, 4, 6].map(|at| cycles(Timing::M4, at, at != 2)),
            [2, 3, 5, 3]
        );
        assert_eq!([0, 6].map(|at| cycles(Timing::M4, at, false)), [1, 1]);
    }
}
