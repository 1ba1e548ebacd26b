//! What can be wrong with a shape.

use crate::fault::{Blame, Fault};
use crate::math::digits::to_digits;

/// What went wrong with a shape.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum ShapeError {
    #[error(
        "radius {} mm is outside the drop model {model} ({} to {} mm)",
        to_digits(*.radius_mm, 9), to_digits(*.from_mm, 9), to_digits(*.to_mm, 9)
    )]
    RadiusOutsideModel { radius_mm: f64, model: &'static str, from_mm: f64, to_mm: f64 },
    #[error("axis_ratio = {0}: a number from 0.1 to 10 (vertical over horizontal) is accepted")]
    AxisRatio(f64),
    #[error(
        "shape \"{0}\": it has facets, which no ray method of smooth bodies follows; tables take it with \
         method = \"facets\""
    )]
    Faceted(&'static str),
    #[error("shape \"{name}\": {fault}; accepted: {accepted}")]
    OwnBody { name: String, fault: String, accepted: &'static str },
}

impl Blame for ShapeError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}
