//! A medium as waves meet it: what varies inside it, what is around it, and light in the surroundings.

use super::error::{MediumError, invalid};
use super::kinds::Medium;
use super::radial::{Body, Film, Immersed, Inside, Radial};
use num_complex::Complex64;
use std::sync::Arc;

/// Light of one wavelength as a particle meets it in its surroundings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// In the surroundings, metres.
    pub wavelength: f64,
    /// Of the particle, relative to the surroundings.
    pub index: Complex64,
}

impl Medium {
    /// The same with films on it, from inside out.
    ///
    /// # Errors
    /// A film that itself varies, or a medium that is already inside another.
    pub fn coated(self, films: Vec<Film<Medium>>) -> Result<Medium, MediumError> {
        if films.is_empty() {
            return Ok(self);
        }
        if let Some(film) = films.iter().find(|film| !film.medium.is_plain()) {
            let accepted = "a medium that is the same everywhere";
            return Err(invalid("coating: medium", film.medium.name(), accepted));
        }
        let radial = match self {
            Medium::Radial(radial) => {
                let all = radial.films.iter().cloned().chain(films).collect();
                Radial { inside: radial.inside.clone(), films: all }
            }
            Medium::Immersed(immersed) => {
                let accepted = "films first, then the surroundings";
                return Err(invalid("coating", immersed.name(), accepted));
            }
            plain => Radial { inside: Inside::Homogeneous(plain), films },
        };
        Ok(Medium::Radial(Arc::new(radial)))
    }

    /// The same inside another medium: from here on wavelengths are those in it, and indices relative to
    /// it.
    ///
    /// # Errors
    /// Surroundings that vary.
    pub fn immersed(self, outside: Medium) -> Result<Medium, MediumError> {
        if !(self.surroundings().is_none() && outside.is_plain()) {
            let accepted = "a medium that is the same everywhere, around one that is in none yet";
            return Err(invalid("outside", outside.name(), accepted));
        }
        Ok(Medium::Immersed(Arc::new(Immersed { inside: self, outside })))
    }

    fn is_plain(&self) -> bool {
        !matches!(self, Medium::Radial(_) | Medium::Immersed(_))
    }

    /// What varies along the radius, if it does.
    pub fn radial(&self) -> Option<&Radial<Medium>> {
        match self {
            Medium::Radial(radial) => Some(radial),
            Medium::Immersed(immersed) => immersed.inside.radial(),
            _ => None,
        }
    }

    /// What is around it, if not vacuum.
    pub fn surroundings(&self) -> Option<&Medium> {
        match self {
            Medium::Immersed(immersed) => Some(&immersed.outside),
            _ => None,
        }
    }

    /// The body of a sphere of this radius (metres) if the medium varies along it, at a wavelength in
    /// the surroundings (metres; in vacuum where there are none).
    ///
    /// # Errors
    /// A wavelength outside the data, or films thicker than the radius.
    pub fn body(&self, wavelength: f64, radius: f64) -> Result<Option<Body>, MediumError> {
        let Some(radial) = self.radial() else { return Ok(None) };
        Ok(Some(match self {
            Medium::Immersed(immersed) => immersed.body(radial, wavelength, radius)?,
            _ => radial.at(wavelength, radius, 1.0)?,
        }))
    }

    /// The light of a wavelength in vacuum (metres) as a particle of one index meets it.
    ///
    /// # Errors
    /// A wavelength outside the data, or a medium that varies along the radius and has no one index.
    pub fn light(&self, vacuum: f64) -> Result<Light, MediumError> {
        let wavelength = self.seen_outside(vacuum)?;
        Ok(Light { wavelength, index: self.index(wavelength)? })
    }

    /// The same for a sphere of a radius (metres), with the index at its surface where it varies.
    ///
    /// # Errors
    /// As [`Self::body`] and [`Self::light`].
    pub fn light_at_surface(&self, vacuum: f64, radius: f64) -> Result<Light, MediumError> {
        let wavelength = self.seen_outside(vacuum)?;
        let index = match self.body(wavelength, radius)? {
            Some(body) => body.surface(),
            None => self.index(wavelength)?,
        };
        Ok(Light { wavelength, index })
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

    /// k of the surroundings at a wavelength in vacuum (metres).
    ///
    /// # Errors
    /// A wavelength outside their data.
    pub fn outside_absorption(&self, vacuum: f64) -> Result<f64, MediumError> {
        self.surroundings().map_or(Ok(0.0), |outside| Ok(outside.index(vacuum)?.im))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(n: f64) -> Medium {
        Medium::Constant(n.into())
    }

    /// There and back: a wavelength in water and in vacuum; an air bubble's index is below 1.
    #[test]
    fn wavelengths_inside_and_outside() {
        let water = Medium::Water { temperature: 293.15 };
        let bubble = constant(1.0).immersed(water.clone()).unwrap();
        let light = bubble.light(650e-9).unwrap();
        let n = water.index(650e-9).unwrap().re;
        assert!((light.wavelength * n / 650e-9 - 1.0).abs() < 1e-14);
        assert!((light.index.re * n - 1.0).abs() < 1e-14);
        assert!((bubble.vacuum(light.wavelength).unwrap() / 650e-9 - 1.0).abs() < 1e-13);
        assert!(bubble.clone().immersed(water.clone()).is_err());
        assert_eq!(constant(1.3).vacuum(1e-6).unwrap(), 1e-6);
        assert!(bubble.light(1.0).is_err());
    }

    /// Films are layers from the outside inwards; a varying medium has no one index.
    #[test]
    fn films_take_their_room_from_the_particle() {
        let film = |n: f64, thickness| Film { medium: constant(n), thickness };
        let coated = constant(1.3).coated(vec![film(1.4, 1e-7), film(1.5, 2e-7)]).unwrap();
        let body = coated.body(5e-7, 1e-6).unwrap().unwrap();
        let radii: Vec<f64> = body.layers.iter().map(|layer| layer.0).collect();
        assert!((body.core_radius - 0.7).abs() < 1e-15 && (radii[0] - 0.8).abs() < 1e-15);
        assert_eq!((radii[1], body.surface().re), (1.0, 1.5));
        assert!(coated.index(5e-7).is_err() && coated.light(5e-7).is_err());
        assert_eq!(coated.light_at_surface(5e-7, 1e-6).unwrap().index.re, 1.5);
        let error = coated.body(5e-7, 2e-7).unwrap_err().to_string();
        assert!(error.contains("300 nm") && error.contains("200 nm"), "{error}");
        let again = coated.clone().coated(vec![film(1.6, 1e-7)]).unwrap();
        assert_eq!(again.radial().unwrap().films.len(), 3);
        assert!(constant(1.3).coated(vec![Film { medium: coated, thickness: 1e-9 }]).is_err());
    }
}
