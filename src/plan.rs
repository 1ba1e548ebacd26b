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

mod cost;

pub use cost::Cost;

use crate::math::digits::to_digits;
use crate::medium::MediumError;
use crate::optics::fresnel;
use crate::scene::{Diffraction, Method, Orders, Particle, Scene};
use crate::shape::{Shape, ShapeError};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Why a scene cannot be planned.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum PlanError {
    #[error(transparent)]
    Shape(#[from] ShapeError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error("method = \"{0}\": the exact series serve spheres only; accepted here: \"rays\"")]
    SeriesNeedsSphere(&'static str),
    #[error(
        "index {index}{place} with size parameter {size_parameter:.0}: light loses more than the ray \
         picture can follow (k/n must stay below {limit}); use --method mie (method = \"mie\" in a scene) for a sphere"
    )]
    TooAbsorbing { index: String, place: String, size_parameter: f64, limit: f64 },
    #[error(
        "size parameter {size_parameter:.3e}{place}: rays are accepted from {} to {:e} (below, there \
         are no rays; above, phases lose their digits); use --method mie (method = \"mie\" in a scene) for a small sphere",
        RAY_SIZES.0,
        RAY_SIZES.1
    )]
    Size { place: String, size_parameter: f64 },
    #[error(
        "index {index}{place} with size parameter {size_parameter:.4}: the phase shift through the \
         particle, 2x|n - 1| = {phase_shift:.3}, is too small for rays, which are accepted from \
         {LEAST_PHASE_SHIFT} on (below, the light that passes and the light around the particle are \
         one wave: extinction by rays is {SOFT_MISS} off); use --method mie (method = \"mie\" in a scene) for a sphere"
    )]
    Soft { index: String, place: String, size_parameter: f64, phase_shift: f64 },
}

/// Size parameters for which rays are accepted.
pub const RAY_SIZES: (f64, f64) = (1.0, 1e9);

/// Least phase shift `2x|n - 1|` of the central ray for which rays are accepted. Measured against
/// Lorenz–Mie for n = 0.97, 1.002, 1.02 and 1.1: extinction is 87 % off at 2, 33 % at 3, 13 % at 4 and
/// 3 to 5 % from 5 to 10, at any index.
pub const LEAST_PHASE_SHIFT: f64 = 5.0;
const SOFT_MISS: &str = "13 % at 4, 87 % at 2";
/// Phase shift below which a warning goes with rays: extinction errs by up to 5 %, and directions
/// beside the forward peak by much more (the stated error tells).
pub const DOUBTFUL_PHASE_SHIFT: f64 = 20.0;

/// The phase shift of the central ray against light that passes the particle, radians.
///
/// ```
/// assert_eq!(gonio::plan::phase_shift(1.25.into(), 100.0), 50.0);
/// ```
pub fn phase_shift(index: Complex64, size_parameter: f64) -> f64 {
    2.0 * size_parameter * (index.re - 1.0).abs()
}

/// Whether rays can serve a particle of this index and size; `place` says where, for the message.
///
/// ```
/// use gonio::plan::check_rays;
/// assert!(check_rays(1.333.into(), 100.0, "").is_ok());
/// let error = check_rays(1.002.into(), 100.0, " at 550 nm").unwrap_err().to_string();
/// assert!(error.contains("at 550 nm") && error.contains("phase shift"), "{error}");
/// ```
///
/// # Errors
/// Too small or too large a particle, absorption beyond the ray picture, or an index so near 1 that
/// rays do not part from the light around the particle.
pub fn check_rays(index: Complex64, size_parameter: f64, place: &str) -> Result<(), PlanError> {
    let place = || place.to_string();
    let words = || {
        if index.im == 0.0 { index.re.to_string() } else { format!("{}+{}i", index.re, index.im) }
    };
    if index.im > LARGEST_K_OVER_N * index.re {
        let limit = LARGEST_K_OVER_N;
        return Err(PlanError::TooAbsorbing {
            index: words(),
            place: place(),
            size_parameter,
            limit,
        });
    }
    if !(RAY_SIZES.0..=RAY_SIZES.1).contains(&size_parameter) {
        return Err(PlanError::Size { place: place(), size_parameter });
    }
    let phase_shift = phase_shift(index, size_parameter);
    if phase_shift < LEAST_PHASE_SHIFT {
        return Err(PlanError::Soft {
            index: words(),
            place: place(),
            size_parameter,
            phase_shift,
        });
    }
    Ok(())
}

