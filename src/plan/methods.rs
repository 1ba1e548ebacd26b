//! Who computes what in a scene, in words: per range of wavelengths and order the method, why, how far it
//! may be off, its share of the light and of the time, and what is skipped.

use super::{Engine, Plan};
use crate::farfield::assignment::Assignment;
use crate::medium::radial::Inside;
use crate::medium::{Light, MediumError};
use crate::phase_table::{MethodPart, MethodRange};
use crate::scene::Scene;
use crate::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use std::f64::consts::TAU;
use std::fmt;

/// Rays per side of the grid by which the light is shared out.
const GRID: usize = 60;

/// The methods of a range of wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRange {
    /// Wavelengths and methods.
    pub range: MethodRange,
    /// What is skipped, and why.
    pub skipped: Vec<String>,
    /// The wavelength (nanometres) at which the range was tried, and at how many azimuths, if it was.
    pub tried_at_nm: Option<(f64, usize)>,
    /// Share of the time by part, and of everything else, where it was measured.
    pub share_of_time: Option<(Vec<f64>, f64)>,
}

impl PlannedRange {
    /// What was found at a wavelength (metres) of the range and so many azimuths.
    pub fn tried(&mut self, wavelength: f64, azimuths: usize, parts: &[MethodPart]) {
        self.range.parts = parts.to_vec();
        self.tried_at_nm = Some(((1e15 * wavelength).round() / 1e6, azimuths));
    }
}

impl Plan {
    /// What traces its rays at a wavelength of this size parameter.
    pub fn tracer(&self, index: Complex64, size_parameter: f64) -> Tracer<'_> {
        let last = self.orders.iter().copied().max().unwrap_or(0);
        let tracer = Tracer::new(&self.shape, index, size_parameter, last);
        if self.engine == Engine::Meridians {
            return tracer.with_curved_interface(size_parameter);
        }
        tracer
    }

    /// Which method stands for which order at this size parameter, before any of them is tried; `None`
    /// for the exact series.
    pub fn assignment(&self, tracer: &Tracer, size_parameter: f64) -> Option<Assignment> {
        let (orders, by) = (&self.orders, &self.thresholds);
        match self.engine {
            Engine::Meridians => {
                Some(Assignment::new(tracer, orders, size_parameter, self.tolerance, by))
            }
            Engine::Patches => Some(Assignment::of_patches(tracer, orders, size_parameter, by)),
            Engine::LorenzMie | Engine::Debye | Engine::TMatrix | Engine::Facets => None,
        }
    }

    /// The parts of an exact series or of facets; none for rays.
    pub fn series_parts(&self, scene: &Scene) -> Vec<MethodPart> {
        let part = |order, method: &str| MethodPart {
            order,
            method: method.into(),
            reason: "the particle is a sphere: exact".into(),
            ..MethodPart::default()
        };
        match self.engine {
            Engine::LorenzMie => vec![part(None, name_of_series(scene))],
            Engine::Debye => {
                self.orders.iter().map(|&order| part(Some(order), "Debye series")).collect()
            }
            Engine::TMatrix => vec![MethodPart {
                reason: "a body of revolution: exact".into(),
                ..part(None, "T-matrix")
            }],
            Engine::Facets => vec![self.part_of_crystal(scene)],
            Engine::Meridians | Engine::Patches => Vec::new(),
        }
    }

    /// The methods of all wavelengths of a scene, as planned.
    ///
    /// # Errors
    /// A wavelength outside the medium's data.
    pub fn methods(&self, scene: &Scene) -> Result<Vec<PlannedRange>, MediumError> {
        let mut skipped = Vec::new();
        let mut parts = Vec::new();
        for &wavelength in &scene.wavelengths {
            let Light { wavelength, index } = self.light(scene, wavelength)?;
            let x = TAU * self.radius / wavelength;
            let tracer = self.tracer(index, x);
            let assignment = self.assignment(&tracer, x);
            parts.push(
                assignment.as_ref().map_or_else(|| self.series_parts(scene), |a| a.parts(&[])),
            );
            skipped.push(assignment.map_or_else(Vec::new, |assignment| assignment.skipped()));
        }
        let mut ranges = MethodRange::collect(scene.wavelengths.iter().copied().zip(&parts));
        for range in &mut ranges {
            if self.series_parts(scene).is_empty() {
                self.share_out_light(range, scene)?;
            }
        }
        let planned = |range: MethodRange| PlannedRange {
            skipped: skipped[range.first].clone(),
            tried_at_nm: None,
            share_of_time: None,
            range,
        };
        Ok(ranges.into_iter().map(planned).collect())
    }

    /// Light of a wavelength in vacuum as the particle meets it.
    pub(crate) fn light(&self, scene: &Scene, wavelength: f64) -> Result<Light, MediumError> {
        self.engine.light(scene, self.radius, wavelength)
    }

    /// The share of the light of each order at a range's first wavelength.
    fn share_out_light(&self, range: &mut MethodRange, scene: &Scene) -> Result<(), MediumError> {
        let wavelength = scene.wavelengths[range.first];
        let Light { wavelength, index } = scene.medium.light(wavelength)?;
        let x = TAU * self.radius / wavelength;
        let rays = Wavefront::midpoints(&self.shape, GRID, GRID);
        let light = energy_by_fate(&self.tracer(index, x), &rays).left_by_order;
        for part in &mut range.parts {
            part.share_of_light = part.order.and_then(|order| light.get(order as usize)).copied();
        }
        Ok(())
    }
}

