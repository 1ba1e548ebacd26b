//! Tables for tests: spheres by Lorenz–Mie, made with nothing but the series.

use gonio::medium::Medium;
use gonio::phase_table::{Axes, PhaseTable, Quantity, Slab, TableHeader};
use gonio::series::lorenz_mie::Sphere;
use ndarray::Array3;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

pub fn range(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count - 1) as f64).collect()
}

pub fn degrees(from: f64, to: f64, count: usize) -> Vec<f64> {
    range(from.to_radians(), to.to_radians(), count)
}

pub fn visible(count: usize) -> Vec<f64> {
    range(380e-9, 720e-9, count)
}

/// A water sphere of `radius` (m); elements as `quantity` says, one azimuth.
pub fn sphere(
    radius: f64,
    wavelength: Vec<f64>,
    theta: Vec<f64>,
    quantity: Quantity,
) -> PhaseTable {
    let water = Medium::Water { temperature: 293.15 };
    let slabs = wavelength
        .iter()
        .map(|&w| {
            let index = water.index(w).unwrap();
            let k = TAU / w;
            let solved = Sphere::new(k * radius, index).unwrap();
            let q = solved.efficiencies();
            let area = PI * radius * radius;
            let scale = 1.0 / (k * k * q.q_sca * area);
            let amplitudes = solved.amplitudes_parallel(&theta);
            let values =
                Array3::from_shape_fn((quantity.elements(), theta.len(), 1), |(e, t, _)| {
                    (scale * element(amplitudes[t], e)) as f32
                });
            slab((w, index), values, [q.q_sca * area, q.q_ext * area], q.asymmetry)
        })
        .collect();
    let axes = Axes { wavelength, theta, phi: vec![0.0] };
    PhaseTable { header: TableHeader::of_sphere(radius, axes, quantity), slabs }
}

/// Mueller element of a sphere (Bohren & Huffman 1983, eq. 4.77), row by row.
fn element((s1, s2): (Complex64, Complex64), index: usize) -> f64 {
    let (i1, i2, cross) = (s1.norm_sqr(), s2.norm_sqr(), s2 * s1.conj());
    match index {
        0 | 5 => 0.5 * (i2 + i1),
        1 | 4 => 0.5 * (i2 - i1),
        10 | 15 => cross.re,
        11 => cross.im,
        14 => -cross.im,
        _ => 0.0,
    }
}

/// A slab without error, normalised.
fn slab(
    place: (f64, Complex64),
    values: Array3<f32>,
    [scattering, extinction]: [f64; 2],
    asymmetry: f64,
) -> Slab {
    let slab = Slab::plain(place, values, [scattering, extinction], asymmetry).with_error(0.0);
    Slab { sum_before_peak: 1.0, ..slab }
}

/// The table of a sphere spread over `phi`, its curve shifted by `shift` (radians) · cos φ: a
/// stand-in for a flattened drop, whose bow lies at different angles up and sideways.
pub fn lopsided(of: &PhaseTable, phi: Vec<f64>, shift: f64) -> PhaseTable {
    let theta = of.header.axes.theta.clone();
    let (first, last) = (theta[0], theta[theta.len() - 1]);
    let steps = (theta.len() - 1) as f64;
    let mut table = of.clone();
    table.header.axes.phi = phi.clone();
    table.header.rotational_symmetry = false;
    table.header.shape = "raindrop".into();
    for slab in &mut table.slabs {
        let column = slab.values.clone();
        slab.values =
            Array3::from_shape_fn((column.dim().0, theta.len(), phi.len()), |(e, t, p)| {
                let moved = theta[t] + shift * phi[p].cos() * theta[t].sin();
                let place = ((moved - first) / (last - first) * steps).clamp(0.0, steps);
                column[[e, place.round() as usize, 0]]
            });
    }
    table
}
