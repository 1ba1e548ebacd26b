//! Reciprocity: the light's path reversed has the transposed matrix, S3 ↔ -S4 in these frames
//! (van de Hulst 1957, §5.22). A spheroid looks the same from below as from above.

use gonio::optics::AmplitudeMatrix;
use gonio::plan::{Engine, Plan};
use gonio::shape::Shape;
use gonio::simulate;
use num_complex::Complex64;

const WATER: Complex64 = Complex64::new(1.333, 0.0);
/// Vertical over horizontal diameter.
const RATIO: f64 = 0.9;

/// One order without diffraction.
fn plan_of(shape: Shape, order: u32) -> Plan {
    Plan::direct(shape, 1.0, Engine::Meridians, vec![order], false, 0.01, None)
}

/// A direction of light and one of scattering about a vertical axis.
pub struct Path {
    pub sun: f64,
    pub theta: f64,
    pub phi: f64,
}

impl Path {
    /// The same path backwards. A body of revolution does not change when it is turned about its axis, so
    /// only the elevations and the scattering angle matter.
    pub fn reversed(&self) -> Path {
        // vertical component of the scattered direction: z·down = sin(sun), x·down = -cos(sun)
        let down =
            self.theta.cos() * self.sun.sin() - self.theta.sin() * self.phi.cos() * self.sun.cos();
        // reversed light travels along -s: it falls downwards by -down
        let sun = -down.asin();
        // scattered direction is -z: its component along the new "up"
        let sine = self.theta.sin();
        let cos_phi = (self.theta.cos() * sun.sin() + self.sun.sin()) / (sine * sun.cos());
        // the handedness of the triple (axis, incident, scattered) turns over, and φ with it
        Path {
            sun,
            theta: self.theta,
            phi: -cos_phi.clamp(-1.0, 1.0).acos() * self.phi.sin().signum(),
        }
    }
}

/// What the amplitudes of the path backwards say about those of the path.
pub fn turned(back: AmplitudeMatrix) -> AmplitudeMatrix {
    AmplitudeMatrix { s1: back.s1, s2: back.s2, s3: -back.s4, s4: -back.s3 }
}

#[test]
fn reciprocity_of_a_spheroid() {
    for (order, bound) in [(0u32, 1e-4), (1, 1e-4), (2, 1e-4), (3, 1e-4)] {
        let mut size: f64 = 0.0;
        let mut difference: f64 = 0.0;
        for (sun_deg, theta_deg, phi_deg) in [
            (20.0f64, 139.0f64, 40.0f64),
            (20.0, 142.0, 75.0),
            (35.0, 145.0, 110.0),
            (10.0, 30.0, 60.0),
            (10.0, 100.0, 20.0),
            (25.0, 150.0, 150.0),
        ] {
            let direct = Path {
                sun: sun_deg.to_radians(),
                theta: theta_deg.to_radians(),
                phi: phi_deg.to_radians(),
            };
            let back = direct.reversed();
            let of = |path: &Path| {
                let shape = Shape::spheroid(RATIO, path.sun).unwrap();
                simulate::scatter(&plan_of(shape, order), WATER, 3000.0, &[(path.theta, path.phi)])
                    [0]
            };
            let (a, b) = (of(&direct), of(&back));
            size = size.max(a.s11().sqrt());
            difference = difference.max((a - turned(b)).s11().sqrt());
        }
        println!(
            "p = {order}: reciprocity within {:.1e} of the largest amplitude",
            difference / size
        );
        assert!(difference < bound * size, "p = {order}: {}", difference / size);
    }
}
