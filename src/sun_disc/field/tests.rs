//! Tests of `field`.

use super::*;
use crate::sun_disc::{DiscPoints, smooth_over_sun};

/// A field that depends on the angle alone comes out as a curve along chords does.
#[test]
fn without_azimuth_a_curve() {
    let curve = |t: f64| 2.0 + (150.0 * t).sin();
    let theta: Vec<f64> = [2.0, 60.0, 138.0, 177.0, 180.0].map(f64::to_radians).to_vec();
    let limb = LimbDarkening::at(550e-9);
    for half_turn in [None, Some(36)] {
        let disc = DiscField::new(&theta, Some(limb), false, half_turn);
        let fine = disc.fine_angles();
        let azimuths = half_turn.map_or(1, |steps| steps + 1);
        let field = Array3::from_shape_fn((1, fine.len(), azimuths), |(_, i, _)| curve(fine[i]));
        let all: Vec<f64> = (0..=36000).map(|i| (0.005 * f64::from(i)).to_radians()).collect();
        let values: Vec<f64> = all.iter().map(|&t| curve(t)).collect();
        let known = smooth_over_sun(&all, &values, 550e-9, SUN_ANGULAR_RADIUS, &theta);
        for (i, known) in known.iter().enumerate() {
            let found = disc.means(&field)[(0, i, 0)];
            assert!((found - known).abs() < 3e-3, "{half_turn:?} {i}: {found} {known}");
        }
    }
}

/// Against points of the disc, at the axis too, for a field that is smooth on the sphere and elements that the
/// mirror turns over.
#[test]
fn with_azimuth_as_points_say() {
    // harmonics of the direction: even and odd in azimuth
    let field = |e: usize, t: f64, p: f64| {
        let (x, y) = (t.sin() * p.cos(), t.sin() * p.sin());
        if mirror_sign(e) > 0.0 {
            2.0 + 20.0 * x + 300.0 * (x * x - y * y)
        } else {
            20.0 * y + 300.0 * x * y
        }
    };
    let theta: Vec<f64> = [0.0, 0.1, 0.4, 3.0, 90.0, 179.7, 180.0].map(f64::to_radians).to_vec();
    let disc = DiscField::new(&theta, None, false, Some(36));
    let fine = disc.fine_angles();
    let phi = |j: usize| PI * j as f64 / 36.0;
    let values = Array3::from_shape_fn((16, fine.len(), 37), |(e, i, j)| field(e, fine[i], phi(j)));
    let means = disc.means(&values);
    let points = DiscPoints::new(SUN_ANGULAR_RADIUS, 60, 240);
    for (i, &t) in theta.iter().enumerate() {
        for (e, j) in [(0, 0), (0, 5), (2, 5), (2, 30)] {
            let (mut sum, mut number) = (0.0, 0.0);
            for ring in 0..60 {
                for (t, p) in points.around(ring, t, phi(j)) {
                    sum += field(e, t, p);
                    number += 1.0;
                }
            }
            let (found, known) = (means[(e, i, j)], sum / number);
            assert!((found - known).abs() < 4e-3, "{t} {e} {j}: {found} {known}");
        }
    }
}

/// Cells about the light hold the power that falls into them.
#[test]
fn cells_hold_the_power_of_the_peak() {
    let width = 0.1f64.to_radians();
    let peak = |t: f64| (-(t / width).powi(2)).exp();
    for count in [181, 721] {
        let theta: Vec<f64> = (0..count).map(|i| PI * i as f64 / f64::from(count - 1)).collect();
        let disc = DiscField::new(&theta, None, true, None);
        let fine = disc.fine_angles();
        let field = Array3::from_shape_fn((1, fine.len(), 1), |(_, i, _)| peak(fine[i]));
        let means = disc.means(&field);
        let cell = |i: usize| {
            let half = 0.5 * theta[1];
            (theta[i] - half).max(0.0).cos() - (theta[i] + half).min(PI).cos()
        };
        let sum: f64 = (0..count as usize).map(|i| cell(i) * means[(0, i, 0)]).sum();
        let known = 0.5 * width * width;
        assert!((sum / known - 1.0).abs() < 0.02, "{count}: {sum} {known}");
    }
}
