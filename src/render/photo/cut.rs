//! A photograph cut into sectors about the antisolar point, each into steps of the scattering angle.
//!
//! Means over cells of both keep what a bow changes, across it, and average what it does not. A cell remembers the mean
//! direction of its pixels, so that it serves a bow about another antisolar point, too.

use crate::render::camera::Camera;
use crate::render::linear_picture::LinearPicture;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Where a photograph is cut: about an antisolar point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutPlan {
    /// Elevation of the sun that cells are laid out for, radians.
    pub sun_elevation: f64,
    /// Scattering angles from and to, radians.
    pub theta: [f64; 2],
    /// Steps between them.
    pub steps: usize,
    /// Sectors of the whole circle.
    pub sectors: usize,
}

/// Mean of some pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// What they look at.
    pub view: DVec3,
    /// Which sector they are in.
    pub sector: usize,
    /// From −1 to 1 along the cut.
    pub along: f64,
    /// Linear sRGB.
    pub rgb: [f64; 3],
    /// Pixels.
    pub count: f64,
}

/// Least share of a sector's steps that must be in the picture for it to count.
const LEAST_WHOLE: f64 = 0.6;

/// Where light comes from that was scattered by θ when the sun is at an elevation: the antisolar point.
pub(super) fn antisolar(sun_elevation: f64) -> DVec3 {
    DVec3::new(sun_elevation.cos(), 0.0, -sun_elevation.sin())
}

/// Scattering angle of a line of sight.
pub(super) fn scattering_angle(view: DVec3, sun_elevation: f64) -> f64 {
    let point = antisolar(sun_elevation);
    PI - view.cross(point).length().atan2(view.dot(point))
}

/// Cut a photograph.
pub fn cut(photo: &LinearPicture, camera: &Camera, plan: &CutPlan) -> Vec<Cell> {
    // colours, scattering angle and angle about the antisolar point, pixels
    let empty = ([0.0f64; 3], [0.0f64; 2], 0.0);
    let mut sums = vec![empty; plan.sectors * plan.steps];
    let point = antisolar(plan.sun_elevation);
    let up = (DVec3::Z - point * point.z).normalize();
    let side = point.cross(up);
    let [from, to] = plan.theta;
    for row in 0..photo.height {
        for column in 0..photo.width {
            let Some(view) = camera.direction(column as f64 + 0.5, row as f64 + 0.5) else {
                continue;
            };
            let theta = scattering_angle(view, plan.sun_elevation);
            let step = (theta - from) / (to - from) * plan.steps as f64;
            if !(0.0..plan.steps as f64).contains(&step) {
                continue;
            }
            let turn = view.dot(side).atan2(view.dot(up)).rem_euclid(TAU) / TAU;
            let sector = ((turn * plan.sectors as f64) as usize).min(plan.sectors - 1);
            let sum = &mut sums[sector * plan.steps + step as usize];
            let rgb = photo.at(column, row);
            (0..3).for_each(|c| sum.0[c] += rgb[c]);
            sum.1[0] += theta;
            sum.1[1] += TAU * turn;
            sum.2 += 1.0;
        }
    }
    let mut cells = Vec::new();
    for (sector, steps) in sums.chunks(plan.steps).enumerate() {
        let met = steps.iter().filter(|sum| sum.2 > 0.0).count();
        if (met as f64) < LEAST_WHOLE * plan.steps as f64 {
            continue;
        }
        for (k, (rgb, [theta, turn], count)) in
            steps.iter().enumerate().filter(|(_, sum)| sum.2 > 0.0)
        {
            let along = 2.0 * (k as f64 + 0.5) / plan.steps as f64 - 1.0;
            let rgb = rgb.map(|sum| sum / count);
            // the mean of directions on an arc would lie within it
            let ((st, ct), (sp, cp)) = ((theta / count).sin_cos(), (turn / count).sin_cos());
            let view = (up * cp + side * sp) * st - point * ct;
            cells.push(Cell { view, sector, along, rgb, count: *count });
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::Lens;

    /// A picture whose brightness is the scattering angle: every cell has that of its direction.
    #[test]
    fn cells_are_where_they_say() {
        let camera = Camera {
            lens: Lens::Rectilinear,
            field_of_view: 1.2,
            elevation: 0.25,
            azimuth: 0.1,
            width: 240,
            height: 160,
        };
        let (sun, true_sun) = (0.3, 0.31);
        let mut rgb = Vec::new();
        for row in 0..160 {
            for column in 0..240 {
                let view = camera.direction(column as f64 + 0.5, row as f64 + 0.5).unwrap();
                rgb.extend([scattering_angle(view, true_sun) as f32; 3]);
            }
        }
        let photo = LinearPicture { width: 240, height: 160, rgb };
        let plan = CutPlan { sun_elevation: sun, theta: [2.2, 2.7], steps: 60, sectors: 24 };
        let cells = cut(&photo, &camera, &plan);
        assert!(cells.len() > 200, "{}", cells.len());
        for cell in cells {
            let there = scattering_angle(cell.view, true_sun);
            assert!((cell.rgb[0] - there).abs() < 2e-4, "{} {there}", cell.rgb[0]);
        }
    }
}
