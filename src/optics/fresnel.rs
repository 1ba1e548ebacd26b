//! Fresnel coefficients of a plane interface, normalised to power.
//!
//! `r` as in Bohren & Huffman 1983, eqs. 2.67–2.70; `t` is multiplied by `√(n₂ cos θt / n₁ cos θi)`
//! so that `|r|² + |t|² = 1`. Written as `2 √(cᵢ m cₜ) / (…)`, `t` stays finite at grazing incidence.
//! With `exp(-iωt)` the evanescent wave under total reflection has `cos θt = +i |cos θt|`.

use super::grazing::Grazing;
use crate::math::scalar::Scalar;
use num_complex::Complex64;

/// Reflection and power-normalised transmission for both polarisations.
#[derive(Clone, Copy, Debug)]
pub struct Fresnel {
    /// Reflected over incident field, normal to the plane of incidence.
    pub r_perpendicular: Complex64,
    /// Reflected over incident field, in the plane of incidence.
    pub r_parallel: Complex64,
    /// Transmitted over incident field, normal to the plane of incidence, scaled to power.
    pub t_perpendicular: Complex64,
    /// Transmitted over incident field, in the plane of incidence, scaled to power.
    pub t_parallel: Complex64,
}

/// Coefficients for the cosine of incidence and the index behind over the index before.
pub fn fresnel<T: Scalar>(cos_incidence: T, relative_index: Complex64) -> Fresnel {
    if T::REAL && relative_index.im == 0.0 {
        let (c, m) = (cos_incidence.re(), relative_index.re);
        let square = 1.0 - (1.0 - c * c) / (m * m);
        if square >= 0.0 {
            return real_interface(c, m, square.sqrt());
        }
    }
    let c = cos_incidence.complex();
    let m = relative_index;
    let square = 1.0 - (1.0 - c * c) / (m * m);
    let mut transmitted = square.root();
    if transmitted.im < 0.0 && square.re < 0.0 {
        transmitted = -transmitted;
    }
    let mct = m * transmitted;
    let (perpendicular, parallel) = ((c + mct).inv(), (m * c + transmitted).inv());
    let root = 2.0 * (c * mct).root();
    Fresnel {
        r_perpendicular: (c - mct) * perpendicular,
        r_parallel: (m * c - transmitted) * parallel,
        t_perpendicular: root * perpendicular,
        t_parallel: root * parallel,
    }
}

/// Coefficients of a curved interface for a wave from outside (index `m` behind), for the cosine
/// outside and what stands for it on the curved surface. `r` holds for reflection outside.
pub fn curved_from_outside<T: Scalar>(cos: T, index: Complex64, grazing: &Grazing) -> Fresnel {
    let c = cos.complex();
    let inside = (1.0 - (1.0 - c * c) / (index * index)).root();
    let g = grazing;
    let (mct, root) = (index * inside, 2.0 * g.root * (index * inside).root());
    let (perpendicular, parallel) = ((g.lambda + mct).inv(), (index * g.lambda + inside).inv());
    Fresnel {
        r_perpendicular: (g.lambda_in - mct) * perpendicular * g.turn,
        r_parallel: (index * g.lambda_in - inside) * parallel * g.turn,
        t_perpendicular: root * perpendicular,
        t_parallel: root * parallel,
    }
}

/// The same for a wave from inside, for the cosine inside; `index` is that of the inside.
pub fn curved_from_inside<T: Scalar>(cos: T, index: Complex64, grazing: &Grazing) -> Fresnel {
    let inside = cos.complex();
    let g = grazing;
    let (mct, root) = (index * inside, 2.0 * g.root * (index * inside).root());
    let (perpendicular, parallel) = ((g.lambda + mct).inv(), (index * g.lambda + inside).inv());
    Fresnel {
        r_perpendicular: (mct - g.lambda) * perpendicular,
        r_parallel: (inside - index * g.lambda) * parallel,
        t_perpendicular: root * perpendicular,
        t_parallel: root * parallel,
    }
}

