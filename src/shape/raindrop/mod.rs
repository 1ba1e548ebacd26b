//! Falling raindrops: `r(θ) = 1 + Σ c_n cos nθ`, θ from the downward vertical (θ = 0 is the
//! flattened lower pole), in units of the radius of equal volume.
//!
//! Two models. Beard & Chuang, J. Atmos. Sci. 44, 1509 (1987), as printed by Sadeghi et al. 2012
//! (Table I): linear in the radius between the rows, a sphere up to 0.4 mm. Chuang & Beard,
//! J. Atmos. Sci. 47, 1374 (1990), Table 1: its θ counts from the upper pole, so that its odd
//! coefficients change sign here; linear between the rows; below the first row (0.5 mm) the
//! deformation shrinks with the square of the radius, as balance of pressure and surface tension
//! asks for small drops.

mod axis_ratio;

pub use axis_ratio::AxisRatioLaw;

use super::error::ShapeError;
use super::level::{Level, Slope};
use crate::math::scalar::Scalar;
use std::f64::consts::PI;

const BEARD_CHUANG_1987: &str = include_str!("../../../data/drops/raindrop_beard_chuang_1987.csv");
const CHUANG_BEARD_1990: &str = include_str!("../../../data/drops/raindrop_chuang_beard_1990.csv");

/// Radius up to which the 1987 model takes a drop for a sphere (Sadeghi et al. 2012, Table I).
const SPHERE_UP_TO: f64 = 0.4e-3;
/// A polar profile is rough at its origin; the smallest profile radius of the models is 0.6.
pub(super) const ROUGH_CORE: f64 = 0.4;

const SMALLEST_RADIUS: f64 = 1e-6;

/// Model of the equilibrium shape of a falling raindrop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaindropModel {
    /// Beard & Chuang 1987.
    BeardChuang1987,
    /// Chuang & Beard 1990.
    ChuangBeard1990,
}

impl RaindropModel {
    /// Name in scene files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BeardChuang1987 => "beard-chuang-1987",
            Self::ChuangBeard1990 => "chuang-beard-1990",
        }
    }

    /// Accepted radii of equal volume, metres.
    pub fn radius_range(self) -> (f64, f64) {
        match self {
            Self::BeardChuang1987 => (SMALLEST_RADIUS, 3.0e-3),
            Self::ChuangBeard1990 => (SMALLEST_RADIUS, 4.5e-3),
        }
    }

    /// Rows (radius in metres, coefficients with θ from the lower pole).
    fn rows(self) -> Vec<(f64, Vec<f64>)> {
        let (text, odd_sign) = match self {
            Self::BeardChuang1987 => (BEARD_CHUANG_1987, 1.0),
            Self::ChuangBeard1990 => (CHUANG_BEARD_1990, -1.0),
        };
        text.lines()
            .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
            .map(|line| {
                let numbers: Vec<f64> = line.split(',').filter_map(|w| w.parse().ok()).collect();
                let signed = |(n, c): (usize, &f64)| if n % 2 == 1 { odd_sign * c } else { *c };
                (numbers[1] * 1e-3, numbers[2..].iter().enumerate().map(signed).collect())
            })
            .collect()
    }

    /// Radius up to which drops are spheres, metres; `None` where all are flattened.
    pub fn sphere_up_to(self) -> Option<f64> {
        match self {
            Self::BeardChuang1987 => Some(SPHERE_UP_TO),
            Self::ChuangBeard1990 => None,
        }
    }

    /// Coefficients `c_n` at a radius of equal volume (metres) inside the model's range.
    pub fn coefficients(self, radius: f64) -> Result<Vec<f64>, ShapeError> {
        let (from, to) = self.radius_range();
        // a radius that arrives as 3 mm times 1e-3 may be one rounding above 3e-3
        if !(radius >= from * (1.0 - 1e-12) && radius <= to * (1.0 + 1e-12)) {
            return Err(ShapeError::RadiusOutsideModel {
                radius_mm: radius * 1e3,
                model: self.name(),
                from_mm: from * 1e3,
                to_mm: to * 1e3,
            });
        }
        let rows = self.rows();
        let (first_radius, first) = &rows[0];
        if radius < *first_radius {
            let share = match self {
                Self::BeardChuang1987 => {
                    ((radius - SPHERE_UP_TO) / (first_radius - SPHERE_UP_TO)).max(0.0)
                }
                Self::ChuangBeard1990 => (radius / first_radius).powi(2),
            };
            return Ok(first.iter().map(|c| c * share).collect());
        }
        let above = rows.iter().position(|row| row.0 >= radius).unwrap_or(rows.len() - 1).max(1);
        let ((r0, c0), (r1, c1)) = (&rows[above - 1], &rows[above]);
        let share = ((radius - r0) / (r1 - r0)).clamp(0.0, 1.0);
        Ok(c0.iter().zip(c1).map(|(a, b)| a + (b - a) * share).collect())
    }
}

