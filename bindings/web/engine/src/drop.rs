//! The drop that the page's controls describe, as a scene of the library.
//!
//! Every check is the library's: a drop is made a scene, and the key that is refused says which control is
//! to show the message.

use crate::message::Trouble;
use gonio::medium::Medium;
use gonio::scene::{Scene, SceneError, SceneFile, SceneText};
use serde::Deserialize;
use toml::{Table, Value};

/// A drop as the controls say it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Drop {
    /// `sphere`, `spheroid`, `raindrop`, `layered` or `gradient`.
    pub shape: String,
    /// Of the sphere of equal volume.
    pub radius_um: f64,
    /// Of a spheroid: vertical over horizontal diameter.
    pub axis_ratio: f64,
    /// A name in the library, an index, or an index and absorption as `1.33+0.001i`.
    pub medium: String,
    /// Of water.
    pub temperature_c: f64,
    /// Of a layered drop: the core's radius over the drop's.
    pub core_fraction: f64,
    /// Of a layered drop: as `medium`.
    pub core_medium: String,
    /// Of a drop with a gradient.
    pub centre_index: f64,
    /// Of a drop with a gradient.
    pub surface_index: f64,
    /// Sun above the horizon.
    pub sun_elevation_deg: f64,
    /// Standard deviation of ln radius.
    pub spread: f64,
}

/// Largest spread of sizes that the page offers, as Lee diagrams accept it.
const LARGEST_SPREAD: f64 = 0.5;

impl Drop {
    /// Whether it is round with one index, so that Debye's terms are its own.
    pub fn is_plain_sphere(&self) -> bool {
        self.shape == "sphere"
    }

    /// Whether it varies along its radius.
    pub fn is_radial(&self) -> bool {
        matches!(self.shape.as_str(), "layered" | "gradient")
    }

    /// Whether scattering is the same at every azimuth.
    pub fn is_round(&self) -> bool {
        self.is_plain_sphere() || self.is_radial()
    }

    /// Metres.
    pub fn radius(&self) -> f64 {
        1e-6 * self.radius_um
    }

    /// Radians.
    pub fn sun_elevation(&self) -> f64 {
        self.sun_elevation_deg.to_radians()
    }

    /// `[particle]` and `[light]` of the scene.
    ///
    /// # Errors
    /// A shape or a spread that is none.
    pub fn keys(&self) -> Result<Table, Trouble> {
        let shape = match self.shape.as_str() {
            "sphere" | "layered" | "gradient" => "sphere",
            "spheroid" => "spheroid",
            "raindrop" => "raindrop",
            other => {
                let accepted = "accepted: sphere, spheroid, raindrop, layered, gradient";
                return Err(Trouble::new("shape", format!("\"{other}\" is not known; {accepted}")));
            }
        };
        if !(0.0..=LARGEST_SPREAD).contains(&self.spread) {
            let message = format!("{}: accepted are 0 to {LARGEST_SPREAD}", self.spread);
            return Err(Trouble::new("spread", message));
        }
        let mut particle = Table::new();
        particle.insert("shape".into(), shape.into());
        particle.insert("radius_um".into(), self.radius_um.into());
        if shape == "spheroid" {
            particle.insert("axis_ratio".into(), self.axis_ratio.into());
        }
        particle.insert("medium".into(), self.medium_keys());
        let mut light = Table::new();
        light.insert("sun_elevation_deg".into(), self.sun_elevation_deg.into());
        let mut keys = Table::new();
        keys.insert("particle".into(), particle.into());
        keys.insert("light".into(), light.into());
        Ok(keys)
    }

    fn medium_keys(&self) -> Value {
        let of = |name: &str| one_medium(name, self.temperature_c);
        match self.shape.as_str() {
            "layered" => {
                let core = table([
                    ("radius_fraction", self.core_fraction.into()),
                    ("medium", of(&self.core_medium)),
                ]);
                let shell = table([("medium", of(&self.medium))]);
                table([("layers", Value::Array(vec![core, shell]))])
            }
            "gradient" => table([
                ("profile", "linear".into()),
                ("centre", self.centre_index.into()),
                ("surface", self.surface_index.into()),
            ]),
            _ => of(&self.medium),
        }
    }

    /// The scene of one wavelength, by the method that suits: exact series for what is round, rays otherwise.
    ///
    /// # Errors
    /// What the library refuses, by the control.
    pub fn scene(&self, wavelength_nm: f64) -> Result<Scene, Trouble> {
        let mut keys = self.keys()?;
        let light = keys["light"].as_table_mut();
        light.map(|light| light.insert("wavelengths_nm".into(), vec![wavelength_nm].into()));
        let method = if self.is_round() { "mie" } else { "rays" };
        keys.insert("model".into(), table([("method", method.into())]));
        checked(&keys)
    }

