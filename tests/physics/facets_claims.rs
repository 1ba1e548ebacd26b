//! The same amplitude there and back in the directions in which beams leave.

use glam::{DMat3, DVec3};
use gonio::facets::beams::{Incidence, Settings, split};
use gonio::facets::orientation::Stand;
use gonio::facets::{Body, FarField};

/// In the directions in which beams leave, the whole amplitude there is that on the way back the more nearly the
/// larger the body: the sum over all other beams' edges is what differs.
#[test]
fn the_way_back_along_beams() {
    let turn = Stand::Fixed { zenith: 0.7, azimuth: 0.4, spin: 0.3 }.rotation([0.5; 3], 0.2);
    let body = Body::hexagonal_column(1.2).unwrap().turned(&turn);
    let settings = Settings { last_order: 24, least_power: 1e-6 };
    let mut last = f64::INFINITY;
    for x in [50.0, 200.0, 800.0] {
        let light = Incidence { index: 1.31.into(), size_parameter: x };
        let beams = split(&body, &light, &settings);
        let mut ways: Vec<(f64, DVec3)> = Vec::new();
        for patch in &beams.patches {
            let Some(way) = patch.leaving.direction else { continue };
            // not ahead, where the shadow is
            if way.z > 0.99 || patch.leaving.order == 0 {
                continue;
            }
            match ways.iter_mut().find(|(_, other)| other.angle_between(way) < 1e-9) {
                Some((power, _)) => *power += patch.leaving.power,
                None => ways.push((patch.leaving.power, way)),
            }
        }
        ways.sort_by(|a, b| b.0.total_cmp(&a.0));
        let far = FarField::new(&beams, &light);
        let (mut off, mut all) = (0.0, 0.0);
        for (_, out) in ways.iter().take(6) {
            let at = (out.x.hypot(out.y).atan2(out.z), out.y.atan2(out.x));
            let there = far.amplitudes(&[at])[0];
            let across = DVec3::Z.cross(*out).normalize();
            let z = -*out;
            let frame = DMat3::from_cols(across.cross(z), across, z).transpose();
            let goal = frame * -DVec3::Z;
            let at = (goal.x.hypot(goal.y).atan2(goal.z), goal.y.atan2(goal.x));
            let turned = body.turned(&frame);
            let back =
                FarField::new(&split(&turned, &light, &settings), &light).amplitudes(&[at])[0];
            let cross = (there.s3 + back.s4).norm_sqr() + (there.s4 + back.s3).norm_sqr();
            let same = (there.s1 - back.s1).norm_sqr() + (there.s2 - back.s2).norm_sqr();
            off += 0.5 * (same + cross);
            all += there.s11();
        }
        let relative = f64::sqrt(off / all);
        println!("x = {x}: {relative:.4} of the amplitude in six beams");
        assert!(relative < last, "{relative} {last}");
        last = relative;
    }
    assert!(last < 0.05, "{last}");
}
