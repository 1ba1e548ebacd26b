//! What the particles of a scene are as bodies: means over sizes and kinds, per particle.

use super::bulk::bulk;
use crate::phase_table::Bodies;
use crate::scene::Scene;
use std::f64::consts::PI;

/// Means over one kind of particles: of the volume, of the shadow, and of the second to fourth power of the
/// radius of equal volume.
struct Moments {
    volume: f64,
    area: f64,
    powers: [f64; 3],
    mass: Option<f64>,
}

/// The particles of a scene as bodies; `shadows` are the areas of the shadows of its kinds in units of the
/// squared radius of equal volume.
///
/// Of many kinds the density is that of all together, mass over volume.
pub fn bodies(scene: &Scene, shadows: &[f64]) -> Bodies {
    let parts = scene.parts();
    let mut all = Moments { volume: 0.0, area: 0.0, powers: [0.0; 3], mass: Some(0.0) };
    for ((part, share), shadow) in parts.iter().zip(scene.number_shares()).zip(shadows) {
        let one = part.particle.radius();
        let moment = |power: f64| match &part.size_distribution {
            Some(sizes) => sizes.moment(power),
            None => one.powf(power),
        };
        let volume = share * 4.0 / 3.0 * PI * moment(3.0);
        all.volume += volume;
        all.area += share * shadow * moment(2.0);
        for (sum, power) in all.powers.iter_mut().zip([2.0, 3.0, 4.0]) {
            *sum += share * moment(power);
        }
        let mass = part.density.as_ref().map(|density| density.kg_m3 * volume);
        all.mass = all.mass.zip(mass).map(|(sum, more)| sum + more);
    }
    let [square, cube, fourth] = all.powers;
    let variance = match &scene.size_distribution {
        Some(sizes) if parts.len() == 1 => sizes.effective_variance(),
        None if parts.len() == 1 => 0.0,
        _ => (fourth * square / (cube * cube) - 1.0).max(0.0),
    };
    let bodies =
        Bodies { effective_variance: variance, ..Bodies::of_one_size(all.volume, all.area) };
    let mut sources: Vec<&str> = parts
        .iter()
        .filter_map(|part| part.density.as_ref().map(|density| density.source.as_str()))
        .collect();
    sources.dedup();
    let held = bulk(scene);
    let bodies = Bodies {
        number_density: held.map(|held| held.number),
        rain_rate: held.and_then(|held| held.rain_rate),
        ..bodies
    };
    match all.mass {
        Some(mass) => bodies.with_density(Some(mass / all.volume), &sources.join("; ")),
        None => bodies,
    }
}
