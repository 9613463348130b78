//! An electronic cam as PLCs and drives read it: each form is written from the same rows.

use crate::name::{Name, PlcNames};
use crate::structured_text::{array, commented, real};
use jred_file::problem;
use jred_file::text::problem::Result;

jred_file::words! {
    /// The form of an electronic cam's table.
    pub enum CamForm default Csv {
        /// Columns with units: master, position, first and second derivative by the master.
        Csv = "csv",
        /// Structured Text for CODESYS SoftMotion and its relatives: an array of SMC_CAMXYVA and its MC_CAM_REF.
        Codesys = "codesys",
        /// Structured Text for TwinCAT (TF5050): an array of MC_MotionFunctionPoint and its MC_CAM_REF.
        Twincat = "twincat",
        /// Structured Text for Studio 5000: assignments to an array of CAM, for MCCP.
        Rockwell = "rockwell",
        /// SCL for Siemens TIA Portal: a data block with arrays of master and slave.
        Siemens = "siemens",
        /// Text for SEW MOVI-C: number of rows, then master;slave.
        Sew = "sew",
        /// CSV for Kollmorgen KAS: master;slave;SPLINE.
        Kollmorgen = "kollmorgen",
        /// Text for the Lenze Cam Loader: master and slave.
        Lenze = "lenze",
    }
}

/// A row: master, position, first and second derivative of the position by the master.
pub type CamRow = [f64; 4];

/// A cam's table with its units.
#[derive(Clone, Copy, Debug)]
pub struct Cam<'a> {
    /// Name of the machine.
    pub title: &'a str,
    /// The rows, masters ascending.
    pub rows: &'a [CamRow],
    /// Unit of the master.
    pub master: &'a str,
    /// Symbol and unit of the position.
    pub position: [&'a str; 2],
    /// A turn in this unit, of a link that turns.
    pub turn: Option<f64>,
}

/// Names of cams in a PLC: a tag of Studio 5000 has 40 characters, and a name here may get a suffix.
const NAMES: PlcNames = PlcNames {
    longest: 32,
    taken: "master slave count",
};

/// Share of the largest value by which the ends of a cyclic cam may differ: rounding.
const ROUNDING: f64 = 1e-9;

impl CamForm {
    /// Fewest and most rows that the maker's program takes, and what sets them.
    const fn limits(self) -> (usize, usize, &'static str) {
        match self {
            Self::Csv | Self::Twincat | Self::Lenze => (2, usize::MAX, ""),
            Self::Codesys => (2, 32_767, "nElements of MC_CAM_REF is an INT"),
            Self::Rockwell => (2, 65_535, "Length of MCCP is a UINT"),
            Self::Siemens => (2, 10_000, "the points of a TO_Cam_10k"),
            Self::Sew => (2, 16_383, "gc_uMaxNumberOfInterpPoints of MOVI-C"),
            Self::Kollmorgen => (5, usize::MAX, "KAS imports four segments or more"),
        }
    }

    /// Rows that the maker's program takes as delivered, and how to have more; none if that is no fewer than it ever takes.
    const fn delivered(self) -> Option<(usize, &'static str)> {
        match self {
            Self::Siemens => Some((1_000, "use a TO_Cam_10k instead of a TO_Cam")),
            Self::Sew => Some((1_024, "raise gc_uMaxNumberOfInterpPoints of MOVI-C")),
            _ => None,
        }
    }

    /// The number of rows that suits the maker's program as delivered: steps of half a degree, or finer.
    pub const fn usual_rows(self) -> u32 {
        if self.delivered().is_some() {
            721
        } else {
            2001
        }
    }

    /// The fault and cure of a number of rows that the maker's program takes only after a change.
    pub fn excess(self, rows: usize) -> Option<String> {
        let (most, cure) = self.delivered().filter(|(most, _)| rows > *most)?;
        Some(format!(
            "the cam has {rows} rows; the form {self} takes {most} as delivered: {cure}, or use --rows {most}"
        ))
    }

