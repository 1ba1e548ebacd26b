//! The plan: what a scene needs, what is skipped, and why.
//!
//! Decided once, before anything is traced: the method, symmetries, orders, the wavefront's grid.
//! Every decision leaves a sentence, so that `gonio plan` can print them.
//!
//! ```
//! use gonio::plan::{Engine, Plan};
//! use gonio::scene::{Scene, SceneFile};
//!
//! let plan = Plan::new(&Scene::built_in(&SceneFile::default())?)?;
//! assert_eq!(plan.engine, Engine::Meridians);
//! assert!(plan.orders.contains(&2), "the primary bow");
//! assert!(plan.reasons.iter().any(|reason| reason.contains("mirror images")));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod acceptance;
mod cost;
mod crystal;
mod engine;
mod methods;
mod orders;
mod t_matrix;

pub use acceptance::{
    DOUBTFUL_PHASE_SHIFT, LARGEST_K_OVER_N, OUTSIDE_LOSS, PlanError, check_outside, check_rays,
    phase_shift,
};
pub use cost::{Cost, available_memory};
pub use crystal::stand;
pub use engine::Engine;
pub use methods::PlannedRange;
pub use orders::{last_order, orders_that_matter};
pub use t_matrix::amplitude_tolerance;

use crate::facets;
use crate::farfield::assignment::Thresholds;
use crate::math::digits::to_digits;
use crate::medium::Light;
use crate::scene::{Orders, Orientation, Particle, Scene};
use crate::shape::{Shape, ShapeError};
use crate::size_distribution::SizeDistribution;
use std::f64::consts::{PI, TAU};

/// How the scattering depends on azimuth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Not at all: one azimuth is computed and stored.
    Rotational,
    /// Mirror images on both sides of the vertical plane: half the azimuths are computed.
    Mirror,
    /// Each azimuth is computed: a crystal that stands still.
    None,
}

/// What will be computed.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Who computes.
    pub engine: Engine,
    /// What scatters; of crystals the sphere of equal volume, for those who ask for its size alone.
    pub shape: Shape,
    /// Of crystals the body of facets.
    pub crystal: Option<facets::Body>,
    /// Radius of equal volume, metres.
    pub radius: f64,
    /// How scattering depends on azimuth.
    pub symmetry: Symmetry,
    /// Orders (chords) summed.
    pub orders: Vec<u32>,
    /// Whether these are all that matter, so that the whole of the scattering is their truth; else the
    /// orders alone are.
    pub complete: bool,
    /// Whether forward diffraction is summed too.
    pub forward_diffraction: bool,
    /// Relative error asked for.
    pub tolerance: f64,
    /// By which numbers particles are accepted, and each order gets its method.
    pub thresholds: Thresholds,
    /// Whether the power of each order is compared with its rays' and the error is measured; many runs of much
    /// the same particle may do without.
    pub checked: bool,
    /// Grid of the patches: rings from centre to rim, and spokes.
    pub rings: usize,
    /// Rays about the axis.
    pub spokes: usize,
    /// What was decided and why, one sentence each.
    pub reasons: Vec<String>,
    /// Of several kinds of particles the plan of each; what stands above is then of the first.
    pub parts: Vec<Plan>,
}

impl Plan {
    /// Plan a scene.
    ///
    /// # Errors
    /// A shape outside its model, a wavelength outside the medium's data, an exact series asked for
    /// a particle that is no sphere, surroundings that absorb, or absorption beyond the ray picture.
    pub fn new(scene: &Scene) -> Result<Self, PlanError> {
        Self::by(scene, Thresholds::MEASURED)
    }

