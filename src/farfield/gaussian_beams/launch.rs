//! Launch points of Gaussian beams, in coordinates in which all beams have the same width.
//!
//! A beam near the rim must be narrow, since its rays' angles change fast there, but not so narrow that
//! it spreads by its own width: the widths go like the square root of the cosine of incidence, and so
//! do the steps of `y`: `|(u, v)|² = 1 - (1 - y²)^{4/3}` of the way to the rim, squared.

use crate::math::vec3::Vec3;
use crate::shape::Silhouette;

/// A launch point and its derivatives by `y`.
pub(crate) struct Launch {
    pub point: [f64; 2],
    /// `∂(u, v)/∂y`, one column for each coordinate of `y`.
    columns: [[f64; 2]; 2],
    pub determinant: f64,
}

impl Launch {
    /// The point that belongs to `y`; `None` beyond the rim.
    pub(crate) fn at(silhouette: &Silhouette, y: [f64; 2]) -> Option<Self> {
        let t = y[0].hypot(y[1]);
        if t >= 1.0 {
            return None;
        }
        let (cos, sin) = (y[0] / t, y[1] / t);
        let (radius, slope) = silhouette.radius_and_slope(sin.atan2(cos));
        let third = (1.0 - t * t).cbrt();
        let share = (1.0 - third.powi(4)).sqrt();
        let rate = 4.0 / 3.0 * t * third / share;
        // along the ray from the centre, and across it
        let along = [rate * radius * cos, rate * radius * sin];
        let turn = share / t;
        let across = [turn * (slope * cos - radius * sin), turn * (slope * sin + radius * cos)];
        let column = |a: f64, b: f64| [along[0] * a + across[0] * b, along[1] * a + across[1] * b];
        Some(Self {
            point: [share * radius * cos, share * radius * sin],
            columns: [column(cos, -sin), column(sin, cos)],
            determinant: radius * radius * turn * rate,
        })
    }

    /// Derivatives by `y` from those by `(u, v)`.
    pub(crate) fn by_place(&self, by_point: &[Vec3<f64>; 2]) -> [Vec3<f64>; 2] {
        self.columns.map(|[a, b]| by_point[0] * a + by_point[1] * b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    /// Derivatives of launch points by differences, and their determinant.
    #[test]
    fn derivatives_are_those_of_neighbouring_points() {
        const H: f64 = 1e-6;
        let shape = Shape::spheroid(0.8, 0.4).unwrap();
        let silhouette = shape.silhouette();
        for y in [[0.3, 0.2], [-0.5, 0.6], [0.1, -0.97]] {
            let at = |a: f64, b: f64| Launch::at(&silhouette, [y[0] + a, y[1] + b]).unwrap();
            let launch = at(0.0, 0.0);
            for (k, (a, b)) in [(H, 0.0), (0.0, H)].into_iter().enumerate() {
                let (before, behind) = (at(-a, -b).point, at(a, b).point);
                for (c, column) in launch.columns[k].into_iter().enumerate() {
                    let rate = (behind[c] - before[c]) / (2.0 * H);
                    assert!((rate - column).abs() < 1e-7, "{y:?} {k} {c}: {rate} {column}");
                }
            }
            let [[a, b], [c, d]] = launch.columns;
            assert!((a * d - b * c - launch.determinant).abs() < 1e-12, "{y:?}");
        }
    }

    /// The unit disc of `y` is the whole shadow.
    #[test]
    fn the_disc_covers_the_shadow() {
        let shape = Shape::sphere();
        let silhouette = shape.silhouette();
        assert!(Launch::at(&silhouette, [0.8, 0.7]).is_none());
        let last = Launch::at(&silhouette, [0.6, 0.79999]).unwrap().point;
        assert!((last[0].hypot(last[1]) - 1.0).abs() < 1e-5);
        const STEPS: usize = 200;
        let h = 1.0 / STEPS as f64;
        let ring = |k: usize| {
            let t = (k as f64 + 0.5) * h;
            std::f64::consts::TAU * t * h * Launch::at(&silhouette, [t, 0.0]).unwrap().determinant
        };
        let area: f64 = (0..STEPS).map(ring).sum();
        assert!((area / std::f64::consts::PI - 1.0).abs() < 1e-3, "{area}");
    }
}
