//! Ticks over a table image, bit for bit those of firmware.

use numpy::{IntoPyArray as _, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use jred::number::Quantity;
use jred::{
    Cubic, Harmonic, Image, ImageError, Phase, Q15, Q31, Quadratic, Rows16, SliderCrankForm,
    Spline, Spline16,
};

/// A table image with its ticks.
#[pyclass(frozen, module = "jred._jred")]
pub(crate) struct Model {
    words: Vec<u32>,
    format: &'static str,
}

/// The formats of images with the numbers of their ticks.
macro_rules! formats {
    ($each:ident) => {
        $each! {
            "spline-f32": Spline<f32>, float;
            "cubic-f32": Cubic<f32>, float;
            "quadratic-f32": Quadratic<f32>, float;
            "harmonic-f32": Harmonic<f32>, float;
            "slider-crank-f32": SliderCrankForm, float;
            "spline-q31": Spline<Q31>, q31;
            "cubic-q31": Cubic<Q31>, q31;
            "quadratic-q31": Quadratic<Q31>, q31;
            "spline16-q31": Spline16, q31;
            "rows-q15": Rows16, q15;
        }
    };
}

fn wrong(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// One-dimensional arrays of equal length, of the number type of the model; copies, because without the interpreter's lock Python may change them.
macro_rules! taken {
    ($number:ty, $($name:ident)*) => {$(
        let $name: PyReadonlyArray1<'_, $number> = $name.extract().map_err(|_| {
            wrong(format!(
                concat!(stringify!($name), " must be a one-dimensional array of {}, as the numbers of this model"),
                std::any::type_name::<$number>()
            ))
        })?;
        let $name = $name.as_slice().map_err(|_| wrong(concat!(stringify!($name), " must be contiguous")))?.to_vec();
    )*};
}

fn equal(lengths: [usize; 3]) -> PyResult<()> {
    if lengths.iter().all(|length| *length == lengths[0]) {
        return Ok(());
    }
    Err(wrong(format!(
        "the arrays have {} phases, {} speeds and {} values: give as many of each",
        lengths[0], lengths[1], lengths[2]
    )))
}

macro_rules! tick {
    (float, $($rest:tt)*) => { tick!(@each f32, |x| x, |x| x, $($rest)*) };
    (q31, $($rest:tt)*) => { tick!(@each i32, Q31::from_bits, Q31::to_bits, $($rest)*) };
    (q15, $($rest:tt)*) => { tick!(@each i16, Q15::from_bits, Q15::to_bits, $($rest)*) };
    (@each $bits:ty, $number:expr, $raw:expr, $format:ty, $image:expr, $py:expr, $phase:expr, $omega:expr, $third:expr, $inverse:expr) => {{
        let (omega, third) = ($omega, $third);
        taken!($bits, omega third);
        equal([$phase.len(), omega.len(), third.len()])?;
        let model = $image.any_model::<$format>().map_err(wrong)?;
        let samples = $phase.iter().zip(&omega).zip(&third);
        let samples = samples.map(|((phase, omega), third)| {
            (Phase::from_bits(*phase), $number(*omega), $number(*third))
        });
        if $inverse {
            let torque = samples.map(|(phase, omega, alpha)| {
                $raw(model.torque(phase, Quantity::of(omega), Quantity::of(alpha)).number())
            });
            let torque: Vec<$bits> = $py.detach(|| torque.collect());
            torque.into_pyarray($py).into_any()
        } else {
            let outcome = samples.map(|(phase, omega, torque)| {
                let found = model.acceleration(phase, Quantity::of(omega), Quantity::of(torque));
                ($raw(found.value.number()), found.saturated)
            });
            let (value, saturated): (Vec<$bits>, Vec<bool>) = $py.detach(|| outcome.unzip());
            let both = (value.into_pyarray($py), saturated.into_pyarray($py));
            both.into_pyobject($py)?.into_any()
        }
    }};
}

impl Model {
    fn image(&self) -> Image<'_> {
        Image::new(&self.words).unwrap_or_else(|_| unreachable!("checked when it was read"))
    }

    fn tick<'py>(
        &self,
        py: Python<'py>,
        phase: &PyReadonlyArray1<'_, u32>,
        omega: &Bound<'_, PyAny>,
        third: &Bound<'_, PyAny>,
        inverse: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let image = self.image();
        let phase = phase.as_slice().map_err(wrong)?.to_vec();
        macro_rules! each {
            ($($name:literal: $format:ty, $kind:ident;)*) => {
                match self.format {
                    $($name => tick!($kind, $format, image, py, phase, omega, third, inverse),)*
                    _ => return Err(wrong("unknown format")),
                }
            };
        }
        Ok(formats!(each))
    }
}