/// The profile as a polynomial `R(μ)` in `μ = cos θ`.
#[derive(Clone, Debug, PartialEq)]
pub struct Raindrop {
    /// Coefficients of μ⁰, μ¹, …
    powers: Vec<f64>,
    bounding_radius: f64,
    convex: bool,
}

/// Points of the profile at which its curvature is looked at.
const CURVATURES: u32 = 360;

impl Raindrop {
    /// A drop of equal-volume radius (metres).
    pub fn new(radius: f64, model: RaindropModel) -> Result<Self, ShapeError> {
        Ok(Self::from_coefficients(&model.coefficients(radius)?))
    }

    /// A drop by the coefficients `c_n` of `r = 1 + Σ c_n cos nθ`, θ from the lower pole.
    fn from_coefficients(coefficients: &[f64]) -> Self {
        let mut powers = chebyshev_to_powers(coefficients);
        powers[0] += 1.0;
        while powers.len() > 1 && powers[powers.len() - 1] == 0.0 {
            powers.pop();
        }
        let bound = 1.0 + coefficients.iter().map(|c| c.abs()).sum::<f64>();
        let mut drop = Self { powers, bounding_radius: bound, convex: true };
        let angle = |k: u32| PI * f64::from(k) / f64::from(CURVATURES);
        drop.convex = (0..=CURVATURES).all(|k| drop.bulges(angle(k)));
        drop
    }

    /// Whether the profile bulges at an angle from the lower pole: `ρ² + 2ρ'² - ρρ'' > 0`.
    fn bulges(&self, angle: f64) -> bool {
        let (sin, cos) = angle.sin_cos();
        let (r, dr, ddr) = self.profile(cos);
        let (slope, bend) = (-dr * sin, ddr * sin * sin - dr * cos);
        r * r + 2.0 * slope * slope - r * bend > 0.0
    }

    pub(super) fn is_convex(&self) -> bool {
        self.convex
    }

    pub(super) fn is_sphere(&self) -> bool {
        self.powers == [1.0]
    }

    pub(super) fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// `R`, `R'` and `R''` at `μ`, by Horner's rule.
    fn profile<T: Scalar>(&self, mu: T) -> (T, T, T) {
        let (mut r, mut slope, mut bend) = (T::default(), T::default(), T::default());
        for &c in self.powers.iter().rev() {
            bend = bend * mu + slope;
            slope = slope * mu + r;
            r = r * mu + c;
        }
        (r, slope, bend * 2.0)
    }

    pub(super) fn slope<T: Scalar>(&self, q: T, depth: T) -> Slope<T> {
        let rho = q.root();
        let inverse = T::real(1.0) / rho;
        let mu = depth * inverse;
        let (mut r, mut dr) = (T::default(), T::default());
        for &c in self.powers.iter().rev() {
            dr = dr * mu + r;
            r = r * mu + c;
        }
        // ∂μ/∂q = -μ/2q, ∂ρ/∂q = 1/2ρ
        Slope { f: rho - r, q: (inverse + dr * mu * inverse * inverse) * 0.5, z: -(dr * inverse) }
    }

