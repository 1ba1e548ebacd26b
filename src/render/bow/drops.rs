//! The drops of a picture: tables read from files, or computed for the picture as `gonio table` computes them.
//!
//! Any kind of particles with any distribution of sizes and tilts is one scene, whose means `population` takes.
//! Spheres of one size alone are computed here ([`super::sphere`]), at the wavelengths that their ripple needs.

use super::error::BowError;
use super::sphere::sphere;
use super::store::DropStore;
use crate::phase_table::{PhaseTable, Quantity};
use crate::plan::{Engine, Plan, Symmetry};
use crate::population::bulk;
use crate::scene::{
    Choice, Diffraction, Grid, Interference, Method, ParticleKeys, Scene, SceneFile, SceneText,
    ShapeName, SizeKeys, SunDisc,
};
use crate::simulate;
use serde::Deserialize;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// One kind of drops of a picture: a table, the scene of one, or the keys of a particle.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DropKeys {
    /// A table, in place of the keys below; relative to the scene file.
    pub table: Option<String>,
    /// The scene of a table, in place of the keys below: its particles and their amount.
    pub scene: Option<String>,
    /// How many drops of this kind there are, relative to the other kinds.
    pub number: Option<f64>,
    /// The same by the rain that they are, mm/h.
    pub rain_rate_mm_h: Option<f64>,
    /// Standard deviation of ln(radius): a log-normal distribution of sizes about the radius.
    pub size_spread: Option<f64>,
    /// Number of wavelengths (not of spheres of one size).
    pub wavelengths: Option<u64>,
    /// Relative error asked for (not of spheres of one size).
    pub tolerance: Option<f64>,
    /// As in the scene of a table; files are looked for beside the scene of the picture.
    #[serde(flatten)]
    pub particle: ParticleKeys,
}

/// Standard deviations of ln(radius) that sizes reach to, on both sides.
const REACH: f64 = 2.5;
/// Radius where the scene tells none, mm.
const USUAL_RADIUS: f64 = 0.5;
/// Relative error of means where none is asked for: with fewer sizes their bows stand apart as rings.
const TOLERANCE_OF_MEANS: f64 = 0.02;
/// Wavelengths, nm, and how many unless told: bows of neighbours 20 nm apart are 0.1° apart, which means over sizes
/// and the sun's disc smooth over.
const VISIBLE: (f64, f64) = (390.0, 710.0);
const WAVELENGTHS_OF_ONE: u64 = 33;
const WAVELENGTHS_OF_MANY: u64 = 17;
/// Scattering angles, degrees: where raindrops have their bows, and of all else, nearer to whose light nobody looks.
const BOWS: (f64, f64) = (100.0, 180.0);
const ALL: (f64, f64) = (2.0, 180.0);
/// Of crystals: from where the sun's own light ends, and the step.
const HALOES: (f64, f64, f64) = (0.5, 180.0, 0.25);
/// Steps of a degree: of one drop's fringes, of means over sizes.
const STEPS_OF_ONE: f64 = 20.0;
const STEPS_OF_MANY: f64 = 10.0;

/// What a picture asks of its drops.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub sun_elevation_deg: f64,
    /// Whether the picture smooths over the sun's disc.
    pub sun_disc: bool,
    pub polarised: bool,
    /// Whether light is scattered many times: all angles, and the polarisation of spheres.
    pub layer: bool,
}

/// How many drops of a kind there are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    /// To the other kinds.
    Relative(f64),
    /// Per m³.
    Absolute(f64),
}

impl DropKeys {
    /// Drops of a finished table.
    pub fn table(path: &Path) -> Self {
        Self { table: Some(path.to_string_lossy().into_owned()), ..Self::default() }
    }

    /// Spheres of a radius (metres) and a spread of ln(radius).
    pub fn spheres(radius: f64, spread: f64) -> Self {
        let mut kind = Self { size_spread: (spread > 1e-4).then_some(spread), ..Self::default() };
        kind.particle.shape = Some(Choice(ShapeName::Sphere));
        kind.particle.radius_um = Some(1e6 * radius);
        kind
    }