    /// What it is of.
    ///
    /// # Errors
    /// As [`Drop::scene`].
    pub fn medium(&self) -> Result<Medium, Trouble> {
        Ok(self.scene(SOMEWHERE)?.medium)
    }
}

/// A wavelength inside the visible, where none matters (nm).
const SOMEWHERE: f64 = 550.0;

fn table<const N: usize>(keys: [(&str, Value); N]) -> Value {
    Value::Table(keys.into_iter().map(|(key, value)| (key.to_string(), value)).collect())
}

/// A medium by its name or its index.
fn one_medium(text: &str, temperature_c: f64) -> Value {
    let text = text.trim();
    if let Ok(index) = text.parse::<f64>() {
        return table([("index", Value::Array(vec![index.into(), 0.0.into()]))]);
    }
    let complex = text.strip_suffix('i').and_then(|text| text.split_once('+'));
    if let Some((n, k)) = complex
        && let (Ok(n), Ok(k)) = (n.trim().parse::<f64>(), k.trim().parse::<f64>())
    {
        return table([("index", Value::Array(vec![n.into(), k.into()]))]);
    }
    if text == "water" || text == "sea-water" {
        return table([("name", text.into()), ("temperature_c", temperature_c.into())]);
    }
    text.into()
}

/// A scene of keys.
///
/// # Errors
/// What the library refuses, by the control that the key belongs to.
pub fn checked(keys: &Table) -> Result<Scene, Trouble> {
    let text = SceneText::of_keys(NAME, keys).map_err(|error| placed(&error))?;
    Scene::from_text(text, &SceneFile::default()).map_err(|error| placed(&error))
}

/// How the library's messages name the scene.
const NAME: &str = "drop";

/// What the program's messages add for those who have it.
const OF_PROGRAM: &str = "gonio material --list shows all names";

/// The control of a message such as `drop: particle.radius_um = -1: accepted are …`.
fn placed(error: &SceneError) -> Trouble {
    let text = error.to_string().replace(OF_PROGRAM, "the field suggests names");
    let text = text.strip_prefix(NAME).map_or(text.as_str(), |rest| rest.trim_start_matches(": "));
    let end = text.find([' ', ':']).unwrap_or(text.len());
    let (key, rest) = text.split_at(end);
    let field = match key.rsplit('.').next().unwrap_or_default() {
        "wavelengths_nm" => "wavelength_nm",
        known @ ("shape" | "radius_um" | "axis_ratio" | "medium" | "temperature_c"
        | "sun_elevation_deg") => known,
        _ => return Trouble::new("", text.into()),
    };
    Trouble::new(field, rest.trim_start_matches([' ', '=', ':']).into())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A drop of water for tests.
    pub fn drop(shape: &str, radius_um: f64) -> Drop {
        Drop {
            shape: shape.into(),
            radius_um,
            axis_ratio: 0.9,
            medium: "water".into(),
            temperature_c: 20.0,
            core_fraction: 0.6,
            core_medium: "1.5".into(),
            centre_index: 1.34,
            surface_index: 1.33,
            sun_elevation_deg: 20.0,
            spread: 0.0,
        }
    }

    /// All shapes are scenes, and indices can be typed.
    #[test]
    fn drops_are_scenes() {
        for shape in ["sphere", "spheroid", "raindrop", "layered", "gradient"] {
            drop(shape, 200.0).scene(589.0).unwrap();
        }
        let glass = Drop { medium: "1.5+0.001i".into(), ..drop("sphere", 5.0) };
        let index = glass.medium().unwrap().index(5e-7).unwrap();
        assert_eq!((index.re, index.im), (1.5, 0.001));
    }

    /// What is wrong is said at its control.
    #[test]
    fn troubles_name_their_control() {
        let field = |drop: Drop| drop.scene(589.0).unwrap_err().field;
        for bad in [-1.0, 0.0, 1e9, f64::NAN, f64::INFINITY] {
            assert_eq!(field(drop("sphere", bad)), "radius_um", "{bad}");
        }
        assert_eq!(field(Drop { medium: "watr".into(), ..drop("sphere", 5.0) }), "medium");
        assert_eq!(field(Drop { axis_ratio: 90.0, ..drop("spheroid", 50.0) }), "axis_ratio");
        assert_eq!(field(Drop { temperature_c: 1e4, ..drop("sphere", 5.0) }), "medium");
        assert_eq!(field(Drop { spread: -0.1, ..drop("sphere", 5.0) }), "spread");
        assert_eq!(field(drop("cube", 5.0)), "shape");
        assert_eq!(drop("sphere", 5.0).scene(-3.0).unwrap_err().field, "wavelength_nm");
    }
}
