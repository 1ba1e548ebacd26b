//! Random orientation: the scattering matrix averaged over all orientations, as expansion coefficients.
//!
//! One T serves all of them. Of a body of revolution two angles are left: that between light and axis, and the
//! azimuth of the scattering plane. The mean over azimuth is exact: with the light's polarisation in
//! right- and left-handed waves an amplitude is a Fourier series in azimuth, and means of products are sums
//! of products of its coefficients (Parseval). The mean over the angle is by Gauss's rule in its cosine, with
//! nodes doubled until the coefficients stand still. The elements
//! are finite sums of generalised spherical functions of the scattering angle (Mishchenko, Travis & Lacis
//! 2002, eqs. 4.75–4.80), whose coefficients Gauss's rule gives exactly.

use super::far_field::{FixedEfficiencies, Scattered};
use super::kernel::error::NoMean;
use super::kernel::rotation::wigner;
use super::matrix::TMatrix;
use crate::math::gauss_legendre;
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;

/// The mean over all orientations of a body.
///
/// ```
/// use gonio::series::tmatrix::{RandomOrientation, TMatrix};
/// use gonio::shape::Shape;
///
/// let t = TMatrix::new(&Shape::spheroid(0.6, 0.0)?, 2.0, 1.5.into(), 1e-6)?;
/// let mean = RandomOrientation::new(&t, 1e-6)?;
/// // a phase function, whose first moment is the asymmetry
/// assert!((mean.coefficients[0][0] - 1.0).abs() < 1e-9);
/// assert!((mean.coefficients[1][0] / 3.0 - mean.asymmetry()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RandomOrientation {
    /// By degree s: α₁, α₂, α₃, α₄, β₁, β₂ of a₁ = F₁₁, a₂ = F₂₂, a₃ = F₃₃, a₄ = F₄₄, b₁ = F₁₂, b₂ = F₃₄, where
    /// F₁₁ has a mean of 1 over all directions.
    pub coefficients: Vec<[f64; 6]>,
    /// Extinction efficiency over the shadow of the sphere of equal volume.
    pub q_ext: f64,
    /// Scattering efficiency.
    pub q_sca: f64,
    /// Radar back-scattering efficiency.
    pub q_back: f64,
}

/// Nodes over the angle between axis and light to begin with, and at most per degree of T.
const FIRST_NODES: usize = 8;
/// The same.
const MOST_PER_DEGREE: usize = 2;

/// a₁ … a₄, b₁, b₂ at one angle.
type Elements = [f64; 6];

impl RandomOrientation {
    /// The mean of a body, to a relative error of the phase function's coefficients.
    ///
    /// # Errors
    /// Where twice as many nodes as are exact for all of T still change it: rounding.
    pub fn new(t: &TMatrix, tolerance: f64) -> Result<Self, NoMean> {
        let angles = gauss_legendre::nodes(2 * t.top + 2);
        let most = (MOST_PER_DEGREE * t.top + 2).max(2 * FIRST_NODES);
        let (q_ext, q_sca) = t.random_efficiencies();
        let (mut nodes, mut before): (usize, Option<Vec<Elements>>) = (FIRST_NODES, None);
        loop {
            let elements = elements(t, &angles, nodes);
            let scale = normalisation(&angles, &elements);
            let coefficients = expand(&angles, &elements, scale, 2 * t.top);
            let change = before.as_ref().map_or(f64::INFINITY, |b| difference(b, &coefficients));
            if change <= tolerance || nodes >= most {
                if change > tolerance {
                    let size_parameter = t.size_parameter;
                    return Err(NoMean { size_parameter, change, nodes, tolerance });
                }
                let mut mean = Self { coefficients, q_ext, q_sca, q_back: 0.0 };
                mean.q_back = q_sca * mean.at(-1.0)[0];
                return Ok(mean);
            }
            before = Some(coefficients);
            nodes = (2 * nodes).min(most);
        }
    }

    /// Mean cosine of the scattering angle.
    pub fn asymmetry(&self) -> f64 {
        self.coefficients.get(1).map_or(0.0, |first| first[0] / 3.0)
    }

    /// Efficiencies as of a fixed body.
    pub fn efficiencies(&self) -> FixedEfficiencies {
        FixedEfficiencies {
            q_ext: self.q_ext,
            q_ahead: self.q_ext,
            q_sca: self.q_sca,
            q_back: self.q_back,
            asymmetry: self.asymmetry(),
        }
    }

