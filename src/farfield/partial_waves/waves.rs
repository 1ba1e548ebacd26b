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

use super::radial_line::{RadialLine, Ring, central_ray};
use crate::farfield::assignment::Thresholds;
use crate::farfield::wave_field::WaveField;
use crate::math::spherical_harmonics::legendre;
use crate::math::vec3::Vec3;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Azimuths of launch points to look at how far planes are tilted.
const PROBES: usize = 16;
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

/// Potentials of the two kinds of ring for incident light along x, then along y, for one degree and
/// `m` from `-l`.
type Potentials = Vec<[Complex64; 4]>;

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

/// The potentials of one order, for `l` from 1; `whole` lines of rays begin at the centre.
fn potentials(tracer: &Tracer, order: u32, x: f64, whole: bool) -> Option<Vec<Potentials>> {
    let silhouette = tracer.shape().silhouette();
    let centre = central_ray(tracer, &silhouette, order, whole)?;
    let line = |k: usize, count: usize| {
        let azimuth = TAU * (k as f64 + 0.5) / count as f64;
        RadialLine::new(tracer, &silhouette, order, centre, azimuth, x, whole)
    };
    let probes = (0..PROBES).map(|k| line(k, PROBES)).collect::<Option<Vec<_>>>()?;
    let twist = probes.iter().map(RadialLine::largest_twist).fold(0.0, f64::max);
    let count = 2 * (x * twist + 5.0 * x.sqrt() + 8.0).ceil() as usize;
    let lines: Option<Vec<(usize, Vec<Ring>)>> = (0..count)
        .into_par_iter()
        .map(|k| Some(line(k, count)?.rings(tracer.index(), x)))
        .collect();
    let lines = lines?;
    let last = lines.iter().map(|(first, rings)| first + rings.len() - 1).max()?;
    let weight = TAU / count as f64;
    let degree = |l: usize| {
        let rings = lines.iter().filter_map(|(first, rings)| rings.get(l.checked_sub(*first)?));
        projected(l, rings, weight)
    };
    Some((1..=last).into_par_iter().map(degree).collect())
}

/// The rings of one degree as sums over `m`.
fn projected<'r>(l: usize, rings: impl Iterator<Item = &'r Ring>, weight: f64) -> Potentials {
    const FADED: f64 = 1e-10;
    let mut sums = vec![[Complex64::default(); 4]; 2 * l + 1];
    let factor = Complex64::i() * weight / l as f64;
    let degree = l as f64;
    for ring in rings {
        let [[px, qx], [py, qy]] = ring.fields;
        let size = [px, qx, py, qy].map(|f| f * factor);
        let [p, q] = spinor(ring.null);
        let peak = (0.5 * degree * (p.norm_sqr() - q.norm_sqr())).round().clamp(-degree, degree);
        let (ln_p, ln_q) = (p.ln(), q.ln());
        let start =
            ((degree + peak) * ln_p + (degree - peak) * ln_q + ln_share(degree, peak)).exp();
        let mut visit = |m: f64, value: Complex64| {
            let sum = &mut sums[(m + degree) as usize];
            for c in 0..4 {
                sum[c] += size[c] * value;
            }
        };
        visit(peak, start);
        let (up, down) = (p / q, q / p);
        let floor = FADED * start.norm();
        let (mut m, mut value) = (peak, start);
        while m < degree && value.norm() > floor {
            value *= up * ((degree - m) / (degree + m + 1.0)).sqrt();
            m += 1.0;
            visit(m, value);
        }
        (m, value) = (peak, start);
        while m > -degree && value.norm() > floor {
            value *= down * ((degree + m) / (degree - m + 1.0)).sqrt();
            m -= 1.0;
            visit(m, value);
        }
    }
    sums
}

/// `ln [l!/√((l+m)! (l-m)!)]`.
fn ln_share(l: f64, m: f64) -> f64 {
    libm::lgamma(l + 1.0) - 0.5 * (libm::lgamma(l + m + 1.0) + libm::lgamma(l - m + 1.0))
}

