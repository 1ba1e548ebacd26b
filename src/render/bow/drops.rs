//! The drops of a picture: tables read from files, or computed for the picture.

use super::error::BowError;
use crate::lee::Beats;
use crate::lee::sampling::{Sampling, SamplingNeed};
use crate::math::parallel::*;
use crate::medium::{Medium, MediumSpec};
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{Axes, PhaseTable, Quantity, Slab, TableHeader};
use crate::plan::Plan;
use crate::scene::{Choice, Grid, Scene, SceneFile, ShapeName};
use crate::series::lorenz_mie::Sphere;
use crate::simulate;
use crate::size_distribution::log_normal_classes;
use ndarray::Array3;
use num_complex::Complex64;
use serde::Deserialize;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// One kind of drop of a picture.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DropKeys {
    /// A table, in place of the keys below; relative to the scene file.
    pub table: Option<String>,
    /// sphere or raindrop
    pub shape: Option<String>,
    /// Radius of equal volume, mm.
    pub radius_mm: Option<f64>,
    /// As in a scene of one particle; files are looked for beside the scene.
    pub medium: Option<MediumSpec>,
    /// How many drops of this kind there are, relative to the other kinds.
    pub number: Option<f64>,
    /// Standard deviation of ln(radius): a log-normal distribution of sizes.
    pub size_spread: Option<f64>,
    /// Number of wavelengths (raindrops).
    pub wavelengths: Option<u64>,
}

/// Sizes that stand for a distribution.
const SIZES: usize = 11;
/// Of the wavelengths of a Lee diagram, which shows a single size at single angles, every third: the
/// picture's time.
const EVERY: usize = 3;
/// Scattering angles of spheres computed here, degrees; nearer to the sun nobody looks.
const FROM: f64 = 2.0;

impl DropKeys {
    /// Drops of a finished table.
    pub fn table(path: &Path) -> Self {
        Self { table: Some(path.to_string_lossy().into_owned()), ..Self::default() }
    }

    /// Refuses keys that contradict each other.
    fn check(&self) -> Result<(), BowError> {
        let present = [
            ("shape", self.shape.is_some()),
            ("radius_mm", self.radius_mm.is_some()),
            ("medium", self.medium.is_some()),
            ("size_spread", self.size_spread.is_some()),
            ("wavelengths", self.wavelengths.is_some()),
        ];
        let beside_table = present.iter().find(|(_, there)| self.table.is_some() && *there);
        if let Some((key, _)) = beside_table {
            let message =
                format!("drops.{key} with drops.table: the table says what its drops are");
            return Err(BowError::Keys(message));
        }
        let sphere = self.shape.as_deref().unwrap_or("sphere") == "sphere";
        match self.wavelengths {
            Some(count) if sphere => Err(BowError::Keys(format!(
                "drops.wavelengths = {count}: those of a sphere follow from its size; a key of \
                 shape = \"raindrop\""
            ))),
            _ => Ok(()),
        }
    }
}

/// The tables and numbers of all kinds.
pub(super) fn tables(
    kinds: &[DropKeys],
    folder: &Path,
    sun_elevation_deg: f64,
    polarised: bool,
    tell: &dyn Fn(String),
) -> Result<Vec<(PhaseTable, f64)>, BowError> {
    if kinds.is_empty() {
        let message = "drops: none given; add [[drops]] to the scene, or --table FILE.h5";
        return Err(BowError::Keys(message.into()));
    }
    let mut out = Vec::new();
    for kind in kinds {
        let number = kind.number.unwrap_or(1.0);
        kind.check()?;
        if let Some(name) = &kind.table {
            out.push((crate::hdf5::read(&folder.join(name))?, number));
            continue;
        }
        let radius = kind.radius_mm.unwrap_or(0.5);
        let spread = kind.size_spread.unwrap_or(0.0);
        if !(1e-4..=10.0).contains(&radius) || !(0.0..=1.0).contains(&spread) {
            let message = format!(
                "drops: radius_mm = {radius}, size_spread = {spread}: accepted are 0.0001 to 10 \
                 and 0 to 1"
            );
            return Err(BowError::Keys(message));
        }
        for (radius, share) in log_normal_classes(radius * 1e-3, spread, SIZES) {
            let table = match kind.shape.as_deref().unwrap_or("sphere") {
                "sphere" => sphere(kind, folder, radius, polarised, tell)?,
                "raindrop" => {
                    let sun = sun_elevation_deg;
                    let scene = raindrop_scene(kind, folder, radius, sun, polarised)?;
                    if let Some(scene) = &scene {
                        scene.medium.notes().into_iter().for_each(tell);
                    }
                    match scene {
                        Some(scene) => simulate::table(&scene)?,
                        None => sphere(kind, folder, radius, polarised, tell)?,
                    }
                }
                other => {
                    let message =
                        format!("drops.shape = \"{other}\": accepted are sphere and raindrop");
                    return Err(BowError::Keys(message));
                }
            };
            out.push((table, number * share));
        }
    }
    Ok(out)
}

