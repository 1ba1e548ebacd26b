//! Small things that figures of all kinds need: colours, angles, circles.

use crate::render::plots::sheet::{Curve, Foot, Panel, Sheet};
use std::f64::consts::TAU;

/// Colours that stay apart for colour-blind readers (Okabe & Ito 2008).
pub const BLUE: [u8; 3] = [0, 114, 178];
pub const RED: [u8; 3] = [213, 94, 0];
pub const GREEN: [u8; 3] = [0, 158, 115];
pub const PURPLE: [u8; 3] = [204, 121, 167];
pub const ORANGE: [u8; 3] = [230, 159, 0];
pub const SKY: [u8; 3] = [86, 180, 233];
pub const BLACK: [u8; 3] = [0, 0, 0];
pub const GREY: [u8; 3] = [150, 150, 150];
/// Water.
pub const WATER: [u8; 3] = [227, 241, 251];
/// In this order.
pub const PALETTE: [[u8; 3]; 7] = [BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK];

/// `count` values (2 or more) from an end to the other.
pub fn evenly(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count - 1) as f64).collect()
}

/// The same with even factors.
pub fn by_factors(from: f64, to: f64, count: usize) -> Vec<f64> {
    evenly(from.ln(), to.ln(), count).into_iter().map(f64::exp).collect()
}

/// A circle about the origin, filled.
pub fn disc(radius: f64, fill: [u8; 3]) -> Curve {
    let points = (0..=180).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) / 180.0).sin_cos();
        (radius * cos, radius * sin)
    });
    Curve::new("", BLUE, points).thin().filled(fill)
}

/// Points of two columns.
pub fn points(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y.iter().copied()).collect()
}

/// A sheet with notes and no table.
pub fn sheet(
    title: &str,
    columns: usize,
    panel: (u32, u32),
    panels: Vec<Panel>,
    notes: &[&str],
) -> Sheet {
    let notes = notes.iter().map(|note| (*note).to_owned()).collect();
    let foot = Foot { rows: Vec::new(), notes };
    Sheet { title: title.into(), columns, panel, panels, foot }
}

/// The place of the largest value between two abscissae.
pub fn maximum(x: &[f64], y: &[f64], from: f64, to: f64) -> f64 {
    let inside = (0..x.len()).filter(|&i| (from..=to).contains(&x[i]));
    inside.max_by(|&a, &b| y[a].total_cmp(&y[b])).map_or(f64::NAN, |i| x[i])
}