/// `(p, q)` with `a_x - ia_y = p²`, `a_x + ia_y = -q²`, `a_z = pq` for a null vector `a`: then
/// `(n·a)^l = Σ_m p^{l+m} q^{l-m} l!/√((l+m)!(l-m)!) P_l^m(cos θ) e^{imφ}` in Schmidt's normalisation, with
/// `P_l^{-m} = (-1)^m P_l^m`.
fn spinor(a: Vec3<Complex64>) -> [Complex64; 2] {
    const LEAST: f64 = 1e-8;
    let i = Complex64::i();
    let (minus, plus) = (a.x - i * a.y, a.x + i * a.y);
    let [p, q] = if minus.norm() > plus.norm() {
        let p = minus.sqrt();
        [p, a.z / p]
    } else {
        let q = (-plus).sqrt();
        [a.z / q, q]
    };
    // a plane square to the axis has one of them zero
    let off_zero = |v: Complex64| if v.norm() < LEAST { Complex64::from(LEAST) } else { v };
    [off_zero(p), off_zero(q)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A null vector `s - iw` of a plane.
    fn null(theta: f64, phi: f64, turn: f64) -> Vec3<Complex64> {
        let (d, e, f) = {
            let direction = crate::farfield::direction::Direction::new(theta, phi);
            (direction.unit, direction.theta_hat, direction.phi_hat)
        };
        let w = e * turn.cos() + f * turn.sin();
        let part = |s: f64, w: f64| Complex64::new(s, -w);
        Vec3 { x: part(d.x, w.x), y: part(d.y, w.y), z: part(d.z, w.z) }
    }

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

    #[test]
    fn spinors_square_to_their_null_vector() {
        for a in
            [null(1.0, 0.3, 0.0), null(1.0, 0.3, 2.0), null(2.5, -1.0, 1.3), null(0.4, 2.0, -1.0)]
        {
            let [p, q] = spinor(a);
            let i = Complex64::i();
            assert!((p * p - (a.x - i * a.y)).norm() < 1e-14);
            assert!((q * q + (a.x + i * a.y)).norm() < 1e-14);
            assert!((p * q - a.z).norm() < 1e-14);
        }
        // a plane square to the axis: one of them vanishes, but for what keeps quotients finite
        let [p, q] = spinor(null(0.5 * PI, 0.2, 0.5 * PI));
        assert!(p.norm().min(q.norm()) <= 1e-8 && p.norm().max(q.norm()) > 1.0);
    }

    #[test]
    fn shares_are_factorials() {
        // 3!/√(5! 1!), 3!/√(3! 3!)
        assert!((ln_share(3.0, 2.0).exp() - 6.0 / 120f64.sqrt()).abs() < 1e-13);
        assert!((ln_share(3.0, 0.0).exp() - 1.0).abs() < 1e-13);
        assert!((ln_share(40.0, -7.0) - ln_share(40.0, 7.0)).abs() < 1e-12);
    }

    /// A ring `(n·a)^l` projected on spherical harmonics is itself again, in every direction.
    #[test]
    fn projected_rings_are_powers_of_their_null_vector() {
        for (l, a) in
            [(5, null(1.0, 0.3, 2.0)), (24, null(2.2, -0.8, 0.4)), (12, null(0.3, 0.0, 1.0))]
        {
            let field = Complex64::new(0.3, -0.7);
            let none = Complex64::default();
            let ring = Ring { null: a, fields: [[field, none], [none, none]] };
            let sums = projected(l, std::iter::once(&ring), 0.5);
            assert_eq!(sums.len(), 2 * l + 1);
            for (theta, phi) in [(0.7, 1.1), (1.9, -2.0), (1.1, 0.2f64)] {
                let n = crate::farfield::direction::Direction::new(theta, phi).unit;
                let dot = a.x * n.x + a.y * n.y + a.z * n.z;
                let expected = dot.powu(l as u32) * field * Complex64::i() * 0.5 / l as f64;
                let mut found = Complex64::default();
                for m in 0..=l {
                    legendre(m, l, theta, |degree, value, _| {
                        if degree < l {
                            return;
                        }
                        let wave = Complex64::cis(m as f64 * phi) * value;
                        found += sums[l + m][0] * wave;
                        let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
                        if m > 0 {
                            found += sums[l - m][0] * wave.conj() * sign * Complex64::from(1.0);
                        }
                    });
                }
                assert!(
                    (found - expected).norm() < 1e-9 * (1.0 + expected.norm()),
                    "{l}: {found} {expected}"
                );
            }
        }
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
