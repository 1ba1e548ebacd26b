//! The twinned bow of the paper's Fig. 17: two showers split the primary and leave the secondary
//! whole. The scene is read from `data/scenes/bows`; its profile is taken straight up from the
//! antisolar point.

use crate::bows::{Peak, WATER, peaks};
use gonio::color::{Illuminant, Observer};
use gonio::lee::{Angles, Beats, Drop, LeeError, Polarisation, Request, diagram};
use gonio::plan::Plan;
use gonio::scene::{Choice, Grid, Orders, SceneFile, ShapeName};
use serde::Deserialize;
use std::f64::consts::{PI, TAU};

#[derive(Deserialize)]
struct Picture {
    sun: Sun,
    drops: Vec<Shower>,
}

#[derive(Deserialize)]
struct Sun {
    elevation_deg: f64,
}

#[derive(Deserialize)]
struct Shower {
    shape: String,
    radius_mm: f64,
    number: Option<f64>,
}

fn scene(name: &str) -> Picture {
    let path = format!("{}/data/scenes/bows/{name}", env!("CARGO_MANIFEST_DIR"));
    toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Luminance of a drop (mm) above the antisolar point, times its cross-section.
fn profile(radius_mm: f64, sun_elevation_deg: f64, theta: &[f64]) -> Vec<f64> {
    let radius = radius_mm * 1e-3;
    let plan = |order: u32| {
        let mut file = SceneFile::default();
        file.particle.shape = Some(Choice(ShapeName::Raindrop));
        file.particle.radius_mm = Some(radius_mm);
        file.light.sun_elevation_deg = Some(sun_elevation_deg);
        file.light.wavelengths_nm = Some(Grid::List(vec![550.0]));
        file.model.method = Some(Choice(gonio::scene::Method::Rays));
        file.model.orders = Some(Orders::List(vec![order]));
        Plan::new(&file.validate().unwrap()).unwrap()
    };
    let plans: Vec<Plan> = (0..=3).map(plan).collect();
    let request = Request {
        radii: vec![radius],
        theta: theta.iter().map(|t| t.to_radians()).collect(),
        medium: WATER,
        sun_disc: true,
        size_spread: 0.0,
        illuminant: Illuminant::D65,
        observer: Observer::Cie1931,
        fineness: 1.0,
    };
    // Light that goes down comes from above.
    let directions = |angles: &Angles| angles.theta.iter().map(|&t| (t, PI)).collect::<Vec<_>>();
    let one = |drop: &Drop, at: &Vec<(f64, f64)>| {
        let mut sum = vec![[0.0; 2]; at.len()];
        for plan in &plans {
            let size_parameter = TAU * drop.radius / drop.wavelength;
            let found = gonio::simulate::scatter(plan, drop.index, size_parameter, at);
            for (sum, m) in sum.iter_mut().zip(found) {
                sum[0] += m.s11();
            }
        }
        sum
    };
    let scatter = |drops: &[Drop], at: &Vec<(f64, f64)>| {
        Ok::<_, LeeError>(drops.iter().map(|drop| one(drop, at)).collect())
    };
    let seen = diagram(&request, Beats::WithinOrders, &directions, scatter).unwrap();
    let area = PI * radius * radius;
    seen.seen(Polarisation::Total)[0].iter().map(|xyz| area * xyz[1]).collect()
}

/// Maxima that stand out by a tenth of the highest: primary, then secondary.
fn bows_of(theta: &[f64], values: &[f64]) -> (Vec<Peak>, Vec<Peak>) {
    let clear = |from: f64, to: f64| {
        let all = peaks(theta, values, from, to);
        let highest = all.iter().fold(0.0, |most, peak| peak.height.max(most));
        all.into_iter().filter(|peak| peak.prominence > 0.1 * highest).collect()
    };
    (clear(136.0, 148.0), clear(121.0, 134.0))
}

#[test]
fn two_showers_split_the_primary_and_leave_the_secondary() {
    let theta: Vec<f64> = (0..=560).map(|i| 120.0 + 0.05 * f64::from(i)).collect();
    for (name, radii, apart) in
        [("twinned.toml", [0.4, 0.45], 0.7..1.0), ("twinned_05.toml", [0.4, 0.5], 1.5..2.1)]
    {
        let picture = scene(name);
        let found: Vec<f64> = picture.drops.iter().map(|shower| shower.radius_mm).collect();
        assert_eq!(found, radii);
        let mut sum = vec![0.0; theta.len()];
        for shower in &picture.drops {
            assert_eq!(shower.shape, "raindrop");
            let own = profile(shower.radius_mm, picture.sun.elevation_deg, &theta);
            let (primary, secondary) = bows_of(&theta, &own);
            assert_eq!((primary.len(), secondary.len()), (1, 1), "one size, one bow: {primary:?}");
            let number = shower.number.unwrap_or(1.0);
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += number * own);
        }
        let (primary, secondary) = bows_of(&theta, &sum);
        println!("{name}: {primary:?} {secondary:?}");
        assert_eq!((primary.len(), secondary.len()), (2, 1), "{name}");
        let split = primary[1].theta - primary[0].theta;
        assert!(apart.contains(&split), "{name}: {split:.2}°");
    }
}
