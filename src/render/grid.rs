//! Lines to find one's way by in a picture of the sky: circles of 42° and 51° about the antisolar point, where water's
//! bows are, that point, and the horizon.

use super::camera::Camera;
use super::error::RenderError;
use super::picture::Picture;
use glam::DVec3;

/// Circles about the antisolar point, degrees, with their names.
const CIRCLES: [(f64, &str); 2] = [(42.0, "42°"), (51.0, "51°")];
/// Share of a line's own colour, the rest is that of the picture behind it; and the colour.
const OPACITY: f64 = 0.65;
const COLOUR: [u8; 3] = [255, 255, 225];
/// Half the size of the cross at the antisolar point, pixels.
const CROSS: usize = 6;

/// A name, and the pixel it stands beside.
type Named = (&'static str, (usize, usize));

/// Draw them over a picture of the sky with the sun at an elevation (radians).
///
/// # Errors
/// [`RenderError::Drawing`] for the names.
pub(super) fn draw_grid(
    picture: &mut Picture,
    camera: &Camera,
    sun_elevation: f64,
) -> Result<(), RenderError> {
    let (sin, cos) = sun_elevation.sin_cos();
    let antisolar = DVec3::new(cos, 0.0, -sin);
    let mut names: Vec<Named> = Vec::new();
    for (degrees, name) in CIRCLES {
        let circle = degrees.to_radians().cos();
        let line = line(camera, |view| view.dot(antisolar) - circle);
        // beside the top of the circle
        if let Some(&top) =
            line.iter().min_by_key(|(column, row)| (*row, column.abs_diff(camera.width / 2)))
        {
            names.push((name, top));
        }
        line.into_iter().for_each(|place| blend(picture, place));
    }
    let horizon = line(camera, |view| view.z);
    if let Some(&left) = horizon.iter().min_by_key(|(column, _)| *column) {
        names.push(("horizon", left));
    }
    horizon.into_iter().for_each(|place| blend(picture, place));
    if let Some((column, row)) = nearest(camera, antisolar) {
        for away in 0..=2 * CROSS {
            let (x, y) = ((column + away).checked_sub(CROSS), (row + away).checked_sub(CROSS));
            x.into_iter().for_each(|x| blend(picture, (x, row)));
            y.into_iter().for_each(|y| blend(picture, (column, y)));
        }
        names.push(("antisolar point", (column + CROSS, row)));
    }
    write(picture, &names)
}

/// Pixels between which and the next, to the right or below, a function of the direction changes its sign.
fn line(camera: &Camera, of: impl Fn(DVec3) -> f64) -> Vec<(usize, usize)> {
    let row_of = |row: usize| -> Vec<Option<bool>> {
        let place = |column: usize| camera.direction(column as f64 + 0.5, row as f64 + 0.5);
        (0..camera.width).map(|column| place(column).map(|view| of(view) > 0.0)).collect()
    };
    let mut found = Vec::new();
    let mut above = row_of(0);
    for row in 0..camera.height {
        let below = row_of(row + 1);
        let differs = |a: Option<bool>, b: Option<bool>| a.zip(b).is_some_and(|(a, b)| a != b);
        for column in 0..camera.width {
            let here = above[column];
            let right = above.get(column + 1).copied().flatten();
            if differs(here, right) || (row + 1 < camera.height && differs(here, below[column])) {
                found.push((column, row));
            }
        }
        above = below;
    }
    found
}

/// The pixel that looks along a direction, if one does.
fn nearest(camera: &Camera, wanted: DVec3) -> Option<(usize, usize)> {
    let pixels = (0..camera.width * camera.height).map(|i| (i % camera.width, i / camera.width));
    let towards = |(column, row): (usize, usize)| {
        camera
            .direction(column as f64 + 0.5, row as f64 + 0.5)
            .map_or(-1.0, |view| view.dot(wanted))
    };
    let (dot, place) =
        pixels.map(|place| (towards(place), place)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let pixel = camera.field_of_view / camera.width as f64;
    (dot.clamp(-1.0, 1.0).acos() < 2.0 * pixel).then_some(place)
}

fn blend(picture: &mut Picture, (column, row): (usize, usize)) {
    if column >= picture.width || row >= picture.height {
        return;
    }
    let at = 3 * (row * picture.width + column);
    for (value, own) in picture.rgb[at..at + 3].iter_mut().zip(COLOUR) {
        *value = (OPACITY * f64::from(own) + (1.0 - OPACITY) * f64::from(*value)).round() as u8;
    }
}

/// Small names beside their pixels, within the picture.
#[cfg(feature = "pictures")]
fn write(picture: &mut Picture, names: &[Named]) -> Result<(), RenderError> {
    use super::plots::font::{FONT, ensure_font};
    use plotters::prelude::*;
    const SIZE: i32 = 13;
    ensure_font()?;
    let (width, height) = (picture.width as i32, picture.height as i32);
    let size = (picture.width as u32, picture.height as u32);
    let root = BitMapBackend::with_buffer(&mut picture.rgb, size).into_drawing_area();
    let [r, g, b] = COLOUR;
    for (name, (column, row)) in names {
        let wide = SIZE * 62 / 100 * name.chars().count() as i32;
        let x = (*column as i32 + 6).clamp(2, (width - wide - 4).max(2));
        let y = (*row as i32 - SIZE - 4).clamp(2, (height - SIZE - 4).max(2));
        // A dark shadow lets them be read on any sky.
        for (place, colour) in [((x + 1, y + 1), RGBColor(0, 0, 0)), ((x, y), RGBColor(r, g, b))] {
            let style = (FONT, SIZE).into_font().color(&colour);
            root.draw(&Text::new((*name).to_owned(), place, style))?;
        }
    }
    root.present()?;
    Ok(())
}

/// Without letters lines stand alone.
#[cfg(not(feature = "pictures"))]
fn write(_: &mut Picture, _: &[Named]) -> Result<(), RenderError> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::Lens;

    fn camera() -> Camera {
        Camera {
            lens: Lens::Equidistant,
            field_of_view: 120f64.to_radians(),
            elevation: -20f64.to_radians(),
            azimuth: 0.0,
            width: 240,
            height: 240,
        }
    }

    /// Half a degree per pixel about the antisolar point: circles lie 84 and 102 pixels from the middle, the horizon 40
    /// above it.
    #[test]
    fn lines_lie_where_they_should() {
        let camera = camera();
        let antisolar = DVec3::new(20f64.to_radians().cos(), 0.0, -20f64.to_radians().sin());
        let circle = line(&camera, |view| view.dot(antisolar) - 42f64.to_radians().cos());
        let away =
            |(column, row): (usize, usize)| (column as f64 - 119.5).hypot(row as f64 - 119.5);
        assert!(circle.len() > 400);
        for place in circle {
            assert!((away(place) - 84.0).abs() < 1.6, "{place:?}");
        }
        let horizon = line(&camera, |view| view.z);
        let middle = horizon.iter().find(|place| place.0 == 120).unwrap();
        assert!(middle.1.abs_diff(79) <= 1, "{middle:?}");
        let (column, row) = nearest(&camera, antisolar).unwrap();
        assert!(column.abs_diff(120) <= 1 && row.abs_diff(120) <= 1);
        assert!(nearest(&camera, -antisolar).is_none());
        let mut picture = Picture::new(240, 240);
        draw_grid(&mut picture, &camera, 20f64.to_radians()).unwrap();
        assert!(picture.rgb.iter().filter(|v| **v > 100).count() > 3000);
    }
}
