//! The rings of an order's rays as potentials: sums over the spherical harmonics of each degree.

use super::central_ray::central_ray;
use super::radial_line::{RadialLine, Ring};
use crate::math::parallel::*;
use crate::math::vec3::Vec3;
use crate::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Azimuths of launch points to look at how far planes are tilted.
const PROBES: usize = 16;
/// Potentials of the two kinds of ring for incident light along x, then along y, for one degree and
/// `m` from `-l`.
pub(super) type Potentials = Vec<[Complex64; 4]>;

/// The potentials of one order, for `l` from 1; `whole` lines of rays begin at the centre.
pub(super) fn potentials(
    tracer: &Tracer,
    order: u32,
    x: f64,
    whole: bool,
) -> Option<Vec<Potentials>> {
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
    use crate::math::spherical_harmonics::legendre;
    use std::f64::consts::PI;

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
}
