//! Whether a Lee diagram is sampled finely enough: its colours against a run with four times the
//! wavelengths and four times the angular frequencies, as CIEDE2000.
//!
//! The exposure is the picture's own: every column's brightest angle has luminance 0.8 of D65 white.
//! With `GONIO_LEE_RADII=40` as many radii of the default range are measured and printed.

use gonio::color::{Illuminant, Observer, delta_e_2000, illuminant_white, lab};
use gonio::lee::{Polarisation, Request, column_exposures, spheres};
use gonio::medium::Medium;

fn request(radii: Vec<f64>, fineness: f64) -> Request {
    Request {
        radii,
        theta: (0..=400).map(|i| (120.0 + 0.075 * f64::from(i)).to_radians()).collect(),
        medium: Medium::Water { temperature: 293.15 },
        sun_disc: true,
        size_spread: 0.0,
        illuminant: Illuminant::D65,
        observer: Observer::Cie1931,
        fineness,
    }
}

/// ΔE at all angles of one radius, ascending.
fn differences(radius: f64) -> Vec<f64> {
    let white = illuminant_white(Illuminant::D65, Observer::Cie1931);
    let colours = |fineness| {
        let seen = spheres(&request(vec![radius], fineness)).unwrap().seen(Polarisation::Total);
        let exposure = column_exposures(&seen, 0.8)[0];
        seen[0].iter().map(|xyz| lab(xyz.map(|v| v * exposure), white)).collect::<Vec<_>>()
    };
    let (usual, fine) = (colours(1.0), colours(4.0));
    let mut out: Vec<f64> = usual.iter().zip(fine).map(|(a, b)| delta_e_2000(*a, b)).collect();
    out.sort_by(f64::total_cmp);
    out
}

/// Radii over the whole default range, between those that the numbers of wavelengths were chosen by.
#[test]
fn no_colour_changes_visibly_with_finer_sampling() {
    for i in 0..12 {
        let radius = 1.03e-5 * 97f64.powf(f64::from(i) / 11.0);
        let all = differences(radius);
        assert!(all[400] <= 0.9, "{radius}: median {:.2}, largest {:.2}", all[200], all[400]);
    }
}

#[test]
fn table_of_differences() {
    let Some(count) = std::env::var("GONIO_LEE_RADII").ok().and_then(|n| n.parse::<u32>().ok())
    else {
        eprintln!("skipped: GONIO_LEE_RADII is not set");
        return;
    };
    println!("radius (mm) | ΔE median | ΔE 99 % | ΔE max");
    let mut everything = Vec::new();
    for i in 0..count {
        let radius = 1e-5 * 100f64.powf((f64::from(i) + 0.5) / f64::from(count));
        let all = differences(radius);
        println!("{:.4} | {:.2} | {:.2} | {:.2}", radius * 1e3, all[200], all[396], all[400]);
        everything.extend(all);
    }
    everything.sort_by(f64::total_cmp);
    let at = |q: f64| everything[(q * (everything.len() - 1) as f64) as usize];
    println!("all | {:.2} | {:.2} | {:.2}", at(0.5), at(0.99), at(1.0));
}