    /// Refuses keys that contradict each other.
    fn check(&self) -> Result<(), BowError> {
        let refuse = |message: String| Err(BowError::Keys(message));
        let own = toml::Table::try_from(&self.particle).unwrap_or_default();
        let particle = own.keys().next().cloned();
        let spread = self.size_spread.map(|_| "size_spread".to_string());
        let made = self.wavelengths.map(|_| "wavelengths".to_string());
        let made = made.or(self.tolerance.map(|_| "tolerance".into()));
        let what = particle.or(spread);
        let beside_table = what.clone().or(self.scene.as_ref().map(|_| "scene".into())).or(made);
        if let (Some(_), Some(key)) = (&self.table, beside_table) {
            return refuse(format!(
                "drops.{key} with drops.table: the table says what its drops are"
            ));
        }
        if let (Some(_), Some(key)) = (&self.scene, what) {
            return refuse(format!(
                "drops.{key} with drops.scene: the scene says what its drops are"
            ));
        }
        if let Some(number) = self.number.filter(|number| !(*number > 0.0 && number.is_finite())) {
            return refuse(format!("drops.number = {number}: a number above 0 is accepted"));
        }
        if let (Some(number), Some(_)) = (self.number, self.rain_rate_mm_h) {
            return refuse(format!(
                "drops.number = {number} with drops.rain_rate_mm_h: one says the other; keep one"
            ));
        }
        if let (Some(rate), Some(_)) = (self.rain_rate_mm_h, &self.table) {
            return refuse(format!(
                "drops.rain_rate_mm_h = {rate} with drops.table: give the number of its drops"
            ));
        }
        Ok(())
    }

    /// The scene of a table of these drops, as it is written.
    fn file(&self, folder: &Path) -> Result<(SceneFile, PathBuf), BowError> {
        if let Some(name) = &self.scene {
            let text = SceneText::load(&folder.join(name))?;
            return Ok((text.file, text.folder));
        }
        let mut particle = self.particle.clone();
        particle.shape.get_or_insert(Choice(ShapeName::Sphere));
        let sizes = [particle.radius_mm, particle.radius_um, particle.diameter_mm];
        let told = sizes.iter().any(Option::is_some)
            || particle.size_distribution.is_some()
            || particle.file_unit.is_some();
        if !told {
            particle.radius_mm = Some(USUAL_RADIUS);
        }
        if let Some(spread) = self.size_spread.filter(|spread| *spread != 0.0) {
            particle.size_distribution = Some(log_normal(&particle, spread)?);
            (particle.radius_mm, particle.radius_um, particle.diameter_mm) = (None, None, None);
        }
        Ok((SceneFile { particle, ..SceneFile::default() }, folder.to_path_buf()))
    }

