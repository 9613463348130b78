//! `jred export`: the smallest table that meets a torque error, as an image or as source code.

use std::fmt::Write as _;

use jred::table::{MAX_CELLS, control_points, curves};
use jred::tabulate::{self, Request, Tabulated};
use jred::{Domain, Error, Q31, Reducible, Scalar, Scale, Table};

use crate::coordinate::Coordinate;
use crate::machine::{AnyMechanism, MachineFile};
use crate::output::rounded;

/// Number type of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Number {
    /// Single precision, SI units.
    #[default]
    F32,
    /// Fixed point with 31 fractional bits, per-unit.
    Q31,
}

/// What an export is written as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Form {
    /// The binary image, for `include_image!` or a flash region.
    #[default]
    Image,
    /// A Rust source file with the image as a `static` array of words.
    Rust,
    /// A C source file with the image as a `const` array of words.
    C,
}

/// A table, ready to be written.
#[derive(Clone, Debug)]
pub struct Export {
    /// The image.
    pub words: Vec<u32>,
    /// How exact it is.
    pub found: Tabulated,
    /// What it was made for.
    pub request: Request,
    /// Its machine units.
    pub scale: Scale,
    /// Its curves.
    pub curves: u8,
    /// Its number type.
    pub number: Number,
    title: String,
    coordinate: Coordinate,
}

type Whole = jred::Machine<AnyMechanism>;

impl Export {
    /// Finds the smallest table for a request, with an inertia `rotor` (kg·m²) of motor and gearbox at the input of the
    /// drive train.
    ///
    /// # Errors
    /// Those of the machine and of [`tabulate`].
    pub fn new(
        file: &MachineFile,
        number: Number,
        request: Request,
        rotor: f64,
    ) -> Result<Self, Error> {
        const PLACES: u32 = 1440;
        let ratio = file.drive_train.ratio();
        let machine = file
            .with_drive_train()?
            .with_flywheel(rotor * ratio * ratio)?;
        let set = tabulate::curves_in_use(&machine, PLACES)?;
        let scale = match number {
            Number::F32 => Scale::SI,
            Number::Q31 => Scale::covering(&machine, request.omega, request.alpha, PLACES)?,
        };
        let found = match number {
            Number::F32 => by_curves::<f32>(set, &machine, &request, &scale),
            Number::Q31 => by_curves::<Q31>(set, &machine, &request, &scale),
        };
        let (found, words) = found?;
        Ok(Self {
            words,
            found,
            request,
            scale,
            curves: set,
            number,
            title: file.title.clone(),
            coordinate: Coordinate::of(file.machine.mechanism())?,
        })
    }

    /// The table in one of the forms.
    pub fn write(&self, form: Form) -> Vec<u8> {
        match form {
            Form::Image => self.words.iter().flat_map(|w| w.to_le_bytes()).collect(),
            Form::Rust => self.source(
                &format!("pub static TABLE: [u32; {}] = [\n", self.words.len()),
                "];\n",
            ),
            Form::C => self.source(
                &format!(
                    "#include <stdint.h>\n\nconst uint32_t jred_table[{}] = {{\n",
                    self.words.len()
                ),
                "};\n",
            ),
        }
    }

    fn source(&self, open: &str, close: &str) -> Vec<u8> {
        let mut text = String::new();
        for line in self.summary().lines() {
            let _ = writeln!(text, "// {line}");
        }
        text.push_str(open);
        for row in self.words.chunks(8) {
            let words: Vec<String> = row.iter().map(|w| format!("0x{w:08x}")).collect();
            let _ = writeln!(text, "    {},", words.join(", "));
        }
        text.push_str(close);
        text.into_bytes()
    }

