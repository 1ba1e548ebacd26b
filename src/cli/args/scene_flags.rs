//! A flag for every key of a scene file, of the same name; flags win over the file.

use crate::cli::show::notes;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use gonio::medium::MediumSpec;
use gonio::phase_table::{ForwardPeak, Quantity};
use gonio::scene::{
    Choice, Diffraction, Grid, LightKeys, Method, ModelKeys, Named, Orders, ParticleKeys, Scene,
    SceneError, SceneFile, ShapeName, SizeKeys, SunDisc, TableKeys,
};
use gonio::shape::RaindropModel;
use std::path::Path;

/// All keys of a scene.
#[derive(Args, Clone, Debug, Default)]
pub struct SceneFlags {
    #[command(flatten)]
    pub particle: ParticleFlags,
    #[command(flatten)]
    pub light: LightFlags,
    #[command(flatten)]
    pub table: TableFlags,
    #[command(flatten)]
    pub model: ModelFlags,
}

/// What scatters.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Particle")]
pub struct ParticleFlags {
    /// Kind of particle
    #[arg(long, value_parser = word::<ShapeName>())]
    pub shape: Option<Choice<ShapeName>>,
    /// Radius of the sphere of equal volume
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub radius_mm: Option<f64>,
    /// The same in micrometres
    #[arg(long, value_name = "UM", allow_negative_numbers = true, conflicts_with = "radius_mm")]
    pub radius_um: Option<f64>,
    /// Diameter of the sphere of equal volume
    #[arg(long, value_name = "MM", allow_negative_numbers = true,
          conflicts_with_all = ["radius_mm", "radius_um"])]
    pub diameter_mm: Option<f64>,
    /// Many spheres: kind = "gamma", effective_radius_um = 10, effective_variance = 0.1
    #[arg(long, value_name = "TABLE",
          conflicts_with_all = ["radius_mm", "radius_um", "diameter_mm"])]
    pub size_distribution: Option<SizeKeys>,
    /// Vertical over horizontal diameter of a spheroid
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    pub axis_ratio: Option<f64>,
    /// Shape model of a raindrop
    #[arg(long, value_parser = word::<RaindropModel>())]
    pub model: Option<Choice<RaindropModel>>,
    /// Medium of the particle: a name, a file, or a table as in a scene file
    #[arg(long, value_name = "NAME", value_parser = parse_medium)]
    pub medium: Option<MediumSpec>,
    /// Constant index n+ik of the particle in place of a medium
    #[arg(long, value_name = "N[+K]", value_parser = parse_index, conflicts_with = "medium")]
    pub index: Option<[f64; 2]>,
    /// Temperature of the medium
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    pub temperature_c: Option<f64>,
    /// Density of the medium, for whatever is told per mass (default: the library's)
    #[arg(long, value_name = "KG_M3", allow_negative_numbers = true)]
    pub density_kg_m3: Option<f64>,
}

/// What shines on it.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Light")]
pub struct LightFlags {
    /// Sun above the horizon
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub sun_elevation_deg: Option<f64>,
    /// Wavelengths in vacuum: FROM:TO:COUNT or A,B,C
    #[arg(long, value_name = "NM", allow_hyphen_values = true)]
    pub wavelengths_nm: Option<Grid>,
    /// Full width at half maximum of the band that each wavelength stands for (spheres)
    #[arg(long, value_name = "NM", allow_negative_numbers = true)]
    pub bandwidth_nm: Option<f64>,
    /// Mean over the sun's disc (spheres)
    #[arg(long, value_parser = word::<SunDisc>())]
    pub sun_disc: Option<Choice<SunDisc>>,
}

/// What is tabulated, and where.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Table")]
pub struct TableFlags {
    /// Scattering angles: FROM:TO:COUNT or A,B,C
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub theta_deg: Option<Grid>,
    /// Azimuths: FROM:TO:COUNT or A,B,C
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub azimuth_deg: Option<Grid>,
    /// Unpolarised phase function, or all Mueller elements
    #[arg(long, value_parser = word::<Quantity>())]
    pub quantity: Option<Choice<Quantity>>,
    /// How the forward diffraction peak enters
    #[arg(long, value_parser = word::<ForwardPeak>())]
    pub forward_peak: Option<Choice<ForwardPeak>>,
    /// Keep so many bits of each value's mantissa, for a smaller file
    #[arg(long, value_name = "BITS")]
    pub bit_round: Option<u8>,
}

