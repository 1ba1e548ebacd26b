//! Distributions of particle sizes: how many particles there are per size.
//!
//! A [`SizeLaw`] between two limits. The density is normalised: the number of particles between the
//! limits is 1, whatever share of the law lies beyond them ([`SizeDistribution::share_inside`]). So
//! a mean "per particle" is one per particle inside the limits.
//!
//! ```
//! use gonio::size_distribution::{SizeDistribution, SizeLaw};
//!
//! let soot = SizeLaw::LogNormal { median: 11.8e-9, spread: 2f64.ln() };
//! let soot = SizeDistribution::between(soot, 5e-9, 20e-6).unwrap();
//! assert!((soot.share_inside() - 0.89229).abs() < 1e-5);
//! assert!((soot.effective_radius() - 39.37456e-9).abs() < 1e-14);
//! ```

mod law;
mod limits;
mod spread;

pub use law::SizeLaw;
pub use spread::log_normal_sample;

use crate::fault::{Blame, Fault};
use crate::math::digits::to_digits;
use crate::math::gauss_legendre;

/// Why a distribution cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SizeError {
    /// The limits are no interval of radii.
    #[error("limits = {from} to {to} m: accepted are 0 ≤ from < to")]
    Limits {
        /// Metres.
        from: f64,
        /// Metres.
        to: f64,
    },
    /// Nothing to average over.
    #[error("no particles lie between {} and {} µm", micrometres(*from), micrometres(*to))]
    Nothing {
        /// Metres.
        from: f64,
        /// Metres.
        to: f64,
    },
    /// The number of particles has no end towards this limit.
    #[error("the number of particles is infinite without a {0} limit")]
    Endless(&'static str),
}

/// Metres as they are written.
fn micrometres(metres: f64) -> f64 {
    to_digits(metres * 1e6, 9)
}

impl Blame for SizeError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

/// Number of particles by radius (metres), 1 in all.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeDistribution {
    law: SizeLaw,
    from: f64,
    to: f64,
    /// Logarithm of the number inside the limits in units of the law's density.
    ln_number: f64,
}

/// Panels of the integrals between two breaks, and Gauss nodes in each.
const PANELS: usize = 240;
const NODES: usize = 8;
/// An integrand that has fallen by exp of this counts for nothing.
const DEPTH: f64 = 60.0;
/// Radii (metres) that a search for the ends of a law looks at.
const RADII: (f64, f64) = (1e-30, 1e30);
/// Power of the radius at which a sphere's light straight ahead grows, and its forward excess where it
/// is small; beyond size parameters of 1 the first grows as r⁴ alone.
const SMALL: f64 = 8.0;

impl SizeDistribution {
    /// Particles of one radius.
    pub fn delta(radius: f64) -> Self {
        Self { law: SizeLaw::Delta { radius }, from: radius, to: radius, ln_number: 0.0 }
    }

    /// A law without limits.
    ///
    /// # Errors
    /// A law that has no end.
    pub fn whole(law: SizeLaw) -> Result<Self, SizeError> {
        if let SizeLaw::Delta { radius } = law {
            return Ok(Self::delta(radius));
        }
        Self::between(law, 0.0, f64::INFINITY)
    }

    /// A law between two radii (0 and ∞: no limit).
    ///
    /// # Errors
    /// Limits that are none, that hold no particles, or that hold no end of them.
    pub fn between(law: SizeLaw, from: f64, to: f64) -> Result<Self, SizeError> {
        if !(from >= 0.0 && from < to) {
            return Err(SizeError::Limits { from, to });
        }
        let (low, high) = law.reach();
        let (inner, outer) = (from.max(low), to.min(high));
        if inner >= outer {
            return Err(SizeError::Nothing { from, to });
        }
        if let SizeLaw::PowerExponential { exponent, scale, .. } = law {
            if inner == 0.0 && exponent <= -1.0 {
                return Err(SizeError::Endless("lower"));
            }
            if outer.is_infinite() && scale.is_infinite() {
                return Err(SizeError::Endless("upper"));
            }
        }
        let mut sizes = Self { law, from: inner, to: outer, ln_number: 0.0 };
        let peak = sizes.peak();
        sizes.ln_number = peak;
        let number = sizes.moment(0.0);
        if !(number > 0.0 && number.is_finite()) {
            return Err(SizeError::Nothing { from, to });
        }
        sizes.ln_number = peak + number.ln();
        Ok(sizes)
    }

    /// The law.
    pub fn law(&self) -> &SizeLaw {
        &self.law
    }

    /// The only radius (metres), if there is but one.
    pub fn single(&self) -> Option<f64> {
        match self.law {
            SizeLaw::Delta { radius } => Some(radius),
            _ => None,
        }
    }

