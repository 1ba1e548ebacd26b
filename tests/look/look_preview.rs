//! The preview of a table: a PNG with its panels filled, and a plain word where one is missing.

use crate::tables::{degrees, lopsided, sphere, visible};
use gonio::export::strip;
use gonio::optics::Polarisation;
use gonio::phase_table::Quantity;
use gonio::render::preview;

/// Colours in a block of the picture, as a share of pixels that are not grey.
fn coloured(
    picture: &gonio::render::Picture,
    x: std::ops::Range<usize>,
    y: std::ops::Range<usize>,
) -> f64 {
    let total = (x.len() * y.len()) as f64;
    let mut count = 0;
    for row in y {
        for column in x.clone() {
            let at = 3 * (row * picture.width + column);
            let rgb = &picture.rgb[at..at + 3];
            let (low, high) = (rgb.iter().min().unwrap(), rgb.iter().max().unwrap());
            count += usize::from(high - low > 12);
        }
    }
    count as f64 / total
}

/// Keep a picture to look at: `GONIO_KEEP_PICTURES=folder cargo test`.
fn keep(picture: &gonio::render::Picture, name: &str) {
    if let Some(folder) = std::env::var_os("GONIO_KEEP_PICTURES") {
        picture.write_png(&std::path::Path::new(&folder).join(name)).unwrap();
    }
}

#[test]
fn previews_are_drawn_and_written_complete() {
    let folder = tempfile::tempdir().unwrap();
    let round = sphere(2e-4, visible(33), degrees(0.0, 180.0, 3601), Quantity::PhaseFunction);
    let path = folder.path().join("sphere.png");
    preview::write_png(&round, &path).unwrap();
    let picture = preview::picture(&round).unwrap();
    keep(&picture, "preview_sphere.png");
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(bytes, picture.png(&[]).unwrap());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing left beside it");
    // The strip of colours of the bow.
    assert!(coloured(&picture, 150..1200, 720..850) > 0.3);

    let flat = lopsided(&round, degrees(0.0, 360.0, 73), 0.02);
    let picture = preview::picture(&flat).unwrap();
    keep(&picture, "preview_flat.png");
    assert!(coloured(&picture, 100..1100, 140..450) > 0.9, "the heat map");
    assert!(coloured(&picture, 760..1220, 620..850) > 0.4, "the bow by azimuth");
}

#[test]
fn a_table_without_colours_is_still_drawn() {
    let one = sphere(5e-5, vec![650e-9], degrees(0.0, 180.0, 901), Quantity::PhaseFunction);
    let picture = preview::picture(&one).unwrap();
    assert_eq!(coloured(&picture, 150..1200, 720..850), 0.0);
    let part = sphere(5e-5, visible(9), degrees(0.0, 20.0, 201), Quantity::PhaseFunction);
    preview::picture(&part).unwrap();
}

#[test]
fn an_unwritable_place_is_named() {
    let table = sphere(1e-5, vec![650e-9], degrees(0.0, 180.0, 91), Quantity::PhaseFunction);
    let error = preview::write_png(&table, std::path::Path::new("/nowhere/at/all.png"));
    assert!(error.unwrap_err().to_string().contains("/nowhere/at/all.png"));
}

/// A sphere much smaller than the wavelength sends nothing along the scattering plane at 90°; straight on,
/// both filters pass half.
#[test]
fn a_strip_seen_through_a_filter_is_dark_where_no_light_of_that_kind_goes() {
    let small = sphere(1e-9, visible(9), degrees(0.0, 180.0, 181), Quantity::Mueller);
    let range = (0.0, std::f64::consts::PI);
    let line = |seen| {
        let file = strip::png(&small, 0.0, seen, range, (181, 1)).unwrap();
        crate::decoded(&file).1
    };
    let (parallel, across) = (line(Polarisation::Parallel), line(Polarisation::Perpendicular));
    let blue = |pixels: &[u8], degree: usize| pixels[3 * degree + 2];
    assert!(blue(&parallel, 90) < 3, "{}", blue(&parallel, 90));
    // across the plane Rayleigh scattering is the same to all sides
    let [low, high] = [0, 90].map(|degree| blue(&across, degree));
    assert!(low.abs_diff(high) <= 1 && high > 200, "{low} {high}");
    assert!(blue(&parallel, 0) > 200);

    let unpolarised = sphere(1e-6, visible(9), degrees(0.0, 180.0, 181), Quantity::PhaseFunction);
    let error = strip::png(&unpolarised, 0.0, Polarisation::Parallel, range, (9, 1)).unwrap_err();
    assert!(error.to_string().starts_with("polarisation = parallel"), "{error}");
}