/// The everyday case without complex arithmetic.
fn real_interface(c: f64, m: f64, transmitted: f64) -> Fresnel {
    let real = |x: f64| Complex64::new(x, 0.0);
    let mct = m * transmitted;
    let (perpendicular, parallel) = (1.0 / (c + mct), 1.0 / (m * c + transmitted));
    let root = 2.0 * (c * mct).sqrt();
    Fresnel {
        r_perpendicular: real((c - mct) * perpendicular),
        r_parallel: real((m * c - transmitted) * parallel),
        t_perpendicular: real(root * perpendicular),
        t_parallel: real(root * parallel),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INDICES: [f64; 4] = [1.333, 2.4, 1.0 / 1.333, 0.6];

    fn real(x: f64) -> Complex64 {
        x.into()
    }

    /// What is not reflected goes on, and under total reflection nothing does.
    #[test]
    fn power_is_conserved() {
        for m in INDICES {
            for cos in [1.0, 0.9, 0.5, 0.1, 1e-4] {
                let f = fresnel(cos, real(m));
                for (r, t) in [(f.r_perpendicular, f.t_perpendicular), (f.r_parallel, f.t_parallel)]
                {
                    let total = m < 1.0 && 1.0 - cos * cos > m * m;
                    let through = if total { 0.0 } else { t.norm_sqr() };
                    assert!((r.norm_sqr() + through - 1.0).abs() < 1e-14, "{m} {cos}: {f:?}");
                }
            }
        }
    }

    #[test]
    fn known_values() {
        let f = fresnel(1.0, real(1.5));
        assert!((f.r_perpendicular + 0.2).norm() < 1e-15 && (f.r_parallel - 0.2).norm() < 1e-15);
        // Brewster's angle
        let brewster = fresnel((1.5f64).atan().cos(), real(1.5));
        assert!(brewster.r_parallel.norm() < 1e-15);
        assert!((brewster.t_parallel - 1.0).norm() < 1e-15);
        // metals: Born & Wolf, r = (1 - m)/(1 + m) at normal incidence
        let m = Complex64::new(0.2, 3.4);
        assert!((fresnel(1.0, m).r_perpendicular - (1.0 - m) / (1.0 + m)).norm() < 1e-15);
    }

    /// Stokes: the way back has the same transmission and the opposite reflection.
    #[test]
    fn the_way_back_has_the_same_transmission() {
        for cos in [0.95, 0.4, 0.05f64] {
            let inside = (1.0 - (1.0 - cos * cos) / (1.4 * 1.4)).sqrt();
            let (there, back) = (fresnel(cos, real(1.4)), fresnel(inside, real(1.0 / 1.4)));
            assert!((there.t_parallel - back.t_parallel).norm() < 1e-14);
            assert!((there.t_perpendicular - back.t_perpendicular).norm() < 1e-14);
            assert!((there.r_parallel + back.r_parallel).norm() < 1e-14);
            assert!((there.r_perpendicular + back.r_perpendicular).norm() < 1e-14);
        }
    }

    /// With `exp(-iωt)` the wave behind decays: `r = (c - iκ)/(c + iκ)` for the perpendicular field.
    #[test]
    fn total_reflection_has_the_phase_of_a_decaying_wave() {
        let (m, cos) = (1.0 / 1.5, 0.3f64);
        let kappa = (1.0 - cos * cos - m * m).sqrt();
        let f = fresnel(cos, real(m));
        let expected = Complex64::new(cos, -kappa) / Complex64::new(cos, kappa);
        assert!((f.r_perpendicular - expected).norm() < 1e-14);
        let parallel = Complex64::new(m * m * cos, -kappa) / Complex64::new(m * m * cos, kappa);
        assert!((f.r_parallel - parallel).norm() < 1e-14);
    }

    /// Real and complex arithmetic agree, as do complex angles that are real.
    #[test]
    fn the_quick_way_is_the_general_way() {
        for (m, cos) in [(1.333, 0.7), (0.75, 0.9)] {
            let (quick, general) = (fresnel(cos, real(m)), fresnel(real(cos), real(m)));
            assert!((quick.r_parallel - general.r_parallel).norm() < 1e-15);
            assert!((quick.t_perpendicular - general.t_perpendicular).norm() < 1e-15);
        }
    }

    #[test]
    fn a_flat_interface_is_the_limit_of_a_curved_one() {
        let m = Complex64::new(1.333, 1e-3);
        for cos in [0.9, 0.3f64] {
            let flat = Grazing::flat((cos * cos).into());
            let (outside, plane) = (curved_from_outside(cos, m, &flat), fresnel(cos, m));
            assert!((outside.r_parallel - plane.r_parallel).norm() < 1e-14);
            assert!((outside.r_perpendicular - plane.r_perpendicular).norm() < 1e-14);
            assert!((outside.t_parallel - plane.t_parallel).norm() < 1e-14);
            let inside = (1.0 - (1.0 - real(cos * cos)) / (m * m)).sqrt();
            let (back, plane) = (curved_from_inside(inside, m, &flat), fresnel(inside, m.inv()));
            assert!((back.r_parallel - plane.r_parallel).norm() < 1e-14);
            assert!((back.r_perpendicular - plane.r_perpendicular).norm() < 1e-14);
            assert!((back.t_perpendicular - plane.t_perpendicular).norm() < 1e-14);
        }
    }
}
