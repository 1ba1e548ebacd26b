//! Tests of `rays`.

use super::*;
use crate::facets::Body;
use crate::facets::beams::{Incidence, Settings};
use crate::facets::mean::{Azimuths, Request};
use crate::facets::orientation::Stand;
use crate::phase_table::{ForwardPeak, Quantity};
use num_complex::Complex64;
use std::f64::consts::PI;

struct Asked<'a> {
    body: &'a Body,
    stand: Stand,
    index: Complex64,
    theta: Vec<f64>,
    phi: Vec<f64>,
    count: u32,
    sun: f64,
    quantity: Quantity,
}

impl Asked<'_> {
    fn slab(&self) -> (Slab, Axes) {
        let axes =
            Axes { wavelength: vec![5e-7], theta: self.theta.clone(), phi: self.phi.clone() };
        let places: Vec<(usize, bool)> = (0..self.phi.len()).map(|j| (j, false)).collect();
        let light = Incidence { index: self.index, size_parameter: 1000.0 };
        let request = Request {
            body: self.body,
            stand: self.stand,
            sun_elevation: self.sun,
            light,
            settings: Settings { last_order: 20, least_power: 1e-5 },
            theta: &axes.theta,
            cells: &[],
            azimuths: Azimuths::Mean(1),
            whole: self.quantity == Quantity::Mueller,
            count: self.count,
            replicas: 4,
        };
        let job = TableJob {
            request,
            wavelength: 5e-7,
            radius: 1e-4,
            axes: &axes,
            places: &places,
            quantity: self.quantity,
            forward_peak: ForwardPeak::CellAverage,
            tolerance: 0.01,
            method_error: 0.0,
        };
        (job.ray_slab(), axes)
    }
}

fn degrees(from: f64, to: f64, count: usize) -> Vec<f64> {
    let step = (to - from) / (count - 1) as f64;
    (0..count).map(|i| (from + step * i as f64).to_radians()).collect()
}

/// Random columns of ice: powers add up to 1, the halo stands at 21.84° and 45.73° with nothing before
/// the first but what facets reflect and parallel ones let through, and no ray is lost.
#[test]
fn columns_at_random_make_the_haloes() {
    let body = Body::hexagonal_column(1.0).unwrap();
    let (slab, axes) = Asked {
        body: &body,
        stand: Stand::Random,
        index: 1.31.into(),
        theta: degrees(0.0, 180.0, 361),
        phi: vec![0.0],
        count: 4096,
        sun: 0.0,
        quantity: Quantity::PhaseFunction,
    }
    .slab();
    assert!((slab.sum(&axes) - 1.0).abs() < 1e-5, "{}", slab.sum(&axes));
    let at = |degrees: f64| slab.values[(0, (2.0 * degrees).round() as usize, 0)];
    assert!(at(22.0) > 20.0 * at(21.0), "{} {}", at(21.0), at(22.0));
    assert!(at(46.5) > 1.5 * at(45.0), "{} {}", at(45.0), at(46.5));
    let budget = slab.energy.as_ref().unwrap();
    assert!(budget.residual.abs() < 1e-10);
    assert!(slab.left_out < 0.01, "{}", slab.left_out);
}

