//! Keys that are right one by one and contradict each other: what a method knows nothing of is refused.

use super::choice::Named;
use super::error::SceneError;
use super::{Diffraction, Interference, Method, Orders, Orientation, Particle, Scene, SunDisc};
use crate::medium::radial::{Inside, Profile};
use crate::phase_table::ForwardPeak;
use crate::size_distribution::SizeDistribution;

/// Azimuths by which a circle is told in cells.
const LEAST_AZIMUTHS: usize = 8;

impl Scene {
    /// Whether a crystal's beams are taken as rays, with their powers alone.
    pub fn is_of_rays_alone(&self) -> bool {
        let crystal = matches!(self.particle, Particle::Crystal { .. });
        let alone = self.interference == Interference::Powers;
        crystal && alone && self.diffraction == Diffraction::None
    }

    /// Facets have a method of their own, and not every switch of the others.
    pub(super) fn check_crystal(&self) -> Result<(), SceneError> {
        let Particle::Crystal { crystal, .. } = &self.particle else {
            if self.method == Method::Facets {
                let accepted =
                    "\"facets\" is for crystals and prisms, such as shape = \"hexagonal-column\"";
                return Err(SceneError::invalid("model.method", "facets", accepted));
            }
            if matches!(self.orientation, Orientation::Horizontal | Orientation::Fixed) {
                let accepted =
                    "drops and spheroids stand \"upright\" or at \"random\"; crystals any way";
                let word = self.orientation.name();
                return Err(SceneError::invalid("particle.orientation", word, accepted));
            }
            if let Some(count) = self.orientations {
                let accepted =
                    "a number of orientations is for crystals; the T-matrix has all of them";
                let value = format!("{{ count = {count} }}");
                return Err(SceneError::invalid("particle.orientation", value, accepted));
            }
            return Ok(());
        };
        let refuse = |key: &str, value: String, accepted: &str| {
            let value = format!("{value} of a {}", crystal.name());
            Err(SceneError::invalid(key, value, accepted))
        };
        if !matches!(self.method, Method::Auto | Method::Facets) {
            let accepted = "crystals and prisms take \"facets\" or \"auto\"";
            return refuse("model.method", self.method.name().into(), accepted);
        }
        if self.size_distribution.is_some() {
            let accepted = "one size: radius_um, radius_mm or diameter_mm; several kinds in [[particles]] add up";
            return refuse("particle.size_distribution", "many sizes".into(), accepted);
        }
        if let Orders::List(list) = &self.orders {
            let accepted = "facets have all orders at once: \"auto\"";
            return refuse("model.orders", format!("{list:?}"), accepted);
        }
        let rays = self.is_of_rays_alone();
        if self.interference != Interference::Waves && !rays {
            let accepted = "beams of facets add as waves: true; or, with diffraction = \"none\", as rays: false";
            return refuse("model.interference", self.interference.name().into(), accepted);
        }
        if self.diffraction != Diffraction::Airy && !rays {
            let accepted = "beams of facets have their own diffraction: leave it out; or rays alone: \"none\" with \
                            interference = false";
            return refuse("model.diffraction", self.diffraction.name().into(), accepted);
        }
        if rays && self.forward_peak != ForwardPeak::CellAverage {
            let accepted = "rays are told as means over cells: \"cell_average\"";
            return refuse("table.forward_peak", self.forward_peak.name().into(), accepted);
        }
        if rays && self.orientation != Orientation::Random && self.phi.len() < LEAST_AZIMUTHS {
            let accepted = "rays are told as means over cells: azimuths over the circle, 8 at least, or \
                            orientation = \"random\"";
            return refuse("table.azimuth_deg", format!("{} azimuths", self.phi.len()), accepted);
        }
        if let Some(rays) = self.rays_across {
            return refuse(
                "model.rays_across",
                rays.to_string(),
                "facets have no rays; leave it out",
            );
        }
        if self.forward_peak == ForwardPeak::Separate {
            let accepted = "reflection, transmission and diffraction of facets are one sum: \"cell_average\" or \"point\"";
            return refuse("table.forward_peak", self.forward_peak.name().into(), accepted);
        }
        let tilts = matches!(self.orientation, Orientation::Upright | Orientation::Horizontal);
        if self.canting > 0.0 && !tilts {
            let accepted = "tilts go with \"upright\" and \"horizontal\"";
            let value = format!("with orientation = \"{}\"", self.orientation.name());
            return refuse("particle.canting", value, accepted);
        }
        if self.bandwidth > 0.0 || self.sun_disc != SunDisc::None {
            let key = if self.bandwidth > 0.0 { "light.bandwidth_nm" } else { "light.sun_disc" };
            return refuse(
                key,
                "a mean".into(),
                "means over bands and the sun's disc are for spheres",
            );
        }
        if self.medium.radial().is_some() {
            let accepted = "one index inside: layers, profiles and films are for spheres";
            return refuse("particle.medium", "what varies inside".into(), accepted);
        }
        Ok(())
    }

