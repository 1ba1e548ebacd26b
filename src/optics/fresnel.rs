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
    let mut transmitted = square.sqrt();
    if transmitted.im < 0.0 && square.re < 0.0 {
        transmitted = -transmitted;
    }
    let mct = m * transmitted;
    let (perpendicular, parallel) = ((c + mct).inv(), (m * c + transmitted).inv());
    let root = 2.0 * (c * mct).sqrt();
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
    let inside = (1.0 - (1.0 - c * c) / (index * index)).sqrt();
    let g = grazing;
    let (mct, root) = (index * inside, 2.0 * g.root * (index * inside).sqrt());
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
    let (mct, root) = (index * inside, 2.0 * g.root * (index * inside).sqrt());
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
