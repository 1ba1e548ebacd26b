//! Tests of `table`.

use super::*;
use crate::facets::Body;
use crate::facets::beams::{Incidence, Settings};
use std::f64::consts::PI;

fn slab(stand: Stand, quantity: Quantity, count: u32, x: f64, theta: usize) -> Slab {
    let body = Body::hexagonal_column(1.0).unwrap();
    let theta: Vec<f64> = (0..=theta).map(|i| PI * i as f64 / theta as f64).collect();
    let phi: Vec<f64> = match stand {
        Stand::Random => vec![0.0],
        _ => (0..24).map(|j| PI * f64::from(j) / 12.0).collect(),
    };
    let axes = Axes { wavelength: vec![5e-7], theta: theta.clone(), phi: phi.clone() };
    let places: Vec<(usize, bool)> = (0..phi.len()).map(|j| (j, false)).collect();
    let light = Incidence { index: num_complex::Complex64::new(1.31, 1e-4), size_parameter: x };
    let request = Request {
        body: &body,
        stand,
        sun_elevation: 0.3,
        light,
        settings: Settings { last_order: 12, least_power: 1e-4 },
        theta: &theta,
        cells: &[],
        azimuths: azimuths(stand, &phi),
        whole: quantity == Quantity::Mueller,
        count,
        replicas: 4,
    };
    TableJob {
        request,
        wavelength: 5e-7,
        radius: 1e-6,
        axes: &axes,
        places: &places,
        quantity,
        forward_peak: ForwardPeak::CellAverage,
        tolerance: 0.01,
        method_error: 0.05,
    }
    .slab()
}

/// Random orientation: power by directions is that of the optical theorem, energy closes, elements are no
/// larger than the first, and the peak closes the sum.
#[test]
fn a_random_table_is_sound() {
    let slab = slab(Stand::Random, Quantity::Mueller, 8, 60.0, 90);
    let budget = slab.energy.as_ref().unwrap();
    assert!(budget.residual.abs() < 1e-10);
    assert!((slab.sum_before_peak - 1.0).abs() < 0.03, "{}", slab.sum_before_peak);
    assert!(slab.error_estimate < 0.2 && slab.error_estimate >= 0.05);
    assert!((slab.asymmetry - 0.8).abs() < 0.1, "{}", slab.asymmetry);
    for i in 0..=90 {
        for e in 1..16 {
            assert!(slab.values[(e, i, 0)].abs() <= slab.values[(0, i, 0)] * 1.00001);
        }
    }
    // straight behind nothing is polarised, and next to nothing in the cell straight ahead
    let polarised = |i: usize| slab.values[(1, i, 0)].abs() / slab.values[(0, i, 0)];
    assert!(polarised(90) < 1e-6 && polarised(0) < 1e-3, "{} {}", polarised(90), polarised(0));
}

/// The stated scatter of replicas is that of tables of other seeds: half as many orientations scatter more,
/// and two means differ by what they state.
#[test]
fn the_stated_scatter_is_honest() {
    let few = slab(Stand::Random, Quantity::PhaseFunction, 8, 50.0, 90);
    let many = slab(Stand::Random, Quantity::PhaseFunction, 48, 50.0, 90);
    let (mut off, mut stated, mut bands) = (0.0, 0.0, 0);
    for i in 6..84 {
        let (a, b) = (few.values[(0, i, 0)], many.values[(0, i, 0)]);
        off += f64::from((a / b - 1.0).powi(2));
        let band = i.div_ceil(2);
        stated += few.error_by_direction[band].powi(2) - 0.05f64.powi(2);
        bands += 1;
    }
    let (off, stated) = ((off / f64::from(bands)).sqrt(), (stated / f64::from(bands)).sqrt());
    assert!(off < 2.0 * stated && off > 0.5 * stated, "{off} {stated}");
}

/// Mirror images about the vertical plane come out by themselves.
#[test]
fn falling_plates_are_their_mirror_images() {
    let upright = Stand::Upright { deviation: 0.02 };
    let slab = slab(upright, Quantity::PhaseFunction, 64, 30.0, 18);
    let (mut off, mut all) = (0.0, 0.0);
    for i in 2..17 {
        for j in 1..12 {
            let (a, b) = (slab.values[(0, i, j)], slab.values[(0, i, 24 - j)]);
            off += f64::from((a - b).powi(2));
            all += f64::from((a + b).powi(2)) / 4.0;
        }
    }
    assert!((off / all).sqrt() < 0.1, "{}", (off / all).sqrt());
}

/// Where no light is seen the error is that of the method.
#[test]
fn darkness_has_the_error_of_the_method() {
    let mut bands = Band::none();
    assert_eq!(Errors::new(bands, 0.1).means(), (0.1, 0.1));
    Band::at(&mut bands, 0.5).add(0.0, 0.0, 3.0);
    assert_eq!(Errors::new(bands, 0.1).means(), (0.1, 0.1));
    Band::at(&mut bands, 0.6).add(2.0, 0.0, 3.0);
    assert!((Errors::new(bands, 0.1).means().0 - 0.1).abs() < 1e-15);
}
