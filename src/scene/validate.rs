//! From keys as written to a `Scene` that physics can rely on.

use super::choice::{Choice, ShapeName, chosen};
use super::error::SceneError;
use super::file::{ParticleKeys, SceneFile};
use super::grid::Grid;
use super::modes::{Mode, amount, modes};
use super::particle::is_by_rays;
use super::{Diffraction, Interference, Method, Orders, Scene, SunDisc};
use crate::medium::{MediumSpec, wavelength_of_ghz};
use crate::phase_table::{ForwardPeak, Quantity};
use crate::shape::RaindropModel;
use std::path::Path;

/// Highest order that may be asked for by name.
const MAX_ORDER: u32 = 100;
/// Relative error asked for where the scene asks for none.
const TOLERANCE: f64 = 0.01;
/// Mantissa bits of an `f32` without the implied one.
const MANTISSA_BITS: u8 = 23;

impl SceneFile {
    /// Check everything and convert to metres and radians.
    ///
    /// # Errors
    /// The first key that is missing or has a value that is not accepted.
    pub fn validate(&self) -> Result<Scene, SceneError> {
        self.validate_in(Path::new(""))
    }

    /// The same; files that the scene names are looked for in `folder`.
    ///
    /// # Errors
    /// As for [`SceneFile::validate`].
    pub fn validate_in(&self, folder: &Path) -> Result<Scene, SceneError> {
        let resolved = self.with_defaults();
        let (light, table, model) = (&resolved.light, &resolved.table, &resolved.model);
        let wavelengths = match (&light.frequencies_ghz, &self.light.wavelengths_nm) {
            (Some(grid), Some(_)) => {
                let accepted = "wavelengths_nm is given too; keep one of the two";
                return Err(SceneError::invalid("light.frequencies_ghz", grid, accepted));
            }
            (Some(grid), None) => frequencies(grid)?,
            (None, _) => wavelengths(light.wavelengths_nm.as_ref())?,
        };
        let mut modes = modes(&resolved, folder, &wavelengths)?;
        let Mode {
            particle,
            size_distribution,
            density,
            medium,
            orientation,
            fixed_angles,
            orientations,
            axis_ratio_law,
            canting,
            ..
        } = if modes.len() == 1 { modes.remove(0) } else { modes[0].clone() };
        let scene = Scene {
            particle,
            size_distribution,
            density,
            medium,
            orientation,
            fixed_angles,
            orientations,
            axis_ratio_law,
            canting,
            amount: amount(&resolved.amount)?,
            modes,
            bandwidth: bandwidth(light.bandwidth_nm, &wavelengths)?,
            sun_disc: chosen(light.sun_disc, "light.sun_disc")?,
            sun_elevation: sun_elevation(light.sun_elevation_deg)?,
            wavelengths,
            theta: theta(table.theta_deg.as_ref())?,
            phi: azimuth(table.azimuth_deg.as_ref())?,
            quantity: chosen(table.quantity, "table.quantity")?,
            forward_peak: chosen(table.forward_peak, "table.forward_peak")?,
            bit_round: bit_round(table.bit_round)?,
            method: chosen(model.method, "model.method")?,
            interference: model.interference.unwrap_or(Interference::Waves),
            diffraction: chosen(model.diffraction, "model.diffraction")?,
            orders: orders(model.orders.as_ref())?,
            tolerance: tolerance(model.tolerance)?,
            allow_unmet_tolerance: model.allow_unmet_tolerance.unwrap_or(false),
            rays_across: rays_across(model.rays_across)?,
            toml: resolved.to_toml(),
        };
        for part in scene.parts() {
            part.check_crystal()?;
            part.check_outline()?;
            part.check_method(scene.modes.is_empty())?;
            part.check_means()?;
            part.check_radial()?;
        }
        scene.check_amount()?;
        scene.check_size()?;
        Ok(scene)
    }

    /// The scene as TOML.
    pub fn to_toml(&self) -> String {
        // Plain structs of numbers and words always have a TOML form.
        toml::to_string(self).unwrap_or_default()
    }

