//! How many radii each order needs: found out at one wavelength and a few azimuths.
//!
//! From eight steps on, the order and stretch of radii that adds most to the error gets twice as many, until all
//! together err by less than the tolerance, or as many are taken as there may be. The error of a mean is the
//! difference to that of every second radius, times [`OF_DIFFERENCE`].

use super::azimuths::Azimuths;
use super::error::band_errors;
use super::groups::{Part, groups};
use super::one_drop::Drop;
use super::seen::{Means, Seen};
use crate::medium::{Light, MediumError};
use crate::phase_table::Quantity;
use crate::plan::Plan;
use crate::population::{Radius, radii};
use crate::scene::{Particle, Scene};
use crate::shape::AxisRatioLaw;
use crate::simulate::error::SimulateError;
use crate::size_distribution::SizeDistribution;
use ndarray::{Array3, Axis, s};
use num_complex::Complex64;
use std::collections::{BTreeMap, HashMap};
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps at first, of orders from this on half as many: they hold less than half a percent of the light.
const LEAST: usize = 8;
const FAINT: u32 = 4;
/// Most steps of flattened drops, of such that cant, and of spheres, which cost one azimuth.
const MOST: usize = 128;
const MOST_OF_TILTED: usize = 512;
const MOST_OF_SPHERES: usize = 512;
/// Azimuths of the trial: in the plane of the sun both ways, and across.
const AZIMUTHS: [f64; 3] = [0.0, FRAC_PI_2, PI];
/// Twice the radii halve the error (measured: 2.0 to 2.9 times, `validation/population.md`): what is left is
/// that much of the difference.
pub(super) const OF_DIFFERENCE: f64 = 0.5;

/// How many radii stand for a distribution of sizes of drops, by order and stretch of radii.
#[derive(Clone, Debug, PartialEq)]
pub struct Steps {
    pub(super) parts: Vec<Part>,
    /// Relative error of the mean that they were chosen for, root mean square over bands of scattering angle.
    pub expected_error: f64,
}

/// Stretches of radii between which the shape of a kind of drops changes smoothly; whether each is of spheres.
pub(super) fn stretches(scene: &Scene, sizes: &SizeDistribution) -> Vec<((f64, f64), bool)> {
    let (from, to) = sizes.bounds();
    let kink = match &scene.particle {
        Particle::Sphere { .. } => Some(f64::INFINITY),
        Particle::Raindrop { model, .. } => model.sphere_up_to(),
        Particle::Spheroid { .. } => scene.axis_ratio_law.and_then(AxisRatioLaw::sphere_up_to),
        Particle::Own { .. } | Particle::Crystal { .. } => None,
    };
    match kink {
        None => vec![((from, to), false)],
        Some(kink) if kink >= to => vec![((from, to), true)],
        Some(kink) if kink <= from => vec![((from, to), false)],
        Some(kink) => vec![((from, kink), true), ((kink, to), false)],
    }
}

/// The sizes of a kind of drops, also of one size.
pub(super) fn sizes_of(scene: &Scene) -> SizeDistribution {
    let one = || SizeDistribution::delta(scene.particle.radius());
    scene.size_distribution.clone().unwrap_or_else(one)
}

/// Light of the middle one of a scene's wavelengths.
pub(super) fn middle_light(scene: &Scene) -> Result<Light, MediumError> {
    scene.medium.light(scene.wavelengths[scene.wavelengths.len() / 2])
}

/// Least and largest index (real part) of a scene's wavelengths.
pub(super) fn index_range(scene: &Scene) -> Result<[f64; 2], MediumError> {
    let mut range = [f64::MAX, f64::MIN];
    for wavelength in &scene.wavelengths {
        let index = scene.medium.light(*wavelength)?.index.re;
        range = [range[0].min(index), range[1].max(index)];
    }
    Ok(range)
}

impl Steps {
    /// Radii for a scene of one kind of drops with a distribution of sizes.
    ///
    /// # Errors
    /// A radius outside the model of the shape, or a wavelength outside the medium's data.
    pub fn new(
        scene: &Scene,
        plan: &Plan,
        sizes: &SizeDistribution,
    ) -> Result<Self, SimulateError> {
        let Light { wavelength, index } = middle_light(scene)?;
        let azimuths: Vec<f64> = match scene.phi.as_slice() {
            [one] => vec![plan.computed_azimuths(&[*one]).0[0]],
            _ => AZIMUTHS.to_vec(),
        };
        // each azimuth by itself
        let apart = Azimuths::new((azimuths.clone(), Vec::new()), false);
        let seen = Seen::new(scene, wavelength, &apart);
        let trial = Scene { quantity: Quantity::PhaseFunction, ..seen.scene(scene) };
        let mut parts = Vec::new();
        for (stretch, spheres) in stretches(scene, sizes) {
            let steps = |order: u32| if order < FAINT { LEAST } else { LEAST / 2 };
            let of_order = |&order: &u32| Part { stretch, spheres, order, steps: steps(order) };
            parts.extend(plan.orders.iter().map(of_order));
        }
        let mut drops = Tried {
            scene: &trial,
            seen: &seen,
            plan,
            azimuths: &azimuths,
            index,
            wavelength,
            found: HashMap::new(),
        };
        let mut means =
            parts.iter().map(|part| drops.means(sizes, part)).collect::<Result<Vec<Means>, _>>()?;
        loop {
            let total = means.iter().skip(1).fold(means[0][0].clone(), |sum, mean| sum + &mean[0]);
            let error = |mean: &Means| {
                let difference = (&mean[0] - &mean[1]) * OF_DIFFERENCE;
                band_errors(&scene.theta, &difference, &total).by_band
            };
            let errors: Vec<f64> = means.iter().map(error).collect();
            let expected_error = errors.iter().map(|error| error * error).sum::<f64>().sqrt();
            let most = |part: &Part| match (part.spheres, scene.canting > 0.0) {
                (true, _) => MOST_OF_SPHERES,
                (false, false) => MOST,
                (false, true) => MOST_OF_TILTED,
            };
            let worst = (0..parts.len())
                .filter(|&k| parts[k].steps < most(&parts[k]))
                .max_by(|&a, &b| errors[a].total_cmp(&errors[b]));
            let done = expected_error <= scene.tolerance;
            let Some(worst) = worst.filter(|&k| !done && errors[k] > 0.05 * scene.tolerance) else {
                return Ok(Self { parts, expected_error });
            };
            parts[worst].steps *= 2;
            means[worst] = drops.means(sizes, &parts[worst])?;
        }
    }

