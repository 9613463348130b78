//! The table as C source: words, and the definitions from which `jred.h` makes functions.

use crc::{CRC_32_ISO_HDLC, Crc};
use jred::curves;
use jred::slider_crank::terms;

use crate::candidate::{Candidate, RangeTable};
use crate::choice::{LayoutName, Number};
use crate::export::Export;
use crate::form::rows;
use crate::name::Name;

/// The definitions from which `jred.h` makes the functions of a machine.
fn model(name: &str, table: &Candidate) -> String {
    let number = match table.number {
        Number::F32 => "f32",
        Number::I32 => "q31",
        Number::I16 => "q15",
    };
    let (layout, set) = (table.layout.name().replace('-', "_"), table.curves());
    // Harmonics with varying friction, and slider-cranks with uncommon terms, have too many sets for separate functions.
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

/// In C++ a constant is local to its file, unless it is declared `extern`.
fn constant(declaration: &str, value: &str) -> String {
    format!("extern const {declaration};\nconst {declaration} = {value};\n")
}

fn array(name: &str, words: &[u32]) -> String {
    let declaration = format!("uint32_t {name}[{}]", words.len());
    constant(&declaration, &format!("{{\n{}}}", rows(words, "u")))
}

/// A source file of C or C++ that may be compiled or included, with the same names in both. If `jred.h` was included before, the file also has the
/// functions of the machine. Its guard is a digest of its content: another file with the same names then causes a compile error instead of being
/// skipped.
fn source(Name(name): &Name, data: &str, functions: &str, cure: &str) -> String {
    let guard = format!("{}_TABLE", name.to_uppercase());
    let digest =
        Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(format!("{data}{functions}").as_bytes());
    format!(
        "#ifndef {guard}\n#define {guard} 0x{digest:08x}u\n\n#include <stdint.h>\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n{data}\n\
         #ifdef __cplusplus\n}}\n#endif\n\n{functions}\
         #elif {guard} != 0x{digest:08x}u\n\
         #error \"two tables have the name {name} in one program: {cure}\"\n\
         #endif\n"
    )
}

/// Cure for two tables of one name.
const OTHER_NAME: &str = "export one of them with another --name";

/// Only if `jred.h` was included before.
fn with_jred(functions: &str) -> String {
    format!("#ifdef JRED_H\n{functions}\n#endif\n\n")
}

/// The identifier of this machine, as `jred_info` of an image and `jred_plan` of a plan contain it.
fn machine_constant(Name(name): &Name, machine: u32) -> String {
    format!(
        "/* Identifier of the machine: that of another in jred_info is another machine's. */\n\
         #define {}_MACHINE 0x{machine:08x}u\n\n",
        name.to_uppercase()
    )
}

/// A plan as a source file of C or C++, under the name of its file.
pub fn plan_c_source(title: &str, file: &str, machine: u32, words: &[u32]) -> String {
    let name = Name::of_file(file);
    let data = machine_constant(&name, machine) + &array(&format!("{}_words", name.0), words);
    let title = title.replace(['\n', '\r'], " ");
    let cure = "write one of the plans to a file of another name";
    format!("// {title}\n{}", source(&name, &data, "", cure))
}

impl Export {
    /// One table.
    pub(crate) fn c_table(&self, table: &RangeTable, named: &Name) -> String {
        let Name(name) = named;
        let model = model(name, self.chosen());
        let load = format!(
            "static inline jred_status {name}_load({name}_model *model) {{\n\
             \x20   return {name}_load_words(model, {name}_words, sizeof {name}_words / sizeof {name}_words[0]);\n\
             }}"
        );
        let data =
            machine_constant(named, self.machine) + &array(&format!("{name}_words"), &table.words);
        let functions = with_jred(&format!("{model}\n{load}"));
        source(named, &data, &functions, OTHER_NAME)
    }

    /// A table for each piece, and the start of each.
    pub(crate) fn c_pieces(&self, tables: &[RangeTable], named: &Name) -> String {
        let Name(name) = named;
        let mut data = machine_constant(named, self.machine);
        for (number, table) in (1..).zip(tables) {
            data += &array(&format!("{name}_words_{number}"), &table.words);
            data.push('\n');
        }
        let count = tables.len();
        let list = |each: &dyn Fn(usize, &RangeTable) -> String| {
            let all = (1..).zip(tables);
            let all = all.map(|(number, table)| each(number, table));
            format!("{{ {} }}", all.collect::<Vec<_>>().join(", "))
        };
        let starts = list(&|_, table| format!("0x{:08x}u", self.start(table).to_bits()));
        let names = list(&|number, _| format!("{name}_words_{number}"));
        let lengths = list(&|_, table| table.words.len().to_string());
        data += "/* Phase at which each begins, in units of 2^-32 of the whole range. */\n";
        data += &constant(&format!("uint32_t {name}_starts[{count}]"), &starts);
        data += &constant(&format!("uint32_t *const {name}_tables[{count}]"), &names);
        data += &constant(&format!("uint32_t {name}_lengths[{count}]"), &lengths);
        let functions = with_jred(&model(name, self.chosen()));
        source(named, &data, &functions, OTHER_NAME)
    }
}
