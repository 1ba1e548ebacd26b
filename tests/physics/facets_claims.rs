//! What beams of facets must be in limits that have other truths: Fresnel's sum where nothing comes through,
//! Lorenz–Mie where a mesh becomes a sphere, the same amplitude there and back in beams' own directions, and means
//! over few orientations beside those over many.

use glam::{DMat3, DVec3};
use gonio::facets::beams::{Incidence, Settings, split};
use gonio::facets::mean::{Azimuths, Request, Sums};
use gonio::facets::orientation::{Stand, point};
use gonio::facets::{Body, FarField};
use gonio::series::lorenz_mie::Sphere;
use num_complex::Complex64;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// An icosahedron whose triangles are cut into four, corners on the sphere, so many times.
fn geodesic(cuts: u32) -> Body {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::new();
    for (a, b) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
        corners.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
    }
    let mut corners: Vec<DVec3> = corners.into_iter().map(DVec3::normalize).collect();
    let near = |i: usize, j: usize| (corners[i] - corners[j]).length() < 1.06;
    let mut facets = Vec::new();
    for i in 0..12 {
        for j in 0..i {
            for k in 0..j {
                if near(i, j) && near(j, k) && near(i, k) {
                    let [a, b, c] = [i, j, k].map(|n| corners[n]);
                    let outwards = (b - a).cross(c - a).dot(a) > 0.0;
                    facets.push(if outwards { vec![i, j, k] } else { vec![i, k, j] });
                }
            }
        }
    }
    for _ in 0..cuts {
        let mut middles: HashMap<(usize, usize), usize> = HashMap::new();
        let mut cut = Vec::new();
        for f in &facets {
            let mut middle = |a: usize, b: usize| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    corners.push((corners[a] + corners[b]).normalize());
                    corners.len() - 1
                })
            };
            let (x, y, z) = (middle(f[0], f[1]), middle(f[1], f[2]), middle(f[2], f[0]));
            cut.extend([vec![f[0], x, z], vec![f[1], y, x], vec![f[2], z, y], vec![x, y, z]]);
        }
        facets = cut;
    }
    Body::new(&corners, &facets).unwrap()
}

/// Facets of a sphere's mesh scatter as the sphere does the better the finer they are: powers in bands of 6° from
/// 6 to 60°, relative to those of Lorenz–Mie, an absorbing sphere (what comes out after one chord).
#[test]
fn a_mesh_of_a_sphere_becomes_the_sphere() {
    let index = Complex64::new(1.31, 0.002);
    let x = 400.0;
    let angles: Vec<f64> = (0..=108).map(|i| (6.0 + 0.5 * f64::from(i)).to_radians()).collect();
    let sphere = Sphere::new(x, index).unwrap();
    let known: Vec<f64> = sphere
        .amplitudes(&angles)
        .iter()
        .map(|(s1, s2)| 0.5 * (s1.norm_sqr() + s2.norm_sqr()))
        .collect();
    let bands = |curve: &[f64]| -> Vec<f64> {
        let part = |k: usize| {
            let part = (12 * k..=12 * k + 12).map(|i| curve[i] * angles[i].sin());
            part.sum::<f64>()
        };
        (0..9).map(part).collect()
    };
    let mut errors = Vec::new();
    for cuts in 0..3 {
        let body = geodesic(cuts);
        let turns = 4;
        let mut curve = vec![0.0; angles.len()];
        for index_of_turn in 0..turns {
            let turn = Stand::Random.rotation(point(index_of_turn, 0), 0.0);
            let light = Incidence { index, size_parameter: x };
            let settings = Settings { last_order: 4, least_power: 1e-5 };
            let far = FarField::new(&split(&body.turned(&turn), &light, &settings), &light);
            for (value, &theta) in curve.iter_mut().zip(&angles) {
                let ways: Vec<(f64, f64)> =
                    (0..24).map(|j| (theta, TAU * (f64::from(j) + 0.5) / 24.0)).collect();
                let sum: f64 = far.amplitudes(&ways).iter().map(|s| s.s11()).sum();
                *value += sum / 24.0 / f64::from(turns);
            }
        }
        let (found, known) = (bands(&curve), bands(&known));
        let off = found.iter().zip(&known).map(|(a, b)| (a / b - 1.0).powi(2)).sum::<f64>();
        errors.push((off / 9.0).sqrt());
        println!("{} facets: {:.3}", body.facets().len(), errors[errors.len() - 1]);
    }
    assert!(errors.windows(2).all(|e| e[1] < e[0]), "{errors:?}");
}