/// Horizontal plates under the sun at 20° send sundogs to where Snell's law for rays askew to the prism puts
/// them: the least turn about the vertical of the index n' = √(n² − sin²e)/cos e (Bravais).
#[test]
fn sundogs_are_where_bravais_says() {
    let body = Body::hexagonal_column(0.3).unwrap();
    let (n, sun) = (1.31f64, 20f64.to_radians());
    let effective = (n * n - sun.sin().powi(2)).sqrt() / sun.cos();
    let turn = 2.0 * (0.5 * effective).asin() - PI / 3.0;
    // from the turn in azimuth, at the height of the sun, to the angle from it
    let angle = 2.0 * (sun.cos() * (0.5 * turn).sin()).asin();
    let (slab, axes) = Asked {
        body: &body,
        stand: Stand::Upright { deviation: 0.0 },
        index: n.into(),
        theta: degrees(0.0, 180.0, 721),
        phi: degrees(0.0, 360.0, 361),
        count: 2048,
        sun,
        quantity: Quantity::PhaseFunction,
    }
    .slab();
    assert!((slab.sum(&axes) - 1.0).abs() < 1e-5);
    let (mut brightest, mut most) = (0.0, 0.0);
    for (i, &theta) in axes.theta.iter().enumerate() {
        if !(10f64.to_radians()..40f64.to_radians()).contains(&theta) {
            continue;
        }
        let row: f32 = (0..360).map(|j| slab.values[(0, i, j)]).fold(0.0, f32::max);
        if row > most {
            (brightest, most) = (theta, row);
        }
    }
    assert!(
        (brightest - angle).abs() < 0.3f64.to_radians(),
        "{} {}",
        brightest.to_degrees(),
        angle.to_degrees()
    );
}

/// A cube that stands still, seen face on: what goes through goes straight on, what comes back comes straight
/// back, by Fresnel and the sum of all echoes.
#[test]
fn a_cube_face_on_is_a_window() {
    let body = Body::cuboid(1.0).unwrap();
    let stand = Stand::Fixed { zenith: 0.0, azimuth: 0.0, spin: 0.0 };
    let (slab, axes) = Asked {
        body: &body,
        stand,
        index: 1.31.into(),
        theta: degrees(0.0, 180.0, 181),
        phi: degrees(0.0, 360.0, 13),
        count: 1,
        sun: PI / 2.0,
        quantity: Quantity::Mueller,
    }
    .slab();
    let weights = axes.solid_angle();
    let row = |i: usize, e: usize| -> f64 {
        (0..13).map(|j| f64::from(slab.values[(e, i, j)]) * weights[[i, j]]).sum()
    };
    let r = (0.31f64 / 2.31).powi(2);
    let back = 2.0 * r / (1.0 + r);
    assert!((row(180, 0) - back).abs() < 1e-4, "{} {back}", row(180, 0));
    assert!((row(0, 0) - (1.0 - back)).abs() < 1e-4);
    assert!((1..180).all(|i| row(i, 0) == 0.0));
    // circular polarisation goes through as it is, and comes back with its sense reversed
    assert!((row(0, 15) - row(0, 0)).abs() < 1e-4 && (row(180, 15) + row(180, 0)).abs() < 1e-4);
}

/// Mueller elements keep Σ M_ij² ≤ 4 M₁₁² in every cell, and the stated scatter is that of other seeds.
#[test]
fn elements_are_physical_and_the_scatter_is_honest() {
    let body = Body::hexagonal_column(2.0).unwrap();
    let asked = |count| Asked {
        body: &body,
        stand: Stand::Random,
        index: Complex64::new(1.31, 1e-6),
        theta: degrees(0.0, 180.0, 91),
        phi: vec![0.0],
        count,
        sun: 0.0,
        quantity: Quantity::Mueller,
    };
    let ((few, _), (many, _)) = (asked(64).slab(), asked(2048).slab());
    for i in 0..91 {
        let m = |e: usize| f64::from(few.values[(e, i, 0)]);
        let squares: f64 = (0..16).map(|e| m(e).powi(2)).sum();
        assert!(squares <= 4.0 * m(0).powi(2) * 1.0001 + 1e-12, "{i}");
    }
    let (mut off, mut stated, mut rows) = (0.0, 0.0, 0);
    for i in 6..86 {
        let (a, b) = (few.values[(0, i, 0)], many.values[(0, i, 0)]);
        off += f64::from((a / b - 1.0).powi(2));
        stated += few.error_by_direction[i.div_ceil(2)].powi(2);
        rows += 1;
    }
    let ratio = ((stated / f64::from(rows)) / (off / f64::from(rows))).sqrt();
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
}
