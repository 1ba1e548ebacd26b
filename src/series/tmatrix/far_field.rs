//! Scattering by a fixed body: a plane wave's expansion, T, and the waves that leave, about the light.
//!
//! T is known about the body's axis; the waves that leave are turned to the light's direction
//! ([`super::kernel::rotation`]), where scattering angle and azimuth are those of the amplitude matrix
//! (conventions: [`crate::optics`]): a column of a table then costs one sum over n for all azimuths,
//! and one over m for each. Plane wave and far field after Mishchenko, Travis & Lacis 2002, eqs. 5.10
//! and 5.25, with `E = exp(ikr)/(kr) F E₀`, `S = -iF`.

use super::kernel::rotation::{sign, wigner};
use super::kernel::waves::{Angular, gamma};
use super::matrix::TMatrix;
use crate::cancel;
use crate::math::gauss_legendre;
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Coefficients of one order m and both polarisations of the light (along x, along y), by n.
#[derive(Clone, Debug)]
struct OrderWaves {
    magnetic: Vec<[Complex64; 2]>,
    electric: Vec<[Complex64; 2]>,
}

impl OrderWaves {
    fn zero(top: usize) -> Self {
        let zero = vec![[Complex64::ZERO; 2]; top + 1];
        Self { magnetic: zero.clone(), electric: zero }
    }
}

/// What leaves a body in light of one direction.
#[derive(Clone, Debug)]
pub struct Scattered {
    top: usize,
    size_parameter: f64,
    /// k times the height of the waves' origin above the body's centre.
    shift: f64,
    /// cos and sin of the angle between axis (upwards) and light.
    axis: (f64, f64),
    /// Orders 0, 1, -1, 2, -2, … about the light.
    orders: Vec<(i64, OrderWaves)>,
    powers: Powers,
}

/// What unpolarised light loses and what leaves, in units of `πx²`: products of coefficients about the
/// body's axis (Mishchenko, Travis & Lacis 2002, eqs. 5.18).
#[derive(Clone, Copy, Debug, Default)]
struct Powers {
    taken: f64,
    scattered: f64,
}

/// Efficiencies referring to the sphere of equal volume, for unpolarised light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedEfficiencies {
    /// What the light loses, by the coefficients of T.
    pub q_ext: f64,
    /// The same by the optical theorem, from the amplitudes straight ahead.
    pub q_ahead: f64,
    /// What leaves.
    pub q_sca: f64,
    /// Radar back-scattering efficiency `4 S11(180°)/x²`.
    pub q_back: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
}

/// Components `[along θ̂, along φ̂][light along x, along y]` of one order's `F` at an angle.
pub(super) type Ring = [[Complex64; 2]; 2];

/// An azimuth about the light, with the turns of all orders.
#[derive(Clone, Debug)]
pub struct Azimuth {
    sin: f64,
    cos: f64,
    turns: Vec<Complex64>,
}

/// `i^k`.
fn power_of_i(k: i64) -> Complex64 {
    match k.rem_euclid(4) {
        0 => Complex64::ONE,
        1 => Complex64::I,
        2 => -Complex64::ONE,
        _ => -Complex64::I,
    }
}

impl Scattered {
    /// Light that travels downwards at `elevation` (radians): the sun's elevation.
    pub fn new(t: &TMatrix, elevation: f64) -> Self {
        let (sin, cos) = elevation.sin_cos();
        let axis = (-sin, if cos.abs() < 1e-15 { 0.0 } else { cos });
        let (about_axis, powers): (Vec<(i64, OrderWaves)>, Vec<Powers>) = (0..t.blocks.len()
            as i64)
            .into_par_iter()
            .flat_map_iter(|m| {
                let signs: &[i64] = if m == 0 { &[1] } else { &[1, -1] };
                signs.iter().map(move |s| {
                    let (waves, powers) = leaving(t, s * m, axis);
                    ((s * m, waves), powers)
                })
            })
            .unzip();
        let powers = powers.iter().fold(Powers::default(), |sum, order| Powers {
            taken: sum.taken + order.taken,
            scattered: sum.scattered + order.scattered,
        });
        let top = t.top;
        let orders = (0..=top as i64)
            .into_par_iter()
            .flat_map_iter(|m| {
                let signs: &[i64] = if m == 0 { &[1] } else { &[1, -1] };
                let about_axis = &about_axis;
                signs.iter().map(move |s| (s * m, turned(about_axis, s * m, top, axis.0)))
            })
            .collect();
        Self { top, size_parameter: t.size_parameter, shift: t.shift(), axis, orders, powers }
    }

