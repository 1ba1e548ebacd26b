//! A photograph of a bow: the computed one over it, and what size of drops fits a cut across it.
//!
//! The lens is rectilinear, with the optical axis in the middle. Where the antisolar point is, in pixels, and
//! the field of view say the scattering angle of every pixel. Drops are round.

use crate::colours::Column;
use crate::message::{Reply, Request, Trouble};
use crate::sky::{Columns, Lookup, exposure};
use gonio::color::{decode_srgb, encode_srgb, fit_gamut, xyz_to_linear_srgb};
use serde::Deserialize;
use serde_json::json;
use std::f64::consts::PI;

/// How a photograph was taken.
#[derive(Debug, Deserialize)]
struct View {
    width: usize,
    height: usize,
    /// Across the picture's width.
    fov_deg: f64,
    /// Pixels from the left and from the top; may lie outside.
    antisolar: [f64; 2],
}

/// Most pixels of a side.
const LARGEST: usize = 2048;

impl View {
    fn check(&self) -> Result<(), Trouble> {
        if !(1.0..=150.0).contains(&self.fov_deg) {
            let message = format!("{}: accepted are 1 to 150 degrees", self.fov_deg);
            return Err(Trouble::new("photo_fov_deg", message));
        }
        let sides = 2..=LARGEST;
        if !sides.contains(&self.width) || !sides.contains(&self.height) {
            return Err(Trouble::new(
                "photo",
                format!("accepted are pictures of 2 to {LARGEST} pixels a side"),
            ));
        }
        if self.antisolar.iter().all(|v| v.is_finite()) {
            return Ok(());
        }
        Err(Trouble::new("photo", "the antisolar point is nowhere".into()))
    }

    /// Direction of a place in the picture, up to its length.
    fn ray(&self, x: f64, y: f64) -> [f64; 3] {
        let focal = 0.5 * self.width as f64 / (0.5 * self.fov_deg.to_radians()).tan();
        [x - 0.5 * self.width as f64, 0.5 * self.height as f64 - y, focal]
    }

    /// Scattering angle of a place, radians.
    fn theta(&self, x: f64, y: f64) -> f64 {
        let (a, b) = (self.ray(x, y), self.ray(self.antisolar[0], self.antisolar[1]));
        let dot: f64 = (0..3).map(|k| a[k] * b[k]).sum();
        let cross =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        PI - cross.iter().map(|v| v * v).sum::<f64>().sqrt().atan2(dot)
    }
}

#[derive(Deserialize)]
struct Overlay {
    view: View,
    columns: Columns,
    stops: f64,
}

/// The computed bow as `rgba`, transparent where it is dark.
///
/// # Errors
/// A view or columns that make no sense.
pub fn overlay(request: &Request) -> Result<Reply, Trouble> {
    let asked: Overlay = request.parsed()?;
    asked.view.check()?;
    let lookup = Lookup::new(&asked.columns, &request.numbers)?;
    let exposure = exposure(&lookup, &asked.columns, asked.stops);
    let mut rgba = Vec::with_capacity(4 * asked.view.width * asked.view.height);
    for row in 0..asked.view.height {
        for column in 0..asked.view.width {
            let theta = asked.view.theta(column as f64 + 0.5, row as f64 + 0.5);
            let xyz = lookup.at(theta, 0.0).unwrap_or_default();
            let linear = fit_gamut(xyz_to_linear_srgb(xyz.map(|v| v * exposure)));
            let most = linear.iter().fold(0.0_f64, |most, v| most.max(*v));
            // the brightest channel decides how much of the photograph is covered
            let opaque = encode_srgb(most.min(1.0));
            let colour = linear.map(|v| if most > 0.0 { v / most } else { 0.0 });
            rgba.extend(colour.map(|v| (255.0 * encode_srgb(v)).round() as u8));
            rgba.push((255.0 * opaque).round() as u8);
        }
    }
    Ok(Reply::new(json!({})).with_bytes("rgba", rgba))
}

#[derive(Deserialize)]
struct Cut {
    view: View,
    /// First and last scattering angle, and how many bins.
    theta_deg: [f64; 2],
    bins: usize,
    /// Middle and half width of the sector about the antisolar point, degrees from the picture's right,
    /// counter-clockwise.
    sector_deg: [f64; 2],
}