    /// The exact series know only spheres, and not every switch of the ray method.
    pub(super) fn check_method(&self, alone: bool) -> Result<(), SceneError> {
        if matches!(self.particle, Particle::Crystal { .. }) {
            return Ok(());
        }
        let series = matches!(self.method, Method::Mie | Method::Debye);
        if series && !matches!(self.particle, Particle::Sphere { .. }) {
            let accepted = "the exact series are for spheres; other shapes take \"rays\", \"tmatrix\" or \"auto\"";
            return Err(SceneError::invalid("model.method", self.method.name(), accepted));
        }
        let sphere = matches!(self.particle, Particle::Sphere { .. });
        let takes_any = matches!(self.method, Method::Auto | Method::TMatrix);
        if self.orientation == Orientation::Random && !sphere && !takes_any {
            let value = format!("random with method = \"{}\"", self.method.name());
            let accepted =
                "the T-matrix averages over orientations: method = \"tmatrix\" or \"auto\"";
            return Err(SceneError::invalid("particle.orientation", value, accepted));
        }
        let mie = self.method == Method::Mie || (self.method == Method::Auto && sphere);
        let random = self.orientation == Orientation::Random && !sphere;
        let all_at_once = mie || random || self.method == Method::TMatrix;
        let one = self.size_distribution.as_ref().is_none_or(|sizes| sizes.single().is_some());
        let one = one && self.canting == 0.0;
        if !all_at_once && one && self.interference == Interference::WithinOrders {
            let accepted = "orders of one drop add as waves (true) or as powers with all rays (false); \
                            \"within-orders\" is for a size_distribution or canting, by rays";
            return Err(SceneError::invalid("model.interference", "within-orders", accepted));
        }
        if !all_at_once && self.method != Method::Debye {
            return Ok(());
        }
        // What Lorenz–Mie (also by "auto" of a sphere), the T-matrix and the sum of Debye terms know nothing of.
        let refuse = |key: &str, value: String, accepted: &str| {
            let method = format!("with method = \"{}\"", self.method.name());
            Err(SceneError::invalid(key, format!("{value} {method}"), accepted))
        };
        if let (true, Orders::List(list)) = (all_at_once, &self.orders) {
            let accepted = if mie {
                "Lorenz–Mie, which \"auto\" takes for a sphere, has all orders at once; method = \"debye\" or \
                 \"rays\" takes a list"
            } else {
                "the T-matrix has all orders at once; method = \"rays\" takes a list"
            };
            return refuse("model.orders", format!("{list:?}"), accepted);
        }
        if let Some(rays) = self.rays_across {
            let accepted = "an exact series has no rays; method = \"rays\" takes it";
            return refuse("model.rays_across", rays.to_string(), accepted);
        }
        if self.diffraction != Diffraction::Airy {
            let accepted = "an exact series has its own diffraction; method = \"rays\" takes it";
            return refuse("model.diffraction", self.diffraction.name().into(), accepted);
        }
        if self.forward_peak == ForwardPeak::Separate {
            let accepted = "an exact series has no forward peak apart from the rest; \"cell_average\" and \
                            \"point\" have it in the table, method = \"rays\" can keep it apart";
            return refuse("table.forward_peak", self.forward_peak.name().into(), accepted);
        }
        // Within orders is what drops of the same scene take; to a mean of the exact series it says nothing.
        let told = self.interference == Interference::WithinOrders
            && (!alone || self.size_distribution.is_some());
        if self.interference != Interference::Waves && !told {
            let accepted = "an exact series adds waves; method = \"rays\" can leave that out";
            return refuse("model.interference", self.interference.name().into(), accepted);
        }
        Ok(())
    }

    /// Means over sizes, bands and the sun's disc are taken of the exact series.
    pub(super) fn check_means(&self) -> Result<(), SceneError> {
        if matches!(self.particle, Particle::Crystal { .. }) {
            return Ok(());
        }
        let sphere = matches!(self.particle, Particle::Sphere { .. });
        let exact = sphere && !matches!(self.method, Method::Rays | Method::TMatrix);
        let many = self.size_distribution.is_some();
        let sizes = self.size_distribution.as_ref().is_some_and(|sizes| sizes.single().is_none());
        let single = self.method == Method::Debye && (many || self.bandwidth > 0.0);
        if exact && !single {
            return Ok(());
        }
        let by_rays = matches!(self.method, Method::Rays) || !sphere && self.method == Method::Auto;
        if (sizes || self.canting > 0.0) && by_rays {
            self.check_drops()?;
        }
        if self.canting > 0.0 && !by_rays {
            let value =
                format!("{}°, method = \"{}\"", self.canting.to_degrees(), self.method.name());
            let accepted = "drops that cant are computed by rays: method = \"rays\" or \"auto\"";
            return Err(SceneError::invalid("particle.canting", value, accepted));
        }
        let accepted = "means over sizes, bands and the sun's disc need a sphere and method = \
                        \"mie\" (or \"auto\"); \"debye\" takes the sun's disc alone, \"rays\" many sizes or \
                        tilts, with the sun's disc or without";
        if sizes && !by_rays {
            let key = "particle.size_distribution";
            let method = format!("(many spheres) with method = \"{}\"", self.method.name());
            return Err(SceneError::invalid(key, method, accepted));
        }
        if self.bandwidth > 0.0 {
            let nm = self.bandwidth * 1e9;
            return Err(SceneError::invalid("light.bandwidth_nm", nm, accepted));
        }
        let many = sizes || self.canting > 0.0;
        if self.sun_disc != SunDisc::None && !(many && by_rays) {
            return Err(SceneError::invalid("light.sun_disc", self.sun_disc.name(), accepted));
        }
        Ok(())
    }

