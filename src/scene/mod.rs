//! The scene: `SceneFile` mirrors the TOML and the flags; `Scene` is validated and immutable.
//! After validation, physics does not fail.
//!
//! ```
//! use gonio::scene::{Scene, SceneFile};
//!
//! let scene = Scene::built_in(&SceneFile::default())?;
//! assert_eq!(scene.wavelengths.len(), 33);
//! # Ok::<(), gonio::scene::SceneError>(())
//! ```

mod choice;
mod contradictions;
mod error;
mod file;
mod files;
#[cfg(feature = "cli")]
mod flags;
mod grid;
mod modes;
mod orientation;
mod particle;
mod read;
mod shipped;
mod size;
mod sizes;
#[cfg(test)]
mod tests;
mod validate;

pub use choice::{AxisRatioKey, CantingKeys, Choice, LengthUnit, Named, ShapeName};
// Batches use them, and batches need HDF5.
pub use crate::math::bytes::human_bytes;
#[cfg(feature = "hdf5")]
pub(crate) use error::shown;
pub use error::{Place, SceneError};
pub use file::{AmountKeys, LightKeys, ModeKeys, ModelKeys, ParticleKeys, SceneFile, TableKeys};
pub use files::named_files;
#[cfg(feature = "hdf5")]
pub(crate) use files::read_limited;
pub use grid::{Grid, Range, Third};
pub(crate) use modes::WATER_DENSITIES;
pub use modes::{Amount, Mode};
pub use orientation::OrientationKey;
pub use read::SceneText;
#[cfg(feature = "hdf5")]
pub(crate) use read::line_at;
pub use shipped::{SHIPPED, SceneKind, Shipped};
pub use size::TableSize;
pub use sizes::SizeKeys;

use crate::medium::{Density, Medium};
use crate::phase_table::{ForwardPeak, Quantity};
use crate::shape::{AxisRatioLaw, Crystal, OwnBody, RaindropModel};
use crate::size_distribution::SizeDistribution;
use std::path::Path;

/// The scene that is taken where none is given: a raindrop of 0.5 mm, the sun at 20°.
pub const BUILT_IN: &str = include_str!("../../data/scenes/raindrop.toml");

/// What scatters. Radii are those of the sphere of equal volume, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Particle {
    /// A sphere.
    Sphere {
        /// Metres.
        radius: f64,
    },
    /// `axis_ratio` is vertical over horizontal diameter.
    Spheroid {
        /// Metres.
        radius: f64,
        /// Vertical over horizontal diameter.
        axis_ratio: f64,
    },
    /// A falling raindrop.
    Raindrop {
        /// Metres.
        radius: f64,
        /// Who gives its shape.
        model: RaindropModel,
    },
    /// A crystal or prism of flat facets.
    Crystal {
        /// Metres.
        radius: f64,
        /// Its proportions.
        crystal: Crystal,
    },
    /// A body that no key of a scene file names: see [`Scene::with_own_body`].
    Own {
        /// Metres.
        radius: f64,
        /// Its outline.
        body: OwnBody,
    },
}

/// How the axes of particles stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// Vertically; crystals are turned about it at random.
    Upright,
    /// In all directions alike.
    Random,
    /// Horizontally, in all azimuths alike (crystals).
    Horizontal,
    /// As [`Scene::fixed_angles`] says (crystals).
    Fixed,
}

/// How scattering is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Lorenz–Mie for a sphere, the T-matrix where one converges at a cost that is allowed, rays otherwise.
    Auto,
    /// Rays traced with phase, on any particle.
    Rays,
    /// The Lorenz–Mie series, on spheres.
    Mie,
    /// Single orders of the Lorenz–Mie series, on spheres.
    Debye,
    /// The T-matrix, on bodies of revolution.
    TMatrix,
    /// Beams of flat facets, on crystals and prisms.
    Facets,
}

/// Which waves add as amplitudes; the others add as powers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interference {
    /// All of a particle.
    Waves,
    /// None.
    Powers,
    /// Those of one order: what is left of interference in a mean over sizes.
    WithinOrders,
}

