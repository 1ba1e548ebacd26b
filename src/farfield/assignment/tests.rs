//! Tests of `assignment`.

use super::*;
use crate::shape::Shape;
use num_complex::Complex64;

const ORDERS: [u32; 4] = [0, 1, 2, 5];

fn spheroid(ratio: f64, size_parameter: f64, tolerance: f64, by: &Thresholds) -> Assignment {
    let shape = Shape::spheroid(ratio, 0.0).unwrap();
    let tracer = Tracer::new(&shape, Complex64::new(1.333, 0.0), size_parameter, 5);
    Assignment::new(&tracer, &ORDERS, size_parameter, tolerance, by)
}

fn lost(orders: &[u32]) -> Vec<PlanesOutcome> {
    orders.iter().map(|&order| PlanesOutcome { order, found: None }).collect()
}

/// Whatever happens, each order has one method.
#[test]
fn no_order_is_lost() {
    for x in [100.0, 599.0, 600.0, 5000.0] {
        let first = spheroid(0.9, x, 0.01, &Thresholds::MEASURED);
        let second = first.clone().after(Outcome::RadialLines(&[2]));
        let third = second.clone().after(Outcome::Planes(&lost(&[0, 2, 5])));
        for found in [first, second, third] {
            let orders: Vec<u32> = found.entries().iter().map(|entry| entry.order).collect();
            assert_eq!(orders, ORDERS, "x = {x}");
        }
    }
}

#[test]
fn outcomes_hand_on_what_was_lost() {
    let by = &Thresholds::MEASURED;
    let found = spheroid(0.9, 200.0, 0.01, by).after(Outcome::RadialLines(&[1]));
    assert_eq!(found.orders_of(Method::Planes), [0, 1]);
    let found = found.after(Outcome::Planes(&lost(&[0, 1])));
    assert_eq!(found.orders_of(Method::Patches), [0, 1]);
    assert_eq!([0, 1, 2].map(|order| found.error_of(order)), [0.07, 0.3, 2.0 / 200.0]);
    // reflection and, for so few wavelengths, every order stay with patches
    let large = spheroid(0.95, 2000.0, 0.01, by).after(Outcome::Planes(&lost(&[0, 2])));
    assert_eq!(large.orders_of(Method::Patches), [0]);
    assert_eq!(large.orders_of(Method::ComplexWavefront), [2, 5]);
    assert!(large.entries()[2].reasons.contains(&Reason::Unmatched));
    assert!(matches!(large.entries()[3].reasons[..], [Reason::Disordered(..)]));
}

fn shares(radius_mm: f64, elevation: f64) -> Vec<f64> {
    let model = crate::shape::RaindropModel::BeardChuang1987;
    let shape = Shape::raindrop(1e-3 * radius_mm, model, elevation.to_radians()).unwrap();
    let tracer = Tracer::new(&shape, Complex64::new(1.33, 0.0), 5000.0, 5);
    let orders = [0, 1, 2, 3, 4, 5];
    let found = Assignment::new(&tracer, &orders, 5000.0, 0.01, &Thresholds::MEASURED);
    found.entries().iter().map(|entry| entry.share_of_sum).collect()
}

/// The sum takes over little by little, with order and deformation.
#[test]
fn shares_of_the_sum_rise_with_order_and_deformation() {
    assert_eq!(shares(0.45, 20.0), [0.0; 6]);
    assert_eq!(shares(2.5, 20.0), [0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    // seen along its axis a drop is round, however flat
    assert_eq!(shares(2.0, 90.0), [0.0; 6]);
    for order in 1..6 {
        let all: Vec<f64> = (40..260).map(|r| shares(0.01 * f64::from(r), 20.0)[order]).collect();
        assert!(all.windows(2).all(|w| w[1] >= w[0]), "{order}: {all:?}");
        assert!(all.iter().any(|share| (0.02..0.98).contains(share)), "{order}: {all:?}");
    }
}

/// Another threshold, another method and another reason.
#[test]
fn thresholds_decide() {
    let by = Thresholds { partial_waves_below: 150.0, ..Thresholds::MEASURED };
    assert!(spheroid(0.9, 200.0, 0.01, &by).orders_of(Method::PartialWaves).is_empty());
    let both = [&Thresholds::MEASURED, &by].map(|by| spheroid(0.9, 200.0, 0.01, by).parts(&[]));
    assert_ne!(both[0][1].reason, both[1][1].reason);
    assert_eq!(both[0][0], both[1][0], "reflection is no matter of size");
}
