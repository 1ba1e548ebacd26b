//! What a particle is made of and is in, as `gonio scatter` and `gonio rays` take it.

use super::particle::Index;
use crate::cli::failure::Result;
use clap::Args;
use gonio::medium::{FilmSpec, Medium, MediumSpec, parse_index};
use std::path::Path;

/// The medium in place of an index, its surroundings, films on it.
#[derive(Args, Clone, Debug)]
pub struct MediumFlags {
    /// Medium in place of an index: a name, a file, or a table as in a scene file; one that varies along
    /// the radius is for spheres
    #[arg(long, value_name = "NAME|TABLE", value_parser = medium, conflicts_with = "index")]
    pub medium: Option<MediumSpec>,
    /// Medium around the particle: a name, an index, or a table (default: vacuum)
    #[arg(long, value_name = "NAME|N", value_parser = outside)]
    pub outside: Option<MediumSpec>,
    /// Films on it, from inside out: [{ medium = "ethanol", thickness_nm = 100 }]
    #[arg(long, value_name = "LIST", value_parser = coating)]
    pub coating: Option<Films>,
}

/// Films from inside out.
pub type Films = Vec<FilmSpec>;

fn medium(text: &str) -> Result<MediumSpec, String> {
    MediumSpec::parse(text).map_err(|error| error.to_string())
}

fn outside(text: &str) -> Result<MediumSpec, String> {
    match parse_index(text) {
        Ok(index) => Ok(MediumSpec::Index { n: index.re, k: index.im }),
        Err(_) => medium(text),
    }
}

fn coating(text: &str) -> Result<Films, String> {
    FilmSpec::parse_list(text).map_err(|error| error.to_string())
}

impl MediumFlags {
    /// The medium with its films and in its surroundings; water where neither it nor an index is given.
    pub fn medium(&self, index: Option<Index>) -> Result<Medium> {
        let here = Path::new(".");
        let inside = match (index, &self.medium) {
            (Some(Index(index)), _) => Medium::Constant(index),
            (None, Some(spec)) => spec.resolve(here)?,
            (None, None) => Medium::Water { temperature: 293.15 },
        };
        let films: Vec<_> = self
            .coating
            .iter()
            .flatten()
            .map(|film| film.resolve(here))
            .collect::<Result<_, _>>()?;
        let coated = inside.coated(films)?;
        Ok(match &self.outside {
            Some(outside) => coated.immersed(outside.resolve(here)?)?,
            None => coated,
        })
    }
}
