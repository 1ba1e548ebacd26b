//! What the particles of a table are as bodies: volume, shadow, effective radius, density. Whoever wants
//! an extinction per mass or volume finds here what to divide by.
//!
//! For a distribution of sizes these are means per particle over the number of particles. The effective
//! radius is `3V/4A` with the mean volume V and the mean projected area A (Hansen & Travis 1974, eq. 2.53,
//! of spheres ⟨r³⟩/⟨r²⟩): it is **not** the radius of the sphere of mean volume.
//!
//! ```
//! use gonio::phase_table::Bodies;
//!
//! let drop = Bodies::sphere(1e-5).with_density(Some(1000.0), "given");
//! // Q = 2: the rule of thumb 3/(2 ρ r_eff), in m²/kg
//! let per_mass = 2.0 * drop.mean_area / drop.mean_mass().unwrap();
//! assert!((per_mass / (1.5 / (1000.0 * 1e-5)) - 1.0).abs() < 1e-12);
//! ```

use super::InvalidTable;
use super::invalid::invalid;
use std::f64::consts::PI;

/// Bodies of one table, means per particle.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    /// `3V/4A`, metres.
    pub effective_radius: f64,
    /// `⟨(r - r_eff)² r²⟩/(r_eff² ⟨r²⟩)`; 0 for one size.
    pub effective_variance: f64,
    /// m³.
    pub mean_volume: f64,
    /// Projected area towards the light, m².
    pub mean_area: f64,
    /// Of the medium, kg/m³; `None`: not known.
    pub density: Option<f64>,
    /// Where the density is from, in words; empty where it is not known.
    pub density_source: String,
    /// Particles per m³ of air; `None`: not known.
    pub number_density: Option<f64>,
    /// Volume of water that falls through a level plane, m/s; `None`: not known, or no water.
    pub rain_rate: Option<f64>,
}

impl Bodies {
    /// Spheres of one radius (metres), density unknown.
    pub fn sphere(radius: f64) -> Bodies {
        Bodies::of_one_size(4.0 / 3.0 * PI * radius.powi(3), PI * radius * radius)
    }

    /// Particles of one size, by volume (m³) and projected area (m²), density unknown.
    pub fn of_one_size(volume: f64, area: f64) -> Bodies {
        Bodies {
            effective_radius: 0.75 * volume / area,
            effective_variance: 0.0,
            mean_volume: volume,
            mean_area: area,
            density: None,
            density_source: String::new(),
            number_density: None,
            rain_rate: None,
        }
    }

    /// The same of a medium of this density (kg/m³), with its source in words.
    pub fn with_density(self, density: Option<f64>, source: &str) -> Bodies {
        Bodies { density, density_source: source.into(), ..self }
    }

    /// Mean mass of a particle, kg, where the density is known.
    pub fn mean_mass(&self) -> Option<f64> {
        self.density.map(|density| density * self.mean_volume)
    }

    /// Mean of the cubed radius of equal volume, m³.
    pub fn mean_cubed_radius(&self) -> f64 {
        0.75 / PI * self.mean_volume
    }

    /// Mass of the particles per volume of air, kg/m³, where it is known.
    pub fn mass_content(&self) -> Option<f64> {
        self.number_density.zip(self.mean_mass()).map(|(number, mass)| number * mass)
    }

    /// # Errors
    /// When a number is not positive and finite, or the effective radius is not `3V/4A`.
    pub fn validate(&self) -> Result<(), InvalidTable> {
        let numbers = [
            ("size_effective_radius", self.effective_radius, "a positive length"),
            ("mean_volume", self.mean_volume, "a positive volume"),
            ("mean_projected_area", self.mean_area, "a positive area"),
            ("medium_density", self.density.unwrap_or(1.0), "a positive density"),
            ("number_density", self.number_density.unwrap_or(1.0), "a positive number per volume"),
            ("rain_rate", self.rain_rate.unwrap_or(1.0), "a positive speed"),
        ];
        if let Some((field, value, accepted)) =
            numbers.into_iter().find(|(_, value, _)| !(value.is_finite() && *value > 0.0))
        {
            return Err(invalid(field, value, accepted));
        }
        if !(self.effective_variance.is_finite() && self.effective_variance >= 0.0) {
            let accepted = "a finite number, 0 or more";
            return Err(invalid("size_effective_variance", self.effective_variance, accepted));
        }
        let expected = 0.75 * self.mean_volume / self.mean_area;
        if (self.effective_radius / expected - 1.0).abs() > 1e-4 {
            let accepted = format!("3/4 mean volume / mean projected area = {expected:e} m");
            return Err(invalid("size_effective_radius", self.effective_radius, &accepted));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contradictions_and_impossible_numbers_are_refused() {
        let sound = Bodies::sphere(1e-5).with_density(Some(917.0), "ice");
        sound.validate().unwrap();
        assert!((sound.effective_radius - 1e-5).abs() < 1e-20);
        for wrong in [
            Bodies { effective_radius: 2e-5, ..sound.clone() },
            Bodies { mean_volume: f64::NAN, ..sound.clone() },
            Bodies { density: Some(-1.0), ..sound.clone() },
            Bodies { effective_variance: -0.1, ..sound },
        ] {
            assert!(wrong.validate().is_err(), "{wrong:?}");
        }
    }
}
