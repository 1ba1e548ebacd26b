//! What a volume of air holds: number of particles, water, rain.
//!
//! Rain is the volume of water through a level plane, `R = N π/6 ⟨D³ v⟩` with the fall speed v. In still air near
//! the ground drops fall after Brandes, Zhang & Vivekanandan, J. Appl. Meteorol. 41, 674 (2002), a polynomial
//! fitted from 0.1 mm on; small ones after Stokes, `v = 1.19e8 r²/(m s)` (Rogers & Yau 1989, eq. 8.5), where that
//! is less (below 0.14 mm diameter; up to a fifth too fast about there).

use crate::scene::{Amount, Scene, WATER_DENSITIES};
use crate::size_distribution::SizeDistribution;
use std::f64::consts::PI;

/// Brandes's coefficients, m/s by mm.
const BRANDES: [f64; 5] = [-0.1021, 4.932, -0.9551, 0.07934, -0.002362];
/// Drops beyond this fall no faster, mm.
const LARGEST_MM: f64 = 8.0;
/// Stokes's law, 1/(m s) by radius.
const STOKES: f64 = 1.19e8;
/// Nodes of the mean over sizes.
const STEPS: usize = 400;

/// Terminal speed of a drop by its radius (metres), m/s.
///
/// ```
/// use gonio::population::fall_speed;
/// // Gunn & Kinzer (1949): the polynomial is 3.6 % too fast at 0.5 mm, and within 2 % from 1 mm on
/// for (diameter_mm, speed, off) in [(0.5, 2.06, 0.04), (1.0, 4.03, 0.02), (2.0, 6.49, 0.02), (3.0, 8.06, 0.02)] {
///     assert!((fall_speed(0.5e-3 * diameter_mm) / speed - 1.0f64).abs() < off);
/// }
/// ```
pub fn fall_speed(radius: f64) -> f64 {
    let d = (2e3 * radius).min(LARGEST_MM);
    let fitted = BRANDES.iter().rev().fold(0.0, |sum, c| sum * d + c);
    let stokes = STOKES * radius * radius;
    if stokes < fitted.max(0.4) { stokes } else { fitted }
}

/// What a volume holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bulk {
    /// Particles per m³.
    pub number: f64,
    /// Volume of water through a level plane, m/s; `None` of what is no water.
    pub rain_rate: Option<f64>,
    /// Mass of the particles, kg/m³; `None` where their density is not known.
    pub mass_content: Option<f64>,
}

/// Per particle of a scene: volume of water that falls per time and number (m⁴/s), and mass (kg).
fn per_particle(scene: &Scene) -> (Option<f64>, Option<f64>) {
    let (mut flux, mut mass) = (Some(0.0), Some(0.0));
    for (part, share) in scene.parts().iter().zip(scene.number_shares()) {
        let radius = part.particle.radius();
        let cubed = |weigh: &dyn Fn(f64) -> f64| match &part.size_distribution {
            Some(sizes) => mean_of_volumes(sizes, weigh),
            None => radius.powi(3) * weigh(radius),
        };
        let density = part.density.as_ref().map(|density| density.kg_m3);
        let volume = 4.0 / 3.0 * PI * share;
        let water = density.filter(|kg_m3| WATER_DENSITIES.contains(kg_m3));
        flux = flux.zip(water).map(|(sum, _)| sum + volume * cubed(&fall_speed));
        mass = mass.zip(density).map(|(sum, kg_m3)| sum + volume * kg_m3 * cubed(&|_| 1.0));
    }
    (flux, mass)
}

/// Mean of `r³ weigh(r)`.
fn mean_of_volumes(sizes: &SizeDistribution, weigh: impl Fn(f64) -> f64) -> f64 {
    if let Some(radius) = sizes.single() {
        return radius.powi(3) * weigh(radius);
    }
    let (from, to) = sizes.limits(1e-9, 1e9);
    let all = super::radii(sizes, (from, to), STEPS);
    all.iter().map(|at| at.weight * at.radius * weigh(at.radius)).sum()
}

/// What a volume holds of a scene's particles, by the amount that is told.
///
/// `None` where none is told, or where it cannot be: rain of what is no water, mass without a density.
pub fn bulk(scene: &Scene) -> Option<Bulk> {
    let amount = scene.amount?;
    let (flux, mass) = per_particle(scene);
    let number = match amount {
        Amount::Number(number) => number,
        Amount::RainRate(rate) => rate / flux?,
        Amount::MassContent(content) => content / mass?,
    };
    Some(Bulk {
        number,
        rain_rate: flux.map(|flux| number * flux),
        mass_content: mass.map(|mass| number * mass),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SceneFile, SceneText};

    fn scene(amount: &str) -> Scene {
        let text = format!(
            "[particle]\nshape = 'raindrop'\nsize_distribution = {{ kind = 'marshall-palmer', rain_rate_mm_h = 5, \
             from_diameter_mm = 0.05, to_diameter_mm = 6 }}\n[amount]\n{amount}\n[light]\nwavelengths_nm = [550]\n"
        );
        Scene::from_text(SceneText::parse("test", text).unwrap(), &SceneFile::default()).unwrap()
    }

    /// Marshall & Palmer's 8000 drops per m³ and mm carry 5.9 mm/h where they are called 5, and
    /// `π ρ N₀/Λ⁴` of water.
    #[test]
    fn rain_by_its_number() {
        let slope = 4.1 * 5f64.powf(-0.21);
        let number = 8000.0 / slope * ((-0.05 * slope).exp() - (-6.0 * slope).exp());
        let bulk = bulk(&scene(&format!("number_per_cm3 = {:e}", number * 1e-6))).unwrap();
        let rate = bulk.rain_rate.unwrap() * 3.6e6;
        assert!((rate - 5.9).abs() < 0.15, "{rate}");
        let known = PI * 998.2 * 8000.0 * 1e-9 / slope.powi(4);
        let content = bulk.mass_content.unwrap();
        assert!((content / known - 1.0).abs() < 2e-3, "{content} {known}");
    }

    /// One amount says the others.
    #[test]
    fn amounts_agree() {
        let by_rate = bulk(&scene("rain_rate_mm_h = 5")).unwrap();
        let grams = by_rate.mass_content.unwrap() * 1e3;
        let by_mass = bulk(&scene(&format!("water_content_g_m3 = {grams:?}"))).unwrap();
        assert!((by_mass.number / by_rate.number - 1.0).abs() < 1e-12);
        assert!((by_mass.rain_rate.unwrap() * 3.6e6 - 5.0).abs() < 1e-9);
        assert!(bulk(&scene("")).is_none());
    }

    #[test]
    fn small_drops_fall_after_stokes_without_a_jump() {
        assert!((fall_speed(1e-5) - 0.0119).abs() < 1e-6);
        let mut before = 0.0;
        for i in 1..4000 {
            let speed = fall_speed(1e-6 * f64::from(i));
            assert!(speed >= before - 0.01 && speed - before < 0.02, "{i}: {before} {speed}");
            before = speed;
        }
    }
}
