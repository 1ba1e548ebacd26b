//! The kinds of particles of a scene, `[particle]` or `[[particles]]`, and the share of each.
//!
//! Shares are fractions of the number, the volume or the mass of all particles. All are turned into
//! fractions of the number, for means are means per particle; particles count that lie inside the limits of
//! their distributions.

mod amount;

pub use amount::Amount;
pub(crate) use amount::WATER_DENSITIES;
pub(super) use amount::amount;

use super::choice::AxisRatioKey;
use super::error::SceneError;
use super::file::{ModeKeys, ParticleKeys, SceneFile};
use super::particle::medium::{density_of, medium_of};
use super::particle::{canting, particle_of, size_distribution};
use super::{Method, Orientation, Particle, Scene};
use crate::math::digits::to_digits;
use crate::medium::{Density, Medium};
use crate::shape::AxisRatioLaw;
use crate::size_distribution::SizeDistribution;
use std::f64::consts::TAU;
use std::path::Path;

/// One kind of particles.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Of the number of all particles.
    pub number_share: f64,
    /// With a distribution of sizes that of the effective radius.
    pub particle: Particle,
    /// Many sizes in place of one.
    pub size_distribution: Option<SizeDistribution>,
    /// How its axis stands.
    pub orientation: Orientation,
    /// Where that is fixed: zenith and azimuth of the axis, turn about it, radians.
    pub fixed_angles: [f64; 3],
    /// Orientations in a mean; `None`: chosen.
    pub orientations: Option<u32>,
    /// Axis ratio of a spheroid by its size.
    pub axis_ratio_law: Option<AxisRatioLaw>,
    /// Standard deviation of its axis about the vertical, in each of two planes, radians; 0: upright.
    pub canting: f64,
    /// What it is made of.
    pub medium: Medium,
    /// Of the medium, where it is known.
    pub density: Option<Density>,
}

/// Size parameter below which small raindrops are averaged as spheres by the exact series.
const BY_SERIES_BELOW: f64 = 300.0;
/// Fractions add up to 1 within this.
const ADD_UP: f64 = 1e-3;

impl Mode {
    fn new(keys: &ParticleKeys, folder: &Path, wavelengths: &[f64]) -> Result<Self, SceneError> {
        let size_distribution = size_distribution(keys, folder)?;
        let particle = particle_of(keys, size_distribution.as_ref(), folder)?;
        let radius = particle.radius();
        let stand = keys.orientation.map_or_else(|| Ok(Default::default()), |key| key.checked());
        let (fixed_angles, orientations) = stand?;
        let smallest = size_distribution.as_ref().map_or(radius, |sizes| sizes.bounds().0);
        Ok(Self {
            number_share: 1.0,
            particle,
            size_distribution,
            orientation: keys.orientation.map_or(Orientation::Upright, |key| key.kind),
            fixed_angles,
            orientations,
            axis_ratio_law: match keys.axis_ratio {
                Some(AxisRatioKey::Law(law)) => Some(law),
                _ => None,
            },
            canting: canting(keys)?,
            medium: medium_of(keys, folder, (smallest, radius), wavelengths)?,
            density: density_of(keys, wavelengths)?,
        })
    }