    /// The same by other numbers than the measured ones.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn by(scene: &Scene, thresholds: Thresholds) -> Result<Self, PlanError> {
        if scene.modes.is_empty() {
            return Self::of_one_kind(scene, thresholds);
        }
        let plans = scene.parts().into_iter().map(|part| Self::of_one_kind(&part, thresholds));
        let parts: Vec<Self> = plans.collect::<Result<_, _>>()?;
        let rotational = parts.iter().all(|part| part.symmetry == Symmetry::Rotational);
        let of_kind = |(place, part): (usize, &Plan)| {
            let sentence = move |reason: &String| format!("particles[{}]: {reason}", place + 1);
            part.reasons.iter().map(sentence).collect::<Vec<_>>()
        };
        let reasons = parts.iter().enumerate().flat_map(of_kind).collect();
        let symmetry = if rotational { Symmetry::Rotational } else { Symmetry::Mirror };
        Ok(Self { symmetry, reasons, ..parts[0].clone() }.with_parts(parts))
    }

    fn with_parts(self, parts: Vec<Self>) -> Self {
        Self { parts, ..self }
    }

    fn of_one_kind(scene: &Scene, thresholds: Thresholds) -> Result<Self, PlanError> {
        if let Particle::Crystal { radius, crystal } = &scene.particle {
            return Self::of_crystal(scene, *radius, crystal, thresholds);
        }
        let (mut shape, radius) = shape(&scene.particle, scene.sun_elevation)?;
        if let Some(sizes) = scene.size_distribution.as_ref().filter(|_| !is_ball(scene)) {
            // of many sizes the largest says whether they are spheres
            let largest = scene.particle_with_radius(sizes.bounds().1);
            shape = self::shape(&largest, scene.sun_elevation)?.0;
        }
        let mut reasons = Vec::new();
        let engine = Engine::of(scene, &shape, radius, &thresholds, &mut reasons)?;
        let random = scene.orientation == Orientation::Random;
        let symmetry = if random && !shape.is_sphere() {
            reasons.push("one azimuth is enough: a mean over all orientations".into());
            Symmetry::Rotational
        } else {
            symmetry(&shape, &mut reasons)
        };
        let lights = lights(scene, engine, radius)?;
        if !engine.is_exact() {
            let smallest =
                scene.size_distribution.as_ref().map_or(radius, |sizes| sizes.bounds().0);
            check_particle(scene, smallest, &lights, &thresholds, &mut reasons)?;
        }
        let share = scene.size_distribution.as_ref().map_or(1.0, |sizes| sizes.share_inside());
        if share < ALL_INSIDE {
            reasons.push(format!(
                "the limits of the sizes leave out {:.3} % of the number of particles; what is said per \
                 particle is per particle inside",
                100.0 * (1.0 - share)
            ));
        }
        say_medium(scene, &mut reasons);
        if scene.medium.radial().is_none() && lights.iter().all(|light| light.index.im == 0.0) {
            reasons.push("absorption is skipped: k = 0 at every wavelength".into());
        }
        let index = lights.first().map_or(1.33, |light| light.index.re);
        let (orders, forward_diffraction) =
            orders(scene, &shape, engine, index, &thresholds, &mut reasons);
        let complete = scene.orders == Orders::Auto;
        let rings = rings(scene.rays_across, scene.tolerance);
        Ok(Self {
            engine,
            shape,
            crystal: None,
            radius,
            symmetry,
            orders,
            complete,
            forward_diffraction,
            tolerance: scene.tolerance,
            thresholds,
            checked: true,
            rings,
            spokes: 2 * rings,
            reasons,
            parts: Vec::new(),
        })
    }

    /// A plan for single directions: what the caller says, nothing decided.
    pub fn direct(
        shape: Shape,
        radius: f64,
        engine: Engine,
        orders: Vec<u32>,
        forward_diffraction: bool,
        tolerance: f64,
        rays_across: Option<usize>,
    ) -> Self {
        let mut reasons = Vec::new();
        let symmetry = symmetry(&shape, &mut reasons);
        let rings = rings(rays_across, tolerance);
        Self {
            engine,
            shape,
            crystal: None,
            radius,
            symmetry,
            orders,
            complete: forward_diffraction,
            forward_diffraction,
            tolerance,
            thresholds: Thresholds::MEASURED,
            checked: true,
            rings,
            spokes: 2 * rings,
            reasons,
            parts: Vec::new(),
        }
    }

    /// The azimuths that the table holds: one where there is no dependence on azimuth.
    pub fn table_azimuths(&self, asked: &[f64]) -> Vec<f64> {
        match self.symmetry {
            Symmetry::Rotational => vec![asked.first().copied().unwrap_or(0.0)],
            Symmetry::Mirror | Symmetry::None => asked.to_vec(),
        }
    }

    /// The azimuths in [0, π] to compute, ascending, and for each azimuth of the table which one
    /// serves it and whether as mirror image.
    pub fn computed_azimuths(&self, table: &[f64]) -> (Vec<f64>, Vec<(usize, bool)>) {
        const SAME: f64 = 1e-9;
        if self.symmetry == Symmetry::None {
            return (table.to_vec(), (0..table.len()).map(|j| (j, false)).collect());
        }
        let fold = |phi: f64| {
            let turned = phi.rem_euclid(TAU);
            if turned > PI { (TAU - turned, true) } else { (turned, false) }
        };
        let mut unique: Vec<f64> = table.iter().map(|&phi| fold(phi).0).collect();
        unique.sort_by(f64::total_cmp);
        unique.dedup_by(|a, b| (*a - *b).abs() < SAME);
        let place = |phi: f64| {
            let (folded, mirrored) = fold(phi);
            let index = unique.partition_point(|&u| u < folded - SAME);
            (index, mirrored)
        };
        let places = table.iter().map(|&phi| place(phi)).collect();
        (unique, places)
    }
}

/// Share of the number of particles inside the limits of their sizes from which on nothing is said.
const ALL_INSIDE: f64 = 0.99999;

fn is_ball(scene: &Scene) -> bool {
    matches!(scene.particle, Particle::Sphere { .. })
}

