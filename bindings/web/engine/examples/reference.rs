//! What the page shows, by other ways of the library than the page's: a sky from a table of 351 wavelengths, as
//! `gonio render` draws it, and scattered light of one wavelength from the partial waves themselves.
//! `tests/pictures.test.mjs` compares the page with it.
//!
//! The question is JSON on standard input, the answer RGB bytes (`picture`) or little-endian f64 (`curve`: angle in
//! degrees, whole, order 2 for each angle) on standard output.

use gonio::color::{Illuminant, Observer};
use gonio::medium::Medium;
use gonio::render::camera::{Camera, Lens};
use gonio::render::sky::{Drops, RainShape, Sky, render};
use gonio::scene::{Scene, SceneFile};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
use gonio_web::sky::{BACKGROUND, BRIGHTEST, GROUND};
use num_complex::Complex64;
use serde::Deserialize;
use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::io::{Read, Write};

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Question {
    Picture(Picture),
    Curve { radius_um: f64, wavelength_nm: f64, theta_deg: [f64; 2], points: usize },
}

#[derive(Deserialize)]
struct Picture {
    radius_um: f64,
    sun_elevation_deg: f64,
    fov_deg: f64,
    elevation_deg: f64,
    azimuth_deg: f64,
    width: usize,
    height: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let bytes = match serde_json::from_str(&text)? {
        Question::Picture(asked) => picture(&asked)?,
        Question::Curve { radius_um, wavelength_nm, theta_deg: [from, to], points } => {
            let last = (points - 1) as f64;
            let deg: Vec<f64> = (0..points).map(|i| from + (to - from) * i as f64 / last).collect();
            curve(radius_um * 1e-6, wavelength_nm * 1e-9, &deg)?
        }
    };
    std::io::stdout().write_all(&bytes)?;
    Ok(())
}

fn picture(asked: &Picture) -> Result<Vec<u8>, Box<dyn Error>> {
    let keys: SceneFile = toml::from_str(&format!(
        "[particle]\nshape = 'sphere'\nradius_um = {}\n[light]\nsun_elevation_deg = {}\n\
         wavelengths_nm = {{ from = 380, to = 730, count = 351 }}\nsun_disc = 'limb-darkened'\n\
         [table]\ntheta_deg = {{ from = 90, to = 180, count = 1801 }}\nazimuth_deg = [0]\n\
         [model]\nmethod = 'mie'",
        asked.radius_um, asked.sun_elevation_deg
    ))?;
    let table = gonio::simulate::table(&Scene::built_in(&keys)?)?;
    let camera = Camera {
        lens: Lens::Rectilinear,
        field_of_view: asked.fov_deg.to_radians(),
        elevation: asked.elevation_deg.to_radians(),
        azimuth: asked.azimuth_deg.to_radians(),
        width: asked.width,
        height: asked.height,
    };
    let sky = Sky {
        sun_elevation: asked.sun_elevation_deg.to_radians(),
        sun_disc: true,
        illuminant: Illuminant::D65,
        observer: Observer::Cie1931,
        rain: RainShape::Around,
        optical_depth: 1.0,
        background: BACKGROUND,
        ground: Some(GROUND),
        brightness: BRIGHTEST,
        exposure: None,
        polariser: None,
        horizon_line: false,
    };
    Ok(render(&camera, &sky, &[Drops { table: &table, number: 1.0 }])?.picture.rgb)
}

/// Differential cross-section over the geometrical one, sr⁻¹, of water at 20 °C.
fn curve(radius: f64, wavelength: f64, deg: &[f64]) -> Result<Vec<u8>, Box<dyn Error>> {
    let index = Medium::Water { temperature: 293.15 }.index(wavelength)?;
    let x = TAU * radius / wavelength;
    let theta: Vec<f64> = deg.iter().map(|deg| deg.to_radians()).collect();
    let intensity =
        |(s1, s2): &(Complex64, Complex64)| 0.5 * (s1.norm_sqr() + s2.norm_sqr()) / (PI * x * x);
    let whole = Sphere::new(x, index)?.amplitudes(&theta);
    let bow = DebyeSeries::new(x, index)?.amplitudes(Term::Order(2), &theta);
    let rows = (0..deg.len()).flat_map(|i| [deg[i], intensity(&whole[i]), intensity(&bow[i])]);
    Ok(rows.flat_map(f64::to_le_bytes).collect())
}