    /// Raindrops so small that they are spheres, and so small for a wavelength that the exact series average
    /// them sooner than rays would, are a kind of their own.
    fn split(self, longest: f64) -> Vec<Mode> {
        let (Particle::Raindrop { model, .. }, Some(sizes)) =
            (&self.particle, &self.size_distribution)
        else {
            return vec![self];
        };
        let Some(limit) = model.sphere_up_to() else { return vec![self] };
        let (from, to) = sizes.bounds();
        let border = (BY_SERIES_BELOW * longest / TAU).min(limit);
        if from >= limit || sizes.single().is_some() {
            return vec![self];
        }
        let between = |from, to| SizeDistribution::between(sizes.law().clone(), from, to).ok();
        let sphere = |sizes: SizeDistribution, number_share: f64| Mode {
            particle: Particle::Sphere { radius: sizes.effective_radius() },
            size_distribution: Some(sizes),
            number_share,
            ..self.clone()
        };
        if to <= limit {
            let sizes = sizes.clone();
            return vec![sphere(sizes, self.number_share)];
        }
        match (between(from, border), between(border, to)) {
            (Some(small), Some(large)) if from < border => {
                let share = sizes.moment(3.0);
                let (low, high) = (small.moment(3.0), large.moment(3.0));
                // of the mean volume of all, that of the parts by their numbers: low s + high (1 - s)
                let number = ((high - share) / (high - low)).clamp(0.0, 1.0);
                let large = Mode {
                    particle: Particle::Raindrop {
                        radius: large.effective_radius(),
                        model: *model,
                    },
                    size_distribution: Some(large),
                    number_share: self.number_share * (1.0 - number),
                    ..self.clone()
                };
                vec![sphere(small, self.number_share * number), large]
            }
            _ => vec![self],
        }
    }

    /// Mean of the cubed radius of equal volume, m³.
    fn cubed_radius(&self) -> f64 {
        let one = || self.particle.radius().powi(3);
        self.size_distribution.as_ref().map_or_else(one, |sizes| sizes.moment(3.0))
    }
}

/// All kinds of a scene: one of `[particle]`, or those of `[[particles]]`.
pub(super) fn modes(
    file: &SceneFile,
    folder: &Path,
    wavelengths: &[f64],
) -> Result<Vec<Mode>, SceneError> {
    let longest = wavelengths.iter().copied().fold(0.0, f64::max);
    let auto = file.model.method.is_none_or(|method| method.0 == Method::Auto);
    let split = |mode: Mode| if auto { mode.split(longest) } else { vec![mode] };
    if file.particles.is_empty() {
        return Ok(split(Mode::new(&file.particle, folder, wavelengths)?));
    }
    if file.particle != ParticleKeys::default() {
        let accepted = "the scene has [[particles]]; say what they are there, and leave out [particle] and \
                        its flags";
        return Err(SceneError::invalid("particle", "given", accepted));
    }
    let mut modes = Vec::new();
    for (place, keys) in file.particles.iter().enumerate() {
        let mode =
            Mode::new(&keys.particle, folder, wavelengths).map_err(|error| error.of_mode(place))?;
        modes.push(mode);
    }
    one_outside(&modes)?;
    for (mode, share) in modes.iter_mut().zip(shares(&file.particles)?) {
        let volume = match share.kind {
            "number_fraction" => 1.0,
            "volume_fraction" => mode.cubed_radius(),
            _ => {
                let unknown = || {
                    let accepted = "the medium's density is needed; give density_kg_m3, or the \
                                    volume_fraction";
                    SceneError::invalid("particles.mass_fraction", share.value, accepted)
                };
                mode.cubed_radius() * mode.density.as_ref().ok_or_else(unknown)?.kg_m3
            }
        };
        mode.number_share = share.value / volume;
    }
    let total: f64 = modes.iter().map(|mode| mode.number_share).sum();
    modes.iter_mut().for_each(|mode| mode.number_share /= total);
    Ok(modes.into_iter().flat_map(split).collect())
}

/// Particles of one volume are in one medium.
fn one_outside(modes: &[Mode]) -> Result<(), SceneError> {
    let outside = |mode: &Mode| mode.medium.surroundings().map(Medium::name);
    let first = modes.first().and_then(outside);
    match modes.iter().map(outside).find(|other| *other != first) {
        None => Ok(()),
        Some(other) => {
            let words = |name: Option<String>| name.unwrap_or_else(|| "vacuum".into());
            let accepted =
                format!("the first kind is in {}; all need the same outside", words(first));
            Err(SceneError::invalid("particles.outside", words(other), accepted))
        }
    }
}

struct Share {
    kind: &'static str,
    value: f64,
}

