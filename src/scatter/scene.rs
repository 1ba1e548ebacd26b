//! One particle of a scene in chosen directions, by the method that the scene's plan chooses.

use super::{
    DebyeTerms, RayDiffraction, RayRequest, Request, ScatterError, Scattering, debye, facets,
    layered, lorenz_mie, rays, t_matrix,
};
use crate::plan::{Engine, Plan, PlanError, stand};
use crate::scene::{Diffraction, Orders, Orientation, Particle, Scene};
use std::f64::consts::TAU;

/// What a scene's one particle does to light of one wavelength (metres) at scattering angles and one azimuth
/// (radians); the engine tells who computed it. Angles of the scene's table are not looked at.
///
/// ```
/// use gonio::scatter::of_scene;
/// use gonio::scene::{Scene, SceneFile};
///
/// let keys: SceneFile = toml::from_str("particle = { shape = 'sphere', radius_um = 1 }")?;
/// let (seen, _) = of_scene(&Scene::built_in(&keys)?, 550e-9, &[0.0, 1.0], 0.0)?;
/// assert_eq!(seen.amplitudes.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Several particles or sizes, for which there are no amplitudes; what the method refuses.
pub fn of_scene(
    scene: &Scene,
    wavelength: f64,
    theta: &[f64],
    azimuth: f64,
) -> Result<(Scattering, Engine), ScatterError> {
    let several = !scene.modes.is_empty()
        || scene.size_distribution.as_ref().is_some_and(|sizes| sizes.single().is_none());
    let crystal = matches!(scene.particle, Particle::Crystal { .. });
    let moves = scene.orientation == Orientation::Random || scene.canting > 0.0;
    if several || moves || crystal && scene.orientation != Orientation::Fixed {
        return Err(ScatterError::Several);
    }
    if scene.is_of_rays_alone() {
        return Err(ScatterError::RaysAlone);
    }
    let one = Scene { wavelengths: vec![wavelength], ..scene.clone() };
    let plan = Plan::new(&one)?;
    // the wavelength and the index that the surroundings leave
    let light = plan.light(scene, wavelength)?;
    let body = scene.medium.body(light.wavelength, plan.radius)?;
    let request = Request {
        size_parameter: TAU * plan.radius / light.wavelength,
        index: light.index,
        theta: theta.to_vec(),
        azimuth,
        tolerance: scene.tolerance,
    };
    let orders = match &scene.orders {
        Orders::Auto => None,
        Orders::List(orders) => Some(orders.clone()),
    };
    let seen = match plan.engine {
        Engine::LorenzMie => match &body {
            Some(body) => layered(&request, body)?,
            None => lorenz_mie(&request)?,
        },
        Engine::Debye => debye(&request, &DebyeTerms { orders, diffraction: false })?,
        Engine::TMatrix => t_matrix(&request, &plan.shape)?,
        Engine::Facets => {
            let body = plan.crystal.as_ref().ok_or(PlanError::FacetsNeedCrystal)?;
            let (settings, error) =
                (plan.beam_settings(), plan.error_of_facets(&one, request.size_parameter));
            facets(&request, body, stand(&one), one.sun_elevation, settings, error)
        }
        Engine::Meridians | Engine::Patches => {
            let diffraction = match scene.diffraction {
                Diffraction::None => RayDiffraction::None,
                Diffraction::Gaussian => RayDiffraction::Gaussian { radius: plan.radius },
                Diffraction::Airy => RayDiffraction::Airy,
            };
            let rays_across = scene.rays_across;
            rays(
                &request,
                &RayRequest { shape: plan.shape.clone(), orders, diffraction, rays_across },
            )?
        }
    };
    Ok((seen, plan.engine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneFile;

    fn scene(text: &str) -> Scene {
        let keys: SceneFile = toml::from_str(text).unwrap();
        Scene::built_in(&keys).unwrap()
    }

    /// The engine is that of a table of the scene, and many sizes have no amplitudes.
    #[test]
    fn engines_are_the_plans() {
        let of = |text: &str| of_scene(&scene(text), 550e-9, &[0.5, 1.0], 0.3).map(|seen| seen.1);
        let particle = "[particle]\nradius_um = 20\n";
        let auto = format!("{particle}shape = 'sphere'\n[model]\nmethod = 'auto'");
        assert_eq!(of(&auto).unwrap(), Engine::LorenzMie);
        let debye = format!("{particle}shape = 'sphere'\n[model]\nmethod = 'debye'\norders = [2]");
        assert_eq!(of(&debye).unwrap(), Engine::Debye);
        let rays = format!("{particle}shape = 'sphere'\n[model]\nmethod = 'rays'");
        assert_eq!(of(&rays).unwrap(), Engine::Meridians);
        // the built-in scene is one by rays
        assert_eq!(of(&format!("{particle}shape = 'sphere'")).unwrap(), Engine::Meridians);
        let many = "[particle]\nshape = 'sphere'\nsize_distribution = { kind = 'gamma', \
                    effective_radius_um = 5, effective_variance = 0.1 }\n[model]\nmethod = 'mie'";
        assert!(matches!(of(many), Err(ScatterError::Several)));
    }

    /// A bubble is seen at the wavelength in its water and by the index relative to it; a sphere of equal layers is one.
    #[test]
    fn surroundings_and_layers_are_those_of_the_scene() {
        let of = |medium: &str, more: &str| {
            let text = format!(
                "[particle]\nshape = 'sphere'\nradius_um = 10\nmedium = {medium}\n{more}\n[model]\nmethod = 'mie'"
            );
            of_scene(&scene(&text), 650e-9, &[0.5, 1.0], 0.0).unwrap().0
        };
        let bubble = of("{ index = 1.0 }", "outside = { index = 1.33167 }");
        assert!((bubble.efficiencies.q_ext - 1.967060831).abs() < 1e-6);
        let one = of("{ index = [1.33, 1e-3] }", "");
        let layers = "{ layers = [{ radius_fraction = 0.5, medium = { index = [1.33, 1e-3] } }, \
                      { medium = { index = [1.33, 1e-3] } }] }";
        let layered = of(layers, "");
        for (a, b) in one.amplitudes.iter().zip(&layered.amplitudes) {
            assert!((a.s1 - b.s1).norm() < 1e-9 * a.s1.norm());
        }
    }
}
