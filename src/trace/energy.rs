//! Energy by fate: what became of the light on the silhouette. It must add up.

use super::{Tracer, Wavefront};
use rayon::prelude::*;

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
            for j in 0..wavefront.spokes.len() {
                add_ray(tracer, wavefront, i, j, &mut sum);
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

fn add_ray(tracer: &Tracer, wavefront: &Wavefront, i: usize, j: usize, sum: &mut Fates) {
    let (u, v) = wavefront.place(i, j);
    let weight = wavefront.share(i, j) / wavefront.area();
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
