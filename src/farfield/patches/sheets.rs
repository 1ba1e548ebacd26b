//! Sheets of rays, cut into triangular patches on the sphere of directions.
//!
//! All rays of one order form a sheet: the wavefront's grid, mapped to exit directions. Between
//! grid rays only smooth quantities are interpolated: the path with its exact gradient
//! (`dW = -x_ref·ds`), the field transfer and the signed spread `s·(∂ᵤs × ∂ᵥs)`, never `1/√spread`.

use crate::math::parallel::*;
use crate::math::vec3::{Field, Vec3};
use crate::trace::{Exit, Tracer, Wavefront};

/// One traced ray as a corner of patches.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// Unit vector of the exit direction.
    pub direction: Vec3<f64>,
    /// Where the exit ray crosses the plane through the centre normal to it.
    pub reference: Vec3<f64>,
    /// Optical path to infinity, against a ray through the centre; in radii.
    pub path: f64,
    /// Determinant of the exit direction with respect to the launch point, signed.
    pub spread: f64,
    /// Fields for the two incident polarisations.
    pub field: [Field; 2],
    /// Focal lines passed.
    pub focal_lines: u32,
    /// Place on the emitting plane.
    pub place: [f64; 2],
}

/// A triangle of neighbouring rays, as indices of corners; counter-clockwise on the emitting plane.
pub type Triangle = [u32; 3];

/// All rays of one order.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Number of chords.
    pub order: u32,
    /// Rays of the grid.
    pub corners: Vec<Corner>,
    /// Patches between them.
    pub triangles: Vec<Triangle>,
}

impl Corner {
    fn new(exit: &Exit<f64>, place: [f64; 2]) -> Self {
        Self {
            direction: exit.direction,
            reference: exit.reference,
            path: exit.path,
            spread: exit.spread(),
            field: exit.field,
            focal_lines: exit.focal_lines,
            place,
        }
    }
}

/// Trace a wavefront and cut the rays of the given orders into sheets, in the order asked for.
///
/// Rays that are totally reflected leave no corner; triangles that would need one are left out.
pub fn sheets(tracer: &Tracer, wavefront: &Wavefront, orders: &[u32]) -> Vec<Sheet> {
    let slots: Vec<Vec<Option<Corner>>> = (0..wavefront.len())
        .into_par_iter()
        .with_min_len(64)
        .map(|ray| {
            let (u, v) = wavefront.vertex(ray);
            let mut found = vec![None; orders.len()];
            tracer.trace(u, v, |exit| {
                // in strongly deformed particles a few rays cannot be followed
                let followed = (exit.direction.dot(exit.direction) + exit.path).is_finite();
                let slot = orders.iter().position(|&p| p == exit.order);
                if let Some(slot) = slot.filter(|_| followed) {
                    found[slot] = Some(Corner::new(&exit, [u, v]));
                }
            });
            found
        })
        .collect();
    let triangles = wavefront.triangles();
    orders
        .par_iter()
        .enumerate()
        .map(|(slot, &order)| sheet(order, slots.iter().map(|s| s[slot]), &triangles))
        .collect()
}

/// Keep the rays that exist and renumber the triangles.
fn sheet(order: u32, rays: impl Iterator<Item = Option<Corner>>, triangles: &[Triangle]) -> Sheet {
    const MISSING: u32 = u32::MAX;
    let mut corners = Vec::new();
    let numbers: Vec<u32> = rays
        .map(|ray| {
            ray.map_or(MISSING, |corner| {
                corners.push(corner);
                corners.len() as u32 - 1
            })
        })
        .collect();
    let triangles = triangles
        .iter()
        .map(|t| t.map(|i| numbers[i as usize]))
        .filter(|t| t.iter().all(|&i| i != MISSING))
        .collect();
    Sheet { order, corners, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    /// Every ray of a sphere leaves in every order asked for, in the order asked, with the spread of its
    /// deflection.
    #[test]
    fn a_sphere_s_sheets_are_whole() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 1.333.into(), 100.0, 3);
        let wavefront = Wavefront::corners(&shape, 6, 8, 0.1);
        let found = sheets(&tracer, &wavefront, &[2, 0]);
        assert_eq!(found.iter().map(|sheet| sheet.order).collect::<Vec<_>>(), [2, 0]);
        for sheet in &found {
            assert_eq!(sheet.corners.len(), wavefront.len());
            assert_eq!(sheet.triangles, wavefront.triangles());
            for (n, corner) in sheet.corners.iter().enumerate() {
                let (u, v) = wavefront.vertex(n);
                assert_eq!(corner.place, [u, v]);
                let exit = tracer.trace_order(u, v, sheet.order).unwrap();
                assert_eq!((corner.path, corner.spread), (exit.path, exit.spread()));
            }
        }
    }

    /// Rays that do not enter leave no corner; the triangles left are those of corners that exist.
    #[test]
    fn totally_reflected_rays_leave_no_corner() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 0.75.into(), 100.0, 1);
        let wavefront = Wavefront::corners(&shape, 20, 16, 0.0);
        let [reflected, through] = &sheets(&tracer, &wavefront, &[0, 1])[..] else { panic!() };
        assert_eq!(reflected.corners.len(), wavefront.len());
        let entering = (0..wavefront.len())
            .filter(|&n| {
                let (u, v) = wavefront.vertex(n);
                u.hypot(v) < 0.75
            })
            .count();
        assert_eq!(through.corners.len(), entering);
        let rings = (entering - 1) / 16;
        assert_eq!(through.triangles.len(), 16 * (2 * rings - 1));
        assert!(through.triangles.iter().flatten().all(|&n| (n as usize) < entering));
    }
}
