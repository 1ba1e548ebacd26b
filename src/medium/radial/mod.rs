//! Media that vary along the radius of a sphere: layers, profiles, gradients in water, films.
//!
//! A [`Radial`] has no one index; [`Radial::at`] gives the [`Body`] at a wavelength: a core, smooth
//! or homogeneous, and layers around it, all relative to the medium outside.
//!
//! ```
//! use gonio::medium::MediumSpec;
//! use std::path::Path;
//!
//! let lens = MediumSpec::parse("{ profile = \"luneburg\", c = 2.0 }")?.resolve(Path::new("."))?;
//! let body = lens.body(500e-9, 1e-6)?.unwrap();
//! assert!((body.index(0.6).re - 1.64f64.sqrt()).abs() < 1e-15);
//! # Ok::<(), gonio::medium::MediumError>(())
//! ```

mod body;
mod gradient;
mod profile;
mod profile_table;
mod spec;

pub use body::{Body, Core};
pub use gradient::Gradient;
pub use profile::{Profile, Smooth};
pub use spec::{FilmSpec, RadialSpec, coated, immersed};

use super::{Medium, MediumError, invalid};
use num_complex::Complex64;

/// A film on a particle.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    pub medium: Medium,
    /// Metres.
    pub thickness: f64,
}

/// A medium that varies along the radius.
#[derive(Clone, Debug, PartialEq)]
pub enum Radial {
    /// From inside out: outer radius in units of the particle's, medium.
    Layers(Vec<(f64, Medium)>),
    Profile(Profile),
    Gradient(Gradient),
    /// Films on anything, from inside out; the radius of the particle is that of the outermost.
    Coated {
        inside: Medium,
        films: Vec<Film>,
    },
}

impl Radial {
    /// The body at a wavelength in vacuum, for a particle of this radius (metres; films are thinner
    /// or thicker in its units), relative to an index outside.
    ///
    /// # Errors
    /// A wavelength outside the data, or films that leave nothing of the particle.
    pub fn at(&self, wavelength: f64, radius: f64, outside: f64) -> Result<Body, MediumError> {
        match self {
            Self::Layers(layers) => {
                let mut all = Vec::with_capacity(layers.len());
                for (radius, medium) in layers {
                    all.push((*radius, medium.index(wavelength)? / outside));
                }
                let core = Core::Constant(all[0].1);
                Ok(Body { core, core_radius: all[0].0, layers: all[1..].to_vec() })
            }
            Self::Profile(profile) => Ok(Body::smooth(Smooth::profile(profile, outside))),
            Self::Gradient(gradient) => Ok(Body::smooth(gradient.at(wavelength, outside)?)),
            Self::Coated { inside, films } => {
                let total: f64 = films.iter().map(|film| film.thickness).sum();
                let scale = 1.0 - total / radius;
                if scale <= 0.0 {
                    return Err(invalid(
                        "coating",
                        format!("{:.6} nm", total * 1e9),
                        &format!("films thinner than the radius of {:.6} nm", radius * 1e9),
                    ));
                }
                let mut body = match inside.radial() {
                    Some(radial) => radial.at(wavelength, radius * scale, outside)?,
                    None => Body::homogeneous(inside.index(wavelength)? / outside),
                };
                body.shrink(scale);
                let mut reached = scale;
                for (i, film) in films.iter().enumerate() {
                    reached += film.thickness / radius;
                    // The last one reaches the surface to the last digit.
                    let outer = if i + 1 == films.len() { 1.0 } else { reached };
                    body.layers.push((outer, film.medium.index(wavelength)? / outside));
                }
                Ok(body)
            }
        }
    }

    /// Wavelengths in metres that the data cover.
    pub fn valid_range(&self) -> (f64, f64) {
        let all: Vec<(f64, f64)> = match self {
            Self::Layers(layers) => layers.iter().map(|(_, medium)| medium.valid_range()).collect(),
            Self::Profile(_) => Vec::new(),
            Self::Gradient(gradient) => vec![gradient.valid_range()],
            Self::Coated { inside, films } => {
                let films = films.iter().map(|film| film.medium.valid_range());
                films.chain([inside.valid_range()]).collect()
            }
        };
        all.into_iter().fold((0.0, f64::INFINITY), |a, b| (a.0.max(b.0), a.1.min(b.1)))
    }

    /// What it is called.
    pub fn name(&self) -> String {
        match self {
            Self::Layers(layers) => {
                let one = |(radius, medium): &(f64, Medium)| {
                    format!("{} to {radius} of the radius", medium.name())
                };
                format!("layers: {}", layers.iter().map(one).collect::<Vec<_>>().join(", "))
            }
            Self::Profile(profile) => profile.name(),
            Self::Gradient(gradient) => gradient.name(),
            Self::Coated { inside, films } => {
                let one = |film: &Film| {
                    format!("{:.6} nm of {}", film.thickness * 1e9, film.medium.name())
                };
                let films: Vec<String> = films.iter().map(one).collect();
                format!("{}, coated with {}", inside.name(), films.join(", "))
            }
        }
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        let mut sources: Vec<String> = match self {
            Self::Layers(layers) => layers.iter().map(|(_, medium)| medium.source()).collect(),
            Self::Profile(_) => vec!["given".into()],
            Self::Gradient(gradient) => vec![gradient.source()],
            Self::Coated { inside, films } => {
                let films = films.iter().map(|film| film.medium.source());
                [inside.source()].into_iter().chain(films).collect()
            }
        };
        sources.dedup();
        sources.join("; ")
    }
}

