//! The surface at one of its points: normal and curvature, for every kind of body.

use super::body::Shape;
use super::level::Level;
use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;

/// The surface at one of its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent<T> {
    /// Unit normal, outward.
    pub normal: Vec3<T>,
    position: Vec3<T>,
    down: Vec3<T>,
    level: Level<T>,
    /// 1 / |∇F|
    scale: T,
}

impl<T: Scalar> Tangent<T> {
    /// Change of the unit normal for a displacement in the tangent plane (Weingarten map).
    pub fn turn(&self, displacement: Vec3<T>) -> Vec3<T> {
        let along_x = self.position.dot(displacement);
        let along_k = self.down.dot(displacement);
        let l = &self.level;
        let change = displacement * (l.q * 2.0)
            + self.position * (l.qq * along_x * 4.0 + l.qz * along_k * 2.0)
            + self.down * (l.qz * along_x * 2.0 + l.zz * along_k);
        let change = change * self.scale;
        change - self.normal * self.normal.dot(change)
    }

    /// Normal curvature in the direction of a vector: `v·turn(v)`, positive for convex.
    pub fn curvature(&self, v: Vec3<T>) -> T {
        let tangential = v - self.normal * self.normal.dot(v);
        tangential.dot(self.turn(tangential))
    }

    /// Radius of curvature in the plane of the normal and a vector; that of the mean where the
    /// vector is normal. Real part for a complex point.
    pub fn radius_along(&self, v: Vec3<T>) -> f64 {
        let tangential = v - self.normal * self.normal.dot(v);
        let square = tangential.dot(tangential);
        if square.size() < 1e-12 {
            return 1.0;
        }
        (square / tangential.dot(self.turn(tangential))).re().abs().clamp(1e-3, 1e3)
    }
}

impl Shape {
    /// Normal and curvature at a point of the surface.
    pub(crate) fn tangent<T: Scalar>(&self, position: Vec3<T>) -> Tangent<T> {
        let down = Vec3::real(self.down);
        let level = self.level(position.dot(position), down.dot(position));
        let gradient = position * (level.q * 2.0) + down * level.z;
        let scale = T::real(1.0) / gradient.dot(gradient).root();
        Tangent { normal: gradient * scale, position, down, level, scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::samples::shapes;

    /// The turn of the normal along the surface, by differences between neighbouring points.
    #[test]
    fn normals_turn_as_the_surface_bends() {
        const H: f64 = 1e-5;
        for shape in shapes() {
            let point = |du: f64, dv: f64| {
                let (u, v) = (0.3 + du, -0.4 + dv);
                Vec3::new(u, v, shape.entry(u, v).unwrap())
            };
            let tangent = shape.tangent(point(0.0, 0.0));
            for (du, dv) in [(H, 0.0), (0.0, H), (H, -H)] {
                let (a, b) = (point(-du, -dv), point(du, dv));
                let exact = shape.tangent(b).normal - shape.tangent(a).normal;
                let off = (exact - tangent.turn(b - a)) * (0.5 / H);
                assert!(off.dot(off).sqrt() < 1e-8, "{shape:?}: {off:?}");
                assert!(tangent.normal.dot(b - a).abs() < 1e-13);
            }
        }
    }
}