    /// `S11`, mean over all directions.
    pub(super) fn mean_intensity(&self) -> f64 {
        self.powers.scattered / (4.0 * PI)
    }

    pub(super) fn top(&self) -> usize {
        self.top
    }

    /// Components `[along θ̂, along φ̂][light along x, along y]` of all orders at an angle.
    pub(super) fn orders_at(&self, theta: f64) -> impl Iterator<Item = (i64, Ring)> {
        self.orders.iter().map(|(m, _)| *m).zip(self.rings(theta))
    }

    /// An azimuth (radians) made ready for amplitudes at many scattering angles.
    pub fn azimuth(&self, phi: f64) -> Azimuth {
        let (sin, cos) = phi.sin_cos();
        let turns = self.orders.iter().map(|(m, _)| Complex64::cis(*m as f64 * phi)).collect();
        Azimuth { sin, cos, turns }
    }

    /// Amplitudes at one scattering angle (radians) and several azimuths.
    pub fn amplitudes(&self, theta: f64, azimuths: &[Azimuth]) -> Vec<AmplitudeMatrix> {
        let rings = self.rings(theta);
        azimuths.iter().map(|azimuth| self.at(&rings, theta, azimuth)).collect()
    }

    /// Amplitudes at pairs of scattering angle and azimuth (radians).
    pub fn directions(&self, directions: &[(f64, f64)]) -> Vec<AmplitudeMatrix> {
        directions
            .par_iter()
            .map(|&(theta, phi)| self.at(&self.rings(theta), theta, &self.azimuth(phi)))
            .collect()
    }

    /// Components `[along θ̂, along φ̂][light along x, along y]` of `F` at an angle, by order.
    fn rings(&self, theta: f64) -> Vec<Ring> {
        cancel::checkpoint();
        let (sin, cos) = theta.sin_cos();
        let mut angular = Angular::default();
        self.orders
            .iter()
            .map(|(m, waves)| {
                if *m >= 0 {
                    angular = Angular::new(m.unsigned_abs() as usize, self.top, cos, sin.abs());
                }
                let (side, first) = (m.signum() as f64, m.unsigned_abs().max(1) as usize);
                let mut ring = [[Complex64::ZERO; 2]; 2];
                for n in first..=self.top {
                    let weight = power_of_i(-(n as i64) - 1) * (gamma(n) / (4.0 * PI).sqrt());
                    let (pi, tau) = (side * angular.pi[n], angular.tau[n]);
                    let lights = waves.magnetic[n].iter().zip(&waves.electric[n]);
                    for (light, (magnetic, electric)) in lights.enumerate() {
                        let a = weight * magnetic;
                        let b = weight * Complex64::I * electric;
                        ring[0][light] += a * Complex64::I * pi + b * tau;
                        ring[1][light] += b * Complex64::I * pi - a * tau;
                    }
                }
                ring
            })
            .collect()
    }

    fn at(&self, rings: &[Ring], theta: f64, azimuth: &Azimuth) -> AmplitudeMatrix {
        let mut f = [[Complex64::ZERO; 2]; 2];
        for (ring, turn) in rings.iter().zip(&azimuth.turns) {
            for out in 0..2 {
                for light in 0..2 {
                    f[out][light] += turn * ring[out][light];
                }
            }
        }
        let (sin, cos) = (azimuth.sin, azimuth.cos);
        // S = -iF, and from the waves' origin back to the body's centre: exp(ik(i - s)·d)
        let height = self.axis.0 * (1.0 - theta.cos()) - self.axis.1 * theta.sin() * cos;
        let factor = -Complex64::I * Complex64::cis(self.shift * height);
        let parallel = |out: usize| factor * (f[out][0] * cos + f[out][1] * sin);
        let perpendicular = |out: usize| factor * (f[out][0] * sin - f[out][1] * cos);
        AmplitudeMatrix {
            s1: -perpendicular(1),
            s2: parallel(0),
            s3: perpendicular(0),
            s4: -parallel(1),
        }
    }