    /// This scene with every key that may be left out filled in.
    fn with_defaults(&self) -> SceneFile {
        let mut full = self.clone();
        let one = full.particles.is_empty().then_some(&mut full.particle);
        for particle in full.particles.iter_mut().map(|mode| &mut mode.particle).chain(one) {
            particle.medium.get_or_insert_with(MediumSpec::default);
            if particle.shape == Some(Choice(ShapeName::Raindrop)) {
                particle.model.get_or_insert(Choice(RaindropModel::BeardChuang1987));
            }
        }
        let range = |from, to, count| Grid::Range { from, to, count };
        full.light.sun_elevation_deg.get_or_insert(20.0);
        if full.light.frequencies_ghz.is_none() {
            full.light.wavelengths_nm.get_or_insert_with(|| range(380.0, 720.0, 33));
        }
        full.light.sun_disc.get_or_insert(Choice(SunDisc::None));
        full.table.theta_deg.get_or_insert_with(|| range(0.0, 180.0, 1801));
        full.table.azimuth_deg.get_or_insert_with(|| range(0.0, 360.0, 361));
        full.table.quantity.get_or_insert(Choice(Quantity::PhaseFunction));
        full.table.forward_peak.get_or_insert(Choice(ForwardPeak::default()));
        full.model.method.get_or_insert(Choice(Method::Auto));
        let method = full.model.method.map_or(Method::Auto, |method| method.0);
        let all = full.particles.iter().map(|mode| &mode.particle).chain([&full.particle]);
        let drops = |keys: &ParticleKeys| {
            let many = keys.size_distribution.as_ref().is_some_and(|sizes| !sizes.is_delta());
            (many || keys.canting.is_some()) && is_by_rays(keys, method)
        };
        let many = all.into_iter().any(drops);
        let interference = if many { Interference::WithinOrders } else { Interference::Waves };
        full.model.interference.get_or_insert(interference);
        full.model.diffraction.get_or_insert(Choice(Diffraction::Airy));
        full.model.orders.get_or_insert(Orders::Auto);
        full.model.tolerance.get_or_insert(TOLERANCE);
        full
    }
}

fn sun_elevation(degrees: Option<f64>) -> Result<f64, SceneError> {
    let degrees = degrees.unwrap_or_default();
    if (-90.0..=90.0).contains(&degrees) {
        return Ok(degrees.to_radians());
    }
    let accepted = "the sun's elevation above the horizon is -90 to 90 degrees";
    Err(SceneError::invalid("light.sun_elevation_deg", degrees, accepted))
}

/// Width of the band about each wavelength, metres.
fn bandwidth(nm: Option<f64>, wavelengths: &[f64]) -> Result<f64, SceneError> {
    let nm = nm.unwrap_or_default();
    let shortest = wavelengths.iter().copied().fold(f64::INFINITY, f64::min) * 1e9;
    if nm >= 0.0 && nm <= 0.5 * shortest {
        return Ok(nm * 1e-9);
    }
    let accepted = format!(
        "full width at half maximum, 0 to {} nm (half of the shortest wavelength)",
        0.5 * shortest
    );
    Err(SceneError::invalid("light.bandwidth_nm", nm, accepted))
}

/// The values of an axis: ascending, all inside `limits`.
fn axis(
    key: &str,
    grid: Option<&Grid>,
    limits: std::ops::RangeInclusive<f64>,
    accepted: &str,
) -> Result<Vec<f64>, SceneError> {
    let grid = grid.ok_or_else(|| SceneError::missing(key, accepted))?;
    let refuse = |reason: String| SceneError::invalid(key, grid, format!("{reason}; {accepted}"));
    let values = grid.values().map_err(refuse)?;
    if let Some(value) = values.iter().find(|value| !limits.contains(value)) {
        return Err(refuse(format!("{value} is not accepted")));
    }
    if let Some(pair) = values.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(refuse(format!("{} is followed by {}", pair[0], pair[1])));
    }
    Ok(values)
}

