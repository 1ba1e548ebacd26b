//! What each order of one drop scatters, in units of its squared radius.

use super::tilt::Tilt;
use crate::farfield::assignment::{Assignment, Method};
use crate::farfield::{FarField, FarFieldSettings, Guides};
use crate::phase_table::Axes;
use crate::plan::{Plan, PlanError, Symmetry, shape};
use crate::population::Radius;
use crate::scene::Scene;
use crate::simulate::cross_sections::CrossSections;
use crate::simulate::energy::energy;
use crate::simulate::error::SimulateError;
use crate::tabulate::slab::{Tabulator, Values};
use ndarray::Array3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// A drop of a size and tilt, at one wavelength.
pub(super) struct Drop {
    plan: Plan,
    /// By which its pattern is turned about the light.
    turn: f64,
    index: Complex64,
    wavelength: f64,
}

impl Drop {
    /// # Errors
    /// A radius outside the model of the shape.
    pub fn new(
        scene: &Scene,
        plan: &Plan,
        at: &Radius,
        (wavelength, index): (f64, Complex64),
    ) -> Result<Self, SimulateError> {
        let tilt = match scene.canting {
            0.0 => Tilt::upright(scene.sun_elevation),
            deviation => Tilt::of_place(at.place, deviation, scene.sun_elevation),
        };
        let particle = scene.particle_with_radius(at.radius);
        let (shape, radius) = shape(&particle, tilt.elevation).map_err(PlanError::from)?;
        let symmetry = match shape.rotational_symmetry() {
            true => Symmetry::Rotational,
            false => Symmetry::Mirror,
        };
        let plan = Plan { shape, radius, symmetry, checked: false, ..plan.clone() };
        let turn = if symmetry == Symmetry::Rotational { 0.0 } else { tilt.turn };
        Ok(Self { plan, turn, index, wavelength })
    }

    fn size_parameter(&self) -> f64 {
        TAU * self.plan.radius / self.wavelength
    }

    /// `dC/dΩ` over the squared radius of each of some orders (order 0 with forward diffraction), at scattering angles
    /// and azimuths of a half-turn: one azimuth for all where the drop looks the same from all. By guides to the
    /// orders' planes where there are any. The rays of all orders are traced together, where every order has a wave of
    /// its own.
    pub fn orders(
        &self,
        scene: &Scene,
        orders: &[u32],
        azimuths: &[f64],
        guides: Option<&Guides>,
    ) -> Vec<Array3<f32>> {
        let plan = Plan { orders: orders.to_vec(), ..self.plan.clone() };
        let assignment = self.assignment(&plan, orders);
        let of_drop = |orders: &[u32]| -> Vec<Array3<f32>> {
            let plan = Plan { orders: orders.to_vec(), ..self.plan.clone() };
            let far_field = self.far_field(&plan, orders.contains(&0), guides);
            orders.iter().map(|&order| self.tabulated(scene, &far_field, order, azimuths)).collect()
        };
        if assignment.orders_of(Method::PartialWaves).is_empty() {
            return of_drop(orders);
        }
        orders.iter().flat_map(|&order| of_drop(&[order])).collect()
    }

    /// One order of a far field.
    fn tabulated(
        &self,
        scene: &Scene,
        far_field: &FarField,
        order: u32,
        azimuths: &[f64],
    ) -> Array3<f32> {
        let rotational = self.plan.symmetry == Symmetry::Rotational;
        let seen: Vec<f64> = match rotational {
            true => azimuths[..1].to_vec(),
            false => azimuths.iter().map(|phi| phi - self.turn).collect(),
        };
        // what a turned drop shows at an azimuth, it shows upright at another, or its mirror image there
        let (azimuths, places) = self.plan.computed_azimuths(&seen);
        let tabulator = Tabulator {
            theta: &scene.theta,
            size_parameter: self.size_parameter(),
            quantity: scene.quantity,
            forward_peak: scene.forward_peak,
            interference: true,
            filter: None,
            diffraction: (order == 0).then(|| far_field.forward_wave()),
            // values are then in units of the squared radius
            scattering: 1.0,
            shadow_area: far_field.silhouette().area(),
            left_out: 0.0,
            // once, in the mean
            closes: false,
            peak_edge: self.plan.thresholds.peak_edge,
            order: Some(order),
        };
        let theta = scene.theta.clone();
        let axes = Axes { wavelength: vec![self.wavelength], theta, phi: seen };
        let Values { values, .. } = tabulator.tabulate(far_field, &azimuths, &places, &axes);
        values
    }

    /// Guides to the planes of some orders at all indices (real parts) between two, if any has planes.
    pub fn guides(&self, orders: &[u32], range: [f64; 2]) -> Option<Guides> {
        if self.plan.symmetry == Symmetry::Rotational {
            return None;
        }
        let orders = self.assignment(&self.plan, orders).orders_of(Method::Planes);
        let guides = || {
            let Plan { shape, tolerance, thresholds, .. } = &self.plan;
            Guides::new(shape, &orders, *tolerance, range, thresholds)
        };
        (!orders.is_empty()).then(guides)
    }

    fn assignment(&self, plan: &Plan, orders: &[u32]) -> Assignment {
        let x = self.size_parameter();
        let tracer = plan.tracer(self.index, x);
        Assignment::new(&tracer, orders, x, plan.tolerance, &plan.thresholds)
    }

    fn far_field<'a>(
        &self,
        plan: &'a Plan,
        diffraction: bool,
        guides: Option<&Guides>,
    ) -> FarField<'a> {
        let x = self.size_parameter();
        let tracer = plan.tracer(self.index, x);
        let assignment = self.assignment(plan, &plan.orders);
        let settings = FarFieldSettings {
            size_parameter: x,
            orders: &plan.orders,
            tolerance: plan.tolerance,
            diffraction,
        };
        FarField::guided(&tracer, &settings, assignment, guides)
    }

    /// Cross-sections over the squared radius: extinction by the wave straight ahead of order 0 and diffraction
    /// (what other orders add there is a ripple that sizes average out), absorption by all rays.
    ///
    /// # Errors
    /// A budget of energy that does not add up.
    pub fn sections(&self) -> Result<CrossSections, SimulateError> {
        let budget = energy(&self.plan, self.wavelength, self.index, self.size_parameter())?;
        let plan = Plan { orders: vec![0], forward_diffraction: true, ..self.plan.clone() };
        let far_field = self.far_field(&plan, true, None);
        Ok(CrossSections::new(&plan, &far_field, self.index, budget.absorbed))
    }
}