    /// Cross-sections by the coefficients, asymmetry by the waves that leave.
    pub fn efficiencies(&self) -> FixedEfficiencies {
        let x2 = self.size_parameter * self.size_parameter;
        let ends = self.directions(&[(0.0, 0.0), (PI, 0.0)]);
        let (forward, back) = (ends[0], ends[1]);
        let (power, momentum) = self.power_and_momentum();
        FixedEfficiencies {
            q_ext: self.powers.taken / (PI * x2),
            q_ahead: 2.0 * (forward.s1 + forward.s2).re / x2,
            q_sca: self.powers.scattered / (PI * x2),
            q_back: 4.0 * back.s11() / x2,
            asymmetry: momentum / power,
        }
    }

    /// `∫ S11 dΩ` and `∫ cos θ S11 dΩ`: exact by Gauss quadrature of polynomials.
    fn power_and_momentum(&self) -> (f64, f64) {
        let rings = gauss_legendre::nodes(self.top + 2).into_par_iter().map(|(cos, weight)| {
            let ring = self.rings(cos.acos());
            let parts = ring.iter().flatten().flatten();
            let power = 0.5 * TAU * weight * parts.map(|c| c.norm_sqr()).sum::<f64>();
            (power, power * cos)
        });
        reduced(rings, || (0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
    }
}

/// Waves of order m about the axis that leave in light along `(sin, 0, cos)`. Polarisations of the
/// light are along the light's x and y, which are `-θ̂` and `-φ̂` of its direction.
fn leaving(t: &TMatrix, m: i64, (cos, sin): (f64, f64)) -> (OrderWaves, Powers) {
    let block = &t.blocks[m.unsigned_abs() as usize];
    let (top, first, degrees) = (t.top, block.first(), block.degrees());
    let angular = Angular::new(m.unsigned_abs() as usize, top, cos, sin);
    let side = if m < 0 { -1.0 } else { 1.0 };
    let mut incident = vec![[Complex64::ZERO; 2]; 2 * degrees];
    for k in 0..degrees {
        let n = k + first;
        let scale = gamma(n) * (4.0 * PI).sqrt();
        let (pi, tau) = (side * angular.pi[n] * scale, angular.tau[n] * scale);
        let (magnetic, electric) = (power_of_i(n as i64), power_of_i(n as i64 - 1));
        incident[k] = [magnetic * Complex64::I * pi, magnetic * tau];
        // Blocks hold electric waves turned by i, see `OrderBlock`.
        let turn = Complex64::I * side;
        incident[degrees + k] = [-electric * tau * turn, electric * Complex64::I * pi * turn];
    }
    let (mut out, mut powers) = (OrderWaves::zero(top), Powers::default());
    let t = &block.t;
    for light in 0..2 {
        let mut sums = vec![Complex64::ZERO; 2 * degrees];
        for (k, wave) in incident.iter().enumerate() {
            for (sum, element) in sums.iter_mut().zip(t.col(k).iter()) {
                *sum += element * wave[light];
            }
        }
        for (wave, sum) in incident.iter().zip(&sums) {
            // half of each polarisation
            powers.taken -= 0.5 * (wave[light].conj() * sum).re;
            powers.scattered += 0.5 * sum.norm_sqr();
        }
        for k in 0..degrees {
            out.magnetic[k + first][light] = sums[k];
            out.electric[k + first][light] = sums[degrees + k] * -Complex64::I * side;
        }
    }
    (out, powers)
}

/// Waves of order m about the light from all orders about the axis.
fn turned(about_axis: &[(i64, OrderWaves)], m: i64, top: usize, cos: f64) -> OrderWaves {
    let mut out = OrderWaves::zero(top);
    let mut d = vec![0.0; top + 1];
    for (order, waves) in about_axis {
        wigner(m, *order, top, cos, &mut d);
        // The light's x and y point against θ̂ and φ̂: half a turn about the light.
        let half_turn = if m % 2 == 0 { 1.0 } else { -1.0 };
        let factor = half_turn * sign(m) * sign(*order);
        let first = m.abs().max(order.abs()).max(1) as usize;
        for (n, d) in d.iter().enumerate().skip(first) {
            let share = factor * d;
            for light in 0..2 {
                out.magnetic[n][light] += waves.magnetic[n][light] * share;
                out.electric[n][light] += waves.electric[n][light] * share;
            }
        }
    }
    out
}