/// The exact series of a sphere by what it is made of.
fn name_of_series(scene: &Scene) -> &'static str {
    match scene.medium.radial().map(|radial| &radial.inside) {
        None => "Lorenz–Mie series",
        Some(Inside::Homogeneous(_) | Inside::Layers(_)) => "series of layers",
        Some(Inside::Profile(_) | Inside::Gradient(_)) => "series of a radial profile",
    }
}

/// The table of a range, as `gonio plan` prints it.
impl fmt::Display for PlannedRange {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let MethodRange { from_nm, to_nm, .. } = self.range;
        let found = match self.tried_at_nm {
            Some((nm, 1)) => format!("as found at {nm} nm and one azimuth"),
            Some((nm, azimuths)) => format!("as found at {nm} nm and {azimuths} azimuths"),
            None => "as planned, not tried".into(),
        };
        writeln!(f, "{from_nm} to {to_nm} nm, {found}:")?;
        writeln!(f, "  {:>5} {:>8} {:>8} {:>6}  method: why", "order", "error", "light", "time")?;
        let percent = |share: Option<f64>| {
            share.map_or("-".into(), |share| match 100.0 * share {
                small if small < 0.095 && small > 0.0 => format!("{small:.0e} %"),
                other => format!("{other:.1} %"),
            })
        };
        let time =
            |k: usize| self.share_of_time.as_ref().and_then(|(shares, _)| shares.get(k)).copied();
        for (k, part) in self.range.parts.iter().enumerate() {
            let order = part.order.map_or("all".into(), |order| order.to_string());
            let [error, light] = [part.expected_error, part.share_of_light].map(percent);
            let MethodPart { method, reason, .. } = part;
            writeln!(
                f,
                "  {order:>5} {error:>8} {light:>8} {:>6}  {method}: {reason}",
                percent(time(k))
            )?;
            for formula in &part.formulas {
                let [low, high] = formula.theta_deg;
                writeln!(f, "{:34}{low:.1}° to {high:.1}°: {}", "", formula.formula)?;
            }
        }
        if let Some((_, rest)) = &self.share_of_time {
            let rest = percent(Some(*rest));
            writeln!(
                f,
                "  {:>5} {:>8} {:>8} {rest:>6}  tabulating, stating the error",
                "rest", "", ""
            )?;
        }
        for skipped in &self.skipped {
            writeln!(f, "  skipped: {skipped}")?;
        }
        Ok(())
    }
}
