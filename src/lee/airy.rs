//! The diagram by Airy's theory of both bows: what it has of the rainbow, and what it lacks, beside the exact one.

use super::{Angles, Beats, Diagram, LeeError, Request, diagram};
use crate::series::airy::AiryBow;
use std::f64::consts::TAU;

/// Orders of the primary and the secondary bow.
const ORDERS: [u32; 2] = [2, 3];

/// Spheres by Airy's theory: orders 2 and 3 alone, as powers. An order that has no bow is not there.
///
/// # Errors
/// As [`super::spheres`].
pub fn airy_spheres(request: &Request) -> Result<Diagram, LeeError> {
    let angles = |angles: &Angles| angles.theta.clone();
    diagram(request, Beats::WithinOrders, &angles, |drops, theta| {
        let one = |drop: &super::Drop| {
            let size_parameter = TAU * drop.radius / drop.wavelength;
            let bows = ORDERS.map(|order| AiryBow::new(size_parameter, drop.index, order));
            let at = |&theta: &f64| {
                bows.iter().flatten().fold([0.0; 2], |sum: [f64; 2], bow| {
                    let (s1, s2) = bow.amplitudes(theta);
                    [sum[0] + 0.5 * s2.norm_sqr(), sum[1] + 0.5 * s1.norm_sqr()]
                })
            };
            theta.iter().map(at).collect()
        };
        Ok::<_, LeeError>(drops.iter().map(one).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::super::spheres;
    use super::*;
    use crate::color::{Illuminant, Observer};
    use crate::medium::Medium;

    /// About the primary bow its light is that of Lorenz–Mie within a tenth; between the bows it has next to none.
    #[test]
    fn the_primary_is_that_of_the_exact_series() {
        let request = Request {
            radii: vec![0.1e-3],
            theta: (0..=20).map(|i| (130.0 + 0.5 * f64::from(i)).to_radians()).collect(),
            medium: Medium::Constant(1.333.into()),
            sun_disc: true,
            size_spread: 0.0,
            illuminant: Illuminant::D65,
            observer: Observer::Cie1931,
            fineness: 0.5,
        };
        let light =
            |diagram: &Diagram, i: usize| diagram.xyz[0][i].iter().map(|xyz| xyz[1]).sum::<f64>();
        let (airy, exact) = (airy_spheres(&request).unwrap(), spheres(&request).unwrap());
        for i in [17, 18, 19] {
            let ratio = light(&airy, i) / light(&exact, i);
            assert!((0.88..1.12).contains(&ratio), "{}: {ratio}", request.theta[i].to_degrees());
        }
        assert!(light(&airy, 6) < 0.1 * light(&exact, 6));
    }
}
