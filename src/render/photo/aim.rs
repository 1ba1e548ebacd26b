//! From what is seen in a photograph, the horizon or the antisolar point, to where its camera looked.

use super::error::PhotoError;
use crate::render::camera::Camera;
use glam::DVec3;

/// A direction in the camera's frame (right, up, forward) of a place in the picture, pixels from the upper left corner.
fn in_frame(camera: &Camera, [column, row]: [f64; 2]) -> Option<DVec3> {
    let level = Camera { elevation: 0.0, azimuth: 0.0, ..*camera };
    let seen = level.direction(column, row)?;
    // the level camera looks along x, its right is −y
    Some(DVec3::new(-seen.y, seen.z, seen.x))
}

/// The camera held so that the horizon crosses the middle of the picture at a row.
///
/// # Errors
/// A row that the lens does not show.
pub fn aimed_by_horizon(camera: &Camera, row: f64) -> Result<Camera, PhotoError> {
    let middle = 0.5 * camera.width as f64;
    let seen = in_frame(camera, [middle, row]).ok_or(PhotoError::Invalid {
        field: "--horizon-px",
        value: row.to_string(),
        accepted: "rows that the lens shows",
    })?;
    Ok(Camera { elevation: -seen.y.atan2(seen.z), ..*camera })
}

/// The camera held, upright, so that the antisolar point is at a place, for the sun at an elevation.
///
/// ```
/// use gonio::render::camera::{Camera, Lens};
/// use gonio::render::photo::aimed_by_antisolar;
///
/// let camera = Camera {
///     lens: Lens::Rectilinear, field_of_view: 1.2, elevation: 0.0, azimuth: 0.0, width: 300, height: 200,
/// };
/// let aimed = aimed_by_antisolar(&camera, [40.0, 260.0], 0.4)?;
/// let seen = aimed.direction(40.0, 260.0).unwrap();
/// assert!((seen.z + 0.4f64.sin()).abs() < 1e-12 && seen.y.abs() < 1e-12);
/// # Ok::<(), gonio::render::photo::PhotoError>(())
/// ```
///
/// # Errors
/// A place that no camera held upright sees there.
pub fn aimed_by_antisolar(
    camera: &Camera,
    place: [f64; 2],
    sun_elevation: f64,
) -> Result<Camera, PhotoError> {
    let invalid = || PhotoError::Invalid {
        field: "--antisolar-px",
        value: format!("{},{}", place[0], place[1]),
        accepted: "a place COLUMN,ROW at which a camera held upright can have the antisolar point",
    };
    let seen = in_frame(camera, place).ok_or_else(invalid)?;
    // up and forward parts make the height: y cos E + z sin E = −sin e
    let reach = seen.y.hypot(seen.z);
    let ratio = -sun_elevation.sin() / reach;
    if !(-1.0..=1.0).contains(&ratio) {
        return Err(invalid());
    }
    let elevation = ratio.asin() - seen.y.atan2(seen.z);
    let level = Camera { elevation, azimuth: 0.0, ..*camera };
    let there = level.direction(place[0], place[1]).ok_or_else(invalid)?;
    // azimuths grow to the right, towards −y
    Ok(Camera { azimuth: there.y.atan2(there.x), ..level })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::Lens;

    #[test]
    fn the_horizon_is_where_it_was_seen() {
        let camera = Camera {
            lens: Lens::Rectilinear,
            field_of_view: 1.0,
            elevation: 0.0,
            azimuth: 0.3,
            width: 640,
            height: 480,
        };
        let aimed = aimed_by_horizon(&camera, 400.0).unwrap();
        assert!(aimed.direction(320.0, 400.0).unwrap().z.abs() < 1e-12);
        assert!(aimed.elevation > 0.0 && aimed.azimuth == 0.3);
    }
}
