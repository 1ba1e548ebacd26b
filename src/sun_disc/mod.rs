//! The averages over the sun's disc, in one room.
//!
//! Every point of the disc shines from its own direction, so that one direction of the sky sees scattering
//! angles up to 0.27° on both sides of its own. What is averaged decides how:
//! - [`DiscMean`]: curves of spheres over the whole circle of angles, finely sampled; exact at 0° and 180°.
//! - [`DiscField`]: fields over angle and azimuth that change slowly with the latter, such as means of many drops.
//! - [`smooth_over_sun`]: a curve as a table has it, along chords of the disc.
//! - [`SunFilter`]: curves sampled more coarsely than their beats, which a low-pass filter takes out.
//! - [`DiscPoints`]: what depends on the azimuth too.
//!
//! All are means over directions of the same light, 1 for a constant. The size of the disc and its limb
//! darkening are with the [colours](crate::color).
//!
//! ```
//! use gonio::color::SUN_ANGULAR_RADIUS;
//! use gonio::sun_disc::smooth_over_sun;
//!
//! let theta: Vec<f64> = (0..=1800).map(|i| (0.1 * f64::from(i)).to_radians()).collect();
//! let line: Vec<f64> = theta.iter().map(|t| 3.0 - t).collect();
//! let seen = smooth_over_sun(&theta, &line, 550e-9, SUN_ANGULAR_RADIUS, &[2.4]);
//! assert!((seen[0] - 0.6).abs() < 1e-4);
//! ```

mod field;
mod filter;
mod mean;
mod points;
mod smoothing;

pub use field::DiscField;
pub(crate) use field::near_axis;
pub use filter::{Kernel, SunFilter};
pub use mean::DiscMean;
pub use points::DiscPoints;
pub use smoothing::smooth_over_sun;