/// The shares as written: of one kind, adding up to 1.
fn shares(modes: &[ModeKeys]) -> Result<Vec<Share>, SceneError> {
    let kinds = |keys: &ModeKeys| {
        [
            ("number_fraction", keys.number_fraction),
            ("volume_fraction", keys.volume_fraction),
            ("mass_fraction", keys.mass_fraction),
        ]
    };
    let mut shares: Vec<Share> = Vec::new();
    for keys in modes {
        let given: Vec<Share> = kinds(keys)
            .into_iter()
            .filter_map(|(kind, value)| value.map(|value| Share { kind, value }))
            .collect();
        let [share] = <[Share; 1]>::try_from(given).map_err(|given: Vec<Share>| match given.first() {
            Some(share) => SceneError::invalid(
                &format!("particles.{}", share.kind),
                share.value,
                "the share is given twice; keep one of number_fraction, volume_fraction, mass_fraction",
            ),
            None => SceneError::missing(
                "particles.number_fraction",
                "each kind of particles needs its number_fraction, volume_fraction or mass_fraction",
            ),
        })?;
        let key = format!("particles.{}", share.kind);
        if !(share.value > 0.0 && share.value <= 1.0) {
            return Err(SceneError::invalid(&key, share.value, "above 0, up to 1 is accepted"));
        }
        if let Some(first) = shares.first().filter(|first| first.kind != share.kind) {
            let accepted = format!("the first kind has a {}; all need the same", first.kind);
            return Err(SceneError::invalid(&key, share.value, accepted));
        }
        shares.push(share);
    }
    let total: f64 = shares.iter().map(|share| share.value).sum();
    if (total - 1.0).abs() > ADD_UP {
        let key = format!("particles.{}", shares[0].kind);
        let values: Vec<f64> = shares.iter().map(|share| share.value).collect();
        let total = to_digits(total, 6);
        let accepted = format!("they add up to {total}, and not to 1");
        return Err(SceneError::invalid(&key, format!("{values:?}"), accepted));
    }
    Ok(shares)
}

impl Scene {
    /// The scene of each kind of its particles alone: one, where there is but one kind.
    ///
    /// ```
    /// use gonio::scene::{Scene, SceneFile};
    /// let scene = Scene::built_in(&SceneFile::default())?;
    /// assert_eq!(scene.parts(), [scene.clone()]);
    /// # Ok::<(), gonio::scene::SceneError>(())
    /// ```
    pub fn parts(&self) -> Vec<Scene> {
        if self.modes.is_empty() {
            return vec![self.clone()];
        }
        let part = |mode: &Mode| Scene {
            particle: mode.particle.clone(),
            size_distribution: mode.size_distribution.clone(),
            orientation: mode.orientation,
            fixed_angles: mode.fixed_angles,
            orientations: mode.orientations,
            axis_ratio_law: mode.axis_ratio_law,
            canting: mode.canting,
            medium: mode.medium.clone(),
            density: mode.density.clone(),
            modes: Vec::new(),
            ..self.clone()
        };
        self.modes.iter().map(part).collect()
    }

    /// Of the number of all particles, by kind as in [`Scene::parts`].
    pub fn number_shares(&self) -> Vec<f64> {
        if self.modes.is_empty() {
            return vec![1.0];
        }
        self.modes.iter().map(|mode| mode.number_share).collect()
    }
}

impl Scene {
    /// The same kind of particle with another radius of equal volume (metres).
    pub fn particle_with_radius(&self, radius: f64) -> Particle {
        match &self.particle {
            Particle::Sphere { .. } => Particle::Sphere { radius },
            Particle::Spheroid { axis_ratio, .. } => {
                let law = self.axis_ratio_law.map(|law| law.axis_ratio(2.0 * radius));
                Particle::Spheroid { radius, axis_ratio: law.unwrap_or(*axis_ratio) }
            }
            Particle::Raindrop { model, .. } => Particle::Raindrop { radius, model: *model },
            Particle::Crystal { crystal, .. } => {
                Particle::Crystal { radius, crystal: crystal.clone() }
            }
            Particle::Own { body, .. } => Particle::Own { radius, body: body.clone() },
        }
    }
}

