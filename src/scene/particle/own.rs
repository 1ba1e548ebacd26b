//! Bodies and media that no key of a scene file names.

use crate::medium::{Density, Medium};
use crate::scene::{Particle, Scene};
use crate::shape::OwnBody;

/// Scenes of what no file can name: bodies and media that a program brings itself.
impl Scene {
    /// This scene with a body of one's own in place of its particle; `radius` is that of the sphere of
    /// equal volume, metres. The record of the scene ([`Scene::toml`]) names it; it is not a scene file
    /// that could be read again.
    ///
    /// ```
    /// use gonio::math::{jet::Jet, scalar::Scalar};
    /// use gonio::scene::{Scene, SceneFile};
    /// use gonio::shape::{Outline, OwnBody};
    ///
    /// #[derive(Debug)]
    /// struct Ball;
    /// impl Outline for Ball {
    ///     fn level<T: Scalar>(&self, q: Jet<T>, _depth: Jet<T>) -> Jet<T> {
    ///         q - 1.0
    ///     }
    /// }
    /// let scene = Scene::built_in(&SceneFile::default())?;
    /// let scene = scene.with_own_body(OwnBody::new("ball", Ball)?, 0.3e-3);
    /// assert!(scene.toml.contains("shape = \"ball\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_own_body(mut self, body: OwnBody, radius: f64) -> Scene {
        let struck = [
            "axis_ratio",
            "apex_deg",
            "file",
            "coefficients",
            "exponent",
            "file_unit",
            "canting",
            "model",
            "radius_um",
            "diameter_mm",
            "size_distribution",
        ];
        let keys = [("shape", body.name().into()), ("radius_mm", (radius * 1e3).into())];
        self.note_particle(&struck, keys);
        self.size_distribution = None;
        self.modes = Vec::new();
        (self.axis_ratio_law, self.canting) = (None, 0.0);
        self.particle = Particle::Own { radius, body };
        self
    }

    /// This scene with a medium of one's own; `density` where it is known. The record names it.
    #[must_use]
    pub fn with_own_medium(mut self, medium: Medium, density: Option<Density>) -> Scene {
        let density_key = density.as_ref().map(|density| ("density_kg_m3", density.kg_m3.into()));
        let keys = [Some(("medium", medium.name().into())), density_key].into_iter().flatten();
        self.note_particle(&["temperature_c", "density_kg_m3", "outside", "coating"], keys);
        (self.medium, self.density) = (medium, density);
        self
    }

    /// Strike keys of the particle from the record, and write others into it.
    fn note_particle<'k>(
        &mut self,
        struck: &[&str],
        keys: impl IntoIterator<Item = (&'k str, toml::Value)>,
    ) {
        // the record was written by this program
        let Ok(mut record) = self.toml.parse::<toml::Table>() else { return };
        if let Some(particle) = record.get_mut("particle").and_then(toml::Value::as_table_mut) {
            particle.retain(|name, _| !struck.contains(&name));
            particle.extend(keys.into_iter().map(|(name, value)| (name.to_string(), value)));
        }
        self.toml = record.to_string();
    }
}
