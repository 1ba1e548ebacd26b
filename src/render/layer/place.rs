//! Where the layer is, and at which of its angles a line of sight meets it.

use crate::render::RenderError;
use crate::transfer::Side;
use glam::DVec3;
use std::str::FromStr;

/// Where the layer is, seen from the observer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// Upright across the antisolar direction, lit on the observer's side: a shower seen from outside.
    #[default]
    Curtain,
    /// Level, above the observer, who looks up through it from the ground.
    Above,
    /// Level, below the observer, who looks down upon it: a cloud from an aeroplane.
    Below,
}

/// Words of scenes.
const WORDS: [(&str, Place); 3] =
    [("curtain", Place::Curtain), ("above", Place::Above), ("below", Place::Below)];

impl FromStr for Place {
    type Err = RenderError;

    fn from_str(text: &str) -> Result<Self, RenderError> {
        let known = WORDS.into_iter().find(|(word, _)| *word == text).map(|(_, place)| place);
        known.ok_or_else(|| RenderError::Invalid {
            field: "layer.place".into(),
            value: format!("\"{text}\""),
            accepted: "curtain (upright, before the observer), above or below".into(),
        })
    }
}

/// How a line of sight meets the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::render) struct Met {
    /// Cosine to the normal.
    pub cosine: f64,
    /// From the plane of the sun, where its light travels to.
    pub azimuth: f64,
    /// In the plane of normal and line of sight, and across it: what Stokes parameters are told in.
    pub parallel: DVec3,
    pub perpendicular: DVec3,
}

impl Place {
    /// The word of scenes.
    pub fn word(self) -> &'static str {
        WORDS.into_iter().find(|(_, place)| *place == self).map_or("", |(word, _)| word)
    }

    /// The side that is seen.
    pub fn side(self) -> Side {
        if self == Place::Above { Side::Far } else { Side::Lit }
    }

    /// Cosine of the sun's light to the normal.
    pub fn sun(self, elevation: f64) -> f64 {
        if self == Place::Curtain { elevation.cos() } else { elevation.sin() }
    }

    /// Along the layer the way that the light goes, across that, and into the layer from the sun.
    fn frame(self) -> [DVec3; 3] {
        match self {
            Place::Curtain => [DVec3::NEG_Z, DVec3::Y, DVec3::X],
            Place::Above | Place::Below => [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z],
        }
    }

    /// Nothing where the line of sight does not meet the side that is seen.
    pub(in crate::render) fn met(self, view: DVec3) -> Option<Met> {
        let [along, across, normal] = self.frame();
        let light = -view;
        let u = light.dot(normal);
        let cosine = if self.side() == Side::Lit { -u } else { u };
        if cosine <= 1e-6 {
            return None;
        }
        let azimuth = light.dot(across).atan2(light.dot(along));
        let (sine, cos) = azimuth.sin_cos();
        let parallel = (along * cos + across * sine) * u - normal * (1.0 - u * u).max(0.0).sqrt();
        let perpendicular = along * sine - across * cos;
        Some(Met { cosine: cosine.min(1.0), azimuth, parallel, perpendicular })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From cosine and azimuth the scattering angle is that between sunlight and line of sight; frames are right.
    #[test]
    fn angles_are_those_of_the_sky() {
        let elevation = 0.3f64;
        let light = DVec3::new(elevation.cos(), 0.0, -elevation.sin());
        for (place, view) in [
            (Place::Curtain, DVec3::new(0.8, 0.3, 0.4)),
            (Place::Above, DVec3::new(0.5, -0.7, 0.2)),
            (Place::Below, DVec3::new(0.5, 0.2, -0.9)),
        ] {
            let view = view.normalize();
            let met = place.met(view).unwrap();
            let (sun, sign) =
                (place.sun(elevation), if place.side() == Side::Lit { -1.0 } else { 1.0 });
            let sines = ((1.0 - sun * sun) * (1.0 - met.cosine * met.cosine)).sqrt();
            let cosine = sign * sun * met.cosine + sines * met.azimuth.cos();
            assert!((cosine - light.dot(-view)).abs() < 1e-12, "{place:?}");
            assert!((met.perpendicular.cross(met.parallel) - -view).length() < 1e-12, "{place:?}");
            assert!(place.met(-view).is_none());
            assert_eq!(place.word().parse::<Place>().unwrap(), place);
        }
    }
}