/// Who computes the scattering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Rays along meridians with uniform Airy functions at every fold.
    Meridians,
    /// Patches on the collecting sphere (Sadeghi et al. 2012).
    Patches,
    /// The exact series.
    LorenzMie,
    /// Single orders of the exact series.
    Debye,
}

/// How the scattering depends on azimuth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Not at all: one azimuth is computed and stored.
    Rotational,
    /// Mirror images on both sides of the vertical plane: half the azimuths are computed.
    Mirror,
}

/// What will be computed.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Who computes.
    pub engine: Engine,
    /// What scatters.
    pub shape: Shape,
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
    /// Whether rays of flattened particles are checked by a second method; many runs of much the same
    /// particle may do without.
    pub checked: bool,
    /// Grid of the patches: rings from centre to rim, and spokes.
    pub rings: usize,
    /// Rays about the axis.
    pub spokes: usize,
    /// What was decided and why, one sentence each.
    pub reasons: Vec<String>,
}

/// Beyond this `k/n` the wave inside is too inhomogeneous for real rays.
pub const LARGEST_K_OVER_N: f64 = 0.03;

/// Highest order that `orders = "auto"` goes to.
const HIGHEST_ORDER: u32 = 24;

impl Plan {
    /// Plan a scene.
    ///
    /// # Errors
    /// A shape outside its model, a wavelength outside the medium's data, an exact series asked for
    /// a particle that is no sphere, or absorption beyond the ray picture.
    pub fn new(scene: &Scene) -> Result<Self, PlanError> {
        let (shape, radius) = shape(&scene.particle, scene.sun_elevation)?;
        let mut reasons = Vec::new();
        let engine = engine(scene, &shape, &mut reasons)?;
        let symmetry = symmetry(&shape, &mut reasons);
        let indices = scene
            .wavelengths
            .iter()
            .map(|&w| scene.medium.index(w))
            .collect::<Result<Vec<_>, _>>()?;
        if matches!(engine, Engine::Meridians | Engine::Patches) {
            check_particle(scene, radius, &indices, &mut reasons)?;
        }
        if indices.iter().all(|i| i.im == 0.0) {
            reasons.push("absorption is skipped: k = 0 at every wavelength".into());
        }
        let index = indices.first().map_or(1.33, |i| i.re);
        let (orders, forward_diffraction) = orders(scene, engine, index, &mut reasons);
        let complete = scene.orders == Orders::Auto;
        let rings = rings(scene.rays_across, scene.tolerance);
        Ok(Self {
            engine,
            shape,
            radius,
            symmetry,
            orders,
            complete,
            forward_diffraction,
            tolerance: scene.tolerance,
            checked: true,
            rings,
            spokes: 2 * rings,
            reasons,
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
            radius,
            symmetry,
            orders,
            complete: forward_diffraction,
            forward_diffraction,
            tolerance,
            checked: true,
            rings,
            spokes: 2 * rings,
            reasons,
        }
    }

    /// The azimuths that the table holds: one where there is no dependence on azimuth.
    pub fn table_azimuths(&self, asked: &[f64]) -> Vec<f64> {
        match self.symmetry {
            Symmetry::Rotational => vec![asked.first().copied().unwrap_or(0.0)],
            Symmetry::Mirror => asked.to_vec(),
        }
    }

    /// The azimuths in [0, π] to compute, ascending, and for each azimuth of the table which one
    /// serves it and whether as mirror image.
    pub fn computed_azimuths(&self, table: &[f64]) -> (Vec<f64>, Vec<(usize, bool)>) {
        const SAME: f64 = 1e-9;
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
        Particle::Own { radius, body } => (Shape::own(body.clone(), sun_elevation), *radius),
    })
}

