//! Crystals and prisms by their proportions. The axis (c) is along z; a facet's normal is never along x where
//! the cross-section is a hexagon: corners are.

use super::crystal::Crystal;
use super::{Body, BodyError};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Ratios of length to width beyond which a body is a needle or a leaf, whose facets are no mirrors.
const RATIOS: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// Narrowest angle of a wedge or tip, radians.
const NARROWEST: f64 = 0.02;

/// The same for proportions that are none.
fn ratio(name: &'static str, value: f64) -> Result<f64, BodyError> {
    if RATIOS.contains(&value) {
        return Ok(value);
    }
    Err(BodyError::Proportion { name, value, accepted: "length over width, 0.01 to 100" })
}

/// A full angle between facets, below two right angles.
fn angle(name: &'static str, value: f64) -> Result<f64, BodyError> {
    if (NARROWEST..=PI - NARROWEST).contains(&value) {
        return Ok(value);
    }
    Err(BodyError::Proportion { name, value, accepted: "radians, 0.02 to π − 0.02" })
}

/// Corners of a polygon at a height.
fn ring(outline: &[(f64, f64)], z: f64, scale: f64) -> impl Iterator<Item = DVec3> {
    outline.iter().map(move |&(x, y)| DVec3::new(scale * x, scale * y, z))
}

fn hexagon() -> Vec<(f64, f64)> {
    (0..6).map(|k| (TAU * f64::from(k) / 6.0).sin_cos()).map(|(sin, cos)| (cos, sin)).collect()
}

/// A right prism over an outline that runs anticlockwise.
fn prism(outline: &[(f64, f64)], height: f64) -> Result<Body, BodyError> {
    capped(outline, [(-0.5 * height, 1.0), (0.5 * height, 1.0)], [None, None])
}

/// A prism between two heights, wider or narrower at each by a factor, with a tip beyond either end where one
/// is given.
fn capped(
    outline: &[(f64, f64)],
    [(low, wide), (high, narrow)]: [(f64, f64); 2],
    tips: [Option<f64>; 2],
) -> Result<Body, BodyError> {
    let count = outline.len();
    let mut corners: Vec<DVec3> =
        ring(outline, low, wide).chain(ring(outline, high, narrow)).collect();
    let side = |k: usize| {
        let next = (k + 1) % count;
        vec![k, next, count + next, count + k]
    };
    let mut loops: Vec<Vec<usize>> = (0..count).map(side).collect();
    for (upper, tip) in tips.into_iter().enumerate() {
        let base = upper * count;
        let end: Vec<usize> = match upper {
            0 => (0..count).rev().collect(),
            _ => (base..base + count).collect(),
        };
        match tip {
            None => loops.push(end),
            Some(z) => {
                corners.push(DVec3::new(0.0, 0.0, z));
                let top = corners.len() - 1;
                loops.extend((0..count).map(|k| vec![end[k], end[(k + 1) % count], top]));
            }
        }
    }
    Body::new(&corners, &loops)
}

/// Height of a tip over a hexagon of circumradius 1, whose opposite facets meet at an angle.
fn tip(apex: f64) -> f64 {
    (PI / 6.0).cos() / (0.5 * apex).tan()
}

impl Body {
    /// The body of a crystal's proportions.
    ///
    /// # Errors
    /// Proportions that are none.
    pub fn of(crystal: &Crystal) -> Result<Self, BodyError> {
        match *crystal {
            Crystal::Mesh(ref mesh) => Ok(mesh.body().clone()),
            Crystal::HexagonalColumn { axis_ratio } => Self::hexagonal_column(axis_ratio),
            Crystal::TriangularPrism { axis_ratio, apex } => {
                Self::triangular_prism(apex, axis_ratio)
            }
            Crystal::Cuboid { axis_ratio } => Self::cuboid(axis_ratio),
            Crystal::Octahedron => Self::octahedron(),
            Crystal::PyramidalCrystal { axis_ratio, apex } => {
                Self::pyramidal_crystal(axis_ratio, apex)
            }
            Crystal::Bullet { axis_ratio, apex } => Self::bullet(axis_ratio, apex),
            Crystal::TaperedColumn { axis_ratio, apex } => Self::tapered_column(axis_ratio, apex),
            Crystal::Brilliant => Self::brilliant(),
        }
    }

    /// A hexagonal column or plate; `axis_ratio` is its length over its width from corner to corner.
    ///
    /// # Errors
    /// A ratio of 0.01 to 100 is accepted.
    pub fn hexagonal_column(axis_ratio: f64) -> Result<Self, BodyError> {
        prism(&hexagon(), 2.0 * ratio("axis_ratio", axis_ratio)?)
    }