    /// a₁, a₂, a₃, a₄, b₁, b₂ at the cosine of a scattering angle; a₁ has a mean of 1.
    pub fn at(&self, cos: f64) -> [f64; 6] {
        let top = self.coefficients.len() - 1;
        let functions = Functions::new(top, cos);
        let mut sums = [0.0; 6];
        for (s, [a1, a2, a3, a4, b1, b2]) in self.coefficients.iter().copied().enumerate() {
            sums[0] += a1 * functions.scalar[s];
            sums[1] += (a2 + a3) * functions.same[s];
            sums[2] += (a2 - a3) * functions.opposite[s];
            sums[3] += a4 * functions.scalar[s];
            sums[4] += b1 * functions.mixed[s];
            sums[5] += b2 * functions.mixed[s];
        }
        let [a1, plus, minus, a4, b1, b2] = sums;
        [a1, 0.5 * (plus + minus), 0.5 * (plus - minus), a4, b1, b2]
    }
}

/// `d^s_{00}`, `d^s_{22}`, `d^s_{2,-2}`, `d^s_{02}` at an angle, by s.
struct Functions {
    scalar: Vec<f64>,
    same: Vec<f64>,
    opposite: Vec<f64>,
    mixed: Vec<f64>,
}

impl Functions {
    fn new(top: usize, cos: f64) -> Self {
        let of = |m: i64, primed: i64| {
            let mut d = vec![0.0; top + 1];
            wigner(m, primed, top, cos, &mut d);
            d
        };
        Self { scalar: of(0, 0), same: of(2, 2), opposite: of(2, -2), mixed: of(0, 2) }
    }
}

/// Elements at all angles, means over azimuth and over so many angles between axis and light.
fn elements(t: &TMatrix, angles: &[(f64, f64)], nodes: usize) -> Vec<Elements> {
    let mirror = t.mirror;
    let to_axis = gauss_legendre::nodes(nodes);
    // a body that is its own mirror image looks the same from both ends
    let half = to_axis.into_iter().filter(|(sin, _)| !mirror || *sin >= 0.0);
    let each = half.collect::<Vec<_>>().into_par_iter().map(|(sin, weight)| {
        let scattered = Scattered::new(t, sin.asin());
        let weight = if mirror && sin > 0.0 { weight } else { 0.5 * weight };
        let of = |&(cos, _): &(f64, f64)| scattered.azimuth_mean(cos.acos()).map(|e| e * weight);
        angles.iter().map(of).collect::<Vec<Elements>>()
    });
    let both = |mut sum: Vec<Elements>, other: Vec<Elements>| {
        for (to, from) in sum.iter_mut().flatten().zip(other.iter().flatten()) {
            *to += from;
        }
        sum
    };
    reduced(each, || vec![[0.0; 6]; angles.len()], both)
}

impl Scattered {
    /// a₁ … b₂ at an angle (`k² dC/dΩ`), mean over azimuth.
    fn azimuth_mean(&self, theta: f64) -> Elements {
        let mut mueller = [[0.0; 4]; 4];
        for amplitude in self.harmonics(theta) {
            for (to, from) in mueller.iter_mut().flatten().zip(amplitude.mueller().iter().flatten())
            {
                *to += from;
            }
        }
        let m = &mueller;
        [m[0][0], m[1][1], m[2][2], m[3][3], 0.5 * (m[0][1] + m[1][0]), 0.5 * (m[2][3] - m[3][2])]
    }

    /// Fourier coefficients in azimuth of the amplitude matrix, but for a phase that all have in common.
    fn harmonics(&self, theta: f64) -> Vec<AmplitudeMatrix> {
        use num_complex::Complex64;
        let top = self.top() as i64;
        let place = |order: i64| (order + top + 1) as usize;
        // components along θ̂ and φ̂ for light parallel and perpendicular to the plane
        let mut parts = vec![[Complex64::ZERO; 4]; 2 * self.top() + 3];
        for (m, ring) in self.orders_at(theta) {
            for (out, light) in ring.iter().enumerate() {
                let (right, left) =
                    (light[0] - Complex64::I * light[1], light[0] + Complex64::I * light[1]);
                for (order, wave, side) in [(m + 1, right, 1.0), (m - 1, left, -1.0)] {
                    let to = &mut parts[place(order)];
                    to[2 * out] += 0.5 * wave;
                    to[2 * out + 1] -= Complex64::I * (0.5 * side) * wave;
                }
            }
        }
        let amplitude =
            |[pt, nt, pp, np]: [Complex64; 4]| AmplitudeMatrix { s1: -np, s2: pt, s3: nt, s4: -pp };
        parts.into_iter().map(amplitude).collect()
    }
}

/// What makes the mean of a₁ over directions 1.
fn normalisation(angles: &[(f64, f64)], elements: &[Elements]) -> f64 {
    let sum: f64 = angles.iter().zip(elements).map(|((_, weight), e)| 0.5 * weight * e[0]).sum();
    1.0 / sum
}

