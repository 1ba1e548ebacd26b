//! What rays near the rim of a particle are like, by which the integral over them is judged.

use crate::trace::Tracer;

/// What rays near the rim are like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rim {
    /// Those of a sphere: all is known of them.
    Sphere,
    /// Alike at all azimuths.
    Axial,
    /// Different from azimuth to azimuth.
    Uneven,
}

impl Rim {
    /// That of a particle.
    pub(crate) fn of(tracer: &Tracer) -> Self {
        let shape = tracer.shape();
        match (shape.is_sphere(), shape.rotational_symmetry()) {
            (true, _) => Self::Sphere,
            (false, true) => Self::Axial,
            (false, false) => Self::Uneven,
        }
    }

    /// Whether rays of an order go on beyond the rim smoothly enough for polynomials through all of a ray. Those of
    /// order 1 have no bow before the last: their penumbra hangs on what lies beyond alone.
    pub fn is_settled(self, order: u32) -> bool {
        self == Self::Sphere || (self == Self::Axial && order > 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{RaindropModel, Shape};
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_drop_is_axial_under_the_zenith_sun_alone() {
        let of = |shape: &Shape| Rim::of(&Tracer::new(shape, 1.33.into(), 1e3, 2));
        let drop = |sun: f64| Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, sun).unwrap();
        assert_eq!(of(&Shape::sphere()), Rim::Sphere);
        assert_eq!(of(&drop(FRAC_PI_2)), Rim::Axial);
        assert_eq!(of(&drop(0.3)), Rim::Uneven);
    }
}