impl Particle {
    /// Radius of the sphere of equal volume, metres.
    pub fn radius(&self) -> f64 {
        match self {
            Particle::Sphere { radius }
            | Particle::Spheroid { radius, .. }
            | Particle::Raindrop { radius, .. }
            | Particle::Crystal { radius, .. }
            | Particle::Own { radius, .. } => *radius,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{SceneError, SceneText};
    use super::*;

    fn scene(shares: [&str; 2]) -> Result<Scene, SceneError> {
        let [a, b] = shares;
        let text = format!(
            "[[particles]]\nshape = 'sphere'\nradius_um = 1\nmedium = {{ index = 1.5 }}\ndensity_kg_m3 = 2000\n{a}\n\
             [[particles]]\nshape = 'sphere'\nradius_um = 2\nmedium = 'water'\n{b}\n\
             [light]\nwavelengths_nm = [550]\n"
        );
        Scene::from_text(SceneText::parse("test", text)?, &SceneFile::default())
    }

    #[test]
    fn shares_of_number_volume_and_mass() {
        let share = |a: &str, b: &str| scene([a, b]).unwrap().number_shares()[0];
        assert!((share("number_fraction = 0.2", "number_fraction = 0.8") - 0.2).abs() < 1e-12);
        // 8 of the small ones make one of the large
        let by_volume = share("volume_fraction = 0.5", "volume_fraction = 0.5");
        assert!((by_volume - 8.0 / 9.0).abs() < 1e-12, "{by_volume}");
        let by_mass = share("mass_fraction = 0.5", "mass_fraction = 0.5");
        let density = 2000.0 / 998.2;
        assert!((by_mass - 8.0 / (8.0 + density)).abs() < 1e-3, "{by_mass}");
        let parts = scene(["number_fraction = 0.2", "number_fraction = 0.8"]).unwrap().parts();
        assert_eq!(parts[1].particle, Particle::Sphere { radius: 2e-6 });
        assert!(parts[1].modes.is_empty());
    }

    /// Of glass no rain falls, and of what has no density no mass is known.
    #[test]
    fn amounts_that_cannot_be() {
        let scene = |medium: &str, amount: &str| {
            let text = format!(
                "[particle]\nshape = 'sphere'\nradius_um = 1\n{medium}\n[amount]\n{amount}\n[light]\n\
                 wavelengths_nm = [550]\n"
            );
            Scene::from_text(SceneText::parse("test", text).unwrap(), &SceneFile::default())
        };
        let (glass, heavy) = ("medium = { index = 1.5 }", "density_kg_m3 = 2000");
        for (medium, amount, words) in [
            (glass.into(), "rain_rate_mm_h = 5", "rain is of water"),
            (format!("{glass}\n{heavy}"), "rain_rate_mm_h = 5", "rain is of water"),
            (glass.into(), "water_content_g_m3 = 5", "give density_kg_m3"),
        ] {
            let error = scene(&medium, amount).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
        assert!(scene(&format!("{glass}\n{heavy}"), "water_content_g_m3 = 5").is_ok());
        assert!(scene(glass, "number_per_cm3 = 5").is_ok());
        assert!(scene("medium = 'water'", "rain_rate_mm_h = 5").is_ok());
    }

    #[test]
    fn shares_that_make_no_sense() {
        for (a, b, words) in [
            ("number_fraction = 0.2", "number_fraction = 0.7", "they add up to 0.9"),
            ("number_fraction = 0.2", "volume_fraction = 0.8", "all need the same"),
            ("number_fraction = 0.2", "", "needs its number_fraction"),
            ("number_fraction = 0.2\nmass_fraction = 1", "number_fraction = 0.8", "given twice"),
            ("number_fraction = -0.2", "number_fraction = 1", "above 0"),
            ("number_fraction = 0.2", "number_fracton = 0.8", "did you mean `number_fraction`"),
            (
                "number_fraction = 0.2",
                "number_fraction = 0.8\naxis_ratio = 0.9",
                "particles[2].axis_ratio",
            ),
        ] {
            let error = scene([a, b]).unwrap_err().to_string();
            assert!(error.contains(words), "{a}; {b}: {error}");
        }
    }
}
