//! Laws of particle sizes: the number of particles per radius, up to a common factor.
//!
//! Most laws in use are one: `r^a exp(-(r/s)^c)` is the gamma law of Hansen & Travis 1974 (Space Sci.
//! Rev. 16, 527, eq. 2.56), Deirmendjian's modified gamma, the exponential law of Marshall & Palmer
//! 1948 (J. Meteorol. 5, 165), the normalised gamma of rain, Rosin & Rammler's law of sprays and the
//! power law (s → ∞). They are kept as logarithms, so that nothing overflows.

use std::sync::Arc;

/// Number per radius (metres), up to a factor.
#[derive(Clone, Debug, PartialEq)]
pub enum SizeLaw {
    /// All of one radius.
    Delta {
        /// Metres.
        radius: f64,
    },
    /// `exp(-(r - mean)²/2σ²)` for r > 0.
    Normal {
        /// Metres.
        mean: f64,
        /// σ, metres.
        deviation: f64,
    },
    /// `exp(-ln²(r/median)/2s²)/r`.
    LogNormal {
        /// Metres.
        median: f64,
        /// s, the standard deviation of ln r.
        spread: f64,
    },
    /// `r^exponent exp(-(r/scale)^power)`.
    PowerExponential {
        /// Of r, any sign.
        exponent: f64,
        /// Metres; infinite for a pure power law.
        scale: f64,
        /// Of the exponential, positive.
        power: f64,
    },
    /// So many particles between neighbouring edges, evenly by radius.
    Histogram {
        /// Metres, ascending.
        edges: Arc<[f64]>,
        /// One less than edges.
        numbers: Arc<[f64]>,
    },
    /// Straight lines between points.
    Table {
        /// Metres, ascending.
        radii: Arc<[f64]>,
        /// Number per radius at each.
        densities: Arc<[f64]>,
    },
}

impl SizeLaw {
    /// The gamma law of an effective radius (metres) and an effective variance below ½.
    pub fn gamma(effective_radius: f64, effective_variance: f64) -> Self {
        let v = effective_variance;
        let scale = effective_radius * v;
        Self::PowerExponential { exponent: (1.0 - 3.0 * v) / v, scale, power: 1.0 }
    }

    /// `exp(-Λ D)` with Marshall & Palmer's Λ = 4.1 R^(-0.21) mm⁻¹ at the rain rate R in mm/h.
    pub fn marshall_palmer(rain_rate: f64) -> Self {
        let slope = 4.1e3 * rain_rate.powf(-0.21);
        Self::PowerExponential { exponent: 0.0, scale: 0.5 / slope, power: 1.0 }
    }

    /// Logarithm of the number per radius, up to a constant; -∞ where there is none.
    pub fn ln_density(&self, radius: f64) -> f64 {
        if radius <= 0.0 {
            return f64::NEG_INFINITY;
        }
        match self {
            Self::Delta { radius: only } => {
                if radius == *only {
                    0.0
                } else {
                    f64::NEG_INFINITY
                }
            }
            Self::Normal { mean, deviation } => -0.5 * ((radius - mean) / deviation).powi(2),
            Self::LogNormal { median, spread } => {
                let log = (radius / median).ln();
                -0.5 * (log / spread).powi(2) - log
            }
            Self::PowerExponential { exponent, scale, power } => {
                // Measured from the top of r^exponent exp(…), where large exponents nearly cancel.
                let top = if *exponent > 0.0 { (exponent / power).powf(1.0 / power) } else { 1.0 };
                let unit = if scale.is_finite() { scale * top } else { 1.0 };
                let log = (radius / unit).ln();
                let fall =
                    if scale.is_finite() { top.powf(*power) * (power * log).exp_m1() } else { 0.0 };
                exponent * log - fall
            }
            Self::Histogram { edges, numbers } => {
                let bin = edges.partition_point(|&edge| edge <= radius);
                if bin == 0 || bin == edges.len() {
                    return f64::NEG_INFINITY;
                }
                (numbers[bin - 1] / (edges[bin] - edges[bin - 1])).ln()
            }
            Self::Table { radii, densities } => {
                let next = radii.partition_point(|&r| r <= radius).min(radii.len() - 1);
                if next == 0 || radius > radii[next] {
                    return f64::NEG_INFINITY;
                }
                let share = (radius - radii[next - 1]) / (radii[next] - radii[next - 1]);
                (densities[next - 1] + share * (densities[next] - densities[next - 1])).ln()
            }
        }
    }

    /// Radii between which there are particles at all.
    pub fn reach(&self) -> (f64, f64) {
        match self {
            Self::Delta { radius } => (*radius, *radius),
            Self::Histogram { edges: radii, .. } | Self::Table { radii, .. } => {
                (radii[0], radii[radii.len() - 1])
            }
            _ => (0.0, f64::INFINITY),
        }
    }

    /// Radii inside the reach where the density or its slope jumps.
    pub fn breaks(&self) -> &[f64] {
        match self {
            Self::Histogram { edges: radii, .. } | Self::Table { radii, .. } => {
                &radii[1..radii.len() - 1]
            }
            _ => &[],
        }
    }

    /// Where the density times `r^power` has its maximum by ln r, if it has one inside its reach.
    pub fn mode(&self, power: f64) -> Option<f64> {
        let p = power + 1.0;
        match *self {
            Self::Normal { mean, deviation } => {
                Some(0.5 * (mean + (mean * mean + 4.0 * p * deviation * deviation).sqrt()))
            }
            Self::LogNormal { median, spread } => Some(median * (power * spread * spread).exp()),
            Self::PowerExponential { exponent, scale, power: c } if scale.is_finite() => {
                let total = exponent + p;
                (total > 0.0).then(|| scale * (total / c).powf(1.0 / c))
            }
            _ => None,
        }
    }
}