    /// The scene of a table where a picture looks.
    pub(super) fn scene_of(&self, folder: &Path, wanted: Wanted) -> Result<Scene, BowError> {
        let (mut file, folder) = self.file(folder)?;
        file.amount.rain_rate_mm_h = self.rain_rate_mm_h.or(file.amount.rain_rate_mm_h);
        if self.rain_rate_mm_h.is_some() {
            (file.amount.number_per_cm3, file.amount.water_content_g_m3) = (None, None);
        }
        let many = |keys: &ParticleKeys| keys.size_distribution.is_some() || keys.canting.is_some();
        let mean = many(&file.particle) || file.particles.iter().any(|kind| many(&kind.particle));
        let usual = if mean { WAVELENGTHS_OF_MANY } else { WAVELENGTHS_OF_ONE };
        let count = self.wavelengths.unwrap_or(usual);
        let (from, to) = VISIBLE;
        file.light.sun_elevation_deg = Some(wanted.sun_elevation_deg);
        file.light.wavelengths_nm = Some(Grid::Range { from, to, count });
        (file.light.frequencies_ghz, file.light.bandwidth_nm) = (None, None);
        file.light.sun_disc = None;
        file.table = Default::default();
        let shapes = file.particles.iter().map(|kind| kind.particle.shape);
        let shapes: Vec<_> =
            shapes.chain(file.particles.is_empty().then_some(file.particle.shape)).collect();
        let all = |is: &dyn Fn(ShapeName) -> bool| {
            shapes.iter().all(|shape| shape.is_some_and(|shape| is(shape.0)))
        };
        let spheres = all(&|shape| shape == ShapeName::Sphere);
        let mueller = wanted.polarised || wanted.layer && spheres;
        let quantity = if mueller { Quantity::Mueller } else { Quantity::PhaseFunction };
        file.table.quantity = Some(Choice(quantity));
        if all(&ShapeName::is_crystal) {
            return self.halo(file, &folder);
        }
        let bows = all(&|shape| shape == ShapeName::Raindrop) && !wanted.layer;
        let (from, to) = if bows { BOWS } else { ALL };
        let steps = (to - from) * if mean { STEPS_OF_MANY } else { STEPS_OF_ONE };
        file.table.theta_deg = Some(Grid::Range { from, to, count: steps as u64 + 1 });
        file.table.azimuth_deg = Some(Grid::Range { from: 0.0, to: 360.0, count: 181 });
        if mean {
            file.model.tolerance = self.tolerance.or(Some(TOLERANCE_OF_MEANS));
            file.model.allow_unmet_tolerance = Some(true);
        } else {
            file.model.tolerance = self.tolerance;
        }
        let mut scene = file.validate_in(&folder)?;
        if let Some(by_rays) = by_rays(&file, &folder, &scene) {
            file.model.method = Some(Choice(Method::Rays));
            scene = by_rays;
        }
        // The disc smooths a mean of flattened drops before the picture does, and fewer radii serve it; spheres
        // are smoothed by the picture, which needs no finer angles than these.
        if wanted.sun_disc && mean && Plan::new(&scene)?.symmetry != Symmetry::Rotational {
            file.light.sun_disc = Some(Choice(SunDisc::LimbDarkened));
            if let Ok(scene) = file.validate_in(&folder) {
                return Ok(scene);
            }
        }
        Ok(scene)
    }
}

impl DropKeys {
    /// The scene of crystals: rays alone, by cells that the sun's disc covers.
    fn halo(&self, mut file: SceneFile, folder: &Path) -> Result<Scene, BowError> {
        let (from, to) = VISIBLE;
        let count = self.wavelengths.unwrap_or(WAVELENGTHS_OF_MANY);
        file.light.wavelengths_nm = Some(Grid::Range { from, to, count });
        let (from, to, step) = HALOES;
        let count = ((to - from) / step).round() as u64 + 1;
        file.table.theta_deg = Some(Grid::Range { from, to, count });
        file.table.azimuth_deg = Some(Grid::Range { from: 0.0, to: 360.0, count: 721 });
        file.model.interference = Some(Interference::Powers);
        file.model.diffraction = Some(Choice(Diffraction::None));
        file.model.tolerance = self.tolerance;
        file.model.allow_unmet_tolerance = Some(true);
        Ok(file.validate_in(folder)?)
    }
}

impl DropKeys {
    /// What makes the table of a scene another one: all of it, but the sun's place where that is no matter.
    fn key(&self, scene: &Scene) -> Result<String, BowError> {
        let mut scene = scene.clone();
        if Plan::new(&scene)?.symmetry == Symmetry::Rotational {
            scene.sun_elevation = 0.0;
        }
        // the record of the scene has the sun's place too
        scene.toml.clear();
        Ok(format!("{:?} {:?} {scene:?}", self.wavelengths, self.tolerance))
    }
}

/// A wavelength inside the visible, metres.
const MIDDLE: f64 = 550e-9;