/// Where all that enters is absorbed, what is left is Fresnel's reflection of each lit facet; and whatever the
/// absorption, nothing is lost.
#[test]
fn absorption_to_its_end() {
    let n = 1.31;
    for (body, tilt) in [
        (Body::cuboid(1.0).unwrap(), 0.4),
        (Body::hexagonal_column(1.5).unwrap(), 0.9),
        (Body::brilliant().unwrap(), 0.3),
    ] {
        let body = body.turned(&(DMat3::from_rotation_y(tilt) * DMat3::from_rotation_z(0.2)));
        let reflected: f64 = body
            .facets()
            .iter()
            .map(|facet| {
                let cos = -facet.normal.z;
                if cos <= 0.0 {
                    return 0.0;
                }
                let inside = (1.0 - (1.0 - cos * cos) / (n * n)).sqrt();
                let across = ((cos - n * inside) / (cos + n * inside)).powi(2);
                let along = ((n * cos - inside) / (n * cos + inside)).powi(2);
                0.5 * (across + along) * cos * facet.area(body.vertices())
            })
            .sum::<f64>()
            / body.shadow(DVec3::Z);
        let (mut last, mut left) = (0.0, Vec::new());
        for (k, x) in [(1e-6, 3e3), (1e-4, 3e3), (1e-3, 3e3), (1e-2, 3e3), (3e-2, 3e3), (3e-2, 3e4)]
        {
            let light = Incidence { index: Complex64::new(n, k), size_parameter: x };
            let budget =
                split(&body, &light, &Settings { last_order: 60, least_power: 1e-12 }).budget;
            assert!(budget.residual.abs() < 1e-12, "{k}: {}", budget.residual);
            assert!(budget.absorbed > last && (budget.left_by_order[0] - reflected).abs() < 1e-13);
            last = budget.absorbed;
            left.push(1.0 - reflected - last);
        }
        // edges let something through, as wide as light goes
        println!(
            "absorbed at the end all but {:.2e}, {:.2e} of {:.4}",
            left[4],
            left[5],
            1.0 - reflected
        );
        assert!((0.0..3e-3).contains(&left[4]), "{left:?}");
        assert!((0.05..0.2).contains(&(left[5] / left[4])), "{left:?}");
    }
}

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

/// Random columns of kR = 50, 0.5 to 20°: 256 orientations beside 4096 others, and what the replicas say of it.
#[test]
fn a_mean_over_256_orientations() {
    let body = Body::hexagonal_column(1.0).unwrap();
    let radius = body.vertices().iter().map(|v| v.x.hypot(v.y)).fold(0.0, f64::max);
    let theta: Vec<f64> = (1..=40).map(|i| (0.5 * f64::from(i)).to_radians()).collect();
    let mean = |count: u32, replicas: u32| {
        let request = Request {
            body: &body,
            stand: Stand::Random,
            sun_elevation: 0.0,
            light: Incidence { index: 1.31.into(), size_parameter: 50.0 / radius },
            settings: Settings { last_order: 12, least_power: 1e-4 },
            theta: &theta,
            cells: &[],
            azimuths: Azimuths::Mean(8),
            whole: false,
            count,
            replicas,
        };
        request.replicas()
    };
    let (few, many) = (mean(32, 8), mean(512, 8));
    let (a, b) = (Sums::mean(&few), Sums::mean(&many));
    let (mut off, mut stated) = (0.0, 0.0);
    for i in 0..theta.len() {
        let (x, y) = (a.mueller[i], b.mueller[i]);
        off += (x / y - 1.0).powi(2);
        let scatter: f64 = few.iter().map(|s| (s.mueller[i] / x - 1.0).powi(2)).sum();
        stated += scatter / 56.0;
    }
    let mean = |sum: f64| (sum / theta.len() as f64).sqrt();
    let (off, stated) = (mean(off), mean(stated));
    println!("off by {off:.4} root mean square over angles, stated {stated:.4}");
    assert!(off < 0.05 && (0.5..2.0).contains(&(stated / off)), "{off} {stated}");
}
