//! Crystals and prisms: which are accepted, how they stand, how many orientations are averaged.

use super::acceptance::{PlanError, accept, check_outside};
use super::{Engine, Plan, Symmetry, rings};
use crate::facets::beams::Settings;
use crate::facets::orientation::Stand;
use crate::facets::{Body, mean};
use crate::farfield::assignment::Thresholds;
use crate::math::digits::to_digits;
use crate::phase_table::MethodPart;
use crate::scene::{Orientation, Scene};
use crate::shape::{Crystal, Shape};
use std::f64::consts::TAU;

/// Orientations in a mean where the scene names no number, and replicas by whose scatter its error is told.
const ORIENTATIONS: u32 = 512;
/// The same for rays alone, each of which goes one way only.
const ORIENTATIONS_OF_RAYS: u32 = 32_768;
const REPLICAS: u32 = 8;
/// Most chords, and the share of the light of a beam that is no longer followed per tolerance.
const LAST_ORDER: u32 = 24;
const POWER_PER_TOLERANCE: f64 = 1e-2;

impl Plan {
    /// Of a crystal.
    pub(super) fn of_crystal(
        scene: &Scene,
        radius: f64,
        crystal: &Crystal,
        thresholds: Thresholds,
    ) -> Result<Self, PlanError> {
        let body = Body::of(crystal)?;
        for &wavelength in &scene.wavelengths {
            check(scene, &body, radius, wavelength, &thresholds)?;
        }
        let mut reasons = vec![format!(
            "beams of {} facets: the body is convex and flat; sizes in units of the radius of equal volume: {:.4} \
             from corner to corner, {:.4} between its nearest parallel planes",
            body.facets().len(),
            body.diameter(),
            body.width()
        )];
        let symmetry = match scene.orientation {
            Orientation::Random => {
                reasons.push(
                    "one azimuth is enough: a mean over all orientations and their mirror images"
                        .into(),
                );
                Symmetry::Rotational
            }
            Orientation::Fixed => {
                reasons.push("every azimuth is computed: the crystal stands still".into());
                Symmetry::None
            }
            Orientation::Upright | Orientation::Horizontal => {
                reasons.push("half the azimuths are mirror images of the other half".into());
                Symmetry::Mirror
            }
        };
        super::say_medium(scene, &mut reasons);
        let rings = rings(None, scene.tolerance);
        let plan = Self {
            engine: Engine::Facets,
            shape: Shape::sphere(),
            crystal: Some(body),
            radius,
            symmetry,
            orders: Vec::new(),
            complete: true,
            forward_diffraction: !scene.is_of_rays_alone(),
            tolerance: scene.tolerance,
            thresholds,
            checked: true,
            rings,
            spokes: 2 * rings,
            reasons,
            parts: Vec::new(),
        };
        Ok(plan.saying_orientations(scene))
    }

    fn saying_orientations(mut self, scene: &Scene) -> Self {
        let [count, replicas] = self.orientations(scene);
        if count * replicas > 1 {
            self.reasons.push(format!(
                "{} orientations in {replicas} replicas, whose scatter is stated; another number by orientation = \
                 {{ kind = …, count = … }}",
                count * replicas
            ));
        }
        self
    }

    /// Orientations of each replica, and replicas, of a crystal's mean.
    pub fn orientations(&self, scene: &Scene) -> [u32; 2] {
        match scene.orientation {
            Orientation::Fixed => [1, 1],
            _ => {
                let many = scene.is_of_rays_alone();
                let usual = if many { ORIENTATIONS_OF_RAYS } else { ORIENTATIONS };
                [scene.orientations.unwrap_or(usual).div_ceil(REPLICAS), REPLICAS]
            }
        }
    }

    /// How far beams are followed.
    pub fn beam_settings(&self) -> Settings {
        let least_power = (POWER_PER_TOLERANCE * self.tolerance).clamp(1e-8, 1e-3);
        Settings { last_order: LAST_ORDER, least_power }
    }

    /// What a mean over a crystal's orientations is asked for.
    pub fn crystal_request<'a>(
        &self,
        scene: &Scene,
        body: &'a Body,
        light: crate::facets::beams::Incidence,
        theta: &'a [f64],
        azimuths: mean::Azimuths<'a>,
    ) -> mean::Request<'a> {
        let [count, replicas] = self.orientations(scene);
        mean::Request {
            body,
            stand: stand(scene),
            sun_elevation: scene.sun_elevation,
            light,
            settings: self.beam_settings(),
            theta,
            cells: &[],
            azimuths,
            whole: scene.quantity.elements() > 1,
            count,
            replicas,
        }
    }

    /// Relative error that intensities of facets are expected to have.
    pub fn error_of_facets(&self, scene: &Scene, size_parameter: f64) -> f64 {
        let waves = self.thresholds.error_of_facets / size_parameter;
        let rays = match scene.is_of_rays_alone() {
            true => self.thresholds.error_of_facet_rays / size_parameter.sqrt(),
            false => 0.0,
        };
        waves.hypot(rays).min(1.0)
    }

    /// What is said of a crystal before its table is made.
    pub(super) fn part_of_crystal(&self, scene: &Scene) -> MethodPart {
        let longest = scene.wavelengths.iter().copied().fold(0.0, f64::max);
        let seen = scene.medium.seen_outside(longest).unwrap_or(longest);
        MethodPart {
            order: None,
            method: match scene.is_of_rays_alone() {
                true => "rays through flat facets, without diffraction".into(),
                false => "beams of flat facets, each with its diffraction".into(),
            },
            reason: "a convex body of flat facets".into(),
            expected_error: Some(self.error_of_facets(scene, TAU * self.radius / seen)),
            ..MethodPart::default()
        }
    }
}

/// How a scene's crystal stands.
pub fn stand(scene: &Scene) -> Stand {
    let deviation = scene.canting;
    match scene.orientation {
        Orientation::Random => Stand::Random,
        Orientation::Upright => Stand::Upright { deviation },
        Orientation::Horizontal => Stand::Horizontal { deviation },
        Orientation::Fixed => {
            let [zenith, azimuth, spin] = scene.fixed_angles;
            Stand::Fixed { zenith, azimuth, spin }
        }
    }
}

/// Refuse what plane waves on facets do not serve.
fn check(
    scene: &Scene,
    body: &Body,
    radius: f64,
    wavelength: f64,
    by: &Thresholds,
) -> Result<(), PlanError> {
    let light = scene.medium.light(wavelength)?;
    check_outside(&scene.medium, wavelength, radius)?;
    let place = format!(" at {} nm", to_digits(wavelength * 1e9, 10));
    let x = TAU * radius / light.wavelength;
    let [least, least_width] = by.least_facet_sizes;
    let half_width = 0.5 * x * body.width();
    if light.index.re <= 1.0 {
        return Err(PlanError::ThinnerBody { index: light.index.re, place });
    }
    if x < least || half_width < least_width {
        let error = 100.0 * by.error_of_facets / x;
        return Err(PlanError::SmallCrystal {
            size_parameter: x,
            half_width,
            place,
            limits: by.least_facet_sizes,
            error,
        });
    }
    let size_parameter = x * body.facet_radius();
    if size_parameter < by.least_facet {
        let (facets, limit) = (body.facets().len(), by.least_facet);
        return Err(PlanError::SmallFacets { facets, size_parameter, place, limit });
    }
    accept(by, light.index, x, &place)
}