fn engine(scene: &Scene, shape: &Shape, reasons: &mut Vec<String>) -> Result<Engine, PlanError> {
    let sphere = shape.is_sphere();
    Ok(match scene.method {
        Method::Auto if sphere => {
            reasons.push("rays are skipped: the particle is a sphere, Lorenz–Mie is exact".into());
            Engine::LorenzMie
        }
        Method::Mie if !sphere => return Err(PlanError::SeriesNeedsSphere("mie")),
        Method::Debye if !sphere => return Err(PlanError::SeriesNeedsSphere("debye")),
        Method::Mie => Engine::LorenzMie,
        Method::Debye => Engine::Debye,
        Method::Auto | Method::Rays => {
            if scene.interference && scene.diffraction == Diffraction::Airy {
                Engine::Meridians
            } else {
                reasons.push(
                    "patches on the collecting sphere: interference off, or diffraction that is \
                     not \"airy\""
                        .into(),
                );
                Engine::Patches
            }
        }
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

/// Refuse particles that rays cannot serve at one of the wavelengths; say where they hardly can.
fn check_particle(
    scene: &Scene,
    radius: f64,
    indices: &[Complex64],
    reasons: &mut Vec<String>,
) -> Result<(), PlanError> {
    let mut least = f64::INFINITY;
    for (&index, &wavelength) in indices.iter().zip(&scene.wavelengths) {
        let size_parameter = TAU * radius / wavelength;
        check_rays(index, size_parameter, &format!(" at {} nm", to_digits(wavelength * 1e9, 10)))?;
        least = least.min(phase_shift(index, size_parameter));
    }
    if least < DOUBTFUL_PHASE_SHIFT {
        reasons.push(format!(
            "rays are doubtful: the phase shift 2x|n - 1| is {least:.1}, below {DOUBTFUL_PHASE_SHIFT}; \
             see the error that the table states"
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
    engine: Engine,
    index: f64,
    reasons: &mut Vec<String>,
) -> (Vec<u32>, bool) {
    match &scene.orders {
        Orders::List(list) => (list.clone(), engine != Engine::Debye),
        Orders::Auto => {
            let last = last_order(index, scene.tolerance);
            reasons.push(format!(
                "orders beyond p = {last} are skipped: together they hold less than {:.1e} of the \
                 light",
                remainder_limit(scene.tolerance)
            ));
            ((0..=last).collect(), true)
        }
    }
}

/// Share of the light that orders left out may hold at a tolerance.
///
/// Alexander's band holds about 1 % of the light per steradian that the bow beside it does, so that
/// orders must be kept down to far less than the tolerance itself; measured against exact sums of
/// Debye terms (1.1 % error up to p = 7 at 120–150° for a tolerance of 1 %).
fn remainder_limit(tolerance: f64) -> f64 {
    0.035 * tolerance
}

/// The last order that matters for a sphere of this index.
pub fn last_order(index: f64, tolerance: f64) -> u32 {
    let left = left_inside(index, HIGHEST_ORDER);
    let limit = remainder_limit(tolerance);
    left.iter().position(|&rest| rest < limit).map_or(HIGHEST_ORDER, |p| p as u32).max(3)
}

/// Share of unpolarised light still inside a sphere after each order, by impact parameter.
fn left_inside(index: f64, last: u32) -> Vec<f64> {
    const RAYS: usize = 400;
    let mut left = vec![0.0; last as usize + 1];
    for i in 0..RAYS {
        let impact_squared = (i as f64 + 0.5) / RAYS as f64;
        if impact_squared >= index * index {
            continue; // totally reflected outside: nothing enters
        }
        let f = fresnel((1.0 - impact_squared).sqrt(), index.into());
        for (r, t) in [(f.r_perpendicular, f.t_perpendicular), (f.r_parallel, f.t_parallel)] {
            let (reflected, mut inside) = (r.norm_sqr(), t.norm_sqr());
            for share in &mut left {
                *share += 0.5 * inside / RAYS as f64;
                inside *= reflected;
            }
        }
    }
    // after order p the wave has been reflected p times inside; index 0: all that entered
    left
}

/// Rings of the patch grid: half the rays across where they are given, else by the tolerance, for
/// the error of the path falls with the cube of the step.
fn rings(rays_across: Option<usize>, tolerance: f64) -> usize {
    let chosen = || (200.0 * (0.01 / tolerance).cbrt()).clamp(40.0, 2000.0) as usize;
    rays_across.map_or_else(chosen, |rays| rays.div_ceil(2))
}