#[pymethods]
impl Model {
    /// The model of an image as `jred export` writes it.
    #[new]
    fn new(image: &[u8]) -> PyResult<Self> {
        let chunks = image.chunks_exact(4);
        if !chunks.remainder().is_empty() {
            return Err(wrong(format!(
                "an image has whole words of 4 bytes, not {} bytes",
                image.len()
            )));
        }
        let words: Vec<u32> = chunks
            .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
            .collect();
        let found = Image::new(&words).map_err(wrong)?;
        macro_rules! each {
            ($($name:literal: $format:ty, $kind:ident;)*) => {
                [$(($name, found.any_model::<$format>().err())),*]
            };
        }
        let tried = formats!(each);
        let fits = tried.iter().find(|(_, error)| error.is_none());
        let other = |error: &&ImageError| {
            !matches!(error, ImageError::NumberType(_) | ImageError::Layout(_))
        };
        let why = tried
            .iter()
            .filter_map(|(_, error)| error.as_ref())
            .find(other);
        let Some((format, _)) = fits else {
            return Err(why.map_or_else(|| wrong("an image of an unknown format"), wrong));
        };
        let format = *format;
        Ok(Self { words, format })
    }

    /// Name of the format, such as "spline-f32".
    #[getter]
    fn format(&self) -> &'static str {
        self.format
    }

    /// Machine units of fixed-point numbers: torque (N m), speed (rad/s), acceleration (rad/s²) of 1.0.
    #[getter]
    fn scale(&self) -> [f32; 3] {
        let image = self.image();
        let scale = image.scale();
        [scale.torque(), scale.speed(), scale.acceleration()]
    }

    /// Limits of validity: speed (rad/s), acceleration (rad/s²), and the torque's error within them (N m).
    #[getter]
    fn validity(&self) -> [f32; 3] {
        let valid = self.image().validity();
        [valid.max_speed, valid.max_acceleration, valid.torque_error]
    }

    /// Phase words of positions (rad, or m).
    #[pyo3(signature = (position: "numpy.typing.NDArray[numpy.float64]") -> "numpy.typing.NDArray[numpy.uint32]")]
    fn phase<'py>(
        &self,
        py: Python<'py>,
        position: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let domain = self.image().domain();
        let position = position.as_slice().map_err(wrong)?;
        // Beyond it, a double has fewer digits than a phase word.
        const MOST: f64 = 1e6;
        if let Some(k) = position.iter().position(|x| x.is_nan() || x.abs() > MOST) {
            return Err(wrong(format!(
                "position[{k}] is {}; positions must be finite, and at most {MOST} rad or m",
                position[k]
            )));
        }
        let phases: Vec<u32> = position
            .iter()
            .map(|x| domain.to::<f64>().phase(*x).to_bits())
            .collect();
        Ok(phases.into_pyarray(py))
    }

    #[pyo3(signature = (phase: "numpy.typing.NDArray[numpy.uint32]", omega: "numpy.typing.NDArray[typing.Any]", alpha: "numpy.typing.NDArray[typing.Any]") -> "numpy.typing.NDArray[typing.Any]")]
    fn _torque<'py>(
        &self,
        py: Python<'py>,
        phase: PyReadonlyArray1<'_, u32>,
        omega: &Bound<'_, PyAny>,
        alpha: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.tick(py, &phase, omega, alpha, true)
    }

    #[pyo3(signature = (phase: "numpy.typing.NDArray[numpy.uint32]", omega: "numpy.typing.NDArray[typing.Any]", torque: "numpy.typing.NDArray[typing.Any]") -> "tuple[numpy.typing.NDArray[typing.Any], numpy.typing.NDArray[numpy.bool_]]")]
    fn _outcome<'py>(
        &self,
        py: Python<'py>,
        phase: PyReadonlyArray1<'_, u32>,
        omega: &Bound<'_, PyAny>,
        torque: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.tick(py, &phase, omega, torque, false)
    }
}
