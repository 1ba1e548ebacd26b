//! What a picture would draw of light scattered many times, before anything is computed.

use super::drops::DropKeys;
use super::{BowError, BowScene, USUAL_SUN, drops};
use crate::render::layer::{LayerLight, LayerSky, Place, Scattering};
use crate::series::lorenz_mie::Sphere;
use crate::transfer::{Expansion, Layer};
use std::f64::consts::TAU;
use std::path::Path;

/// Wavelength of the estimate, metres.
const MIDDLE: f64 = 550e-9;
/// Size parameter of spheres that stand for all larger ones: beyond, only the forward peak changes, which counts as not
/// scattered.
const LARGEST: f64 = 400.0;
/// Coefficients that the estimate's streams look at.
const COEFFICIENTS: usize = 33;

impl BowScene {
    /// How much of the light is scattered more often than once, and whether it is drawn, in words: by a coarse solution for
    /// spheres of the volume of the drops.
    ///
    /// # Errors
    /// Keys that make no sense.
    pub fn plan(&self, folder: &Path) -> Result<Vec<String>, BowError> {
        let elevation = self.sun.elevation_deg.unwrap_or(USUAL_SUN).to_radians();
        self.sky(elevation)?;
        self.camera(elevation)?;
        let asked = self.layer(elevation)?;
        let depth = self.rain.optical_depth.unwrap_or(1.0);
        let layer = asked.clone().unwrap_or_else(|| LayerSky::new(depth, Place::Curtain));
        layer.check(elevation)?;
        let mut phase = Expansion::zero(COEFFICIENTS);
        let (mut scattered, mut lost) = (0.0, 0.0);
        for kind in &self.drops {
            let (expansion, [scattering, extinction]) = of_kind(kind, folder, elevation)?;
            phase.add(&expansion, scattering);
            scattered += scattering;
            lost += extinction;
        }
        if scattered.is_nan() || scattered <= 0.0 {
            let message = "drops: none given; add [[drops]] to the scene";
            return Err(BowError::Keys(message.into()));
        }
        let mut mean = Expansion::zero(COEFFICIENTS);
        mean.add(&phase, 1.0 / scattered);
        let whole = Layer {
            optical_depth: layer.optical_depth,
            albedo: (scattered / lost).min(1.0),
            phase: &mean,
            peak: 0.0,
            ground_albedo: layer.ground_albedo,
        };
        let share = layer.share_of_more(whole, layer.place.sun(elevation))?;
        Ok(match asked {
            Some(layer) => {
                let single = match layer.scattering {
                    Scattering::Auto => share <= LayerSky::limit(),
                    Scattering::Single => true,
                    Scattering::Multiple => false,
                };
                vec![layer.words(share, single)]
            }
            None => vec![rain_in_words(depth, share)],
        })
    }
}

/// The same of rain, which is drawn by light scattered once.
fn rain_in_words(depth: f64, share: f64) -> String {
    let (percent, limit) = (100.0 * share, 100.0 * LayerSky::limit());
    let enough = if share <= LayerSky::limit() {
        "is enough"
    } else {
        "is not enough; [layer] with an optical_depth in place of [rain] draws the rest"
    };
    format!(
        "rain of optical depth {depth} is drawn by light scattered once; a curtain of it sends back {percent:.1} % by more \
         scatterings (limit {limit:.0} %): light scattered once {enough}"
    )
}

/// Expansion of a kind of drops, and its cross-sections times its number.
fn of_kind(
    kind: &DropKeys,
    folder: &Path,
    elevation: f64,
) -> Result<(Expansion, [f64; 2]), BowError> {
    let number = kind.number.unwrap_or(1.0);
    if let Some(name) = &kind.table {
        let table = crate::hdf5::read(&folder.join(name))?;
        let (phase, sections) = LayerLight::mean_phase(&table, COEFFICIENTS)?;
        return Ok((phase, sections.map(|section| number * section)));
    }
    let wanted = drops::Wanted {
        sun_elevation_deg: elevation.to_degrees(),
        sun_disc: false,
        polarised: false,
        layer: true,
    };
    let scene = kind.scene_of(folder, wanted)?;
    let mut phase = Expansion::zero(COEFFICIENTS);
    let (mut scattered, mut lost) = (0.0, 0.0);
    for part in scene.parts() {
        let radius = part.particle.radius();
        let size_parameter = (TAU * radius / MIDDLE).min(LARGEST);
        let sphere = Sphere::new(size_parameter, part.medium.index(MIDDLE)?)?;
        let mut own = Expansion::zero(COEFFICIENTS);
        let chi = sphere.legendre(COEFFICIENTS);
        own.alpha[0] = chi.iter().enumerate().map(|(l, chi)| (2 * l + 1) as f64 * chi).collect();
        let efficiencies = sphere.efficiencies();
        let area = number * radius * radius;
        phase.add(&own, area * efficiencies.q_sca);
        scattered += area * efficiencies.q_sca;
        lost += area * efficiencies.q_ext;
    }
    let mut mean = Expansion::zero(COEFFICIENTS);
    mean.add(&phase, 1.0 / scattered);
    Ok((mean, [scattered, lost]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planned(text: &str) -> String {
        let scene: BowScene = text.parse().unwrap();
        scene.plan(Path::new(".")).unwrap().join("\n")
    }

    /// Thin showers are drawn by light scattered once, thick ones by all, and scenes of rain say what they lack.
    #[test]
    fn depth_decides() {
        let drops = "[[drops]]\nradius_mm = 0.4";
        let thin = planned(&format!("[layer]\noptical_depth = 0.003\n{drops}"));
        assert!(
            thin.contains("scattered once is enough") && thin.contains("it alone is drawn"),
            "{thin}"
        );
        let thick = planned(&format!("[layer]\noptical_depth = 3\n{drops}"));
        assert!(thick.contains("is not enough") && thick.contains("all orders"), "{thick}");
        let forced =
            planned(&format!("[layer]\noptical_depth = 3\nscattering = 'single'\n{drops}"));
        assert!(
            forced.contains("is not enough") && forced.contains("it alone is drawn"),
            "{forced}"
        );
        let rain = planned(&format!("[rain]\noptical_depth = 0.8\n{drops}"));
        assert!(rain.contains("[layer] with an optical_depth"), "{rain}");
    }
}
