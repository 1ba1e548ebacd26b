//! Distributions of sizes as they are written in a scene file or a flag.
//!
//! ```toml
//! size_distribution = { kind = "gamma", effective_radius_um = 10, effective_variance = 0.1 }
//! size_distribution = { kind = "log-normal", median_radius_um = 5, spread = 0.3 }
//! size_distribution = { kind = "normal", mean_radius_um = 10, deviation_um = 1 }
//! size_distribution = { kind = "marshall-palmer", rain_rate_mm_h = 5, from_radius_um = 50, to_radius_um = 1000 }
//! size_distribution = { kind = "delta", radius_um = 10 }
//! ```
//! Numbers of particles are per size; `spread` is the standard deviation of ln(radius).

use crate::size_distribution::{SizeDistribution, SizeLaw};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A distribution as written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum SizeKeys {
    /// Spheres of one size.
    Delta {
        /// µm.
        radius_um: f64,
    },
    /// A Gaussian distribution of radii.
    Normal {
        /// µm.
        mean_radius_um: f64,
        /// Standard deviation, µm.
        deviation_um: f64,
    },
    /// A Gaussian distribution of logarithms of radii.
    LogNormal {
        /// µm.
        median_radius_um: f64,
        /// Standard deviation of ln(radius).
        spread: f64,
    },
    /// A gamma distribution after Hansen.
    Gamma {
        /// µm.
        effective_radius_um: f64,
        /// Of the radii, over the square of the effective radius.
        effective_variance: f64,
    },
    /// Rain after Marshall & Palmer 1948.
    MarshallPalmer {
        /// Rain rate, mm/h.
        rain_rate_mm_h: f64,
        /// Smallest radius, µm.
        from_radius_um: f64,
        /// Largest radius, µm.
        to_radius_um: f64,
    },
}

/// Radii of spheres, micrometres: from a nanometre to a centimetre.
const RADII_UM: (f64, f64) = (1e-3, 1e4);

impl SizeKeys {
    /// In metres, every number within what is accepted.
    ///
    /// # Errors
    /// The first number that is not, and what would be.
    pub fn checked(&self) -> Result<SizeDistribution, String> {
        let radius = |name: &str, um: f64| within(name, um, RADII_UM).map(|um| um * 1e-6);
        let law = match *self {
            Self::Delta { radius_um } => SizeLaw::Delta { radius: radius("radius_um", radius_um)? },
            Self::Normal { mean_radius_um: mean, deviation_um } => SizeLaw::Normal {
                mean: radius("mean_radius_um", mean)?,
                deviation: 1e-6 * within("deviation_um", deviation_um, (1e-4 * mean, 0.5 * mean))?,
            },
            Self::LogNormal { median_radius_um, spread } => SizeLaw::LogNormal {
                median: radius("median_radius_um", median_radius_um)?,
                spread: within("spread", spread, (1e-4, 1.0))?,
            },
            Self::Gamma { effective_radius_um, effective_variance } => SizeLaw::gamma(
                radius("effective_radius_um", effective_radius_um)?,
                within("effective_variance", effective_variance, (1e-6, 0.45))?,
            ),
            Self::MarshallPalmer { rain_rate_mm_h, from_radius_um: from, to_radius_um: to } => {
                let (low, high) = (radius("from_radius_um", from)?, radius("to_radius_um", to)?);
                if low >= high {
                    return Err(format!("from_radius_um = {from} must be less than {to}"));
                }
                let rain_rate = within("rain_rate_mm_h", rain_rate_mm_h, (1e-3, 1e3))?;
                let law = SizeLaw::marshall_palmer(rain_rate);
                return SizeDistribution::between(law, low, high).map_err(|e| e.to_string());
            }
        };
        SizeDistribution::whole(law).map_err(|error| error.to_string())
    }
}

fn within(name: &str, value: f64, (from, to): (f64, f64)) -> Result<f64, String> {
    if value >= from && value <= to {
        return Ok(value);
    }
    Err(format!("{name} = {value}: {from} to {to} is accepted"))
}

impl fmt::Display for SizeKeys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = toml::Value::try_from(self).map(|value| value.to_string());
        f.write_str(&text.unwrap_or_default())
    }
}

/// As on the command line: the table of the scene file, with or without its braces.
impl FromStr for SizeKeys {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct Holder {
            sizes: SizeKeys,
        }
        let bare = text.trim();
        let table = if bare.starts_with('{') { bare.into() } else { format!("{{ {bare} }}") };
        let holder: Result<Holder, _> = toml::from_str(&format!("sizes = {table}"));
        holder.map(|holder| holder.sizes).map_err(|error| {
            format!(
                "{}; accepted: kind = \"gamma\", effective_radius_um = 10, effective_variance = \
                 0.1 (or normal, log-normal, marshall-palmer, delta)",
                error.message().trim().replace('\n', ", ")
            )
        })
    }
}
