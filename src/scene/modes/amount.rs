//! The section `[amount]`: how many particles a volume holds.

use crate::math::digits::to_digits;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::scene::file::AmountKeys;

/// How many particles a volume of air holds, by what is known of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Volume of water through a level plane per area and time, m/s.
    RainRate(f64),
    /// Particles per m³.
    Number(f64),
    /// Mass of the particles per volume, kg/m³.
    MassContent(f64),
}

/// Rain from the finest drizzle to cloudbursts, mm/h.
const RAIN_RATES: (f64, f64) = (1e-6, 1e4);
/// Particles per cm³: of rain to smoke.
const NUMBERS: (f64, f64) = (1e-12, 1e12);
/// g/m³.
const CONTENTS: (f64, f64) = (1e-12, 1e6);
/// mm/h in m/s.
const MM_H: f64 = 1e-3 / 3600.0;

/// Densities of water that rains, kg/m³.
pub(crate) const WATER_DENSITIES: std::ops::RangeInclusive<f64> = 950.0..=1050.0;

impl Scene {
    /// Rain is of water, and a mass of what has a density.
    pub(in crate::scene) fn check_amount(&self) -> Result<(), SceneError> {
        let parts = self.parts();
        let density = |part: &Scene| part.density.as_ref().map(|density| density.kg_m3);
        match self.amount {
            Some(Amount::RainRate(rate)) => {
                let dry =
                    |part: &&Scene| !density(part).is_some_and(|kg| WATER_DENSITIES.contains(&kg));
                match parts.iter().find(dry) {
                    None => Ok(()),
                    Some(part) => {
                        let value =
                            format!("{} of {}", to_digits(rate / MM_H, 9), part.medium.name());
                        let accepted = "rain is of water (density_kg_m3 of 950 to 1050); give \
                                        number_per_cm3 or water_content_g_m3";
                        Err(SceneError::invalid("amount.rain_rate_mm_h", value, accepted))
                    }
                }
            }
            Some(Amount::MassContent(content))
                if parts.iter().any(|part| density(part).is_none()) =>
            {
                let accepted = "a mass needs the density of every medium: give density_kg_m3";
                let value = to_digits(content * 1e3, 9);
                Err(SceneError::invalid("amount.water_content_g_m3", value, accepted))
            }
            _ => Ok(()),
        }
    }
}

/// # Errors
/// A number that is not accepted, or two that may contradict each other.
pub(in crate::scene) fn amount(keys: &AmountKeys) -> Result<Option<Amount>, SceneError> {
    let given: Vec<(&str, f64, (f64, f64), Amount)> = [
        keys.rain_rate_mm_h
            .map(|v| ("amount.rain_rate_mm_h", v, RAIN_RATES, Amount::RainRate(v * MM_H))),
        keys.number_per_cm3.map(|v| ("amount.number_per_cm3", v, NUMBERS, Amount::Number(v * 1e6))),
        keys.water_content_g_m3
            .map(|v| ("amount.water_content_g_m3", v, CONTENTS, Amount::MassContent(v * 1e-3))),
    ]
    .into_iter()
    .flatten()
    .collect();
    match given[..] {
        [] => Ok(None),
        [(key, value, (from, to), amount)] => {
            if value >= from && value <= to {
                return Ok(Some(amount));
            }
            Err(SceneError::invalid(key, value, format!("{from:e} to {to:e} is accepted")))
        }
        [_, (key, value, ..), ..] => {
            let accepted = "one amount says the others; keep one of rain_rate_mm_h, number_per_cm3, \
                            water_content_g_m3";
            Err(SceneError::invalid(key, value, accepted))
        }
    }
}