impl Medium {
    /// What varies along the radius, if it does.
    pub fn radial(&self) -> Option<&Radial> {
        match self {
            Medium::Radial(radial) => Some(radial),
            Medium::Immersed(immersed) => immersed.inside.radial(),
            _ => None,
        }
    }

    /// The body of a sphere of this radius (metres) if the medium varies along it, at a wavelength in
    /// the surroundings (metres; in vacuum where there are none).
    ///
    /// # Errors
    /// A wavelength outside the data, or films thicker than the radius.
    pub fn body(&self, wavelength: f64, radius: f64) -> Result<Option<Body>, MediumError> {
        match self {
            Medium::Radial(radial) => Ok(Some(radial.at(wavelength, radius, 1.0)?)),
            Medium::Immersed(immersed) => immersed.body(wavelength, radius),
            _ => Ok(None),
        }
    }

    /// Index relative to the outside at the surface of a sphere of this radius.
    ///
    /// # Errors
    /// As for [`Self::body`] and [`Self::index`].
    pub fn surface_index(&self, wavelength: f64, radius: f64) -> Result<Complex64, MediumError> {
        match self.body(wavelength, radius)? {
            Some(body) => Ok(body.surface()),
            None => self.index(wavelength),
        }
    }

    /// A wavelength in vacuum as it is in the surroundings, metres.
    ///
    /// # Errors
    /// A wavelength outside the data of the surroundings.
    pub fn seen_outside(&self, vacuum: f64) -> Result<f64, MediumError> {
        match self {
            Medium::Immersed(immersed) => Ok(vacuum / immersed.outside(vacuum)?),
            _ => Ok(vacuum),
        }
    }

    /// The wavelength in vacuum of one in the surroundings, metres.
    ///
    /// # Errors
    /// A wavelength outside the data of the surroundings.
    pub fn vacuum(&self, seen: f64) -> Result<f64, MediumError> {
        match self {
            Medium::Immersed(immersed) => immersed.vacuum(seen),
            _ => Ok(seen),
        }
    }

    /// k of the surroundings at a wavelength in vacuum.
    ///
    /// # Errors
    /// A wavelength outside their data.
    pub fn outside_absorption(&self, vacuum: f64) -> Result<f64, MediumError> {
        match self {
            Medium::Immersed(immersed) => Ok(immersed.outside.index(vacuum)?.im),
            _ => Ok(0.0),
        }
    }
}

/// A medium inside another one: indices are relative to it, wavelengths are those in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Immersed {
    pub inside: Medium,
    pub outside: Medium,
}

impl Immersed {
    /// The real index outside at a wavelength in vacuum.
    pub fn outside(&self, vacuum: f64) -> Result<f64, MediumError> {
        Ok(self.outside.index(vacuum)?.re)
    }

    /// The wavelength in vacuum of one in the surroundings: the solution of `λ = λ' n(λ)`.
    pub fn vacuum(&self, wavelength: f64) -> Result<f64, MediumError> {
        let (from, to) = self.outside.valid_range();
        let mut vacuum = (1.33 * wavelength).clamp(from, to);
        // n changes by a few per cent over an octave: each round wins a digit or more.
        for _ in 0..60 {
            let next = (wavelength * self.outside(vacuum)?).clamp(from, to);
            if (next / vacuum - 1.0).abs() < 1e-15 {
                return Ok(next);
            }
            vacuum = next;
        }
        Ok(vacuum)
    }

    /// The relative index at a wavelength in the surroundings.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        let vacuum = self.vacuum(wavelength)?;
        Ok(self.inside.index(vacuum)? / self.outside(vacuum)?)
    }

    /// Wavelengths in the surroundings that the data of both cover, metres.
    pub fn range(&self) -> (f64, f64) {
        let (a, b) = (self.inside.valid_range(), self.outside.valid_range());
        let (from, to) = (a.0.max(b.0), a.1.min(b.1));
        let seen = |vacuum: f64| self.outside(vacuum).map_or(vacuum, |n| vacuum / n);
        (seen(from), seen(to))
    }

    /// What it is called.
    pub fn name(&self) -> String {
        format!("{}, in {}", self.inside.name(), self.outside.name())
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        format!("{}; outside: {}", self.inside.source(), self.outside.source())
    }

    /// The body at a wavelength in the surroundings.
    pub fn body(&self, wavelength: f64, radius: f64) -> Result<Option<Body>, MediumError> {
        let Some(radial) = self.inside.radial() else { return Ok(None) };
        let vacuum = self.vacuum(wavelength)?;
        Ok(Some(radial.at(vacuum, radius, self.outside(vacuum)?)?))
    }
}
