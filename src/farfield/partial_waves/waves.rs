//! Orders of small particles as sums over partial waves, whose coefficients come from rays.
//!
//! Where few wavelengths fit into a particle, all caustics of an order of rays, the axis, the rim and the
//! penumbra lie in one wave zone. But a ray of impact `β = (l + ½)/x` that leaves along `s` with its
//! impact along `w` has a partial wave of its own, the ring
//! `n × ∇ (n·a)^l`, `∇ (n·a)^l`, `a = s - iw`,
//! a vector spherical harmonic of degree `l` that runs round the great circle of the ray's plane and
//! falls off like a Gaussian to both sides. An order is the sum of its rings over all integer `l` and all
//! azimuths `χ` of launch points,
//! `S(n) = Σ_l ∮ dχ (x/2π) √(-det·β·Z/(∂β/∂s)) T e^{ixW} ring(n)`, `Z = m·∂w/∂χ + i m·∂s/∂χ` at constant `β`,
//! `m = s × w`, `det` the area of launch points. Stationary phase gives back each ray; nothing diverges
//! where rays merge, since the root vanishes only where neither impact nor plane changes. Of a sphere all
//! rings of an `l` together are Legendre's functions, and the sum is the Debye term with its coefficients
//! in the WKB form, with impacts beyond the rim where waves tunnel ([`crate::farfield::impact_integral::near_grazing`]).

use super::potentials::{Potentials, potentials};
use crate::cancel;
use crate::farfield::assignment::Thresholds;
use crate::farfield::wave_field::WaveField;
use crate::math::parallel::*;
use crate::math::spherical_harmonics::legendre;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Samples of the scattering angle per period of the highest partial wave.
const SAMPLES_PER_PERIOD: f64 = 5.0;
/// Samples to each side that count in the interpolation over the scattering angle.
const REACH: usize = 8;
/// Coefficients smaller than this share of the largest are left out.
const SMALLEST: f64 = 1e-7;

/// Fields along θ and φ for incident light along x, then along y.
type Fields = [Complex64; 4];

/// The sum over partial waves of some orders.
pub struct PartialWaves {
    /// For each sample `(j + ½) π/count` of the scattering angle, fields of `e^{imφ}` for `m` about 0.
    samples: Vec<Vec<Fields>>,
    /// Largest `m` of all.
    most: usize,
}

impl PartialWaves {
    /// Of some orders; those whose rays cannot be followed are returned beside.
    pub fn new(tracer: &Tracer, orders: &[u32], x: f64, by: &Thresholds) -> (Self, Vec<u32>) {
        let mut sums: Vec<Potentials> = Vec::new();
        let mut missed = Vec::new();
        for &order in orders {
            match potentials(tracer, order, x, !by.is_high(order)) {
                Some(found) => add(&mut sums, found),
                None => missed.push(order),
            }
        }
        (Self::sampled(&sums), missed)
    }

    /// The fields at samples of the scattering angle.
    fn sampled(sums: &[Potentials]) -> Self {
        let last = sums.len();
        let size = |p: &[Complex64; 4]| p.iter().map(|v| v.norm_sqr()).sum::<f64>();
        let largest = sums.iter().flatten().map(size).fold(0.0, f64::max);
        let counts = |p: &[Complex64; 4]| size(p) > SMALLEST * SMALLEST * largest;
        let most = (0..last)
            .rev()
            .find(|&m| {
                (m.max(1)..=last)
                    .any(|l| counts(&sums[l - 1][l + m]) || counts(&sums[l - 1][l - m]))
            })
            .unwrap_or(0);
        let count = ((0.5 * SAMPLES_PER_PERIOD * last as f64).ceil() as usize).max(2 * REACH);
        let sample = |j: usize| {
            cancel::checkpoint();
            let theta = PI * (j as f64 + 0.5) / count as f64;
            // near the axis those of large m are next to nothing
            let degree = last as f64;
            let reach = degree * theta.sin() + 6.0 * degree.cbrt() + 6.0;
            let most = most.min(reach as usize);
            let mut fields = vec![Fields::default(); 2 * most + 1];
            for m in 0..=most {
                let (low, high) = fields_of(sums, m, theta);
                fields[most - m] = low;
                fields[most + m] = high;
            }
            fields
        };
        Self { samples: (0..count).into_par_iter().map(sample).collect(), most }
    }
}

