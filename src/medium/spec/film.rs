//! Films as a scene file writes them: `coating = [{ medium = "ethanol", thickness_nm = 100 }]`.

use crate::medium::error::{MediumError, invalid};
use crate::medium::kinds::Medium;
use crate::medium::radial::Film;
use crate::medium::spec::MediumSpec;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// One film of a coating, as it is written down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilmSpec {
    /// Thickness in nanometres.
    pub thickness_nm: f64,
    /// What it is made of.
    pub medium: MediumSpec,
}

impl FilmSpec {
    /// Reads a list of films as a user types it.
    ///
    /// ```
    /// use gonio::medium::FilmSpec;
    /// let films = FilmSpec::parse_list("[{ medium = \"ethanol\", thickness_nm = 100 }]")?;
    /// assert_eq!(films[0].thickness_nm, 100.0);
    /// # Ok::<(), gonio::medium::MediumError>(())
    /// ```
    ///
    /// # Errors
    /// What is no list of films.
    pub fn parse_list(text: &str) -> Result<Vec<Self>, MediumError> {
        #[derive(Deserialize)]
        struct Holder {
            coating: Vec<FilmSpec>,
        }
        let held: Result<Holder, _> = toml::from_str(&format!("coating = {text}"));
        held.map(|holder| holder.coating).map_err(|error| {
            let message = error.message().trim().replace('\n', ", ");
            let accepted = format!(
                "{message}; a list such as [{{ medium = \"ethanol\", thickness_nm = 100 }}]"
            );
            invalid("coating", text, &accepted)
        })
    }

    /// The film; files are looked for in `folder`.
    ///
    /// # Errors
    /// A film without thickness, or a medium that is wrong.
    pub fn resolve(&self, folder: &Path) -> Result<Film<Medium>, MediumError> {
        if !(self.thickness_nm > 0.0 && self.thickness_nm.is_finite()) {
            let accepted = "a thickness above 0 nm";
            return Err(invalid("coating: thickness_nm", self.thickness_nm, accepted));
        }
        Ok(Film { medium: self.medium.resolve(folder)?, thickness: self.thickness_nm * 1e-9 })
    }
}