/// How it is computed.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Model")]
pub struct ModelFlags {
    /// Rays, an exact series for spheres, or whichever suits
    #[arg(long, value_parser = word::<Method>())]
    pub method: Option<Choice<Method>>,
    /// Add rays with their phases
    #[arg(long, value_name = "true|false")]
    pub interference: Option<bool>,
    /// Diffraction in the ray method
    #[arg(long, value_parser = word::<Diffraction>())]
    pub diffraction: Option<Choice<Diffraction>>,
    /// `auto`, or a list such as 0,1,2
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pub orders: Option<Orders>,
    /// Relative error asked for
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Rays across the silhouette (default: chosen from the tolerance)
    #[arg(long, value_name = "N")]
    pub rays_across: Option<u32>,
    /// Have a mean that misses the tolerance marked in the table, in place of a failure
    #[arg(long, num_args = 0..=1, default_missing_value = "true", value_name = "true|false")]
    pub allow_unmet_tolerance: Option<bool>,
}

/// Parser of a word from a closed set; `--help` lists the set.
fn word<T: Named + Send + Sync>() -> impl TypedValueParser<Value = Choice<T>> {
    PossibleValuesParser::new(T::NAMES.iter().map(|(name, _)| *name))
        .try_map(|word| T::from_name(&word).map(Choice))
}

/// `1.333`, `1.333+0.001`, as in [`gonio::medium::parse_index`].
pub fn parse_index(text: &str) -> Result<[f64; 2], String> {
    let index = gonio::medium::parse_index(text).map_err(|error| error.to_string())?;
    Ok([index.re, index.im])
}

/// `water`, `glass.yml`, `{ solute = … }`
fn parse_medium(text: &str) -> Result<MediumSpec, String> {
    MediumSpec::parse(text).map_err(|error| error.to_string())
}

impl ParticleFlags {
    /// As keys of a scene.
    pub fn keys(&self) -> ParticleKeys {
        let constant = self.index.map(|index| MediumSpec::Index { n: index[0], k: index[1] });
        let medium = constant.or_else(|| self.medium.clone());
        ParticleKeys {
            shape: self.shape,
            radius_mm: self.radius_mm,
            radius_um: self.radius_um,
            diameter_mm: self.diameter_mm,
            size_distribution: self.size_distribution,
            axis_ratio: self.axis_ratio,
            model: self.model,
            temperature_c: self.temperature_c,
            medium,
            density_kg_m3: self.density_kg_m3,
        }
    }
}

impl SceneFlags {
    /// As keys of a scene.
    pub fn keys(&self) -> SceneFile {
        let (light, table, model) = (self.light.clone(), self.table.clone(), self.model.clone());
        SceneFile {
            particle: self.particle.keys(),
            light: LightKeys {
                sun_elevation_deg: light.sun_elevation_deg,
                wavelengths_nm: light.wavelengths_nm,
                bandwidth_nm: light.bandwidth_nm,
                sun_disc: light.sun_disc,
            },
            table: TableKeys {
                quantity: table.quantity,
                forward_peak: table.forward_peak,
                bit_round: table.bit_round,
                theta_deg: table.theta_deg,
                azimuth_deg: table.azimuth_deg,
            },
            model: ModelKeys {
                method: model.method,
                interference: model.interference,
                diffraction: model.diffraction,
                orders: model.orders,
                tolerance: model.tolerance,
                rays_across: model.rays_across,
                allow_unmet_tolerance: model.allow_unmet_tolerance,
            },
        }
    }

    /// The scene of a file, or the built-in one, with the flags laid over it.
    pub fn scene(&self, path: Option<&Path>) -> Result<Scene, SceneError> {
        let scene = match path {
            Some(path) => Scene::load(path, &self.keys()),
            None => Scene::built_in(&self.keys()),
        }?;
        notes::tell(scene.medium.notes());
        Ok(scene)
    }
}