    /// The name of the cam in a file of this name, in forms that have names.
    pub fn name(self, file: &str) -> Option<Name> {
        matches!(
            self,
            Self::Codesys | Self::Twincat | Self::Rockwell | Self::Siemens
        )
        .then(|| Name::for_plc_of_file(file, &NAMES))
    }

    /// Whether its rows have the derivatives.
    pub const fn has_derivatives(self) -> bool {
        matches!(self, Self::Csv | Self::Codesys | Self::Twincat)
    }
}

impl Cam<'_> {
    /// The table in a form, for a file of this name.
    ///
    /// # Errors
    /// More or fewer rows than the form takes.
    pub fn text(&self, form: CamForm, file: &str) -> Result<String> {
        let (least, most, because) = form.limits();
        let count = self.rows.len();
        let ([first, .., last], true) = (self.rows, (least..=most).contains(&count)) else {
            let (word, limit) = if count > most {
                ("most", most)
            } else {
                ("least", least)
            };
            return Err(problem!(
                help = format!("use --rows {limit}"),
                "the cam has {count} rows, and the form {form} takes at {word} {limit}: {because}"
            ));
        };
        let Name(name) = &Name::for_plc_of_file(file, &NAMES);
        let (about, comments) = (self.about(), self.comments(form));
        Ok(match form {
            CamForm::Csv => self.csv(),
            CamForm::Codesys => comments + &self.codesys(name, first[0], last[0]),
            CamForm::Twincat => comments + &self.twincat(name),
            CamForm::Rockwell => comments + &self.rockwell(name, first[2], last[2]),
            CamForm::Siemens => self.siemens(name),
            CamForm::Sew => format!("{count}\n") + &self.lines(|_, [x, y, ..]| format!("{x};{y}")),
            CamForm::Kollmorgen => {
                let cyclic = if self.is_cyclic(first, last) {
                    "YES"
                } else {
                    "NO"
                };
                let rows = self.lines(|_, [x, y, ..]| format!("{x};{y};SPLINE"));
                format!("CYCLIC;{cyclic};\nTABLE_BEGIN;;\n{rows}TABLE_END;;\n")
            }
            CamForm::Lenze => self.lines(|k, [x, y, ..]| match k {
                0 => format!("{x} {y} // {about}"),
                _ => format!("{x} {y}"),
            }),
        })
    }

    /// A line for each row.
    fn lines(&self, line: impl Fn(usize, &CamRow) -> String) -> String {
        let rows = self.rows.iter().enumerate();
        rows.map(|(k, row)| line(k, row) + "\n").collect()
    }

    /// Title and columns, on one line.
    fn about(&self) -> String {
        let [symbol, unit] = self.position;
        let about = format!(
            "{}: master [{}], {symbol} [{unit}]",
            self.title, self.master
        );
        about.replace(['\n', '\r'], " ")
    }

    /// Whether the cam may repeat: position and derivatives end as they start, or a link that turns ends whole turns further.
    fn is_cyclic(&self, first: &CamRow, last: &CamRow) -> bool {
        (1..4).all(|k| {
            let sizes = self.rows.iter().map(|row| row[k].abs());
            let difference = last[k] - first[k];
            let turns = self.turn.filter(|_| k == 1);
            let whole = turns.map_or(0.0, |turn| (difference / turn).round() * turn);
            (difference - whole).abs() <= ROUNDING * sizes.fold(0.0, f64::max)
        })
    }

    fn csv(&self) -> String {
        let ([symbol, unit], by) = (self.position, self.master);
        let head = format!(
            "master [{by}],{symbol} [{unit}],{symbol}' [{unit}/{by}],{symbol}'' [{unit}/{by}^2]\n"
        );
        head + &self.lines(|_, [x, y, v, a]| format!("{x},{y},{v},{a}"))
    }

    /// Comments at the head of a text for a PLC: what it is, and what a derivative is by.
    fn comments(&self, form: CamForm) -> String {
        let ([_, unit], by) = (self.position, self.master);
        let mut text = commented(&self.about()) + "\n";
        if form.has_derivatives() {
            let derivatives = format!("derivatives by the master: [{unit}/{by}], [{unit}/{by}^2]");
            text += &(commented(&derivatives) + "\n");
        }
        text
    }

    /// Global variables: an array with a structure for each row, its members from a function of number and row, and the cam that refers to it.
    fn variables(
        &self,
        name: &str,
        kind: &str,
        cam: &str,
        members: impl Fn(usize, [String; 4]) -> String,
    ) -> String {
        let rows = (1..).zip(self.rows);
        let rows = rows.map(|(number, row)| format!("({})", members(number, row.map(real))));
        let rows = array(&rows.collect::<Vec<_>>(), 1, "    ");
        format!(
            "VAR_GLOBAL\n    {name}_points : {kind} := {rows};\n    {name} : MC_CAM_REF := ({cam});\nEND_VAR\n"
        )
    }

    fn codesys(&self, name: &str, start: f64, end: f64) -> String {
        let count = self.rows.len();
        let kind = format!("ARRAY[0..{}] OF SMC_CAMXYVA", count - 1);
        let cam = format!(
            "nElements := {count}, byType := 3, xStart := {}, xEnd := {}, nTappets := 0, strCAMName := '{name}', pce := ADR({name}_points)",
            real(start),
            real(end)
        );
        self.variables(name, &kind, &cam, |_, [x, y, v, a]| {
            format!("dX := {x}, dY := {y}, dV := {v}, dA := {a}")
        })
    }

    /// Each segment is a polynomial of degree 5 between points in motion: the plain `POLYNOM5` goes from rest to rest.
    fn twincat(&self, name: &str) -> String {
        let count = self.rows.len();
        let kind = format!("ARRAY[1..{count}] OF MC_MotionFunctionPoint");
        let cam = format!(
            "pArray := ADR({name}_points), ArraySize := SIZEOF({name}_points), \
             TableType := MC_TABLETYPE_MOTIONFUNCTION, NoOfRows := {count}, NoOfColumns := 1"
        );
        self.variables(name, &kind, &cam, |number, [x, y, v, a]| {
            let next = u8::from(number < count);
            format!(
                "PointIndex := {number}, FunctionType := MOTIONFUNCTYPE_POLYNOM5_MM, PointType := MOTIONPOINTTYPE_MOTION, \
                 RelIndexNextPoint := {next}, MasterPos := {x}, SlavePos := {y}, SlaveVelo := {v}, SlaveAcc := {a}, SlaveJerk := 0.0"
            )
        })
    }

    /// The slopes at both ends, which MCCP asks for, are in the comment.
    fn rockwell(&self, name: &str, start: f64, end: f64) -> String {
        let count = self.rows.len();
        let head = format!(
            "tag {name} : CAM[{count}]; MCCP with Length {count}, Start Slope {}, End Slope {}",
            short(start),
            short(end)
        );
        let rows = self.lines(|k, [x, y, ..]| {
            let [x, y] = [x, y].map(|value| short(*value));
            format!(
                "{name}[{k}].Master := {x}; {name}[{k}].Slave := {y}; {name}[{k}].SegmentType := 1;"
            )
        });
        commented(&head) + "\n" + &rows
    }

    fn siemens(&self, name: &str) -> String {
        let (count, about) = (self.rows.len(), self.about());
        let rows = self.lines(|k, [x, y, ..]| {
            let (number, [x, y]) = (k + 1, [*x, *y].map(real));
            format!("    Master[{number}] := {x};\n    Slave[{number}] := {y};")
        });
        format!(
            "// {about}\nDATA_BLOCK \"{name}\"\n{{ S7_Optimized_Access := 'TRUE' }}\nVERSION : 0.1\nNON_RETAIN\n    STRUCT\n\
             \x20       Count : DInt := {count};\n        Master : Array[1..{count}] of LReal;\n        Slave : Array[1..{count}] of LReal;\n\
             \x20   END_STRUCT;\nBEGIN\n{rows}END_DATA_BLOCK\n"
        )
    }
}

/// The nearest literal of type REAL.
fn short(value: f64) -> String {
    let shortest = (value as f32).to_string();
    real(shortest.parse().unwrap_or_default())
}
