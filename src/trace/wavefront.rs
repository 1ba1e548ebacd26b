//! The emitting plane: rays that just cover the silhouette.
//!
//! Polar coordinates `(α, ψ)`: the ray starts at `sin α` of the way from a centre to the
//! silhouette's rim at azimuth ψ. Even steps in α crowd the rays towards the rim, where the exit
//! direction changes like the angle of incidence and not like the distance from the axis.

use crate::shape::Shape;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A polar grid of rays over the silhouette.
#[derive(Clone, Debug)]
pub struct Wavefront {
    /// Rings: values of α in (0, π/2).
    pub rings: Vec<f64>,
    /// Values of ψ, radians, evenly spaced over the full circle.
    pub spokes: Vec<f64>,
    /// Radius of the silhouette on each spoke.
    rim: Vec<f64>,
    area: f64,
}

impl Wavefront {
    /// `ring_count` rings at the midpoints of even steps in α, `spoke_count` spokes.
    pub fn midpoints(shape: &Shape, ring_count: usize, spoke_count: usize) -> Self {
        let silhouette = shape.silhouette();
        let ring = |i: usize| (i as f64 + 0.5) * FRAC_PI_2 / ring_count as f64;
        let spoke = |j: usize| j as f64 * TAU / spoke_count as f64;
        let spokes: Vec<f64> = (0..spoke_count).map(spoke).collect();
        let rim: Vec<f64> = spokes.iter().map(|&psi| silhouette.radius(psi)).collect();
        let area = rim.iter().map(|r| 0.5 * r * r * TAU / spoke_count as f64).sum();
        Self { rings: (0..ring_count).map(ring).collect(), spokes, rim, area }
    }

    /// Place `(u, v)` of the ray on ring `i` and spoke `j`.
    pub fn place(&self, i: usize, j: usize) -> (f64, f64) {
        let rho = self.rim[j] * self.rings[i].sin();
        let (sin, cos) = self.spokes[j].sin_cos();
        (rho * cos, rho * sin)
    }

    /// Area of the silhouette that the ray on ring `i` and spoke `j` stands for.
    pub fn share(&self, i: usize, j: usize) -> f64 {
        let half = 0.25 * std::f64::consts::PI / self.rings.len() as f64;
        let (low, high) = ((self.rings[i] - half).sin(), (self.rings[i] + half).sin());
        0.5 * self.rim[j].powi(2) * (high * high - low * low) * TAU / self.spokes.len() as f64
    }

    /// Area of the silhouette in units of the squared radius.
    pub fn area(&self) -> f64 {
        self.area
    }
}