impl WaveField for PartialWaves {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let count = self.samples.len();
        let waves: Vec<Complex64> = (0..=2 * self.most)
            .map(|m| Complex64::cis((m as f64 - self.most as f64) * phi))
            .collect();
        // the fields at φ, and those at φ + π, of the other sense: the same half-plane beyond the axis
        let both: Vec<[Fields; 2]> = self
            .samples
            .iter()
            .map(|fields| {
                let mut parity = [Fields::default(); 2];
                let most = fields.len() / 2;
                for (m, (field, wave)) in fields.iter().zip(&waves[self.most - most..]).enumerate()
                {
                    for k in 0..4 {
                        parity[(m + most) % 2][k] += field[k] * wave;
                    }
                }
                let [even, odd] = parity;
                let mix = |sign: f64, k: usize| even[k] * sign + odd[k];
                [std::array::from_fn(|k| mix(1.0, k)), std::array::from_fn(|k| mix(-1.0, k))]
            })
            .collect();
        let at = |j: i64| {
            let j = j.rem_euclid(2 * count as i64) as usize;
            if j < count { both[j][0] } else { both[2 * count - 1 - j][1] }
        };
        let (sin, cos) = phi.sin_cos();
        for (&theta, sum) in theta.iter().zip(sums) {
            let place = theta / PI * count as f64 - 0.5;
            let first = place.floor() as i64 - REACH as i64 + 1;
            let mut f = Fields::default();
            for j in first..first + 2 * REACH as i64 {
                let weight = kernel(place - j as f64);
                let fields = at(j);
                for k in 0..4 {
                    f[k] += fields[k] * weight;
                }
            }
            let [tx, fx, ty, fy] = f;
            *sum += AmplitudeMatrix {
                s2: tx * cos + ty * sin,
                s3: tx * sin - ty * cos,
                s4: -fx * cos - fy * sin,
                s1: fy * cos - fx * sin,
            };
        }
    }
}

/// A sinc under a Gaussian.
fn kernel(t: f64) -> f64 {
    const VARIANCE: f64 = 2.0 * REACH as f64 / PI;
    let sinc = if t.abs() < 1e-9 { 1.0 } else { (PI * t).sin() / (PI * t) };
    sinc * (-0.5 * t * t / VARIANCE).exp()
}

/// The fields of `e^{-imφ}` and of `e^{imφ}` at a scattering angle.
fn fields_of(sums: &[Potentials], m: usize, theta: f64) -> (Fields, Fields) {
    let mut found = [[[Complex64::default(); 4]; 2]; 2];
    legendre(m, sums.len(), theta, |l, value, slope| {
        let Some(potentials) = l.checked_sub(1).map(|k| &sums[k]) else { return };
        for (sum, number) in found.iter_mut().zip([l - m, l + m]) {
            let potential = &potentials[number];
            for k in 0..4 {
                sum[0][k] += potential[k] * value;
                sum[1][k] += potential[k] * slope;
            }
        }
    });
    let rate = m as f64 / theta.sin();
    // ∇ has ∂/∂θ along θ and im/sin θ along φ; n × turns θ to φ and φ to -θ
    let fields = |[values, slopes]: [[Complex64; 4]; 2], rate: f64| {
        let across = Complex64::new(0.0, rate);
        let [px, qx, py, qy] = values;
        let [dpx, dqx, dpy, dqy] = slopes;
        [dqx - across * px, across * qx + dpx, dqy - across * py, across * qy + dpy]
    };
    let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
    let low = fields(found[0], -rate).map(|f| f * sign);
    let high = if m == 0 { low } else { fields(found[1], rate) };
    (low, high)
}

fn add(sums: &mut Vec<Potentials>, found: Vec<Potentials>) {
    for (k, potentials) in found.into_iter().enumerate() {
        if k == sums.len() {
            sums.push(potentials);
            continue;
        }
        for (sum, p) in sums[k].iter_mut().zip(potentials) {
            for c in 0..4 {
                sum[c] += p[c];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Sines and cosines as fast as the highest partial wave come back between their samples.
    #[test]
    fn the_kernel_interpolates_what_is_sampled_finely_enough() {
        let rate = TAU / SAMPLES_PER_PERIOD;
        for place in [0.0, 0.3, 0.5, 0.99] {
            let range = 1 - REACH as i64..=REACH as i64;
            let sum: f64 =
                range.map(|j| kernel(place - j as f64) * (rate * j as f64 + 0.4).cos()).sum();
            assert!((sum - (rate * place + 0.4).cos()).abs() < 1e-4, "{place}: {sum}");
        }
        assert_eq!(kernel(0.0), 1.0);
        assert!(kernel(3.0).abs() < 1e-16);
    }

    /// Potentials of different degrees add up.
    #[test]
    fn potentials_of_several_orders_add_up() {
        let of = |last: usize, value: f64| -> Vec<Potentials> {
            (1..=last).map(|l| vec![[Complex64::from(value); 4]; 2 * l + 1]).collect()
        };
        let mut sums = of(2, 1.0);
        add(&mut sums, of(3, 0.5));
        assert_eq!((sums.len(), sums[1][4][2].re, sums[2][6][0].re), (3, 1.5, 0.5));
    }
}