/// Diffraction in the ray method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diffraction {
    /// Rays alone.
    None,
    /// The Gaussian filter of Sadeghi et al. 2012.
    Gaussian,
    /// Uniform Airy functions at every fold caustic, and the silhouette's forward diffraction.
    Airy,
}

/// What the sun's disc of 0.53° does to a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SunDisc {
    /// The light comes from a point.
    None,
    /// The disc is equally bright everywhere.
    Uniform,
    /// It is darker and redder towards its rim.
    LimbDarkened,
}

/// Orders to be summed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Orders {
    /// All that matter at the tolerance, and forward diffraction.
    Auto,
    /// Just these (number of chords).
    List(Vec<u32>),
}

/// A validated scene. Units: metres, radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// With a distribution of sizes the sphere of the effective radius.
    pub particle: Particle,
    /// Many sizes in place of one.
    pub size_distribution: Option<SizeDistribution>,
    /// Several kinds of particles in place of one; what is said of one particle here is then said of the
    /// first of them.
    pub modes: Vec<Mode>,
    /// How many particles a volume holds, where that is told.
    pub amount: Option<Amount>,
    /// How its axis stands.
    pub orientation: Orientation,
    /// Where that is fixed: the axis from the vertical, the azimuth of its tilt (0: away from the sun), and a
    /// turn about the axis; radians.
    pub fixed_angles: [f64; 3],
    /// Orientations in a mean; `None`: chosen.
    pub orientations: Option<u32>,
    /// Axis ratio of a spheroid by its size, in place of that of the particle above.
    pub axis_ratio_law: Option<AxisRatioLaw>,
    /// Standard deviation of its axis about the vertical, in each of two planes, radians; 0: upright.
    pub canting: f64,
    /// What the particle is made of.
    pub medium: Medium,
    /// Of the medium, where it is known.
    pub density: Option<Density>,
    /// Sun above the horizon, radians.
    pub sun_elevation: f64,
    /// Wavelengths in vacuum, metres.
    pub wavelengths: Vec<f64>,
    /// Full width at half maximum of the band that each wavelength stands for; 0: none.
    pub bandwidth: f64,
    /// What the sun's disc does.
    pub sun_disc: SunDisc,
    /// Scattering angles, radians.
    pub theta: Vec<f64>,
    /// Azimuths, radians.
    pub phi: Vec<f64>,
    /// What is tabulated.
    pub quantity: Quantity,
    /// How the forward peak enters.
    pub forward_peak: ForwardPeak,
    /// Bits of the mantissa that the file keeps of each value; `None`: all.
    pub bit_round: Option<u8>,
    /// Who computes.
    pub method: Method,
    /// Which rays interfere.
    pub interference: Interference,
    /// How rays diffract.
    pub diffraction: Diffraction,
    /// Orders to be summed.
    pub orders: Orders,
    /// Relative error asked for.
    pub tolerance: f64,
    /// A mean that misses the tolerance is marked in the table rather than a failure.
    pub allow_unmet_tolerance: bool,
    /// Rays across the silhouette; `None`: chosen from the tolerance.
    pub rays_across: Option<usize>,
    /// The scene resolved, as TOML, for the record.
    pub toml: String,
}

impl Scene {
    /// Read and check a scene file; every key that `flags` gives replaces that of the file.
    ///
    /// # Errors
    /// With the line of the file, or the flag, the value and what is accepted.
    pub fn load(path: &Path, flags: &SceneFile) -> Result<Scene, SceneError> {
        Scene::from_text(SceneText::load(path)?, flags)
    }

    /// The built-in scene, with what `flags` gives replaced.
    ///
    /// # Errors
    /// As for [`Scene::load`].
    pub fn built_in(flags: &SceneFile) -> Result<Scene, SceneError> {
        Scene::from_text(SceneText::parse("built-in scene", BUILT_IN.to_string())?, flags)
    }

    /// Check a scene that was read.
    ///
    /// # Errors
    /// As for [`Scene::load`].
    pub fn from_text(text: SceneText, flags: &SceneFile) -> Result<Scene, SceneError> {
        let merged = text.file.clone().overridden_by(flags);
        merged.validate_in(&text.folder).map_err(|error| {
            error.placed(|key| if flags.has(key) { Place::flag(key) } else { text.place_of(key) })
        })
    }
}