    /// What the table is and how exact it is, for the terminal and for source comments.
    pub fn summary(&self) -> String {
        let coordinate = self.coordinate;
        let (effort, inertia) = (coordinate.effort_unit(), coordinate.inertia_unit());
        let ([speed, acceleration], [v, a]) = match coordinate {
            Coordinate::Angle => (["rad/s", "rad/s^2"], ["omega", "alpha"]),
            Coordinate::Length => (["m/s", "m/s^2"], ["v", "a"]),
        };
        let word = match coordinate {
            Coordinate::Angle => "torque",
            Coordinate::Length => "force",
        };
        let mut names = vec![coordinate.inertia()];
        let mut set = Vec::new();
        for (curve, name, constant) in [
            (curves::LOAD, "load", "LOAD"),
            (curves::VISCOUS, "viscous", "VISCOUS"),
            (curves::COULOMB, "coulomb", "COULOMB"),
        ] {
            if self.curves & curve != 0 {
                names.push(name);
                set.push(format!("curves::{constant}"));
            }
        }
        let set = match (self.curves, set.join(" | ")) {
            (curves::INERTIA, _) => "curves::INERTIA".to_owned(),
            (curves::ALL, _) => "curves::ALL".to_owned(),
            (_, set) => set,
        };
        let (number, scalar) = match self.number {
            Number::F32 => (f32::NAME, "f32"),
            Number::Q31 => (Q31::NAME, "Q31"),
        };
        let Tabulated {
            cells,
            torque_error,
            worst,
        } = self.found;
        let mut text = String::new();
        let _ = writeln!(text, "{}: reduced machine at the drive link", self.title);
        let _ = writeln!(
            text,
            "{number}, {cells} cells, curves: {}, {} bytes",
            names.join(", "),
            self.words.len() * 4
        );
        let _ = writeln!(text, "in Rust: image.model::<{scalar}, {{ {set} }}>()");
        let _ = writeln!(
            text,
            "{word} error reached {} {effort} of {} {effort} allowed, at {} {}, for |{v}| <= {} {speed}, |{a}| <= {} \
             {acceleration}",
            rounded(torque_error),
            rounded(self.request.torque_error),
            rounded(coordinate.shown(worst)),
            coordinate.unit(),
            rounded(self.request.omega),
            rounded(self.request.alpha),
        );
        if self.number == Number::Q31 {
            let _ = writeln!(
                text,
                "1.0 stands for: {word} {} {effort}, speed {} {speed}, inertia {} {inertia}, acceleration {} {acceleration}",
                rounded(self.scale.torque().into()),
                rounded(self.scale.speed().into()),
                rounded(self.scale.inertia().into()),
                rounded(self.scale.acceleration().into()),
            );
        }
        text
    }
}

/// The set of curves is a type parameter of tables: one arm for each set.
fn by_curves<S: Scalar>(
    set: u8,
    machine: &Whole,
    request: &Request,
    scale: &Scale,
) -> Result<(Tabulated, Vec<u32>), Error> {
    match set {
        0 => search::<S, 0>(machine, request, scale),
        1 => search::<S, 1>(machine, request, scale),
        2 => search::<S, 2>(machine, request, scale),
        3 => search::<S, 3>(machine, request, scale),
        4 => search::<S, 4>(machine, request, scale),
        5 => search::<S, 5>(machine, request, scale),
        6 => search::<S, 6>(machine, request, scale),
        _ => search::<S, { curves::ALL }>(machine, request, scale),
    }
}

fn search<S: Scalar, const CURVES: u8>(
    machine: &Whole,
    request: &Request,
    scale: &Scale,
) -> Result<(Tabulated, Vec<u32>), Error> {
    let most = request.max_cells.min(MAX_CELLS);
    let mut scratch = vec![0.0; tabulate::scratch_len(most, CURVES)];
    let mut words = vec![bytemuck::Zeroable::zeroed(); most as usize * 4 + 16];
    let found = tabulate::tabulate::<S, CURVES>(machine, request, scale, &mut scratch, &mut words)?;
    words.truncate(control_points(found.cells as usize) * curves::width(CURVES));
    let periodic = machine.domain() == Domain::Turn;
    let table = Table::<S, CURVES>::new(&words, found.cells, periodic).map_err(Error::Table)?;
    let mut image = vec![0; jred::image_words(found.cells, CURVES)];
    let validity = found.validity(request);
    jred::encode(&table, machine.domain(), scale, validity, &mut image)?;
    // What firmware will do with it: a scale that the table's slopes do not fit shows here, not there.
    jred::Model::<S, CURVES>::for_domain(table, machine.domain(), scale).map_err(Error::Table)?;
    Ok((found, image))
}