/// The scene of many large spheres or raindrops by rays, where rays accept them and the scene leaves the choice.
fn by_rays(file: &SceneFile, folder: &Path, scene: &Scene) -> Option<Scene> {
    let choice = file.model.method.is_none_or(|method| method.0 == Method::Auto);
    let many = file.particle.size_distribution.is_some() && file.particles.is_empty();
    let size_parameter = TAU * scene.particle.radius() / MIDDLE;
    if !(choice && many) {
        return None;
    }
    let mut file = file.clone();
    file.model.method = Some(Choice(Method::Rays));
    let scene = file.validate_in(folder).ok()?;
    let plan = Plan::new(&scene).ok()?;
    (size_parameter > plan.thresholds.pictures_by_rays_from).then_some(scene)
}

/// Sizes about the radius of a particle.
fn log_normal(particle: &ParticleKeys, spread: f64) -> Result<SizeKeys, BowError> {
    if !(0.0..=1.0).contains(&spread) {
        let message = format!("drops.size_spread = {spread}: accepted are 0 to 1");
        return Err(BowError::Keys(message));
    }
    if particle.size_distribution.is_some() {
        let message =
            format!("drops.size_spread = {spread} with drops.size_distribution: keep one");
        return Err(BowError::Keys(message));
    }
    let radius_um = particle.radius_um.unwrap_or(0.0)
        + 1e3 * particle.radius_mm.unwrap_or(0.0)
        + 500.0 * particle.diameter_mm.unwrap_or(0.0);
    let end = |side: f64| radius_um * (side * REACH * spread).exp();
    let keys = format!(
        "kind = 'log-normal', median_radius_um = {radius_um:?}, spread = {spread:?}, \
         from_radius_um = {:?}, to_radius_um = {:?}",
        end(-1.0),
        end(1.0)
    );
    keys.parse().map_err(|error| BowError::Keys(format!("drops.size_spread = {spread}: {error}")))
}

/// The tables and numbers of all kinds.
pub(super) fn tables(
    kinds: &[DropKeys],
    folder: &Path,
    wanted: Wanted,
    store: &DropStore,
    tell: &dyn Fn(String),
) -> Result<Vec<(Arc<PhaseTable>, f64)>, BowError> {
    if kinds.is_empty() {
        let message = "drops: none given; add [[drops]] to the scene, or --table FILE.h5";
        return Err(BowError::Keys(message.into()));
    }
    kinds.iter().try_for_each(DropKeys::check)?;
    let mut scenes = Vec::new();
    for kind in kinds {
        let scene = match kind.table {
            Some(_) => None,
            None => Some(kind.scene_of(folder, wanted)?),
        };
        let number = match (kind.number, scene.as_ref().and_then(bulk), kind.rain_rate_mm_h) {
            (Some(number), ..) => Number::Relative(number),
            (None, Some(bulk), _) => Number::Absolute(bulk.number),
            (None, None, None) => Number::Relative(1.0),
            (None, None, Some(rate)) => {
                let message = format!(
                    "drops.rain_rate_mm_h = {rate}: rain is of water; give the number of drops"
                );
                return Err(BowError::Keys(message));
            }
        };
        scenes.push((scene, number));
    }
    let absolute = |number: &Number| matches!(number, Number::Absolute(_));
    let numbers = || scenes.iter().map(|(_, number)| number);
    if numbers().any(absolute) && !numbers().all(absolute) {
        let message = "drops: some kinds have a rain rate or another amount, others a number: all need the same";
        return Err(BowError::Keys(message.into()));
    }
    let mut out = Vec::new();
    for (kind, (scene, number)) in kinds.iter().zip(scenes) {
        let (Number::Relative(number) | Number::Absolute(number)) = number;
        let table = match (&kind.table, scene) {
            (Some(name), _) => Arc::new(crate::hdf5::read(&folder.join(name))?),
            (None, Some(scene)) => {
                let key = kind.key(&scene)?;
                store.get(key, || of_scene(kind, &scene, store.least(), tell))?
            }
            (None, None) => continue,
        };
        out.push((table, number));
    }
    Ok(out)
}

