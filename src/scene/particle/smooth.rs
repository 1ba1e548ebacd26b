//! Smooth bodies of revolution by a few numbers: harmonics and superellipsoids.

use crate::scene::choice::{AxisRatioKey, Named, ShapeName};
use crate::scene::error::SceneError;
use crate::scene::file::ParticleKeys;
use crate::shape::OwnBody;

/// Most coefficients: more make no smooth outline.
const MOST_COEFFICIENTS: usize = 32;
/// Axis ratios and exponents of superellipsoids.
const RATIOS: std::ops::RangeInclusive<f64> = 0.2..=5.0;
const EXPONENTS: std::ops::RangeInclusive<f64> = 2.0..=4.0;

/// Keys that no other shape has.
pub(super) fn only_of_outlines(keys: &ParticleKeys, shape: ShapeName) -> Result<(), SceneError> {
    if let (Some(list), true) = (&keys.coefficients, shape != ShapeName::Harmonics) {
        let accepted =
            format!("only shape = \"harmonics\" has coefficients; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.coefficients", format!("{list:?}"), accepted));
    }
    if let (Some(exponent), true) = (keys.exponent, shape != ShapeName::Superellipsoid) {
        let accepted =
            format!("only a superellipsoid has an exponent; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.exponent", exponent, accepted));
    }
    Ok(())
}

/// The body of a series of cosines, or of an exponent.
pub(super) fn outline(keys: &ParticleKeys, shape: ShapeName) -> Result<OwnBody, SceneError> {
    if shape == ShapeName::Harmonics {
        const KEY: &str = "particle.coefficients";
        let accepted = format!(
            "c_0, c_1, … of r(θ) = Σ c_n cos nθ (θ from straight down), 1 to {MOST_COEFFICIENTS} numbers"
        );
        let Some(list) = &keys.coefficients else { return Err(SceneError::missing(KEY, accepted)) };
        let shown = || format!("{list:?}");
        if list.is_empty() || list.len() > MOST_COEFFICIENTS {
            return Err(SceneError::invalid(KEY, shown(), accepted));
        }
        return OwnBody::harmonics(list)
            .map_err(|error| SceneError::invalid(KEY, shown(), error.to_string()));
    }
    let accepted =
        format!("vertical over horizontal diameter, {} to {}", RATIOS.start(), RATIOS.end());
    let axis_ratio = match keys.axis_ratio {
        None => return Err(SceneError::missing("particle.axis_ratio", accepted)),
        Some(AxisRatioKey::Number(ratio)) if RATIOS.contains(&ratio) => ratio,
        Some(ratio) => return Err(SceneError::invalid("particle.axis_ratio", ratio, accepted)),
    };
    const KEY: &str = "particle.exponent";
    let accepted = format!(
        "{} to {}: 2 is a spheroid; below, curvature has no bound at the equator; far above, walls are flat",
        EXPONENTS.start(),
        EXPONENTS.end()
    );
    match keys.exponent {
        None => Err(SceneError::missing(KEY, accepted)),
        Some(exponent) if EXPONENTS.contains(&exponent) => {
            OwnBody::superellipsoid(axis_ratio, exponent)
                .map_err(|error| SceneError::invalid(KEY, exponent, error.to_string()))
        }
        Some(exponent) => Err(SceneError::invalid(KEY, exponent, accepted)),
    }
}