fn expand(angles: &[(f64, f64)], elements: &[Elements], scale: f64, top: usize) -> Vec<Elements> {
    let mut coefficients = vec![[0.0; 6]; top + 1];
    for (&(cos, weight), e) in angles.iter().zip(elements) {
        let functions = Functions::new(top, cos);
        for (s, to) in coefficients.iter_mut().enumerate() {
            let share = scale * weight * (s as f64 + 0.5);
            let plus = share * (e[1] + e[2]) * functions.same[s];
            let minus = share * (e[1] - e[2]) * functions.opposite[s];
            to[0] += share * e[0] * functions.scalar[s];
            to[1] += 0.5 * (plus + minus);
            to[2] += 0.5 * (plus - minus);
            to[3] += share * e[3] * functions.scalar[s];
            to[4] += share * e[4] * functions.mixed[s];
            to[5] += share * e[5] * functions.mixed[s];
        }
    }
    coefficients
}

/// Largest change of the elements' root mean squares, relative to that of a₁: `∫ a² = Σ α²/(2s + 1)`.
fn difference(before: &[Elements], after: &[Elements]) -> f64 {
    let (mut wrong, mut whole) = ([0.0; 6], 0.0);
    for (s, (a, b)) in before.iter().zip(after).enumerate() {
        let share = 1.0 / (2 * s + 1) as f64;
        for (k, to) in wrong.iter_mut().enumerate() {
            *to += share * (a[k] - b[k]).powi(2);
        }
        whole += share * b[0].powi(2);
    }
    wrong.into_iter().fold(0.0f64, |most, w| most.max((w / whole).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::lorenz_mie::Sphere;
    use crate::shape::{RaindropModel, Shape};
    use num_complex::Complex64;

    /// Of a sphere all orientations are alike.
    #[test]
    fn a_sphere_keeps_its_matrix() {
        let index = Complex64::new(1.4, 0.01);
        let t = TMatrix::new(&Shape::sphere(), 9.0, index, 1e-8).unwrap();
        let mean = RandomOrientation::new(&t, 1e-9).unwrap();
        let sphere = Sphere::new(9.0, index).unwrap();
        let q = sphere.efficiencies();
        assert!((mean.q_sca / q.q_sca - 1.0).abs() < 1e-10);
        assert!((mean.asymmetry() - q.asymmetry).abs() < 1e-10);
        assert!((mean.q_back / q.q_back - 1.0).abs() < 1e-7);
        for theta in [0.0f64, 0.3, 1.4, 3.0] {
            let (s1, s2) = sphere.amplitudes(&[theta])[0];
            let s = AmplitudeMatrix { s1, s2, ..Default::default() }.mueller();
            let scale = 4.0 / (q.q_sca * 81.0);
            let found = mean.at(theta.cos());
            let known = [s[0][0], s[1][1], s[2][2], s[3][3], s[0][1], s[2][3]].map(|e| e * scale);
            for (a, b) in found.iter().zip(known) {
                assert!((a - b).abs() < 1e-9 * known[0], "{theta}: {found:?} {known:?}");
            }
        }
    }

    /// The mean over thousands of fixed orientations, for a body without a horizontal plane of symmetry:
    /// Gauss's rule in elevation, even steps in azimuth.
    #[test]
    fn fixed_orientations_average_to_it() {
        let drop = Shape::raindrop(2e-3, RaindropModel::BeardChuang1987, 0.0).unwrap();
        let t = TMatrix::new(&drop, 4.0, Complex64::new(1.5, 0.01), 1e-7).unwrap();
        let mean = RandomOrientation::new(&t, 1e-8).unwrap();
        let (elevations, azimuths) = (gauss_legendre::nodes(40), 60);
        for theta in [0.2f64, 1.1, 2.5] {
            let mut sums = [0.0; 7];
            for (sin, weight) in &elevations {
                let scattered = Scattered::new(&t, sin.asin());
                for k in 0..azimuths {
                    let phi = std::f64::consts::TAU * f64::from(k) / f64::from(azimuths);
                    let m = scattered.directions(&[(theta, phi)])[0].mueller();
                    let share = 0.5 * weight / f64::from(azimuths);
                    let parts = [m[0][0], m[1][1], m[2][2], m[3][3], m[0][1], m[2][3], m[0][2]];
                    sums.iter_mut().zip(parts).for_each(|(to, part)| *to += share * part);
                }
            }
            let scale = 4.0 / (mean.q_sca * 16.0);
            let found = mean.at(theta.cos());
            for (a, b) in found.iter().zip(&sums) {
                assert!((a - b * scale).abs() < 1e-6 * found[0], "{theta}: {found:?} {sums:?}");
            }
            assert!(sums[6].abs() * scale < 1e-6 * found[0]);
        }
    }
}