    /// Radii (metres) beyond which there are no particles; 0 and ∞ if nothing bounds them.
    pub fn bounds(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// Number per radius, 1/m.
    pub fn density(&self, radius: f64) -> f64 {
        if radius < self.from || radius > self.to {
            return 0.0;
        }
        (self.law.ln_density(radius) - self.ln_number).exp()
    }

    /// Mean of `r^power`, metres to that power.
    pub fn moment(&self, power: f64) -> f64 {
        let Some(radius) = self.single() else {
            return self
                .weighted(self.span(power, power), |r| r.powf(power))
                .iter()
                .map(|w| w.1)
                .sum();
        };
        radius.powf(power)
    }

    /// Mean of r³ over mean of r²: the radius of the sphere with the same volume per shadow, metres.
    pub fn effective_radius(&self) -> f64 {
        self.moment(3.0) / self.moment(2.0)
    }

    /// Variance of the radius weighted with the shadow, over the squared effective radius.
    pub fn effective_variance(&self) -> f64 {
        if self.single().is_some() {
            return 0.0;
        }
        // By differences, since ⟨r⁴⟩⟨r²⟩/⟨r³⟩² - 1 cancels for narrow laws.
        let mean = self.effective_radius();
        let weights = self.weighted(self.span(2.0, 4.0), |r| r * r);
        let shadow: f64 = weights.iter().map(|w| w.1).sum();
        let square: f64 = weights.iter().map(|(r, w)| w * (r / mean - 1.0).powi(2)).sum();
        square / shadow
    }

    /// Share of the law's particles that lie between the limits.
    pub fn share_inside(&self) -> f64 {
        match Self::whole(self.law.clone()) {
            Ok(whole) => (self.ln_number - whole.ln_number).exp().min(1.0),
            Err(_) => f64::NAN,
        }
    }

    /// Radii (metres, ascending) and the share of the particles below each: 0 at the least, 1 at the largest.
    pub fn shares_below(&self) -> Vec<(f64, f64)> {
        if let Some(radius) = self.single() {
            return vec![(radius, 0.0), (radius, 1.0)];
        }
        let (low, high) = self.span(0.0, 0.0);
        let mut below = vec![(low, 0.0)];
        let mut sum = 0.0;
        for (radius, number) in self.weighted((low, high), |_| 1.0) {
            // half of what a node stands for lies below it
            below.push((radius, sum + 0.5 * number));
            sum += number;
        }
        below.push((high, sum));
        below.iter_mut().for_each(|(_, share)| *share /= sum);
        below
    }

    /// Whether the density ends in a step at one of these radii.
    pub fn has_step(&self, (low, high): (f64, f64)) -> bool {
        let breaks = self.law.breaks();
        let step = |r: f64| r == self.from || r == self.to || breaks.contains(&r);
        step(low) || step(high)
    }

    /// Largest logarithm of the density times the radius.
    fn peak(&self) -> f64 {
        let top = self.top(0.0);
        let at = |r: f64| self.law.ln_density(r);
        let breaks = self.law.breaks().iter().map(|r| at(*r)).fold(f64::NEG_INFINITY, f64::max);
        breaks.max(at(top)).max(at(self.from)).max(at(self.to)).max(-700.0) + top.ln()
    }

    /// Where the density times `r^power` is largest by ln r, within the limits.
    fn top(&self, power: f64) -> f64 {
        let (low, high) = (self.from.max(RADII.0), self.to.min(RADII.1));
        match self.law.mode(power) {
            Some(mode) => mode.clamp(low, high),
            // Falling throughout.
            None => low,
        }
    }

    /// Radii beyond which nothing counts: below with `r^low_power`, above with `r^high_power`.
    fn span(&self, low_power: f64, high_power: f64) -> (f64, f64) {
        let (from, to) = (self.from.max(RADII.0), self.to.min(RADII.1));
        // Limits close to each other, laws of several tops and those that fall all the way.
        if self.law.mode(low_power).is_none() && self.to.is_finite() {
            return (from, to);
        }
        let end = |power: f64, end: f64| {
            let top = self.top(power);
            let value = |u: f64| self.law.ln_density(u.exp()) + (power + 1.0) * u;
            let (start, bound) = (top.ln(), end.ln());
            let gone = |u: f64| {
                let fall = value(start) - value(u);
                fall.is_nan() || fall >= DEPTH
            };
            let mut step = 1e-7;
            while step < (bound - start).abs() && !gone(start + step * (bound - start).signum()) {
                step *= 2.0;
            }
            if step >= (bound - start).abs() && !gone(bound) {
                return end;
            }
            let far = step.min((bound - start).abs());
            let (mut inside, mut outside) = (0.0, far);
            for _ in 0..60 {
                let middle = 0.5 * (inside + outside);
                let there = start + middle * (bound - start).signum();
                if gone(there) { outside = middle } else { inside = middle }
            }
            (start + outside * (bound - start).signum()).exp()
        };
        (end(low_power, from).max(from), end(high_power, to).min(to))
    }

    /// Nodes of an integral over a span, in ascending order, with density times `weight` times width.
    fn weighted(&self, (low, high): (f64, f64), weight: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let rule = gauss_legendre::nodes(NODES);
        let inner = self.law.breaks().iter().copied().filter(|&r| r > low && r < high);
        let edges: Vec<f64> = [low].into_iter().chain(inner).chain([high]).collect();
        let pieces = edges.len() - 1;
        let panels = (PANELS / pieces).max(2);
        let mut out = Vec::with_capacity(pieces * panels * NODES);
        for pair in edges.windows(2) {
            let (start, width) = (pair[0].ln(), (pair[1] / pair[0]).ln() / panels as f64);
            for panel in 0..panels {
                for &(node, share) in &rule {
                    let r = (start + (panel as f64 + 0.5 + 0.5 * node) * width).exp();
                    // Rounding must not carry a node over its edge.
                    let r = r.clamp(pair[0], pair[1]);
                    out.push((r, 0.5 * share * width * r * self.density(r) * weight(r)));
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests;
