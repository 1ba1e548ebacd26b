//! What the values of a table are means over, so that nothing is averaged twice: whoever smooths a
//! picture over the sun's disc looks here first.
//!
//! ```
//! use gonio::phase_table::{Averaging, DiscOfSun};
//!
//! let smoothed = Averaging { sun_disc: DiscOfSun::LimbDarkened, ..Averaging::default() };
//! assert!(smoothed.has_sun_disc());
//! assert_eq!(smoothed.words(), ["the sun's disc (limb-darkened)"]);
//! ```

/// The sun's disc in a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DiscOfSun {
    /// Light from a point.
    #[default]
    None,
    /// Equally bright everywhere.
    Uniform,
    /// Darker and redder towards its rim.
    LimbDarkened,
}

impl DiscOfSun {
    /// All words, as in a scene file.
    pub const NAMES: [(&str, DiscOfSun); 3] = [
        ("none", DiscOfSun::None),
        ("uniform", DiscOfSun::Uniform),
        ("limb-darkened", DiscOfSun::LimbDarkened),
    ];

    /// The word that files use.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, disc)| *disc == self).map_or("", |(name, _)| name)
    }

    /// The treatment by that word.
    pub fn from_name(name: &str) -> Option<DiscOfSun> {
        Self::NAMES.iter().find(|(word, _)| *word == name).map(|(_, disc)| *disc)
    }
}

/// What was averaged over when a table was made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Averaging {
    /// What stands for the sun's disc.
    pub sun_disc: DiscOfSun,
    /// Many sizes in place of one.
    pub sizes: bool,
    /// Full width at half maximum of the band about each wavelength, metres; 0: none.
    pub bandwidth: f64,
    /// Standard deviation of the Gaussian filter that stands for diffraction, radians; 0: none.
    pub filter: f64,
}

impl Averaging {
    /// The sun's disc is in the values: it must not be applied again.
    pub fn has_sun_disc(&self) -> bool {
        self.sun_disc != DiscOfSun::None
    }

    /// Everything that was averaged over, for people.
    pub fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        if self.has_sun_disc() {
            words.push(format!("the sun's disc ({})", self.sun_disc.name()));
        }
        if self.sizes {
            words.push("a distribution of sizes".into());
        }
        if self.bandwidth > 0.0 {
            words.push(format!("bands of {:.6} nm", self.bandwidth * 1e9));
        }
        if self.filter > 0.0 {
            let degrees = self.filter.to_degrees();
            words.push(format!("a Gaussian filter of {degrees:.4}° in place of diffraction"));
        }
        words
    }
}