    /// A mean over sizes by rays adds orders as powers, and knows the uniform formulas only.
    fn check_drops(&self) -> Result<(), SceneError> {
        let refuse = |key: &str, value: &str, accepted: &str| {
            let many = "with many sizes or tilts";
            Err(SceneError::invalid(key, format!("{value} {many}"), accepted))
        };
        let bounds = self.size_distribution.as_ref().map(SizeDistribution::bounds);
        if bounds.is_some_and(|(from, to)| from == 0.0 || to.is_infinite()) {
            let accepted = "a mean over sizes by rays needs both limits, such as from_radius_mm = 0.1, \
                            to_radius_mm = 1.5";
            return refuse("particle.size_distribution", "method = \"rays\"", accepted);
        }
        if self.orientation == Orientation::Random {
            let accepted = "the mean over sizes by rays takes \"upright\"";
            return refuse("particle.orientation", self.orientation.name(), accepted);
        }
        if self.interference != Interference::WithinOrders {
            let accepted = "in a mean over sizes by rays orders add as powers: \"within-orders\"";
            return refuse("model.interference", self.interference.name(), accepted);
        }
        if self.diffraction != Diffraction::Airy {
            let accepted = "the mean over sizes by rays takes \"airy\"";
            return refuse("model.diffraction", self.diffraction.name(), accepted);
        }
        if self.forward_peak == ForwardPeak::Separate {
            let accepted = "the peaks of many sizes are no peak apart from the rest: \"cell_average\" or \
                            \"point\"";
            return refuse("table.forward_peak", self.forward_peak.name(), accepted);
        }
        if let Orders::List(list) = &self.orders {
            let accepted = "a mean over sizes by rays takes all orders that matter: \"auto\"";
            return refuse("model.orders", &format!("{list:?}"), accepted);
        }
        if let Some(rays) = self.rays_across {
            let accepted = "the rays of many sizes are chosen by size; leave it out";
            return refuse("model.rays_across", &rays.to_string(), accepted);
        }
        Ok(())
    }

    /// Rays that have left a body do not come back to it, and go straight on from walls that are nearly flat.
    pub(super) fn check_outline(&self) -> Result<(), SceneError> {
        let Particle::Own { body, .. } = &self.particle else { return Ok(()) };
        if self.method == Method::TMatrix {
            return Ok(());
        }
        if let Some(theta) = body.dent() {
            let accepted = "rays take bodies without a dent; method = \"tmatrix\" takes this one where it is small";
            let value = format!("an outline that is dented at θ = {:.1}°", theta.to_degrees());
            return Err(SceneError::invalid("particle.coefficients", value, accepted));
        }
        Ok(())
    }

    /// What varies along the radius is solved by the exact series.
    pub(super) fn check_radial(&self) -> Result<(), SceneError> {
        let Some(radial) = self.medium.radial() else { return Ok(()) };
        let sphere = matches!(self.particle, Particle::Sphere { .. });
        if let Inside::Profile(profile @ Profile::Inverse { .. }) = &radial.inside {
            let accepted = "a profile that is finite at the centre: here waves wind about it without end, and \
                            no series is regular there; gonio rays draws it";
            return Err(SceneError::invalid("particle.medium", profile.name(), accepted));
        }
        if sphere && matches!(self.method, Method::Auto | Method::Mie) {
            return Ok(());
        }
        let accepted = "layers, profiles and films are for spheres with method = \"mie\" (or \"auto\"): \
                        rays, Debye terms and the T-matrix follow one index inside";
        let value = match sphere {
            true => format!("{} with method = \"{}\"", radial.name(), self.method.name()),
            false => format!("{} in a particle that is no sphere", radial.name()),
        };
        let key = if radial.films.is_empty() { "particle.medium" } else { "particle.coating" };
        Err(SceneError::invalid(key, value, accepted))
    }
}