/// The shape of a particle and its radius of equal volume (metres).
///
/// # Errors
/// A radius or axis ratio outside the model.
pub fn shape(particle: &Particle, sun_elevation: f64) -> Result<(Shape, f64), ShapeError> {
    Ok(match particle {
        Particle::Sphere { radius } => (Shape::sphere(), *radius),
        Particle::Spheroid { radius, axis_ratio } => {
            (Shape::spheroid(*axis_ratio, sun_elevation)?, *radius)
        }
        Particle::Raindrop { radius, model } => {
            (Shape::raindrop(*radius, *model, sun_elevation)?, *radius)
        }
        Particle::Crystal { crystal, .. } => return Err(ShapeError::Faceted(crystal.name())),
        Particle::Own { radius, body } => (Shape::own(body.clone(), sun_elevation), *radius),
    })
}

fn symmetry(shape: &Shape, reasons: &mut Vec<String>) -> Symmetry {
    if shape.rotational_symmetry() {
        reasons.push("one azimuth is enough: a sphere, or light along the axis".into());
        return Symmetry::Rotational;
    }
    reasons.push("half the azimuths are mirror images of the other half".into());
    Symmetry::Mirror
}

/// Light of all wavelengths as the particle meets it; refuses surroundings that absorb.
fn lights(scene: &Scene, engine: Engine, radius: f64) -> Result<Vec<Light>, PlanError> {
    let of = |&wavelength: &f64| -> Result<Light, PlanError> {
        let light = engine.light(scene, radius, wavelength)?;
        let largest = |sizes: &SizeDistribution| sizes.limits(1e-3, TAU / light.wavelength).1;
        let radius = scene.size_distribution.as_ref().map_or(radius, largest);
        check_outside(&scene.medium, wavelength, radius)?;
        Ok(light)
    };
    scene.wavelengths.iter().map(of).collect()
}

/// What varies inside, and what is around, where that is not vacuum.
fn say_medium(scene: &Scene, reasons: &mut Vec<String>) {
    if let Some(radial) = scene.medium.radial() {
        let name = radial.name();
        reasons.push(format!("exact series of a sphere that varies along its radius: {name}"));
    }
    if let Some(outside) = scene.medium.surroundings() {
        reasons.push(format!(
            "the particle is in {}: indices are relative to it, size parameters are of the wavelength in it",
            outside.name()
        ));
    }
}

/// Refuse particles that rays cannot serve at one of the wavelengths; say where they hardly can.
fn check_particle(
    scene: &Scene,
    radius: f64,
    lights: &[Light],
    by: &Thresholds,
    reasons: &mut Vec<String>,
) -> Result<(), PlanError> {
    let mut least = f64::INFINITY;
    for (light, &wavelength) in lights.iter().zip(&scene.wavelengths) {
        let (index, size_parameter) = (light.index, TAU * radius / light.wavelength);
        let place = format!(" at {} nm", to_digits(wavelength * 1e9, 10));
        acceptance::accept(by, index, size_parameter, &place)?;
        least = least.min(phase_shift(index, size_parameter));
    }
    if least < by.doubtful_phase_shift {
        reasons.push(format!(
            "rays are doubtful: the phase shift 2x|n - 1| is {least:.1}, below {}; see the error that \
             the table states",
            by.doubtful_phase_shift
        ));
    }
    Ok(())
}

/// Orders to sum, and whether forward diffraction belongs to them.
///
/// Every table of rays has the forward peak (`forward_peak` says how), a list of orders or not: half of
/// the cross-section by which it is normalised is in it. Debye terms are just those of the list.
fn orders(
    scene: &Scene,
    shape: &Shape,
    engine: Engine,
    index: f64,
    by: &Thresholds,
    reasons: &mut Vec<String>,
) -> (Vec<u32>, bool) {
    match &scene.orders {
        _ if engine == Engine::TMatrix => (Vec::new(), true),
        Orders::List(list) => (list.clone(), engine != Engine::Debye),
        Orders::Auto => {
            let last = orders::last_order_by(by, index, scene.tolerance);
            let rays = engine == Engine::Meridians;
            let all = match rays {
                true => orders::orders_that_matter_by(by, index, scene.tolerance, shape),
                false => (0..=last).collect(),
            };
            let beyond: Vec<String> = all[last as usize + 1..].iter().map(u32::to_string).collect();
            let but = match beyond.is_empty() {
                true => String::new(),
                false => {
                    format!(" but {}, which have bows where little else goes", beyond.join(", "))
                }
            };
            reasons.push(format!(
                "orders beyond p = {last} are skipped{but}: together they hold less than {:.1e} of the \
                 light",
                orders::remainder_limit(scene.tolerance, by)
            ));
            (all, true)
        }
    }
}

/// Rings of the patch grid: half the rays across where they are given, else by the tolerance, for
/// the error of the path falls with the cube of the step.
fn rings(rays_across: Option<usize>, tolerance: f64) -> usize {
    let chosen = || (200.0 * (0.01 / tolerance).cbrt()).clamp(40.0, 2000.0) as usize;
    rays_across.map_or_else(chosen, |rays| rays.div_ceil(2))
}
