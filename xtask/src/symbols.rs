//! Names in a program or in a static library, and those of routines that must not be there.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use object::read::archive::ArchiveFile;
use object::{File, Object, ObjectSymbol, SymbolKind};

/// A name for the linker.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Symbol {
    name: String,
    /// Whether other files can call it here.
    function: bool,
}

/// The symbols of a file in the order of their names; there must be some.
pub(crate) fn symbols(path: &Path) -> Result<Vec<Symbol>> {
    let bytes = std::fs::read(path);
    bytes
        .map_err(Into::into)
        .and_then(|bytes| all(&bytes))
        .with_context(|| path.display().to_string())
}

/// The symbols of a program, or of all members of a static library.
fn all(bytes: &[u8]) -> Result<Vec<Symbol>> {
    let mut found = Vec::new();
    if bytes.starts_with(&object::archive::MAGIC) {
        for member in ArchiveFile::parse(bytes)?.members() {
            collect(member?.data(bytes)?, &mut found)?;
        }
    } else {
        collect(bytes, &mut found)?;
    }
    ensure!(!found.is_empty(), "no symbols");
    found.sort();
    Ok(found)
}

fn collect(object: &[u8], found: &mut Vec<Symbol>) -> Result<()> {
    let file = File::parse(object)?;
    let named = |kind| !matches!(kind, SymbolKind::File | SymbolKind::Section);
    for symbol in file.symbols().filter(|symbol| named(symbol.kind())) {
        found.push(Symbol {
            name: symbol.name()?.to_owned(),
            function: symbol.kind() == SymbolKind::Text
                && symbol.is_definition()
                && symbol.is_global()
                && !symbol.is_weak(),
        });
    }
    Ok(())
}

/// Number of functions whose names begin with `prefix`.
pub(crate) fn functions(symbols: &[Symbol], prefix: &str) -> usize {
    symbols
        .iter()
        .filter(|symbol| symbol.function && symbol.name.starts_with(prefix))
        .count()
}

/// Symbols with which a panic would begin.
pub(crate) fn panics(symbols: &[Symbol]) -> Vec<&str> {
    names(symbols, |name| {
        name.contains("panic") || name.contains("begin_unwind")
    })
}

/// Routines in double precision: of the Arm run-time ABI, of the compiler, and functions of libm.
pub(crate) fn doubles(symbols: &[Symbol]) -> Vec<&str> {
    names(symbols, |name| {
        of_the_abi(name) || of_the_compiler(name) || of_libm(name)
    })
}

fn names(symbols: &[Symbol], wanted: impl Fn(&str) -> bool) -> Vec<&str> {
    let names = symbols.iter().map(|symbol| symbol.name.as_str());
    names.filter(|name| wanted(name)).collect()
}

/// Such as `__aeabi_dadd`, `__aeabi_f2d`.
fn of_the_abi(name: &str) -> bool {
    const OPERATIONS: [&str; 7] = ["d", "cd", "f2d", "i2d", "ui2d", "l2d", "ul2d"];
    name.strip_prefix("__aeabi_")
        .is_some_and(|rest| OPERATIONS.iter().any(|start| rest.starts_with(start)))
}

/// Such as `__adddf3`, `__truncdfsf2`, also at the end of a longer name.
fn of_the_compiler(name: &str) -> bool {
    let Some((_, routine)) = name.rsplit_once("__") else {
        return false;
    };
    let letter = |c: char| c.is_ascii_lowercase();
    routine.chars().all(|c| letter(c) || c.is_ascii_digit())
        && routine
            .split_once("df")
            .is_some_and(|(before, _)| before.chars().all(letter))
}

/// Such as `sin`, also at the end of a longer name, where its length stands before it.
fn of_libm(name: &str) -> bool {
    const FUNCTIONS: [&str; 20] = [
        "sin", "cos", "tan", "sincos", "asin", "acos", "atan", "atan2", "sqrt", "exp", "log",
        "pow", "floor", "ceil", "round", "rint", "trunc", "fmod", "fabs", "fma",
    ];
    FUNCTIONS.iter().any(|function| {
        name.strip_suffix(function).is_some_and(|before| {
            before.is_empty() || before.ends_with(|c: char| c.is_ascii_digit())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<Symbol> {
        let symbol = |name: &&str| Symbol {
            name: (*name).to_owned(),
            function: !name.starts_with("U_"),
        };
        names.iter().map(symbol).collect()
    }

    #[test]
    fn routines_in_double_precision_are_found() {
        let names = [
            "__aeabi_dadd",
            "__aeabi_cdcmple",
            "__aeabi_ul2d",
            "__adddf3",
            "__truncdfsf2",
            "_RNvNtNtCs7_17compiler_builtins5float3add8___adddf3",
            "sqrt",
            "_RNvNtNtCs7_4libm4math4sqrt",
            "_ZN4libm5atan2",
        ];
        assert_eq!(doubles(&of(&names)), names);
    }

    #[test]
    fn other_routines_are_not_taken_for_them() {
        let names = [
            "__aeabi_fadd",
            "__aeabi_f2iz",
            "__aeabi_idiv",
            "__addsf3",
            "__udivmoddi4",
            "__df_Table",
            "__add2df3",
            "adddf3",
            "sqrtf",
            "arc_sin",
            "cosine",
            "",
        ];
        assert_eq!(doubles(&of(&names)), [""; 0]);
    }

    #[test]
    fn beginnings_of_a_panic_are_found() {
        let names = [
            "_RNvNtCs7_4core9panicking18panic_bounds_check",
            "U_RNvCs7___rustc17rust_begin_unwind",
            "jred_gate_panic",
        ];
        assert_eq!(panics(&of(&names)), names);
        assert_eq!(panics(&of(&["jred_cubic_f32_torque", "memcpy"])), [""; 0]);
    }

    #[test]
    fn functions_are_counted_where_they_are() {
        let symbols = of(&["jred_a", "jred_b", "other", "U_jred_c"]);
        assert_eq!(functions(&symbols, "jred_"), 2);
        assert_eq!(functions(&symbols, "U_jred_"), 0);
    }

    #[test]
    #[cfg(target_os = "linux")] // Of programs only those of Linux have the form of those for a core.
    fn symbols_of_a_program_and_of_a_library_are_read() {
        let program = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        let once = all(&program).unwrap();
        assert_eq!(functions(&once, "main"), 1);
        assert!(!panics(&once).is_empty());

        // Twice the same member, at even places.
        let header = format!("{:<16}{:<12}{:<6}{:<6}{:<8}", "member.o/", 0, 0, 0, 644);
        let header = format!("{header}{:<10}`\n", program.len());
        let odd = vec![b'\n'; program.len() % 2];
        let member = [header.as_bytes(), &program, &odd].concat();
        let library = [b"!<arch>\n".as_slice(), &member, &member].concat();
        let twice = all(&library).unwrap();
        assert_eq!(twice.len(), 2 * once.len());
        assert_eq!(functions(&twice, "main"), 2);
    }

    #[test]
    fn a_file_without_symbols_is_an_error() {
        assert!(all(b"no object").is_err());
        let empty = all(b"!<arch>\n").unwrap_err();
        assert_eq!(empty.to_string(), "no symbols");
    }
}