    /// A prism over an isosceles triangle, its refracting edge along z at positive x; `apex` is the angle of
    /// that wedge (radians), `axis_ratio` the length of the edge over the side opposite to it.
    ///
    /// # Errors
    /// Proportions that are none.
    pub fn triangular_prism(apex: f64, axis_ratio: f64) -> Result<Self, BodyError> {
        let depth = 0.5 / (0.5 * angle("apex", apex)?).tan();
        let outline = [(0.0, -0.5), (depth, 0.0), (0.0, 0.5)];
        prism(&outline, ratio("axis_ratio", axis_ratio)?)
    }

    /// A cuboid on a square base, facets' normals along x, y, z; `axis_ratio` is its height over the side.
    ///
    /// # Errors
    /// A ratio of 0.01 to 100 is accepted.
    pub fn cuboid(axis_ratio: f64) -> Result<Self, BodyError> {
        let outline = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        prism(&outline, ratio("axis_ratio", axis_ratio)?)
    }

    /// A regular octahedron, corners along x, y, z.
    ///
    /// # Errors
    /// None: its proportions are fixed.
    pub fn octahedron() -> Result<Self, BodyError> {
        let corners = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let upper = (0..4).map(|k| vec![k, (k + 1) % 4, 4]);
        let lower = (0..4).map(|k| vec![(k + 1) % 4, k, 5]);
        Self::new(&corners, &upper.chain(lower).collect::<Vec<_>>())
    }

    /// A hexagonal column with a pyramid on both ends; `axis_ratio` is that of the column between them,
    /// `apex` the angle between opposite facets of a pyramid (radians; 0.98 for ice, {1 0 −1 1}).
    ///
    /// # Errors
    /// Proportions that are none.
    pub fn pyramidal_crystal(axis_ratio: f64, apex: f64) -> Result<Self, BodyError> {
        let (half, tip) = (ratio("axis_ratio", axis_ratio)?, tip(angle("apex", apex)?));
        capped(&hexagon(), [(-half, 1.0), (half, 1.0)], [Some(-half - tip), Some(half + tip)])
    }

    /// A bullet: a hexagonal column with a pyramid on its lower end.
    ///
    /// # Errors
    /// Proportions that are none.
    pub fn bullet(axis_ratio: f64, apex: f64) -> Result<Self, BodyError> {
        let (half, tip) = (ratio("axis_ratio", axis_ratio)?, tip(angle("apex", apex)?));
        capped(&hexagon(), [(-half, 1.0), (half, 1.0)], [Some(-half - tip), None])
    }
}

impl Body {
    /// A hexagonal column that narrows upwards; `axis_ratio` is its length over its width from corner to corner
    /// half-way up, `apex` the angle between opposite sides (radians).
    ///
    /// # Errors
    /// Proportions that are none; sides that meet below the upper end.
    pub fn tapered_column(axis_ratio: f64, apex: f64) -> Result<Self, BodyError> {
        let half = ratio("axis_ratio", axis_ratio)?;
        let narrowing = half / tip(angle("apex", apex)?);
        if narrowing >= LEAST_END {
            let accepted = "an angle at which opposite sides do not meet below the upper end";
            // as scenes have it
            let value = apex.to_degrees();
            return Err(BodyError::Proportion { name: "apex_deg", value, accepted });
        }
        capped(&hexagon(), [(-half, 1.0 + narrowing), (half, 1.0 - narrowing)], [None, None])
    }

