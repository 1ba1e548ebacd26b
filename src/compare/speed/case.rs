//! What is computed in a bench, and the truth of it.

use crate::farfield::Direction;
use crate::farfield::reference::huygens_fresnel::HuygensFresnel;
use crate::fault::{Blame, Fault};
use crate::plan::{Engine, Plan, orders_that_matter};
use crate::series::SeriesError;
use crate::series::lorenz_mie::Sphere;
use crate::shape::{RaindropModel, Shape, ShapeError};
use crate::simulate;
use crate::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Why a case has no truth.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum SpeedError {
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

impl Blame for SpeedError {
    fn fault(&self) -> Fault {
        match self {
            SpeedError::Series(error) => error.fault(),
            SpeedError::Shape(error) => error.fault(),
        }
    }
}

/// Red light in water.
const WAVELENGTH: f64 = 650e-9;
const INDEX: f64 = 1.3314;

/// One particle, directions in one plane, and the intensities that are right there.
pub struct SpeedCase {
    /// Short name, for lists.
    pub name: &'static str,
    /// Above its chart.
    pub title: String,
    /// The particle.
    pub shape: Shape,
    /// `2πa/λ` of the sphere of equal volume.
    pub size_parameter: f64,
    /// Radius for the width of the Gaussian filter, metres.
    pub radius: f64,
    /// Index of the particle.
    pub index: Complex64,
    /// Of the plane of all directions, radians.
    pub azimuth: f64,
    /// Scattering angles, radians, ascending.
    pub theta: Vec<f64>,
    /// Orders of the paper's mode.
    pub orders: Vec<u32>,
    /// This engine takes all orders that matter and forward diffraction, or just `orders`.
    pub all_orders: bool,
    truth: Vec<f64>,
}

impl SpeedCase {
    /// Two spheres and a raindrop, with their truths.
    ///
    /// # Errors
    /// Never for these particles; the series and the shapes may refuse others.
    pub fn all() -> Result<Vec<SpeedCase>, SpeedError> {
        Ok(vec![sphere("sphere_1000", 1000.0)?, sphere("sphere_5000", 5000.0)?, raindrop()?])
    }

    /// Relative L2 error of unpolarised intensities.
    pub fn error(&self, found: &[f64]) -> f64 {
        let square = |v: f64| v * v;
        let error: f64 = found.iter().zip(&self.truth).map(|(f, t)| square(f - t)).sum();
        (error / self.truth.iter().map(|t| square(*t)).sum::<f64>()).sqrt()
    }

    /// Intensities by this engine.
    pub fn engine(&self, tolerance: f64) -> Vec<f64> {
        let orders = if self.all_orders {
            orders_that_matter(self.index.re, tolerance, &self.shape)
        } else {
            self.orders.clone()
        };
        let shape = self.shape.clone();
        let plan =
            Plan::direct(shape, 1.0, Engine::Meridians, orders, self.all_orders, tolerance, None);
        let directions: Vec<(f64, f64)> =
            self.theta.iter().map(|&theta| (theta, self.azimuth)).collect();
        simulate::scatter(&plan, self.index, self.size_parameter, &directions)
            .iter()
            .map(|s| s.s11())
            .collect()
    }
}

fn angles(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from) / step).round() as usize;
    (0..=count).map(|i| (from + i as f64 * step).to_radians()).collect()
}

/// A sphere against Lorenz–Mie, away from the forward peak and the glory.
fn sphere(name: &'static str, size_parameter: f64) -> Result<SpeedCase, SpeedError> {
    let theta = angles(10.0, 165.0, 0.02);
    let index = Complex64::new(INDEX, 0.0);
    let truth = Sphere::new(size_parameter, index)?
        .amplitudes_parallel(&theta)
        .iter()
        .map(|(s1, s2)| 0.5 * (s1.norm_sqr() + s2.norm_sqr()))
        .collect();
    Ok(SpeedCase {
        name,
        title: format!("sphere, x = {size_parameter}, 10–165°, against Lorenz–Mie"),
        shape: Shape::sphere(),
        size_parameter,
        radius: size_parameter * WAVELENGTH / TAU,
        index,
        azimuth: 0.4,
        theta,
        orders: vec![0, 1, 2, 3],
        all_orders: true,
        truth,
    })
}

/// The primary bow of a raindrop against the brute-force sum, off the plane of symmetry.
fn raindrop() -> Result<SpeedCase, SpeedError> {
    let radius = 0.5e-3;
    let size_parameter = TAU * radius / WAVELENGTH;
    let index = Complex64::new(INDEX, 0.0);
    let azimuth = 40f64.to_radians();
    let theta = angles(135.0, 148.0, 0.05);
    let shape = Shape::raindrop(radius, RaindropModel::BeardChuang1987, 20f64.to_radians())?;
    let tracer =
        Tracer::new(&shape, index, size_parameter, 2).with_curved_interface(size_parameter);
    let directions: Vec<Direction> = theta.iter().map(|&t| Direction::new(t, azimuth)).collect();
    let truth = HuygensFresnel::new(size_parameter, 2)
        .amplitudes(&tracer, &directions)
        .iter()
        .map(|wave| wave.amplitude.s11())
        .collect();
    Ok(SpeedCase {
        name: "raindrop_bow",
        title:
            "raindrop 0.5 mm, sun 20°, azimuth 40°, p = 2, 135–148°, against the brute-force sum"
                .into(),
        shape,
        size_parameter,
        radius,
        index,
        azimuth,
        theta,
        orders: vec![2],
        all_orders: false,
        truth,
    })
}