    pub(super) fn level<T: Scalar>(&self, q: T, depth: T) -> Level<T> {
        let inverse = T::real(1.0) / q.root();
        let inverse_q = inverse * inverse;
        let mu = depth * inverse;
        let (_, dr, ddr) = self.profile(mu);
        let mu_q = -(mu * inverse_q) * 0.5;
        let mu_qq = mu * inverse_q * inverse_q * 0.75;
        let mu_qz = -(inverse_q * inverse) * 0.5;
        Level {
            q: inverse * 0.5 - dr * mu_q,
            z: -(dr * inverse),
            qq: -(inverse * inverse_q) * 0.25 - ddr * mu_q * mu_q - dr * mu_qq,
            qz: -(ddr * mu_q * inverse) - dr * mu_qz,
            zz: -(ddr * inverse_q),
        }
    }
}

/// `Σ c_n T_n(μ)` as powers of μ.
fn chebyshev_to_powers(coefficients: &[f64]) -> Vec<f64> {
    let count = coefficients.len().max(1);
    let mut powers = vec![0.0; count];
    let mut previous = vec![0.0; count];
    let mut current = vec![0.0; count];
    current[0] = 1.0;
    for (n, &c) in coefficients.iter().enumerate() {
        for (power, t) in powers.iter_mut().zip(&current) {
            *power += c * t;
        }
        // T_{n+1} = 2 μ T_n - T_{n-1}, and T_1 = μ T_0
        let factor = if n == 0 { 1.0 } else { 2.0 };
        let next: Vec<f64> = (0..count)
            .map(|k| if k > 0 { factor * current[k - 1] } else { 0.0 } - previous[k])
            .collect();
        previous = std::mem::replace(&mut current, next);
        if n == 0 {
            previous = vec![0.0; count];
            previous[0] = 1.0;
        }
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume and axis ratio as published check values (architecture of the model, not of code).
    #[test]
    fn volume_and_axis_ratio_of_beard_chuang() {
        let radii = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0];
        let volumes = [0.99977, 0.99998, 1.00003, 1.00001, 0.99995, 1.00025];
        let ratios = [0.98767, 0.92728, 0.85286, 0.77660, 0.70593, 0.64038];
        for ((radius, volume), ratio) in radii.iter().zip(volumes).zip(ratios) {
            let drop = Raindrop::new(radius * 1e-3, RaindropModel::BeardChuang1987).unwrap();
            let (mut sum, mut wide, mut low, mut high) = (0.0, 0.0f64, 0.0f64, 0.0f64);
            let count = 4000;
            for i in 0..count {
                let angle = (i as f64 + 0.5) * std::f64::consts::PI / count as f64;
                let (r, _, _) = drop.profile(angle.cos());
                sum += r.powi(3) * angle.sin() * std::f64::consts::PI / count as f64 / 2.0;
                wide = wide.max(r * angle.sin());
                low = low.max(r * angle.cos());
                high = high.max(-r * angle.cos());
            }
            assert!((sum - volume).abs() < 1e-5, "volume at {radius}: {sum}");
            assert!(((low + high) / (2.0 * wide) - ratio).abs() < 2e-5, "ratio at {radius}");
        }
    }

    /// Drops of both models bulge everywhere up to 2.5 mm; those of 3.5 mm
    /// have a hollow about the lower pole.
    #[test]
    fn large_drops_are_hollow_below() {
        let chuang_beard =
            |radius: f64| Raindrop::new(radius, RaindropModel::ChuangBeard1990).unwrap();
        for radius in [1e-4, 1e-3, 2.5e-3] {
            assert!(chuang_beard(radius).is_convex(), "{radius}");
            assert!(Raindrop::new(radius, RaindropModel::BeardChuang1987).unwrap().is_convex());
        }
        for radius in [3.5e-3, 4.5e-3] {
            let drop = chuang_beard(radius);
            assert!(!drop.is_convex() && !drop.bulges(0.28), "{radius}");
            assert!(drop.bulges(0.0) && drop.bulges(1.2), "{radius}");
        }
    }

    /// The flattened pole is the lower one in both models: r(0) < r(π).
    #[test]
    fn flattened_pole_is_below() {
        for model in [RaindropModel::BeardChuang1987, RaindropModel::ChuangBeard1990] {
            let drop = Raindrop::new(2e-3, model).unwrap();
            assert!(drop.profile(1.0).0 < drop.profile(-1.0).0);
        }
    }
}