    /// A round brilliant of 73 facets (16 of them the girdle), its table upwards, in the proportions of Tolkowsky,
    /// *Diamond Design* (1919): table 53 % of the width, crown 34.5°, pavilion 40.75°; girdle 2 %, stars half-way
    /// to the girdle, lower halves three quarters of the way to the culet.
    ///
    /// # Errors
    /// None: its proportions are fixed.
    pub fn brilliant() -> Result<Self, BodyError> {
        let (table, girdle, star, lower) = (0.53, 0.02, 0.5, 0.75);
        let [crown, pavilion] = [34.5f64, 40.75].map(|degrees| degrees.to_radians().tan());
        // between two main facets
        let (step, aside) = (TAU / 16.0, (TAU / 16.0).cos());
        let at = |radius: f64, turn: usize, z: f64| {
            let (sin, cos) = (step * turn as f64).sin_cos();
            DVec3::new(radius * cos, radius * sin, z)
        };
        let star_radius = (1.0 - star) * table * aside + star;
        let star_height = girdle + (1.0 - star_radius * aside) * crown;
        let lower_height = -girdle - (1.0 - (1.0 - lower) * aside) * pavilion;
        // corners: table, star tips, girdle above and below, tips of the lower halves, culet
        let mut corners: Vec<DVec3> = Vec::new();
        corners.extend((0..8).map(|k| at(table, 2 * k, girdle + (1.0 - table) * crown)));
        corners.extend((0..8).map(|k| at(star_radius, 2 * k + 1, star_height)));
        corners.extend((0..16).map(|k| at(1.0, k, girdle)));
        corners.extend((0..16).map(|k| at(1.0, k, -girdle)));
        corners.extend((0..8).map(|k| at(1.0 - lower, 2 * k + 1, lower_height)));
        corners.push(DVec3::new(0.0, 0.0, -girdle - pavilion));
        let (star, above, below, tip) = (8, 16, 32, 48);
        let mut loops = vec![(0..8).collect::<Vec<usize>>()];
        for k in 0..8 {
            let (next, last, main) = ((k + 1) % 8, (k + 7) % 8, 2 * k);
            let (half, after) = (main + 1, (main + 2) % 16);
            loops.extend([
                vec![k, star + k, next],
                vec![k, star + last, above + main, star + k],
                vec![star + k, above + main, above + half],
                vec![star + k, above + half, above + after],
                vec![above + main, below + main, below + half, above + half],
                vec![above + half, below + half, below + after, above + after],
                vec![tip + k, below + half, below + main],
                vec![tip + k, below + after, below + half],
                vec![56, tip + k, below + main, tip + last],
            ]);
        }
        Self::new(&corners, &loops)
    }
}

/// Share of its width that a tapered column may lose on the way from its middle to its end.
const LEAST_END: f64 = 0.98;

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// Angle between the inner sides of two facets.
    fn wedge(body: &Body, a: usize, b: usize) -> f64 {
        PI - body.facets()[a].normal.dot(body.facets()[b].normal).acos()
    }

    /// Facets, corners and angles that the names promise; Euler's formula.
    #[test]
    fn bodies_are_what_they_are_called() {
        for (body, facets, corners) in [
            (Body::hexagonal_column(2.0), 8, 12),
            (Body::triangular_prism(1.0, 3.0), 5, 6),
            (Body::cuboid(1.0), 6, 8),
            (Body::octahedron(), 8, 6),
            (Body::pyramidal_crystal(1.0, 0.98), 18, 14),
            (Body::bullet(1.0, 0.98), 13, 13),
            (Body::tapered_column(2.0, 0.3), 8, 12),
            (Body::brilliant(), 73, 57),
        ] {
            let body = body.unwrap();
            assert_eq!((body.facets().len(), body.vertices().len()), (facets, corners));
            let edges: usize = body.facets().iter().map(|f| f.corners.len()).sum::<usize>() / 2;
            assert_eq!(corners + facets, edges + 2);
        }
        let column = Body::hexagonal_column(0.7).unwrap();
        assert!((wedge(&column, 0, 2) - PI / 3.0).abs() < 1e-12, "60° between alternate sides");
        assert!((wedge(&column, 0, 6) - FRAC_PI_2).abs() < 1e-12, "90° to the base");
        let prism = Body::triangular_prism(0.5, 2.0).unwrap();
        assert!((wedge(&prism, 0, 1) - 0.5).abs() < 1e-12);
        let pyramid = Body::pyramidal_crystal(1.0, 0.98).unwrap();
        assert!((wedge(&pyramid, 6, 9) - 0.98).abs() < 1e-12);
        let tapered = Body::tapered_column(1.5, 0.2).unwrap();
        assert!((wedge(&tapered, 1, 4) - 0.2).abs() < 1e-12);
        // crown and pavilion of the gem by their inclinations
        let gem = Body::brilliant().unwrap();
        let tilt = |k: usize| gem.facets()[k].normal.z.abs().acos().to_degrees();
        assert!((tilt(2) - 34.5).abs() < 1e-9 && (tilt(9) - 40.75).abs() < 1e-9);
        let octahedron = Body::octahedron().unwrap();
        assert!((wedge(&octahedron, 0, 1).cos() + 1.0 / 3.0).abs() < 1e-12, "109.47°");
    }

    #[test]
    fn proportions_are_checked() {
        for wrong in [0.0, -1.0, 1e3, f64::NAN] {
            assert!(Body::hexagonal_column(wrong).is_err() && Body::cuboid(wrong).is_err());
            assert!(Body::triangular_prism(wrong, 1.0).is_err() || wrong == 1.0);
            assert!(Body::bullet(1.0, wrong).is_err());
            assert!(Body::tapered_column(1.0, wrong).is_err() || wrong == 1.0);
        }
        let error = Body::hexagonal_column(0.0).unwrap_err().to_string();
        assert!(error.contains("axis_ratio = 0") && error.contains("0.01 to 100"), "{error}");
    }
}