/// Means of a photograph over rings about the antisolar point: the request's numbers are its sRGB (0 to 255,
/// three per pixel); `rgb` are three linear ones per bin, `count` its pixels.
///
/// # Errors
/// A view that makes no sense, or a sector outside the picture.
pub fn cut(request: &Request) -> Result<Reply, Trouble> {
    let asked: Cut = request.parsed()?;
    asked.view.check()?;
    let View { width, height, .. } = asked.view;
    if request.numbers.len() != 3 * width * height || !(2..=4000).contains(&asked.bins) {
        return Err(Trouble::new("photo", "pixels are missing".into()));
    }
    let [from, to] = asked.theta_deg.map(f64::to_radians);
    let mut sums = vec![[0.0; 4]; asked.bins];
    for (place, pixel) in request.numbers.chunks_exact(3).enumerate() {
        let (x, y) = ((place % width) as f64 + 0.5, (place / width) as f64 + 0.5);
        let (dx, dy) = (x - asked.view.antisolar[0], asked.view.antisolar[1] - y);
        let turn =
            (dy.atan2(dx).to_degrees() - asked.sector_deg[0] + 540.0).rem_euclid(360.0) - 180.0;
        let bin = (asked.view.theta(x, y) - from) / (to - from) * asked.bins as f64;
        if turn.abs() > asked.sector_deg[1] || !(0.0..asked.bins as f64).contains(&bin) {
            continue;
        }
        let sum = &mut sums[bin as usize];
        (0..3).for_each(|c| sum[c] += decode_srgb(pixel[c] / 255.0));
        sum[3] += 1.0;
    }
    if sums.iter().filter(|sum| sum[3] > 0.0).count() < 20 {
        return Err(Trouble::new("photo", "the cut meets too little of the picture: move the antisolar point, or check the field of view".into()));
    }
    let rgb = sums.iter().flat_map(|s| [0, 1, 2].map(|c| s[c] / s[3])).collect();
    Ok(Reply::new(json!({})).with("rgb", rgb).with("count", sums.iter().map(|s| s[3]).collect()))
}

#[derive(Deserialize)]
struct Misfit {
    column: Column,
}

/// How far a cut (the request's numbers, `rgb` and then `count` of [`cut`]) is from the computed bow, with
/// what lies before and behind the bow left free: `a_c + b_c t + g · bow_c(θ)`, by least squares.
///
/// # Errors
/// Drops that the library refuses; a cut without light.
pub fn misfit(request: &Request) -> Result<Reply, Trouble> {
    let asked: Misfit = request.parsed()?;
    let bins = asked.column.points;
    if request.numbers.len() != 4 * bins {
        return Err(Trouble::new("photo", "the cut and the column do not fit".into()));
    }
    let (rgb, count) = request.numbers.split_at(3 * bins);
    let diagram = asked.column.diagram()?;
    let total =
        |cell: &[[f64; 3]; 2]| -> [f64; 3] { std::array::from_fn(|c| cell[0][c] + cell[1][c]) };
    let model: Vec<[f64; 3]> =
        diagram.xyz[0].iter().map(|cell| xyz_to_linear_srgb(total(cell))).collect();
    let largest =
        model.iter().flatten().fold(0.0_f64, |most, v| most.max(v.abs())).max(f64::MIN_POSITIVE);
    let (mut normal, mut right, mut square) = ([[0.0; 7]; 7], [0.0; 7], 0.0);
    for bin in (0..bins).filter(|bin| count[*bin] > 0.0) {
        let t = 2.0 * bin as f64 / bins as f64 - 1.0;
        for c in 0..3 {
            let mut row = [0.0; 7];
            (row[2 * c], row[2 * c + 1], row[6]) = (1.0, t, model[bin][c] / largest);
            let measured = rgb[3 * bin + c];
            for i in 0..7 {
                (0..7).for_each(|j| normal[i][j] += row[i] * row[j]);
                right[i] += row[i] * measured;
            }
            square += measured * measured;
        }
    }
    let found =
        solve(normal, right).ok_or_else(|| Trouble::new("photo", "the cut has no light".into()))?;
    let explained: f64 = found.iter().zip(&right).map(|(a, b)| a * b).sum();
    let used = 3.0 * count.iter().filter(|n| **n > 0.0).count() as f64;
    let curve = (0..bins).flat_map(|bin| {
        let t = 2.0 * bin as f64 / bins as f64 - 1.0;
        [0, 1, 2].map(|c| found[2 * c] + found[2 * c + 1] * t + found[6] * model[bin][c] / largest)
    });
    let rms = ((square - explained).max(0.0) / used).sqrt();
    Ok(Reply::new(json!({ "rms": rms, "strength": found[6] })).with("rgb", curve.collect()))
}

/// Gauss's elimination with pivots; nothing where the equations say nothing.
fn solve<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    for k in 0..N {
        let pivot = (k..N).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        if a[k][k].abs() < 1e-12 {
            return None;
        }
        for i in k + 1..N {
            let share = a[i][k] / a[k][k];
            (k..N).for_each(|j| a[i][j] -= share * a[k][j]);
            b[i] -= share * b[k];
        }
    }
    for k in (0..N).rev() {
        let rest: f64 = (k + 1..N).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / a[k][k];
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_are_solved() {
        let found =
            solve([[0.0, 2.0, 1.0], [1.0, 1.0, 0.0], [3.0, 0.0, -1.0]], [7.0, 3.0, 0.0]).unwrap();
        assert!((found[0] - 1.0).abs() + (found[1] - 2.0).abs() + (found[2] - 3.0).abs() < 1e-12);
        assert!(solve([[1.0, 2.0], [2.0, 4.0]], [1.0, 2.0]).is_none());
    }

    /// A place off the axis by half the field of view is that far from the middle.
    #[test]
    fn angles_are_those_of_the_lens() {
        let view = View { width: 800, height: 600, fov_deg: 90.0, antisolar: [400.0, 300.0] };
        assert!((view.theta(400.0, 300.0) - PI).abs() < 1e-12);
        assert!((view.theta(800.0, 300.0).to_degrees() - 135.0).abs() < 1e-9);
        let aside = View { antisolar: [0.0, 300.0], ..view };
        assert!((aside.theta(800.0, 300.0).to_degrees() - 90.0).abs() < 1e-9);
    }
}