/// The table of one kind.
fn of_scene(
    kind: &DropKeys,
    scene: &Scene,
    least: f64,
    tell: &dyn Fn(String),
) -> Result<PhaseTable, BowError> {
    let parts = scene.parts();
    parts.iter().flat_map(|part| part.medium.notes()).for_each(tell);
    let sizes = scene.size_distribution.as_ref();
    let one_size = sizes.is_none_or(|sizes| sizes.single().is_some());
    let plain = scene.medium.radial().is_none() && scene.medium.surroundings().is_none();
    let one = parts.len() == 1 && one_size && plain;
    if one && Plan::new(scene)?.engine == Engine::LorenzMie {
        if let Some(count) = kind.wavelengths {
            return Err(BowError::Keys(format!(
                "drops.wavelengths = {count}: those of a sphere of one size follow from its size; a key of \
                 flattened drops and of many sizes"
            )));
        }
        return sphere(&scene.medium, scene.particle.radius(), scene.quantity, least);
    }
    Ok(simulate::table(scene)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WANTED: Wanted =
        Wanted { sun_elevation_deg: 20.0, sun_disc: true, polarised: false, layer: false };

    fn scene(keys: &str) -> Result<Scene, BowError> {
        let kind: DropKeys = toml::from_str(keys).unwrap();
        kind.check()?;
        kind.scene_of(Path::new("."), WANTED)
    }

    /// Whatever a table takes, a picture takes; means of flattened drops see the sun's disc.
    #[test]
    fn any_population() {
        let rain = scene(
            "shape = 'raindrop'\nsize_distribution = { kind = 'marshall-palmer', rain_rate_mm_h = 5, \
             from_radius_mm = 0.1, to_radius_mm = 1.5 }\nrain_rate_mm_h = 5",
        )
        .unwrap();
        assert_eq!(rain.sun_disc, SunDisc::LimbDarkened);
        assert!(bulk(&rain).unwrap().number > 100.0);
        let spray = scene(
            "size_distribution = { kind = 'gamma', effective_radius_um = 10, effective_variance = 0.1 }",
        )
        .unwrap();
        assert_eq!((spray.sun_disc, spray.modes.len()), (SunDisc::None, 0));
        let spread = scene("radius_mm = 0.2\nsize_spread = 0.1").unwrap();
        assert_eq!((spread.method, spray.method), (Method::Rays, Method::Auto));
        let sizes = spread.size_distribution.unwrap();
        assert!((sizes.bounds().1 / 0.2e-3 - (0.25f64).exp()).abs() < 1e-12);
        assert!(scene("").unwrap().particle.radius() == 0.5e-3);
    }

    /// Crystals make haloes: by rays alone, whose cells are narrower than the sun.
    #[test]
    fn crystals_are_rays() {
        let plates = scene(
            "shape = 'hexagonal-column'\naxis_ratio = 0.2\nradius_um = 60\nmedium = 'ice'\n\
             orientation = 'upright'\ncanting = { deviation_deg = 1 }",
        )
        .unwrap();
        assert!(plates.is_of_rays_alone());
        let step = (plates.theta[1] - plates.theta[0]).to_degrees();
        assert!((step - 0.25).abs() < 1e-9 && plates.wavelengths.len() == 17);
    }

    #[test]
    fn contradictions_are_told() {
        for (keys, words) in [
            ("table = 'x.h5'\nradius_mm = 1", "drops.radius_mm with drops.table"),
            ("scene = 'x.toml'\nsize_spread = 0.1", "drops.size_spread with drops.scene"),
            ("number = 1\nrain_rate_mm_h = 5", "keep one"),
            ("number = -1", "drops.number = -1"),
            ("radius_mm = 0.2\nsize_spread = 2", "accepted are 0 to 1"),
            ("radius_mm = 50", "particle.radius_mm = 50"),
        ] {
            let error = scene(keys).unwrap_err().to_string();
            assert!(error.contains(words), "{keys}: {error}");
        }
        let unknown = toml::from_str::<DropKeys>("radius = 1").unwrap_err().to_string();
        assert!(unknown.contains("unknown field `radius`"), "{unknown}");
    }
}
