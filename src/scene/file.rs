//! `SceneFile`: the keys of a scene as they are written, none of them checked yet.
//!
//! Each key stands here once: as a key of the file, as a field, as a flag of the same name, and in the
//! list of what is known. Every key is optional, because a flag may give what the file does not;
//! [`SceneFile::overridden_by`] lays flags over a file.

use super::choice::{AxisRatioKey, CantingKeys, Choice, LengthUnit, ShapeName};
#[cfg(feature = "cli")]
use super::flags::{coating, coefficients, index, medium, outside, word};
use super::grid::Grid;
use super::orientation::OrientationKey;
use super::sizes::SizeKeys;
use super::{Diffraction, Interference, Method, Orders, SunDisc};
use crate::medium::{FilmSpec, MediumSpec};
use crate::phase_table::{ForwardPeak, Quantity};
use crate::shape::RaindropModel;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A scene as written: one field per section.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::Args))]
#[serde(deny_unknown_fields, default)]
pub struct SceneFile {
    /// `[particle]`.
    #[cfg_attr(feature = "cli", command(flatten))]
    pub particle: ParticleKeys,
    /// `[[particles]]`: several kinds of particles in place of `[particle]`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "cli", arg(skip))]
    pub particles: Vec<ModeKeys>,
    /// `[amount]`.
    #[serde(skip_serializing_if = "AmountKeys::is_empty")]
    #[cfg_attr(feature = "cli", command(flatten))]
    pub amount: AmountKeys,
    /// `[light]`.
    #[cfg_attr(feature = "cli", command(flatten))]
    pub light: LightKeys,
    /// `[table]`.
    #[cfg_attr(feature = "cli", command(flatten))]
    pub table: TableKeys,
    /// `[model]`.
    #[cfg_attr(feature = "cli", command(flatten))]
    pub model: ModelKeys,
}

