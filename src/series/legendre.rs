//! The phase function of a sphere as a sum of Legendre polynomials,
//! `4π P(θ) = Σ (2l + 1) χ_l P_l(cos θ)`, χ_0 = 1 and χ_1 the asymmetry.
//!
//! With N partial waves the phase function is a polynomial of degree 2N in cos θ, so that Gauss–Legendre
//! quadrature of enough nodes gives every χ_l to rounding. The factor 2l + 1 is **not** included, as in
//! DISORT.

use super::lorenz_mie::Sphere;
use crate::cancel;
use crate::math::gauss_legendre;
use crate::math::parallel::*;

/// Nodes that are summed together.
const TOGETHER: usize = 64;

impl Sphere {
    /// Number of coefficients that the phase function has: all beyond are 0.
    pub fn legendre_count(&self) -> usize {
        2 * self.a().len() + 1
    }

    /// χ_l for l = 0, 1, … `count` − 1.
    ///
    /// ```
    /// use gonio::series::lorenz_mie::Sphere;
    ///
    /// let sphere = Sphere::new(5.0, num_complex::Complex64::new(1.33, 0.01))?;
    /// let chi = sphere.legendre(sphere.legendre_count());
    /// assert!((chi[0] - 1.0).abs() < 1e-14 && (chi[1] - sphere.efficiencies().asymmetry).abs() < 1e-13);
    /// # Ok::<(), gonio::series::SeriesError>(())
    /// ```
    pub fn legendre(&self, count: usize) -> Vec<f64> {
        let known = count.min(self.legendre_count());
        // exact for polynomials of degree 2N + l, l < known
        let nodes = self.a().len() + known / 2 + 1;
        let node = |i| {
            cancel::checkpoint();
            gauss_legendre::node(nodes, i)
        };
        let nodes: Vec<(f64, f64)> = (0..nodes).into_par_iter().map(node).collect();
        let theta: Vec<f64> = nodes.iter().map(|(cosine, _)| cosine.acos()).collect();
        let amplitudes = self.amplitudes_parallel(&theta);
        let scale = 1.0 / (self.size_parameter().powi(2) * self.efficiencies().q_sca);
        let power: Vec<(f64, f64)> = (nodes.iter().zip(&amplitudes))
            .map(|((cosine, weight), (s1, s2))| {
                (*cosine, weight * scale * (s1.norm_sqr() + s2.norm_sqr()))
            })
            .collect();
        let parts = power.par_chunks(TOGETHER).map(|part| {
            cancel::checkpoint();
            projections(part, known)
        });
        let add = |mut sum: Vec<f64>, part: Vec<f64>| {
            sum.iter_mut().zip(part).for_each(|(sum, value)| *sum += value);
            sum
        };
        // In a fixed order, so that the number of threads does not show.
        let parts: Vec<Vec<f64>> = parts.collect();
        let mut sum = parts.into_iter().fold(vec![0.0; known], add);
        sum.resize(count, 0.0);
        sum
    }
}

/// Sums of power times P_l over some nodes, by the upward recurrence of P_l.
fn projections(nodes: &[(f64, f64)], count: usize) -> Vec<f64> {
    let mut before = vec![0.0; nodes.len()];
    let mut now = vec![1.0; nodes.len()];
    (0..count)
        .map(|l| {
            let degree = l as f64;
            let mut sum = 0.0;
            for ((before, now), (cosine, power)) in before.iter_mut().zip(&mut now).zip(nodes) {
                sum += power * *now;
                let next =
                    ((2.0 * degree + 1.0) * cosine * *now - degree * *before) / (degree + 1.0);
                (*before, *now) = (*now, next);
            }
            sum
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    /// The sum is the phase function again, at any angle; few coefficients are the first of many.
    #[test]
    fn the_sum_is_the_phase_function() {
        for (x, m) in [(0.01, 1.5), (3.0, 1.33), (60.0, 1.33)] {
            let sphere = Sphere::new(x, Complex64::new(m, 1e-3)).unwrap();
            let chi = sphere.legendre(sphere.legendre_count());
            let few = sphere.legendre(4);
            assert!(few.iter().zip(&chi).all(|(a, b)| (a - b).abs() < 1e-13), "{few:?}");
            assert!((chi[0] - 1.0).abs() < 1e-12, "{}", chi[0]);
            for theta in [0.0f64, 0.7, 2.0, 3.0] {
                let (s1, s2) = sphere.amplitudes(&[theta])[0];
                let scale = x * x * sphere.efficiencies().q_sca;
                let exact = 2.0 * (s1.norm_sqr() + s2.norm_sqr()) / scale;
                let (mut before, mut now, mut sum) = (0.0, 1.0, 0.0);
                for (l, chi) in chi.iter().enumerate() {
                    let l = l as f64;
                    sum += (2.0 * l + 1.0) * chi * now;
                    (before, now) =
                        (now, ((2.0 * l + 1.0) * theta.cos() * now - l * before) / (l + 1.0));
                }
                let largest = chi.iter().enumerate().map(|(l, c)| (2 * l + 1) as f64 * c.abs());
                assert!((sum - exact).abs() < 1e-12 * largest.sum::<f64>(), "{x} {theta}");
            }
        }
        let sphere = Sphere::new(1.0, 1.5.into()).unwrap();
        assert_eq!(
            sphere.legendre(100)[sphere.legendre_count()..],
            vec![0.0; 100 - sphere.legendre_count()]
        );
    }
}
