//! An electronic cam as PLCs and drives read it: each form is written from the same rows.

use std::fmt;

use crate::name::{Name, PlcNames};
use crate::structured_text::{array, commented, real};

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

/// A table that a drive does not take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CamFault {
    form: CamForm,
    rows: usize,
    limit: usize,
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

    /// Whether its rows have the derivatives.
    pub const fn has_derivatives(self) -> bool {
        matches!(self, Self::Csv | Self::Codesys | Self::Twincat)
    }
}

impl fmt::Display for CamFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (_, _, because) = self.form.limits();
        let word = if self.rows > self.limit {
            "most"
        } else {
            "least"
        };
        write!(
            f,
            "the cam has {} rows, and the form {} takes at {word} {}: {because}",
            self.rows, self.form, self.limit
        )
    }
}

impl CamFault {
    /// The cure.
    pub fn cure(&self) -> String {
        format!("use --rows {}", self.limit)
    }
}

impl Cam<'_> {
    /// The table in a form, for a file of this name.
    ///
    /// # Errors
    /// More or fewer rows than the form takes.
    pub fn text(&self, form: CamForm, file: &str) -> Result<String, CamFault> {
        let (least, most, _) = form.limits();
        let rows = self.rows.len();
        if !(least..=most).contains(&rows) {
            let limit = if rows > most { most } else { least };
            return Err(CamFault { form, rows, limit });
        }
        let Name(name) = &Name::for_plc_of_file(file, &NAMES);
        Ok(match form {
            CamForm::Csv => self.csv(),
            CamForm::Codesys => self.codesys(name),
            CamForm::Twincat => self.twincat(name),
            CamForm::Rockwell => self.rockwell(name),
            CamForm::Siemens => self.siemens(name),
            CamForm::Sew => format!("{rows}\n") + &self.lines(|_, [x, y, ..]| format!("{x};{y}")),
            CamForm::Kollmorgen => {
                let cyclic = if self.is_cyclic() { "YES" } else { "NO" };
                let rows = self.lines(|_, [x, y, ..]| format!("{x};{y};SPLINE"));
                format!("CYCLIC;{cyclic};\nTABLE_BEGIN;;\n{rows}TABLE_END;;\n")
            }
            CamForm::Lenze => {
                let columns = self.about().replace(['\n', '\r'], " ");
                self.lines(|k, [x, y, ..]| match k {
                    0 => format!("{x} {y} // {columns}"),
                    _ => format!("{x} {y}"),
                })
            }
        })
    }

    /// A line for each row.
    fn lines(&self, line: impl Fn(usize, &CamRow) -> String) -> String {
        let lines = self.rows.iter().enumerate();
        lines
            .flat_map(|(k, row)| [line(k, row), "\n".to_owned()])
            .collect()
    }

    /// Title and columns.
    fn about(&self) -> String {
        let [symbol, unit] = self.position;
        format!(
            "{}: master [{}], {symbol} [{unit}]",
            self.title, self.master
        )
    }

    /// First and last master.
    fn ends(&self) -> [f64; 2] {
        let end = |row: Option<&CamRow>| row.map_or(0.0, |[x, ..]| *x);
        [end(self.rows.first()), end(self.rows.last())]
    }

    /// Whether the cam may repeat: position and derivatives end as they start, or a link that turns ends whole turns further.
    fn is_cyclic(&self) -> bool {
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else {
            return false;
        };
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

    /// A structure for each row, its members from this function.
    fn structures(&self, members: impl Fn(usize, [String; 4]) -> String) -> String {
        let rows = (1..).zip(self.rows);
        let rows: Vec<String> = rows
            .map(|(number, row)| format!("({})", members(number, row.map(real))))
            .collect();
        array(&rows, 1, "    ")
    }

    fn codesys(&self, name: &str) -> String {
        let rows = self
            .structures(|_, [x, y, v, a]| format!("dX := {x}, dY := {y}, dV := {v}, dA := {a}"));
        let (count, [start, end]) = (self.rows.len(), self.ends().map(real));
        format!(
            "{}VAR_GLOBAL\n    {name}_points : ARRAY[0..{}] OF SMC_CAMXYVA := {rows};\n\
             \x20   {name} : MC_CAM_REF := (nElements := {count}, byType := 3, xStart := {start}, xEnd := {end}, nTappets := 0, \
             strCAMName := '{name}', pce := ADR({name}_points));\nEND_VAR\n",
            self.comments(CamForm::Codesys),
            count - 1
        )
    }

    /// Each segment is a polynomial of degree 5 between points in motion: the plain `POLYNOM5` goes from rest to rest.
    fn twincat(&self, name: &str) -> String {
        let count = self.rows.len();
        let rows = self.structures(|number, [x, y, v, a]| {
            let next = u8::from(number < count);
            format!(
                "PointIndex := {number}, FunctionType := MOTIONFUNCTYPE_POLYNOM5_MM, PointType := MOTIONPOINTTYPE_MOTION, \
                 RelIndexNextPoint := {next}, MasterPos := {x}, SlavePos := {y}, SlaveVelo := {v}, SlaveAcc := {a}, SlaveJerk := 0.0"
            )
        });
        format!(
            "{}VAR_GLOBAL\n    {name}_points : ARRAY[1..{count}] OF MC_MotionFunctionPoint := {rows};\n\
             \x20   {name} : MC_CAM_REF := (pArray := ADR({name}_points), ArraySize := SIZEOF({name}_points), \
             TableType := MC_TABLETYPE_MOTIONFUNCTION, NoOfRows := {count}, NoOfColumns := 1);\nEND_VAR\n",
            self.comments(CamForm::Twincat)
        )
    }

    /// The slopes at both ends, which MCCP asks for, are in the comment.
    fn rockwell(&self, name: &str) -> String {
        let slope = |row: Option<&CamRow>| row.map_or(0.0, |[_, _, v, _]| *v) as f32;
        let head = format!(
            "tag {name} : CAM[{}]; MCCP with Length {}, Start Slope {}, End Slope {}",
            self.rows.len(),
            self.rows.len(),
            short(slope(self.rows.first())),
            short(slope(self.rows.last()))
        );
        let rows = self.lines(|k, [x, y, ..]| {
            let [x, y] = [*x, *y].map(|value| short(value as f32));
            format!(
                "{name}[{k}].Master := {x}; {name}[{k}].Slave := {y}; {name}[{k}].SegmentType := 1;"
            )
        });
        self.comments(CamForm::Rockwell) + &commented(&head) + "\n" + &rows
    }

    fn siemens(&self, name: &str) -> String {
        let (count, about) = (self.rows.len(), self.about().replace(['\n', '\r'], " "));
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

/// A literal of type REAL with the same bits.
fn short(value: f32) -> String {
    let shortest: f64 = value.to_string().parse().unwrap_or_default();
    real(shortest)
}