fn wavelengths(grid: Option<&Grid>) -> Result<Vec<f64>, SceneError> {
    let accepted = "wavelengths in vacuum, 1 to 1e9 nm, ascending";
    let values = axis("light.wavelengths_nm", grid, 1.0..=1e9, accepted)?;
    Ok(values.into_iter().map(|nm| nm * 1e-9).collect())
}

/// Wavelengths of frequencies: the highest first, so that they ascend.
fn frequencies(grid: &Grid) -> Result<Vec<f64>, SceneError> {
    let accepted = "frequencies in GHz, 0.3 to 2.9e8, ascending";
    let values = axis("light.frequencies_ghz", Some(grid), 0.3..=2.9e8, accepted)?;
    Ok(values.into_iter().rev().map(wavelength_of_ghz).collect())
}

fn theta(grid: Option<&Grid>) -> Result<Vec<f64>, SceneError> {
    const KEY: &str = "table.theta_deg";
    let accepted = "at least two scattering angles, 0 to 180 degrees, ascending";
    let values = axis(KEY, grid, 0.0..=180.0, accepted)?;
    if values.len() < 2 {
        return Err(SceneError::invalid(KEY, Grid::List(values), accepted));
    }
    Ok(values.into_iter().map(f64::to_radians).collect())
}

fn azimuth(grid: Option<&Grid>) -> Result<Vec<f64>, SceneError> {
    const KEY: &str = "table.azimuth_deg";
    let accepted = "azimuths of -360 to 360 degrees, ascending, over at most 360 degrees";
    let values = axis(KEY, grid, -360.0..=360.0, accepted)?;
    let span = values.last().unwrap_or(&0.0) - values.first().unwrap_or(&0.0);
    if span > 360.0 {
        let reason = format!("it spans {span} degrees; {accepted}");
        return Err(SceneError::invalid(KEY, Grid::List(values), reason));
    }
    Ok(values.into_iter().map(f64::to_radians).collect())
}

fn bit_round(bits: Option<u8>) -> Result<Option<u8>, SceneError> {
    match bits {
        Some(bits) if !(1..=MANTISSA_BITS).contains(&bits) => {
            let accepted = format!("bits of the mantissa to keep, 1 to {MANTISSA_BITS}");
            Err(SceneError::invalid("table.bit_round", bits, accepted))
        }
        bits => Ok(bits),
    }
}

fn orders(orders: Option<&Orders>) -> Result<Orders, SceneError> {
    const KEY: &str = "model.orders";
    let Some(Orders::List(list)) = orders else { return Ok(Orders::Auto) };
    let refuse = |reason: &str| Err(SceneError::invalid(KEY, format!("{list:?}"), reason));
    if list.is_empty() {
        return refuse("the list is empty; accepted: \"auto\" or at least one order");
    }
    if list.iter().any(|order| *order > MAX_ORDER) {
        return refuse(&format!("an order is the number of chords inside, 0 to {MAX_ORDER}"));
    }
    let mut sorted = list.clone();
    sorted.sort_unstable();
    sorted.dedup();
    if sorted.len() < list.len() {
        return refuse("an order is named twice");
    }
    Ok(Orders::List(list.clone()))
}

fn tolerance(tolerance: Option<f64>) -> Result<f64, SceneError> {
    let tolerance = tolerance.unwrap_or(TOLERANCE);
    if (1e-8..=0.5).contains(&tolerance) {
        return Ok(tolerance);
    }
    let accepted = "the relative error asked for, 1e-8 to 0.5";
    Err(SceneError::invalid("model.tolerance", tolerance, accepted))
}

fn rays_across(rays: Option<u32>) -> Result<Option<usize>, SceneError> {
    match rays {
        Some(rays) if !(8..=20_000).contains(&rays) => Err(SceneError::invalid(
            "model.rays_across",
            rays,
            "rays across the silhouette, 8 to 20000; leave it out to have them chosen",
        )),
        rays => Ok(rays.map(|rays| rays as usize)),
    }
}