/// A sphere by Lorenz–Mie, sampled so that its ripple averages out over the sun's disc.
fn sphere(
    kind: &DropKeys,
    folder: &Path,
    radius: f64,
    polarised: bool,
    tell: &dyn Fn(String),
) -> Result<PhaseTable, BowError> {
    let medium = kind.medium.clone().unwrap_or_default().resolve(folder)?;
    medium.notes().into_iter().for_each(tell);
    let (from, to) = (FROM.to_radians(), PI);
    let sampling = Sampling::new(&SamplingNeed {
        radius,
        index: medium.index(550e-9)?.re,
        sun_disc: true,
        beats: Beats::All,
        size_spread: 0.0,
        angles: (from, to),
        fineness: 1.0,
    });
    let step = sampling.finest_step.max(2e-4);
    let count = ((to - from) / step).ceil() as usize;
    let theta: Vec<f64> =
        (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect();
    // A distribution of sizes averages the ripple that single sizes need wavelengths for.
    let most = if kind.size_spread.unwrap_or(0.0) > 0.0 { 64 } else { 300 };
    let stride = sampling.wavelengths.len().div_ceil(most).max(EVERY);
    let mut wavelength: Vec<f64> = sampling.wavelengths.into_iter().step_by(stride).collect();
    wavelength.sort_by(f64::total_cmp);
    let quantity = if polarised { Quantity::Mueller } else { Quantity::PhaseFunction };
    mie_table(&medium, radius, wavelength, theta, quantity)
}

/// The table of a sphere by Lorenz–Mie (metres, radians).
fn mie_table(
    medium: &Medium,
    radius: f64,
    wavelength: Vec<f64>,
    theta: Vec<f64>,
    quantity: Quantity,
) -> Result<PhaseTable, BowError> {
    let slabs = wavelength
        .par_iter()
        .map(|&w| {
            let index = medium.index(w)?;
            let solved = Sphere::new(TAU * radius / w, index)?;
            Ok(slab(&solved, radius, w, index, &theta, quantity))
        })
        .collect::<Result<Vec<_>, BowError>>()?;
    let axes = Axes { wavelength, theta, phi: vec![0.0] };
    let header = TableHeader::of_sphere(radius, axes, quantity);
    Ok(PhaseTable { header, slabs })
}

fn slab(
    solved: &Sphere,
    radius: f64,
    wavelength: f64,
    index: Complex64,
    theta: &[f64],
    quantity: Quantity,
) -> Slab {
    let q = solved.efficiencies();
    let area = PI * radius * radius;
    let scale = (wavelength / TAU).powi(2) / (q.q_sca * area);
    let amplitudes = solved.amplitudes(theta);
    let shape = (quantity.elements(), theta.len(), 1);
    let values = Array3::from_shape_fn(shape, |(element, t, _)| {
        let (s1, s2) = amplitudes[t];
        let matrix = AmplitudeMatrix { s1, s2, ..Default::default() };
        let value = match quantity {
            Quantity::PhaseFunction => matrix.s11(),
            Quantity::Mueller => matrix.mueller()[element / 4][element % 4],
        };
        (scale * value) as f32
    });
    let sections = [q.q_sca * area, q.q_ext * area];
    Slab::plain((wavelength, index), values, sections, q.asymmetry).with_error(1e-10)
}

/// The scene of a raindrop's table, where a rainbow is: 100° to 180° from the sun; nothing for a
/// drop so small that it is a sphere.
fn raindrop_scene(
    kind: &DropKeys,
    folder: &Path,
    radius: f64,
    sun_elevation_deg: f64,
    polarised: bool,
) -> Result<Option<Scene>, BowError> {
    let mut file = SceneFile::default();
    file.particle.shape = Some(Choice(ShapeName::Raindrop));
    file.particle.radius_mm = Some(radius * 1e3);
    file.particle.medium = Some(kind.medium.clone().unwrap_or_default());
    let range = |from, to, count| Some(Grid::Range { from, to, count });
    file.light.sun_elevation_deg = Some(sun_elevation_deg);
    file.light.wavelengths_nm = range(390.0, 710.0, kind.wavelengths.unwrap_or(33));
    file.table.theta_deg = range(100.0, 180.0, 1601);
    file.table.azimuth_deg = range(0.0, 360.0, 181);
    file.table.quantity =
        Some(Choice(if polarised { Quantity::Mueller } else { Quantity::PhaseFunction }));
    let scene = file.validate_in(folder)?;
    let round = Plan::new(&scene)?.shape.is_sphere();
    Ok((!round).then_some(scene))
}
