//! What varies along the radius: an inside of one of several kinds, and films on it.

use super::body::{Body, Core};
use super::gradient::Gradient;
use super::profile::{Profile, Smooth};
use crate::medium::error::{MediumError, digits, invalid};
use crate::medium::solution::Host;

/// A film on a particle.
#[derive(Clone, Debug, PartialEq)]
pub struct Film<M> {
    /// What it is made of.
    pub medium: M,
    /// Metres.
    pub thickness: f64,
}

/// What is within the films.
#[derive(Clone, Debug, PartialEq)]
pub enum Inside<M> {
    /// The same everywhere.
    Homogeneous(M),
    /// From inside out: outer radius in units of the particle's, medium.
    Layers(Vec<(f64, M)>),
    /// A formula or a table of the radius.
    Profile(Profile),
    /// Water with a gradient.
    Gradient(Gradient),
}

/// A medium that varies along the radius.
#[derive(Clone, Debug, PartialEq)]
pub struct Radial<M> {
    /// What is within the films.
    pub inside: Inside<M>,
    /// From inside out; the radius of the particle is that of the outermost.
    pub films: Vec<Film<M>>,
}

impl<M: Host> Radial<M> {
    /// Without films.
    pub fn bare(inside: Inside<M>) -> Self {
        Self { inside, films: Vec::new() }
    }

    /// The body at a wavelength in vacuum, for a particle of this radius (metres; films are thinner
    /// or thicker in its units), relative to an index outside.
    ///
    /// # Errors
    /// A wavelength outside the data, or films that leave nothing of the particle.
    pub fn at(&self, wavelength: f64, radius: f64, outside: f64) -> Result<Body, MediumError> {
        let mut body = match &self.inside {
            Inside::Homogeneous(medium) => Body::homogeneous(medium.index(wavelength)? / outside),
            Inside::Layers(layers) => {
                let mut all = Vec::with_capacity(layers.len());
                for (radius, medium) in layers {
                    all.push((*radius, medium.index(wavelength)? / outside));
                }
                let core = Core::Constant(all[0].1);
                Body { core, core_radius: all[0].0, layers: all[1..].to_vec() }
            }
            Inside::Profile(profile) => Body::smooth(Smooth::profile(profile, outside)),
            Inside::Gradient(gradient) => Body::smooth(gradient.at(wavelength, outside)?),
        };
        if self.films.is_empty() {
            return Ok(body);
        }
        let total: f64 = self.films.iter().map(|film| film.thickness).sum();
        let scale = 1.0 - total / radius;
        if scale <= 0.0 {
            return Err(invalid(
                "coating",
                format!("{} nm", digits(total * 1e9)),
                &format!("films thinner than the radius of {} nm", digits(radius * 1e9)),
            ));
        }
        body.shrink(scale);
        let mut reached = scale;
        for (i, film) in self.films.iter().enumerate() {
            reached += film.thickness / radius;
            // The last one reaches the surface to the last digit.
            let outer = if i + 1 == self.films.len() { 1.0 } else { reached };
            body.layers.push((outer, film.medium.index(wavelength)? / outside));
        }
        Ok(body)
    }

    /// The media that it is made of.
    fn media(&self) -> impl Iterator<Item = &M> {
        let (one, layers) = match &self.inside {
            Inside::Homogeneous(medium) => (Some(medium), &[][..]),
            Inside::Layers(layers) => (None, &layers[..]),
            Inside::Profile(_) | Inside::Gradient(_) => (None, &[][..]),
        };
        let layers = layers.iter().map(|(_, medium)| medium);
        one.into_iter().chain(layers).chain(self.films.iter().map(|film| &film.medium))
    }

    /// Wavelengths in metres that the data cover.
    pub fn valid_range(&self) -> (f64, f64) {
        let own = match &self.inside {
            Inside::Gradient(gradient) => gradient.valid_range(),
            _ => (0.0, f64::INFINITY),
        };
        let ranges = self.media().map(Host::valid_range);
        ranges.fold(own, |a, b| (a.0.max(b.0), a.1.min(b.1)))
    }

    /// What it is called.
    pub fn name(&self) -> String {
        let inside = match &self.inside {
            Inside::Homogeneous(medium) => medium.name(),
            Inside::Layers(layers) => {
                let one = |(radius, medium): &(f64, M)| {
                    format!("{} to {radius} of the radius", medium.name())
                };
                format!("layers: {}", layers.iter().map(one).collect::<Vec<_>>().join(", "))
            }
            Inside::Profile(profile) => profile.name(),
            Inside::Gradient(gradient) => gradient.name(),
        };
        if self.films.is_empty() {
            return inside;
        }
        let one = |film: &Film<M>| {
            format!("{} nm of {}", digits(film.thickness * 1e9), film.medium.name())
        };
        let films: Vec<String> = self.films.iter().map(one).collect();
        format!("{inside}, coated with {}", films.join(", "))
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        let own = match &self.inside {
            Inside::Profile(_) => Some("given".to_string()),
            Inside::Gradient(gradient) => Some(gradient.source()),
            Inside::Homogeneous(_) | Inside::Layers(_) => None,
        };
        let mut sources: Vec<String> =
            own.into_iter().chain(self.media().map(Host::source)).collect();
        sources.dedup();
        sources.join("; ")
    }

    /// What the readers of its files changed or left out.
    pub fn notes(&self) -> Vec<String> {
        self.media().flat_map(Host::notes).collect()
    }
}
