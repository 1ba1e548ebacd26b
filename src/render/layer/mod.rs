//! A layer of drops behind, above or below which the sky is seen, with light that is scattered many times in it.
//!
//! The tables of the drops say how the layer's particles scatter (`bands`); [`crate::transfer`] solves the layer for a few
//! wavelengths; `light` makes colours of it. Light scattered once stays that of the tables at full sharpness.
//!
//! ```
//! use gonio::render::layer::{LayerSky, Place};
//!
//! let shower = LayerSky::new(2.0, Place::Curtain);
//! assert!(shower.check(20f64.to_radians()).is_ok());
//! // a level layer needs a sun above the horizon
//! let cloud = LayerSky::new(2.0, Place::Below);
//! assert!(cloud.check(0.0).unwrap_err().to_string().starts_with("sun.elevation_deg = 0"));
//! ```

mod bands;
mod light;
mod place;

pub use light::LayerLight;
pub use place::Place;

use super::RenderError;
use crate::farfield::assignment::Thresholds;
use std::str::FromStr;

/// How often light may be scattered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scattering {
    /// Once where that is enough, else many times.
    #[default]
    Auto,
    /// Once.
    Single,
    /// As often as it is.
    Multiple,
}

impl FromStr for Scattering {
    type Err = RenderError;

    fn from_str(text: &str) -> Result<Self, RenderError> {
        match text {
            "auto" => Ok(Self::Auto),
            "single" => Ok(Self::Single),
            "multiple" => Ok(Self::Multiple),
            _ => Err(RenderError::Invalid {
                field: "layer.scattering".into(),
                value: format!("\"{text}\""),
                accepted: "auto, single or multiple".into(),
            }),
        }
    }
}

/// A layer as a picture asks for it.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerSky {
    /// Along the normal, at all wavelengths.
    pub optical_depth: f64,
    /// Share of the light that the ground behind the layer throws back.
    pub ground_albedo: f64,
    /// Where it is.
    pub place: Place,
    /// How often light is scattered.
    pub scattering: Scattering,
    /// Directions per hemisphere.
    pub streams: usize,
}

/// Directions per hemisphere unless told: measured in validation/transfer.md.
const STREAMS: usize = 24;
/// Optical depths that pictures accept.
const DEEPEST: f64 = 1000.0;

impl LayerSky {
    /// Over a black ground.
    pub fn new(optical_depth: f64, place: Place) -> Self {
        Self {
            optical_depth,
            ground_albedo: 0.0,
            place,
            scattering: Scattering::Auto,
            streams: STREAMS,
        }
    }

    /// Refuse what no layer can be.
    ///
    /// # Errors
    /// [`RenderError::Invalid`] naming the key.
    pub fn check(&self, sun_elevation: f64) -> Result<(), RenderError> {
        let invalid = |field: &str, value: String, accepted: &str| {
            let (field, accepted) = (field.to_owned(), accepted.to_owned());
            Err(RenderError::Invalid { field, value, accepted })
        };
        let depth = self.optical_depth;
        if !(depth > 0.0 && depth <= DEEPEST) {
            let accepted = format!("numbers above 0, up to {DEEPEST}, are accepted");
            return invalid("layer.optical_depth", depth.to_string(), &accepted);
        }
        if !(0.0..=1.0).contains(&self.ground_albedo) {
            let value = self.ground_albedo.to_string();
            return invalid("layer.ground_albedo", value, "0 to 1 are accepted");
        }
        if !(4..=64).contains(&self.streams) {
            return invalid("layer.streams", self.streams.to_string(), "4 to 64 are accepted");
        }
        if self.place.sun(sun_elevation) < 1e-3 {
            let accepted = match self.place {
                Place::Curtain => "an upright layer needs the sun below the zenith, up to 89.9",
                Place::Above | Place::Below => {
                    "a level layer needs the sun above the horizon, 0.1 to 90; layer.place = \"curtain\" takes 0"
                }
            };
            let degrees = (sun_elevation.to_degrees() * 1e6).round() / 1e6;
            return invalid("sun.elevation_deg", degrees.to_string(), accepted);
        }
        Ok(())
    }

    /// Share of light scattered more often than once up to which it is left out.
    pub(super) fn limit() -> f64 {
        Thresholds::MEASURED.most_scattered_again
    }

    /// What is done about light scattered more often than once, and why.
    pub(super) fn words(&self, share: f64, single: bool) -> String {
        let limit = Self::limit();
        let Self { optical_depth, place, .. } = self;
        let enough = if share <= limit { "is enough" } else { "is not enough" };
        let done = if single { "it alone is drawn" } else { "all orders of scattering are drawn" };
        format!(
            "layer ({}, optical depth {optical_depth}): {:.1} % of what it sends back was scattered more often than once, or \
             by the ground; light scattered once {enough} (limit {:.0} %): {done}",
            place.word(),
            100.0 * share,
            100.0 * limit
        )
    }
}
