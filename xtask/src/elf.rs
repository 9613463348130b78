//! The program as linked: its code and its functions.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail};
use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Function {
    pub(crate) name: String,
    /// Bytes, including the constants after the code.
    pub(crate) size: u32,
}

/// Code and functions.
pub(crate) struct Program {
    /// Address of the code.
    base: u32,
    code: Vec<u8>,
    functions: BTreeMap<u32, Function>,
}

impl Program {
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
        let file = object::File::parse(&*bytes)?;
        let text = file.section_by_name(".text").context("no section .text")?;
        let mut functions = BTreeMap::new();
        for symbol in file
            .symbols()
            .filter(|s| s.kind() == SymbolKind::Text && s.size() > 0)
        {
            // Bit 0 marks Thumb code.
            let function = Function {
                name: symbol.name()?.to_owned(),
                size: symbol.size() as u32,
            };
            functions.insert(symbol.address() as u32 & !1, function);
        }
        Ok(Self {
            base: text.address() as u32,
            code: text.data()?.to_vec(),
            functions,
        })
    }

    #[cfg(test)]
    pub(crate) fn of(base: u32, code: &[u8], functions: &[(u32, &str, u32)]) -> Self {
        let functions = functions
            .iter()
            .map(|(at, name, size)| {
                (
                    *at,
                    Function {
                        name: (*name).to_owned(),
                        size: *size,
                    },
                )
            })
            .collect();
        Self {
            base,
            code: code.to_vec(),
            functions,
        }
    }

    /// First address of the code, and the first after it.
    pub(crate) fn range(&self) -> [u32; 2] {
        [self.base, self.base + self.code.len() as u32]
    }

    /// The code at `address`, at most four bytes.
    pub(crate) fn code(&self, address: u32) -> Option<&[u8]> {
        let at = address.checked_sub(self.base)? as usize;
        let end = self.code.len().min(at + 4);
        self.code.get(at..end).filter(|code| code.len() >= 2)
    }

    /// Address of the function `name`.
    pub(crate) fn address(&self, name: &str) -> Option<u32> {
        self.functions
            .iter()
            .find(|(_, function)| function.name == name)
            .map(|(address, _)| *address)
    }

    /// Address of the only function whose name contains `part`: compilers extend names.
    pub(crate) fn address_containing(&self, part: &str) -> Result<u32> {
        let mut found = self
            .functions
            .iter()
            .filter(|(_, function)| function.name.contains(part));
        match (found.next(), found.next()) {
            (Some((address, _)), None) => Ok(*address),
            (None, _) => bail!("no function {part} in the program"),
            _ => bail!("several functions {part} in the program"),
        }
    }

    /// The function that contains the instruction at `address`.
    pub(crate) fn function_at(&self, address: u32) -> Option<(u32, &Function)> {
        let (start, function) = self.functions.range(..=address).next_back()?;
        (address < start + function.size).then_some((*start, function))
    }
}
