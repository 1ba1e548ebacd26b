//! Tables made up for tests: smooth, normalised, different in every slab.

use gonio::phase_table::{
    Averaging, Axes, Bodies, EnergyBudget, ForwardPeak, MethodPart, PhaseTable, Quantity, Slab,
    TableHeader,
};
use ndarray::{Array2, Array3};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

pub fn header(wavelengths: usize, theta: usize, phi: usize, quantity: Quantity) -> TableHeader {
    let line = |count: usize, most: f64| -> Vec<f64> {
        (0..count).map(|i| most * i as f64 / (count.max(2) - 1) as f64).collect()
    };
    TableHeader {
        axes: Axes {
            wavelength: (0..wavelengths).map(|i| (400.0 + 10.0 * i as f64) * 1e-9).collect(),
            theta: line(theta, PI),
            phi: line(phi, TAU),
        },
        quantity,
        forward_peak: ForwardPeak::CellAverage,
        rotational_symmetry: phi == 1,
        method: "rays".into(),
        shape: "raindrop".into(),
        radius: 5e-4,
        sun_elevation: 20f64.to_radians(),
        bodies: Some(Bodies::sphere(5e-4).with_density(Some(998.0), "made up")),
        averaging: Averaging { bandwidth: 2e-9, ..Averaging::default() },
        tolerance: 0.01,
        scene_toml: "[particle]\nshape = \"raindrop\"\n".into(),
        command_line: "gonio table".into(),
    }
}

/// A Henyey–Greenstein lobe with a ripple in azimuth, normalised over the samples; polarised as
/// Rayleigh scattering is.
pub fn slab(header: &TableHeader, index: usize) -> Slab {
    let axes = &header.axes;
    let (theta, phi) = (&axes.theta, &axes.phi);
    let g = 0.3 + 0.01 * index as f64;
    let plain = |i: usize, j: usize| {
        let cosine = theta[i].cos();
        let lobe = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5);
        lobe * (1.0 + 0.2 * theta[i].sin().powi(2) * phi[j].cos())
    };
    let weights = axes.solid_angle();
    let sum: f64 = weights.indexed_iter().map(|((i, j), w)| w * plain(i, j)).sum();
    let values = Array3::from_shape_fn(
        (header.quantity.elements(), theta.len(), phi.len()),
        |(element, i, j)| {
            let (c, s11) = (theta[i].cos(), plain(i, j) / sum);
            let norm = 1.0 + c * c;
            let factor = match element {
                0 | 5 => 1.0,
                1 | 4 => (c * c - 1.0) / norm,
                10 | 15 => 2.0 * c / norm,
                _ => 0.0,
            };
            (s11 * factor) as f32
        },
    );
    Slab {
        wavelength: axes.wavelength[index],
        index: Complex64::new(1.33 + 1e-3 * index as f64, 1e-9),
        outside_index: 1.0 + 0.1 * index as f64,
        values,
        caustic_order: Some(Array2::from_shape_fn((theta.len(), phi.len()), |(i, j)| {
            u8::from(i == theta.len() / 2 && j == index) * 3
        })),
        scattering_cross_section: 1.5e-6 + 1e-9 * index as f64,
        extinction_cross_section: 1.6e-6,
        absorption_cross_section: 1e-7 - 1e-9 * index as f64,
        forward_extinction: Some(1.6e-6 + 1e-11),
        asymmetry: g,
        energy: Some(EnergyBudget {
            left_by_order: {
                let more = 1e-4 * index as f64;
                vec![0.06, 0.88 - more, 0.05, 0.009 + more]
            },
            absorbed: 1e-4,
            totally_reflected: 2e-4,
            truncated: 7e-4,
            residual: 1e-12,
        }),
        sum_before_peak: 0.97,
        peak_share: 0.5,
        error_estimate: 0.01,
        error_by_band: 0.05,
        tolerance_met: Some(index.is_multiple_of(2)),
        error_by_direction: [0.05; gonio::phase_table::ERROR_BANDS],
        left_out: 0.0,
        methods: methods(index),
    }
}

/// Two ranges of wavelengths.
fn methods(index: usize) -> Vec<MethodPart> {
    let method = if index < 2 { "rays of scattering planes" } else { "sum on a complex wavefront" };
    let part = MethodPart {
        order: Some(2),
        method: method.into(),
        reason: "because".into(),
        expected_error: Some(0.01),
        share_of_light: Some(0.05),
        ..MethodPart::default()
    };
    vec![part]
}

pub fn table(header: TableHeader) -> PhaseTable {
    let slabs = (0..header.axes.wavelength.len()).map(|index| slab(&header, index)).collect();
    PhaseTable { header, slabs }
}

/// An exact table of a sphere (radius and wavelengths in metres), normalised over its samples.
pub fn mie_table(
    radius: f64,
    wavelengths: &[f64],
    index: f64,
    theta_count: usize,
    quantity: Quantity,
) -> PhaseTable {
    use gonio::optics::AmplitudeMatrix;
    let mut header = header(wavelengths.len(), theta_count, 1, quantity);
    header.axes.wavelength = wavelengths.to_vec();
    (header.method, header.shape, header.radius) = ("mie".into(), "sphere".into(), radius);
    header.averaging = Averaging::default();
    header.bodies = Some(Bodies::sphere(radius).with_density(Some(1000.0), "made up"));
    let weights = header.axes.solid_angle();
    let slabs = wavelengths.iter().map(|&wavelength| {
        let x = TAU * radius / wavelength;
        let sphere = gonio::series::lorenz_mie::Sphere::new(x, Complex64::new(index, 0.0)).unwrap();
        let amplitudes = sphere.amplitudes_parallel(&header.axes.theta);
        let matrices: Vec<[[f64; 4]; 4]> = amplitudes
            .iter()
            .map(|&(s1, s2)| AmplitudeMatrix { s1, s2, ..Default::default() }.mueller())
            .collect();
        let sum: f64 = matrices.iter().zip(&weights).map(|(m, w)| m[0][0] * w).sum();
        let values =
            Array3::from_shape_fn((quantity.elements(), theta_count, 1), |(element, i, _)| {
                (matrices[i][element / 4][element % 4] / sum) as f32
            });
        let q = sphere.efficiencies();
        let sections = [q.q_sca, q.q_ext].map(|efficiency| efficiency * PI * radius * radius);
        let place = (wavelength, Complex64::new(index, 0.0));
        let slab = Slab::plain(place, values, sections, q.asymmetry).with_error(0.0);
        Slab { sum_before_peak: 1.0, ..slab }
    });
    let slabs = slabs.collect();
    PhaseTable { header, slabs }
}
