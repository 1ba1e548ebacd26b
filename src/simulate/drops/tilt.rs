//! How the axes of drops tilt that cant: one tilt for each radius.
//!
//! Tilts have a Gaussian distribution in each of two planes (per axis: a tilt β has the weight
//! `β exp(-β²/2σ²)`, for the small tilts of drops the `sin β exp(-β²/2σ²)` of radar meteorology). Seen along the
//! light a tilt is another elevation of the sun, and a turn about the light, by which the whole pattern turns.
//!
//! Radii and tilts are averaged together: the k-th radius in the order of halving has the k-th point of the
//! two-dimensional sequence by the plastic number (Roberts 2018; its points fill the square evenly however
//! many are taken), so that all radii of a coarser mean keep their tilts in a finer one.

use std::f64::consts::{PI, TAU};

/// Of `x³ = x + 1`: 1/g and 1/g².
const PLASTIC: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
/// Tilts rarer than this are not met.
const RAREST: f64 = 1e-6;

/// How a drop stands to the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tilt {
    /// Elevation of the sun above the plane across the drop's axis, radians.
    pub elevation: f64,
    /// By which its pattern is turned about the light, radians.
    pub turn: f64,
}

impl Tilt {
    /// No tilt under a sun.
    pub fn upright(sun_elevation: f64) -> Self {
        Self { elevation: sun_elevation, turn: 0.0 }
    }

    /// The tilt of a place between 0 and 1 (a dyadic fraction), by its deviation per plane (radians).
    pub fn of_place(place: f64, deviation: f64, sun_elevation: f64) -> Self {
        let number = order(place) as f64;
        let [u, v] = PLASTIC.map(|alpha| (0.5 + alpha * number).fract());
        let tilt = deviation * (-2.0 * u.max(RAREST).ln()).sqrt();
        Self::new(tilt.min(PI), TAU * v, sun_elevation)
    }

    /// Of an axis tilted from the vertical by an angle, into an azimuth from the light's way on.
    fn new(tilt: f64, about: f64, sun_elevation: f64) -> Self {
        let (sin, cos) = sun_elevation.sin_cos();
        let (aside, ahead) = (tilt.sin() * about.sin(), tilt.sin() * about.cos());
        let up = tilt.cos();
        // the axis in the frame of the light: x upper side, z along the light
        let (x, z) = (up * cos + ahead * sin, ahead * cos - up * sin);
        Self { elevation: -z.clamp(-1.0, 1.0).asin(), turn: aside.atan2(x) }
    }
}

/// The number of a dyadic fraction in the order of halving: 0, 1, 1/2, 1/4, 3/4, 1/8, …
fn order(place: f64) -> u64 {
    if place <= 0.0 || place >= 1.0 {
        return u64::from(place >= 1.0);
    }
    let (mut numerator, mut denominator) = (place, 1u64);
    while numerator.fract() != 0.0 && denominator < 1 << 40 {
        numerator *= 2.0;
        denominator *= 2;
    }
    1 + denominator / 2 + (numerator as u64 - 1) / 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_numbered_by_halving() {
        let places = [0.0, 1.0, 0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875];
        for (number, place) in places.iter().enumerate() {
            assert_eq!(order(*place), number as u64, "{place}");
        }
    }

    /// Means over tilts: elevation and turn spread by the deviation, about those of upright drops.
    #[test]
    fn tilts_have_their_deviation() {
        let (sun, deviation) = (0.35, 0.12);
        let count = 4096;
        let tilts = (0..count).map(|k| Tilt::of_place(k as f64 / count as f64, deviation, sun));
        let (mut mean, mut square, mut turn) = (0.0, 0.0, 0.0);
        for tilt in tilts {
            mean += (tilt.elevation - sun) / count as f64;
            square += (tilt.elevation - sun).powi(2) / count as f64;
            turn += (tilt.turn * sun.cos()).powi(2) / count as f64;
        }
        // the axis' own length shortens by 1 - σ²: the elevation falls by σ² tan(sun)/2
        assert!((mean + 0.5 * deviation * deviation * f64::tan(sun)).abs() < 1e-3, "{mean}");
        assert!((square.sqrt() / deviation - 1.0).abs() < 0.02, "{}", square.sqrt());
        assert!((turn.sqrt() / deviation - 1.0).abs() < 0.03, "{}", turn.sqrt());
        assert_eq!(Tilt::new(0.0, 1.0, sun).turn, 0.0);
        assert!((Tilt::new(0.0, 1.0, sun).elevation - sun).abs() < 1e-15);
        // into the light: the sun seems higher; aside: the pattern turns
        assert!(Tilt::new(0.1, PI, sun).elevation > sun + 0.09);
        assert!(Tilt::new(0.1, 0.5 * PI, 0.0).turn > 0.09);
    }
}
