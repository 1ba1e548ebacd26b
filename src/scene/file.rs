//! `SceneFile`: the keys of a scene as they are written, none of them checked yet.
//!
//! Every key is optional here, because a flag of the same name may give it instead;
//! [`SceneFile::overridden_by`] lays flags over a file.

use super::choice::{Choice, ShapeName};
use super::grid::Grid;
use super::sizes::SizeKeys;
use super::{Diffraction, Method, Orders, SunDisc};
use crate::medium::MediumSpec;
use crate::phase_table::{ForwardPeak, Quantity};
use crate::shape::RaindropModel;
use serde::{Deserialize, Serialize};

/// A scene as written: one field per section.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SceneFile {
    /// What scatters.
    pub particle: ParticleKeys,
    /// What shines on it.
    pub light: LightKeys,
    /// What is tabulated.
    pub table: TableKeys,
    /// How it is computed.
    pub model: ModelKeys,
}

/// `[particle]`: what scatters. Exactly one of the three sizes, that of the sphere of equal
/// volume, or a distribution of sizes is to be given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ParticleKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Kind of body.
    pub shape: Option<Choice<ShapeName>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Radius of the sphere of equal volume, mm.
    pub radius_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Radius of the sphere of equal volume, µm.
    pub radius_um: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Diameter of the sphere of equal volume, mm.
    pub diameter_mm: Option<f64>,
    /// Many spheres in place of one: takes the place of the sizes above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_distribution: Option<SizeKeys>,
    /// Vertical over horizontal diameter of a spheroid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis_ratio: Option<f64>,
    /// Model of a raindrop's shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<Choice<RaindropModel>>,
    /// Temperature of the medium where its index depends on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature_c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// What the particle is made of.
    pub medium: Option<MediumSpec>,
    /// Density of the medium, where the library does not know it or it is another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
}

/// `[light]`: what shines on it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LightKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Sun above the horizon, degrees.
    pub sun_elevation_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Wavelengths in vacuum.
    pub wavelengths_nm: Option<Grid>,
    /// Each wavelength stands for a band of this full width at half maximum.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bandwidth_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Smoothing by the sun's disc.
    pub sun_disc: Option<Choice<SunDisc>>,
}

/// `[table]`: what is tabulated, and where.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TableKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    /// What is tabulated per direction.
    pub quantity: Option<Choice<Quantity>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// How the forward peak enters.
    pub forward_peak: Option<Choice<ForwardPeak>>,
    /// Keep this many bits of the mantissa of each value, for smaller files; absent: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bit_round: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Scattering angles, 0 = forward.
    pub theta_deg: Option<Grid>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Azimuths, 0 = upper vertical half-plane.
    pub azimuth_deg: Option<Grid>,
}

/// `[model]`: how it is computed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ModelKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Rays or an exact series.
    pub method: Option<Choice<Method>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Whether rays interfere.
    pub interference: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// How rays diffract.
    pub diffraction: Option<Choice<Diffraction>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    /// Orders summed.
    pub orders: Option<Orders>,
    /// Relative error asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Rays across the silhouette; absent: chosen from the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rays_across: Option<u32>,
    /// A mean that does not meet the tolerance makes a table that says so, in place of a failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allow_unmet_tolerance: Option<bool>,
}

/// Known keys by section, in the order of the structs above (a test compares the two).
pub(super) const KEYS: [(&str, &[&str]); 4] = [
    (
        "particle",
        &[
            "shape",
            "radius_mm",
            "radius_um",
            "diameter_mm",
            "size_distribution",
            "axis_ratio",
            "model",
            "temperature_c",
            "medium",
            "density_kg_m3",
        ],
    ),
    ("light", &["sun_elevation_deg", "wavelengths_nm", "bandwidth_nm", "sun_disc"]),
    ("table", &["quantity", "forward_peak", "bit_round", "theta_deg", "azimuth_deg"]),
    (
        "model",
        &[
            "method",
            "interference",
            "diffraction",
            "orders",
            "tolerance",
            "rays_across",
            "allow_unmet_tolerance",
        ],
    ),
];

impl SceneFile {
    /// This scene with everything replaced that `flags` gives.
    pub fn overridden_by(self, flags: &SceneFile) -> SceneFile {
        SceneFile {
            particle: self.particle.overridden_by(&flags.particle),
            light: self.light.overridden_by(&flags.light),
            table: self.table.overridden_by(&flags.table),
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
            self.size_distribution = None;
        }
        if flags.shape.is_some() && flags.shape != self.shape {
            (self.axis_ratio, self.model) = (None, None);
        }
        if flags.medium.is_some() {
            (self.temperature_c, self.density_kg_m3) = (None, None);
        }
        ParticleKeys {
            shape: flags.shape.or(self.shape),
            radius_mm: flags.radius_mm.or(self.radius_mm),
            radius_um: flags.radius_um.or(self.radius_um),
            diameter_mm: flags.diameter_mm.or(self.diameter_mm),
            size_distribution: flags.size_distribution.or(self.size_distribution),
            axis_ratio: flags.axis_ratio.or(self.axis_ratio),
            model: flags.model.or(self.model),
            temperature_c: flags.temperature_c.or(self.temperature_c),
            medium: flags.medium.clone().or(self.medium),
            density_kg_m3: flags.density_kg_m3.or(self.density_kg_m3),
        }
    }
}

impl LightKeys {
    fn overridden_by(self, flags: &LightKeys) -> LightKeys {
        LightKeys {
            sun_elevation_deg: flags.sun_elevation_deg.or(self.sun_elevation_deg),
            wavelengths_nm: flags.wavelengths_nm.clone().or(self.wavelengths_nm),
            bandwidth_nm: flags.bandwidth_nm.or(self.bandwidth_nm),
            sun_disc: flags.sun_disc.or(self.sun_disc),
        }
    }
}

impl TableKeys {
    fn overridden_by(self, flags: &TableKeys) -> TableKeys {
        TableKeys {
            quantity: flags.quantity.or(self.quantity),
            forward_peak: flags.forward_peak.or(self.forward_peak),
            bit_round: flags.bit_round.or(self.bit_round),
            theta_deg: flags.theta_deg.clone().or(self.theta_deg),
            azimuth_deg: flags.azimuth_deg.clone().or(self.azimuth_deg),
        }
    }
}

impl ModelKeys {
    fn overridden_by(mut self, flags: &ModelKeys) -> ModelKeys {
        // Another method replaces what goes with rays alone.
        let series = [Some(Choice(Method::Mie)), Some(Choice(Method::Debye))];
        if series.contains(&flags.method) && flags.method != self.method {
            (self.interference, self.diffraction, self.rays_across) = (None, None, None);
        }
        ModelKeys {
            method: flags.method.or(self.method),
            interference: flags.interference.or(self.interference),
            diffraction: flags.diffraction.or(self.diffraction),
            orders: flags.orders.clone().or(self.orders),
            tolerance: flags.tolerance.or(self.tolerance),
            rays_across: flags.rays_across.or(self.rays_across),
            allow_unmet_tolerance: flags.allow_unmet_tolerance.or(self.allow_unmet_tolerance),
        }
    }
}