/// The keys of one section: of each its words for `--help`, its name, its kind, and how its flag is read;
/// then fields that are flags only.
macro_rules! section {
    (
        $(#[doc = $about:literal])*
        $name:ident, $heading:literal {
            $( $(#[doc = $doc:literal])* $key:ident: $kind:ty [$($flag:tt)*] )*
        } $(flags {
            $( $(#[doc = $only_doc:literal])* $only:ident: $only_kind:ty [$($only_flag:tt)*] )*
        })?
    ) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "cli", derive(clap::Args), command(next_help_heading = $heading))]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            $(
                $(#[doc = $doc])*
                #[serde(skip_serializing_if = "Option::is_none")]
                #[cfg_attr(feature = "cli", arg(long, $($flag)*))]
                pub $key: Option<$kind>,
            )*
            $($(
                $(#[doc = $only_doc])*
                #[serde(skip)]
                #[cfg_attr(feature = "cli", arg(long, $($only_flag)*))]
                pub $only: Option<$only_kind>,
            )*)?
        }

        impl $name {
            const KEYS: &'static [&'static str] = &[$(stringify!($key)),*];

            /// With everything of `below` that is not given here.
            fn over(self, below: Self) -> Self {
                Self {
                    $($key: self.$key.or(below.$key),)*
                    $($($only: self.$only.or(below.$only),)*)?
                }
            }
        }
    };
}

/// Coefficients of a series, from the zeroth on.
pub type Coefficients = Vec<f64>;

/// Films from inside out.
pub type Films = Vec<FilmSpec>;

section! {
    /// `[particle]`: what scatters. Exactly one of the three sizes, that of the sphere of equal
    /// volume, or a distribution of sizes is to be given.
    ParticleKeys, "Particle" {
        /// Kind of particle
        shape: Choice<ShapeName> [value_parser = word::<ShapeName>()]
        /// Radius of the sphere of equal volume
        radius_mm: f64 [value_name = "MM", allow_negative_numbers = true]
        /// The same in micrometres
        radius_um: f64 [value_name = "UM", allow_negative_numbers = true,
            conflicts_with = "radius_mm"]
        /// Diameter of the sphere of equal volume
        diameter_mm: f64 [value_name = "MM", allow_negative_numbers = true,
            conflicts_with_all = ["radius_mm", "radius_um"]]
        /// Many sizes: kind = "gamma", effective_radius_um = 10, effective_variance = 0.1
        size_distribution: SizeKeys [value_name = "TABLE",
            conflicts_with_all = ["radius_mm", "radius_um", "diameter_mm"]]
        /// Vertical over horizontal diameter of a spheroid; length over width of a crystal
        axis_ratio: AxisRatioKey [value_name = "RATIO|LAW", allow_negative_numbers = true]
        /// Wedge of a triangular prism, or angle between opposite facets of a crystal's pyramid
        apex_deg: f64 [value_name = "DEG", allow_negative_numbers = true]
        /// Outline of harmonics: c_0, c_1, … of r(θ) = Σ c_n cos nθ, θ from straight down
        coefficients: Coefficients [value_name = "LIST", value_parser = coefficients,
            allow_hyphen_values = true]
        /// Exponent of a superellipsoid: 2 is a spheroid
        exponent: f64 [value_name = "M", allow_negative_numbers = true]
        /// Mesh of a closed convex body: OBJ, STL or PLY
        file: PathBuf [id = "particle_file", value_name = "MESH"]
        /// Unit of the mesh's coordinates, in place of a size: nm, um, mm, m
        file_unit: Choice<LengthUnit> [value_parser = word::<LengthUnit>(),
            conflicts_with_all = ["radius_mm", "radius_um", "diameter_mm"]]
        /// Tilts of the axis: deviation_deg = 7 (drops by rays, crystals)
        canting: CantingKeys [value_name = "DEG", allow_negative_numbers = true]
        /// Axis upright, random, horizontal, or kind = "fixed", zenith_deg = 90
        orientation: OrientationKey [value_parser = OrientationKey::parse]
        /// Shape model of a raindrop
        model: Choice<RaindropModel> [value_parser = word::<RaindropModel>()]
        /// Temperature of the medium
        temperature_c: f64 [value_name = "C", allow_negative_numbers = true]
        /// Medium of the particle: a name, a file, or a table as in a scene file
        medium: MediumSpec [value_name = "NAME", value_parser = medium]
        /// Medium around the particle: a name, an index, or a table (default: vacuum)
        outside: MediumSpec [value_name = "NAME|N", value_parser = outside]
        /// Films on it, from inside out: [{ medium = "ethanol", thickness_nm = 100 }]
        coating: Films [value_name = "LIST", value_parser = coating]
        /// Density of the medium, for whatever is told per mass (default: the library's)
        density_kg_m3: f64 [value_name = "KG_M3", allow_negative_numbers = true]
    } flags {
        /// Constant index n+ik of the particle in place of a medium
        index: [f64; 2] [value_name = "N[+K]", value_parser = index, conflicts_with = "medium"]
    }
}

section! {
    /// `[amount]`: how many particles a volume holds. At most one of them.
    AmountKeys, "Amount" {
        /// Water that falls out of the volume
        rain_rate_mm_h: f64 [value_name = "MM_H", allow_negative_numbers = true]
        /// Particles per volume
        number_per_cm3: f64 [value_name = "PER_CM3", allow_negative_numbers = true,
            conflicts_with = "rain_rate_mm_h"]
        /// Mass of the particles per volume
        water_content_g_m3: f64 [value_name = "G_M3", allow_negative_numbers = true,
            conflicts_with_all = ["rain_rate_mm_h", "number_per_cm3"]]
    }
}

section! {
    /// `[light]`: what shines on it.
    LightKeys, "Light" {
        /// Sun above the horizon
        sun_elevation_deg: f64 [value_name = "DEG", allow_negative_numbers = true]
        /// Wavelengths in vacuum: FROM:TO:COUNT, FROM:TO:sSTEP or A,B,C
        wavelengths_nm: Grid [value_name = "NM", allow_hyphen_values = true]
        /// Frequencies in place of wavelengths, GHz, as these
        frequencies_ghz: Grid [value_name = "GHZ", allow_hyphen_values = true,
            conflicts_with = "wavelengths_nm"]
        /// Full width at half maximum of the band that each wavelength stands for (spheres)
        bandwidth_nm: f64 [value_name = "NM", allow_negative_numbers = true]
        /// Mean over the sun's disc (spheres; many sizes or tilts by rays)
        sun_disc: Choice<SunDisc> [value_parser = word::<SunDisc>()]
    }
}

section! {
    /// `[table]`: what is tabulated, and where.
    TableKeys, "Table" {
        /// Unpolarised phase function, or all Mueller elements
        quantity: Choice<Quantity> [value_parser = word::<Quantity>()]
        /// How the forward diffraction peak enters
        forward_peak: Choice<ForwardPeak> [value_parser = word::<ForwardPeak>()]
        /// Keep so many bits of each value's mantissa, for a smaller file
        bit_round: u8 [value_name = "BITS"]
        /// Scattering angles: FROM:TO:COUNT, FROM:TO:sSTEP or A,B,C
        theta_deg: Grid [value_name = "DEG", allow_hyphen_values = true]
        /// Azimuths: FROM:TO:COUNT, FROM:TO:sSTEP or A,B,C
        azimuth_deg: Grid [value_name = "DEG", allow_hyphen_values = true]
    }
}

section! {
    /// `[model]`: how it is computed.
    ModelKeys, "Model" {
        /// Rays, an exact series for spheres, the T-matrix, facets of crystals, or whichever suits
        method: Choice<Method> [value_parser = word::<Method>()]
        /// Add rays with their phases: all, those of one order, or none
        interference: Interference [value_name = "true|false|within-orders"]
        /// Diffraction in the ray method
        diffraction: Choice<Diffraction> [value_parser = word::<Diffraction>()]
        /// `auto`, or a list such as 0,1,2
        orders: Orders [value_name = "LIST", allow_hyphen_values = true]
        /// Relative error asked for
        tolerance: f64 [value_name = "ERROR", allow_negative_numbers = true]
        /// Rays across the silhouette (default: chosen from the tolerance)
        rays_across: u32 [value_name = "N"]
        /// Have a mean that misses the tolerance marked in the table, in place of a failure
        allow_unmet_tolerance: bool [num_args = 0..=1, default_missing_value = "true",
            value_name = "true|false"]
    }
}

/// Known keys by section.
pub(super) const KEYS: [(&str, &[&str]); 5] = [
    ("particle", ParticleKeys::KEYS),
    ("amount", AmountKeys::KEYS),
    ("light", LightKeys::KEYS),
    ("table", TableKeys::KEYS),
    ("model", ModelKeys::KEYS),
];

/// `[[particles]]`, known keys of each: those of `[particle]` and its share.
pub(super) const MODES: &str = "particles";

/// One kind of particles among several, and its share.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ModeKeys {
    /// Share of the number of particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub number_fraction: Option<f64>,
    /// Share of their volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_fraction: Option<f64>,
    /// Share of their mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_fraction: Option<f64>,
    /// What they are.
    #[serde(flatten)]
    pub particle: ParticleKeys,
}

impl ModeKeys {
    const SHARES: [&'static str; 3] = ["number_fraction", "volume_fraction", "mass_fraction"];

    /// All keys.
    pub(super) fn keys() -> Vec<&'static str> {
        ParticleKeys::KEYS.iter().copied().chain(Self::SHARES).collect()
    }
}

impl AmountKeys {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl SceneFile {
    /// This scene with everything replaced that `flags` gives.
    pub fn overridden_by(mut self, flags: &SceneFile) -> SceneFile {
        self.model = self.model.of_shape(flags.particle.shape, self.particle.shape);
        SceneFile {
            particle: self.particle.overridden_by(&flags.particle),
            amount: match flags.amount.is_empty() {
                true => self.amount,
                // one amount replaces another
                false => flags.amount.clone().over(AmountKeys::default()),
            },
            particles: self.particles,
            light: self.light.overridden_by(&flags.light),
            table: flags.table.clone().over(self.table),
            model: self.model.overridden_by(&flags.model),
        }
    }

    /// True if the dotted key, such as `particle.radius_mm`, has a value.
    pub fn has(&self, key: &str) -> bool {
        let Ok(table) = toml::Table::try_from(self) else { return false };
        let Some((section, name)) = key.split_once('.') else { return false };
        table.get(section).is_some_and(|section| section.get(name).is_some())
    }
}

impl ParticleKeys {
    fn overridden_by(mut self, flags: &ParticleKeys) -> ParticleKeys {
        // Another size replaces the size in whatever unit; another shape its own parameters.
        let size = flags.radius_mm.or(flags.radius_um).or(flags.diameter_mm);
        if size.is_some() || flags.size_distribution.is_some() {
            (self.radius_mm, self.radius_um, self.diameter_mm) = (None, None, None);
            (self.size_distribution, self.file_unit) = (None, None);
        }
        if flags.file_unit.is_some() {
            (self.radius_mm, self.radius_um, self.diameter_mm) = (None, None, None);
        }
        if flags.shape.is_some() && flags.shape != self.shape {
            (self.axis_ratio, self.model, self.apex_deg) = (None, None, None);
            (self.file, self.file_unit) = (None, None);
            (self.coefficients, self.exponent) = (None, None);
        }
        if flags.medium.is_some() {
            (self.temperature_c, self.density_kg_m3) = (None, None);
        }
        flags.clone().over(self)
    }
}

impl LightKeys {
    fn overridden_by(mut self, flags: &LightKeys) -> LightKeys {
        // Wavelengths replace frequencies, and the other way round.
        if flags.wavelengths_nm.is_some() || flags.frequencies_ghz.is_some() {
            (self.wavelengths_nm, self.frequencies_ghz) = (None, None);
        }
        flags.clone().over(self)
    }
}

impl ModelKeys {
    /// What a scene said of its own kind of body is not said of facets in its place, and the other way round.
    fn of_shape(
        mut self,
        new: Option<Choice<ShapeName>>,
        old: Option<Choice<ShapeName>>,
    ) -> ModelKeys {
        let faceted = |shape: Choice<ShapeName>| shape.0.is_crystal();
        if new.is_some_and(|new| old.is_some_and(|old| faceted(old) != faceted(new))) {
            (self.method, self.interference, self.diffraction) = (None, None, None);
            (self.orders, self.rays_across) = (None, None);
        }
        self
    }

    fn overridden_by(mut self, flags: &ModelKeys) -> ModelKeys {
        // Another method replaces what goes with rays alone.
        let series = [Method::Mie, Method::Debye, Method::TMatrix, Method::Facets]
            .map(|method| Some(Choice(method)));
        if series.contains(&flags.method) && flags.method != self.method {
            (self.interference, self.diffraction, self.rays_across) = (None, None, None);
        }
        flags.clone().over(self)
    }
}
