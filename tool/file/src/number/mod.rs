//! Numbers: rounding for reading, integration, fitting, and columns.

pub mod columns;
pub mod csv;
pub mod figures;
pub mod formula;
pub mod numerics;
pub mod parabola;
pub mod quadrature;
pub mod rounding;
pub mod spline;
pub mod words;
