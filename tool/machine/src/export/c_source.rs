//! The table as C source: words, and what `jred.h` needs to make functions of them.

use std::path::Path;

use jred::curves;
use jred::slider_crank::terms;

use super::Export;
use super::candidate::{Candidate, Made};
use super::choice::{LayoutName, Number};
use super::form::rows;

/// The name of a machine file as the start of names in C.
fn identifier(name: &str) -> String {
    let stem = Path::new(name).file_stem().unwrap_or_default();
    let words = stem.to_string_lossy();
    let name: String = words
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name
    } else {
        format!("machine_{name}")
    }
}

/// What `jred.h` makes the functions of a machine of.
fn model(name: &str, table: &Candidate) -> String {
    let number = match table.number {
        Number::F32 => "f32",
        Number::I32 => "q31",
        Number::I16 => "q15",
    };
    let (layout, set) = (table.layout.name().replace('-', "_"), table.curves());
    // Harmonics with frictions that vary, and slider-cranks with uncommon terms, have too many sets for functions of their own.
    let rare = match table.layout {
        LayoutName::Harmonic => curves::VISCOUS | curves::COULOMB,
        LayoutName::SliderCrank => {
            curves::VISCOUS | terms::ALL & !(terms::LOAD_SIN | terms::LOAD_COS)
        }
        _ => 0,
    };
    if set & rare != 0 {
        format!("JRED_ANY_MODEL({name}, {layout}_{number});")
    } else {
        format!("JRED_MODEL({name}, {layout}_{number}, {set});")
    }
}

/// In C++ a constant is seen in its file only, unless it was declared `extern`.
fn constant(declaration: &str, value: &str) -> String {
    format!("extern const {declaration};\nconst {declaration} = {value};\n")
}

fn array(name: &str, words: &[u32]) -> String {
    let declaration = format!("uint32_t {name}[{}]", words.len());
    constant(&declaration, &format!("{{\n{}}}", rows(words)))
}

/// A source file of C or C++, compiled or included: once, and with the same names in both. Where `jred.h` was included before, it
/// has the functions of the machine.
fn source(name: &str, data: &str, functions: &str) -> String {
    let guard = format!("{}_TABLE", name.to_uppercase());
    format!(
        "#ifndef {guard}\n#define {guard}\n\n#include <stdint.h>\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n{data}\n\
         #ifdef __cplusplus\n}}\n#endif\n\n{functions}#endif\n"
    )
}

/// Where `jred.h` was included before.
fn with_jred(functions: &str) -> String {
    format!("#ifdef JRED_H\n{functions}\n#endif\n\n")
}

/// The identifier that `jred_info` has of an image, and `jred_plan` of a plan, of this machine.
fn machine_constant(name: &str, machine: u32) -> String {
    format!(
        "/* Identifier of the machine: that of another in jred_info is another machine's. */\n\
         #define {}_MACHINE 0x{machine:08x}u\n\n",
        name.to_uppercase()
    )
}

/// A plan as a source file of C or C++, under the name of its file.
pub fn plan_c_source(title: &str, file: &str, machine: u32, words: &[u32]) -> String {
    let name = identifier(file);
    let data = machine_constant(&name, machine) + &array(&format!("{name}_words"), words);
    let title = title.replace(['\n', '\r'], " ");
    format!("// {title}\n{}", source(&name, &data, ""))
}

impl Export {
    /// One table.
    pub(super) fn c_table(&self, table: &Made) -> String {
        let name = identifier(&self.name);
        let model = model(&name, self.chosen());
        let load = format!(
            "static inline jred_status {name}_load({name}_model *model) {{\n\
             \x20   return {name}_load_words(model, {name}_words, sizeof {name}_words / sizeof {name}_words[0]);\n\
             }}"
        );
        let data =
            machine_constant(&name, self.machine) + &array(&format!("{name}_words"), &table.words);
        source(&name, &data, &with_jred(&format!("{model}\n{load}")))
    }

    /// A table for each piece, and where each starts.
    pub(super) fn c_pieces(&self, tables: &[Made]) -> String {
        let name = identifier(&self.name);
        let mut data = machine_constant(&name, self.machine);
        for (number, table) in (1..).zip(tables) {
            data += &array(&format!("{name}_words_{number}"), &table.words);
            data.push('\n');
        }
        let count = tables.len();
        let list = |each: &dyn Fn(usize, &Made) -> String| {
            let all = (1..).zip(tables);
            let all = all.map(|(number, table)| each(number, table));
            format!("{{ {} }}", all.collect::<Vec<_>>().join(", "))
        };
        let starts = list(&|_, table| format!("0x{:08x}", self.start(table).to_bits()));
        let names = list(&|number, _| format!("{name}_words_{number}"));
        let lengths = list(&|_, table| table.words.len().to_string());
        data += "/* Phase at which each begins, in units of 2^-32 of the whole range. */\n";
        data += &constant(&format!("uint32_t {name}_starts[{count}]"), &starts);
        data += &constant(&format!("uint32_t *const {name}_tables[{count}]"), &names);
        data += &constant(&format!("uint32_t {name}_lengths[{count}]"), &lengths);
        source(&name, &data, &with_jred(&model(&name, self.chosen())))
    }
}

#[cfg(test)]
mod tests {
    use super::identifier;

    #[test]
    fn a_file_name_becomes_an_identifier() {
        for (name, expected) in [
            ("press.toml", "press"),
            ("a/b/toggle-press.toml", "toggle_press"),
            ("3 axis.toml", "machine_3_axis"),
            ("<stdin>", "machine__stdin_"),
            ("", "machine_"),
        ] {
            assert_eq!(identifier(name), expected, "{name}");
        }
    }
}
