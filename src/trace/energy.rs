//! Energy by fate: what became of the light on the silhouette. It must add up.

use super::{Tracer, Wavefront};
use crate::math::parallel::*;

/// Powers as fractions of what fell on the silhouette, for unpolarised light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fates {
    /// Left after `p` chords, by order.
    pub left_by_order: Vec<f64>,
    /// Power absorbed along the chords.
    pub absorbed: f64,
    /// Still inside after the last order because it was totally reflected.
    pub totally_reflected: f64,
    /// Still inside after the last order otherwise.
    pub truncated: f64,
    /// What is missing to 1.
    pub residual: f64,
    /// Power that left, weighted with the cosine of its scattering angle.
    pub forward_momentum: f64,
}

/// Trace every ray of a wavefront and add up where its power went.
pub fn energy_by_fate(tracer: &Tracer, wavefront: &Wavefront) -> Fates {
    let orders = tracer.last_order() as usize + 1;
    let rings: Vec<Fates> = (0..wavefront.rings.len())
        .into_par_iter()
        .map(|i| {
            let mut sum = Fates { left_by_order: vec![0.0; orders], ..Fates::default() };
            for (j, images) in wavefront.half_turn() {
                add_ray(tracer, wavefront, (i, j), images, &mut sum);
            }
            sum
        })
        .collect();
    let mut total = Fates { left_by_order: vec![0.0; orders], ..Fates::default() };
    for ring in &rings {
        for (t, r) in total.left_by_order.iter_mut().zip(&ring.left_by_order) {
            *t += r;
        }
        total.forward_momentum += ring.forward_momentum;
        total.absorbed += ring.absorbed;
        total.totally_reflected += ring.totally_reflected;
        total.truncated += ring.truncated;
    }
    let accounted = total.left_by_order.iter().sum::<f64>()
        + total.absorbed
        + total.totally_reflected
        + total.truncated;
    total.residual = 1.0 - accounted;
    total
}

fn add_ray(
    tracer: &Tracer,
    wavefront: &Wavefront,
    (i, j): (usize, usize),
    images: f64,
    sum: &mut Fates,
) {
    let (u, v) = wavefront.place(i, j);
    let weight = images * wavefront.share(i, j) / wavefront.area();
    let left = &mut sum.left_by_order;
    let momentum = &mut sum.forward_momentum;
    let remainder = tracer.trace_to_the_end(u, v, |exit| {
        let power = exit.power();
        left[exit.order as usize] += weight * power;
        *momentum += weight * power * exit.direction.z;
    });
    if let Some(rest) = remainder {
        sum.absorbed += weight * rest.absorbed;
        sum.totally_reflected += weight * rest.totally_reflected;
        sum.truncated += weight * rest.truncated;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use num_complex::Complex64;

    /// Fresnel's reflectance of unpolarised light, written out.
    fn reflectance(incidence: f64, index: f64) -> f64 {
        let inside = (incidence.sin() / index).asin();
        let (sum, difference) = (incidence + inside, incidence - inside);
        let across = (difference.sin() / sum.sin()).powi(2);
        let along = (difference.tan() / sum.tan()).powi(2);
        0.5 * (across + along)
    }

    /// `∫ f(θ) sin 2θ dθ` over the rays of a sphere.
    fn mean(f: impl Fn(f64) -> f64) -> f64 {
        const STEPS: usize = 20_000;
        let h = std::f64::consts::FRAC_PI_2 / STEPS as f64;
        (0..STEPS).map(|k| (k as f64 + 0.5) * h).map(|t| f(t) * (2.0 * t).sin() * h).sum()
    }

    #[test]
    fn shares_of_a_clear_sphere_are_fresnel_s() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 1.333.into(), 100.0, 4);
        let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 400, 4));
        let reflected = mean(|t| reflectance(t, 1.333));
        assert!((fates.left_by_order[0] - reflected).abs() < 1e-5, "{fates:?} {reflected}");
        assert!(fates.residual.abs() < 1e-12 && fates.absorbed == 0.0);
        // both polarisations apart: of order 1 it is not (1 - R)²
        assert!(fates.left_by_order[1] > mean(|t| (1.0 - reflectance(t, 1.333)).powi(2)));
        assert!(fates.truncated < 0.02 && fates.totally_reflected == 0.0);
    }

    /// Nothing is left when rays are followed to their end, and next to nothing leaves a black sphere.
    #[test]
    fn what_enters_a_black_sphere_is_absorbed() {
        let shape = Shape::sphere();
        let (index, x) = (Complex64::new(1.333, 0.01), 2000.0);
        let tracer = Tracer::new(&shape, index, x, 1);
        let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 300, 4));
        // coefficients of an absorbing interface add up to 1 but for a small part of k
        assert!((fates.absorbed + fates.left_by_order[0] - 1.0).abs() < 1e-4, "{fates:?}");
        assert!(fates.truncated < 1e-5 && fates.residual.abs() < 1e-4);
        // what is reflected has the mean cosine ∫ R cos(π - 2θ)
        let momentum = mean(|t| -reflectance(t, 1.333) * (2.0 * t).cos());
        assert!((fates.forward_momentum - momentum).abs() < 2e-3, "{fates:?} {momentum}");
    }
}