    /// Compute one drop of each set of orders and stretch of radii at the middle wavelength as a table does, `time`
    /// it, and multiply by how many there are: what a whole wavelength takes.
    ///
    /// # Errors
    /// As [`Steps::new`].
    pub fn forecast(
        &self,
        scene: &Scene,
        plan: &Plan,
        mut time: impl FnMut(
            &mut dyn FnMut() -> Result<(), SimulateError>,
        ) -> Result<f64, SimulateError>,
    ) -> Result<f64, SimulateError> {
        let Light { wavelength, index } = middle_light(scene)?;
        let light = (wavelength, index);
        let many = scene.wavelengths.len() >= plan.thresholds.fewest_guided;
        let range = if many { Some(index_range(scene)?) } else { None };
        let azimuths = Azimuths::of(scene, plan);
        let scene = &Seen::new(scene, wavelength, &azimuths).scene(scene);
        let azimuths = azimuths.computed();
        let mut total = 0.0;
        for stretch in self.parts.chunk_by(|a, b| a.stretch == b.stretch) {
            let (from, to) = stretch[0].stretch;
            let middle = Radius { radius: 0.5 * (from + to), place: 0.5, weight: 0.0, coarse: 0.0 };
            let drop = Drop::new(scene, plan, &middle, light)?;
            // drops of the same orders take as long
            let mut alike: BTreeMap<Vec<u32>, usize> = BTreeMap::new();
            for group in groups(&sizes_of(scene), stretch.iter()) {
                *alike.entry(group.numbers()).or_default() += 1;
            }
            for (orders, count) in alike {
                let guides = range.and_then(|range| drop.guides(&orders, range));
                let seconds = time(&mut || {
                    drop.orders(scene, &orders, &azimuths, guides.as_ref());
                    Ok(())
                })?;
                total += seconds * count as f64;
            }
            for part in stretch.iter().filter(|part| part.order == plan.orders[0]) {
                let seconds = time(&mut || drop.sections().map(|_| ()))?;
                total += seconds * (part.steps + 1) as f64;
            }
        }
        Ok(total)
    }

    /// How many radii by order, in words.
    pub fn words(&self) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for stretch in self.parts.chunk_by(|a, b| a.stretch == b.stretch) {
            let (from, to) = stretch[0].stretch;
            let of_order = |part: &Part| format!("{} of order {}", part.steps + 1, part.order);
            let what = if stretch[0].spheres { "spheres" } else { "flattened drops" };
            lines.push(format!(
                "{what} of {:.3} to {:.3} mm: {} radii",
                from * 1e3,
                to * 1e3,
                stretch.iter().map(of_order).collect::<Vec<_>>().join(", ")
            ));
        }
        lines
    }
}

/// Drops that were tried, by radius and order: finer steps keep all radii of coarser ones.
struct Tried<'a> {
    scene: &'a Scene,
    seen: &'a Seen,
    plan: &'a Plan,
    azimuths: &'a [f64],
    index: Complex64,
    wavelength: f64,
    found: HashMap<(u64, u64, u32), Array3<f32>>,
}

impl Tried<'_> {
    fn means(&mut self, sizes: &SizeDistribution, part: &Part) -> Result<Means, SimulateError> {
        let mut means =
            [0, 1].map(|_| Array3::zeros((1, self.scene.theta.len(), self.azimuths.len())));
        for at in radii(sizes, part.stretch, part.steps) {
            let key = (at.radius.to_bits(), at.place.to_bits(), part.order);
            if !self.found.contains_key(&key) {
                let drop = Drop::new(self.scene, self.plan, &at, (self.wavelength, self.index))?;
                let found = drop.orders(self.scene, &[part.order], self.azimuths, None);
                self.found.extend(found.into_iter().map(|values| (key, values)));
            }
            add(&mut means, &self.found[&key], [at.weight, at.coarse]);
        }
        Ok(self.seen.means(means))
    }
}

/// Add the light of one drop to both means; one azimuth stands for all.
pub(super) fn add(means: &mut Means, values: &Array3<f32>, weights: [f64; 2]) {
    for (mean, weight) in means.iter_mut().zip(weights) {
        if weight == 0.0 {
            continue;
        }
        if values.dim().2 == mean.dim().2 {
            mean.zip_mut_with(values, |sum, value| *sum += weight * f64::from(*value));
            continue;
        }
        for mut column in mean.axis_iter_mut(Axis(2)) {
            column.zip_mut_with(&values.slice(s![.., .., 0]), |sum, value| {
                *sum += weight * f64::from(*value);
            });
        }
    }
}
