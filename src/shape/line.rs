//! Straight lines through a body: where they enter, how long their chords are, for every kind of body.

use super::body::Shape;
use super::tangent::Tangent;
use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;
use std::f64::consts::PI;

impl Shape {
    /// Length of the chord from a surface point along an inward direction to the far side.
    ///
    /// Newton's method on `F(t)/t`, which has only the far root; a guess from the curvature where
    /// the chord begins is exact on a sphere. Real chords are kept inside a bracket.
    pub(crate) fn chord<T: Scalar>(
        &self,
        from: Vec3<T>,
        direction: Vec3<T>,
        tangent: &Tangent<T>,
    ) -> T {
        let inward = -(tangent.normal.dot(direction));
        let curvature = tangent.curvature(direction);
        let guess = inward * 2.0 / (curvature + inward * inward);
        Line::new(self, from, direction).far_root(guess, 2.0 * self.bounding_radius())
    }

    /// Distance of the surface from the centre in a direction (a unit vector's components).
    pub fn radius_towards(&self, x: f64, y: f64, z: f64) -> f64 {
        let depth = Vec3 { x, y, z }.dot(self.down);
        let mut radius = 1.0;
        for _ in 0..NEWTON_STEPS {
            let s = self.slope(radius * radius, radius * depth);
            let step = s.f / (2.0 * radius * s.q + depth * s.z);
            radius -= step;
            if step.abs() < 1e-14 {
                break;
            }
        }
        radius
    }

    /// Largest less smallest distance of the surface from the centre, in radii of the sphere of equal volume: 0 for
    /// a sphere, however the light falls.
    pub fn deformation(&self) -> f64 {
        const STEPS: u32 = 16;
        let down = self.down;
        let across = if down.x.abs() < 0.5 {
            Vec3 { x: 1.0, y: 0.0, z: 0.0 }
        } else {
            Vec3 { x: 0.0, y: 1.0, z: 0.0 }
        };
        let aside = across - down * across.dot(down);
        let aside = aside * aside.dot(aside).sqrt().recip();
        let radius = |k: u32| {
            let (sin, cos) = (PI * f64::from(k) / f64::from(STEPS)).sin_cos();
            let towards = down * cos + aside * sin;
            self.radius_towards(towards.x, towards.y, towards.z)
        };
        let (low, high) = (0..=STEPS)
            .map(radius)
            .fold((f64::MAX, 0.0f64), |(low, high), r| (low.min(r), high.max(r)));
        high - low
    }

    /// Where the line `(u, v, t)` along +z first meets the surface: the coordinate `t`.
    /// `None` when it misses.
    pub(crate) fn entry<T: Scalar>(&self, u: T, v: T) -> Option<T> {
        let origin = Vec3::new(u, v, T::default());
        let axis = Vec3::new(T::default(), T::default(), T::real(1.0));
        Line::new(self, origin, axis).near_root(self.bounding_radius())
    }
}

/// `F` along a straight line, as a function of the length `t`.
struct Line<'a, T> {
    shape: &'a Shape,
    q0: T,
    half_q1: T,
    z0: T,
    z1: T,
}

const NEWTON_STEPS: usize = 40;
/// Step after which Newton's method has reached rounding.
const SETTLED: f64 = 1e-9;
/// `F` at the foot of the perpendicular below which a line passes well inside.
const DEEP: f64 = -0.25;
/// Squared distance from the centre up to which a line passes well inside the sphere of equal volume.
const WITHIN_SPHERE: f64 = 0.9;

impl<'a, T: Scalar> Line<'a, T> {
    fn new(shape: &'a Shape, origin: Vec3<T>, direction: Vec3<T>) -> Self {
        let down = Vec3::real(shape.down);
        Self {
            shape,
            q0: origin.dot(origin),
            half_q1: origin.dot(direction),
            z0: down.dot(origin),
            z1: down.dot(direction),
        }
    }

    /// `F(t)` and `F'(t)`.
    fn at(&self, t: T) -> (T, T) {
        let q = self.q0 + (self.half_q1 * 2.0 + t) * t;
        let s = self.shape.slope(q, self.z0 + self.z1 * t);
        (s.f, s.q * (self.half_q1 + t) * 2.0 + s.z * self.z1)
    }

    /// The root beyond the one at `t = 0`.
    fn far_root(&self, guess: T, longest: f64) -> T {
        let mut t = guess;
        let (mut low, mut high) = (0.0, longest);
        for _ in 0..NEWTON_STEPS {
            let (f, slope) = self.at(t);
            if f.re() < 0.0 {
                low = t.re()
            } else {
                high = t.re()
            }
            // (F/t)' = (F' - F/t)/t
            let step = f / (slope - f / t);
            let mut next = t - step;
            // A complex chord has no order on it, and starts close to its root.
            if T::REAL && !(next.re() > low * 0.5 && next.re() < high * 1.5) {
                next = T::real(0.5 * (low + high));
            }
            let change = (next - t).size();
            t = next;
            // Quadratic convergence: what is left is the square of the last step.
            if change <= SETTLED * t.size() {
                return if self.leaves_first(t) { t } else { self.first_exit(longest) };
            }
        }
        if T::REAL { self.first_exit(longest) } else { t }
    }

    /// Whether the line leaves the body at a root, not having left it before: a hollow of the surface
    /// may lie between.
    fn leaves_first(&self, root: T) -> bool {
        if !T::REAL || self.shape.body.is_convex() {
            return true;
        }
        let outside = |share: f64| self.at(root * share).0.re() > 0.0;
        self.at(root).1.re() > 0.0 && ![0.25, 0.5, 0.75, 0.9].into_iter().any(outside)
    }

    /// Where the line first leaves the body, by brute force.
    fn first_exit(&self, longest: f64) -> T {
        const POINTS: u32 = 256;
        const BISECTIONS: u32 = 60;
        let outside = |t: f64| self.at(T::real(t)).0.re() > 0.0;
        let place = |k: u32| longest * f64::from(k) / f64::from(POINTS);
        let beyond = (1..=POINTS).find(|&k| outside(place(k)) && !outside(place(k - 1).max(1e-9)));
        let (mut low, mut high) = beyond.map_or((0.0, longest), |k| (place(k - 1), place(k)));
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if outside(middle) { high = middle } else { low = middle }
        }
        T::real(0.5 * (low + high))
    }

    /// The first of the two roots about the point of greatest depth.
    fn near_root(&self, bound: f64) -> Option<T> {
        let (inside, guess) = self.inside(bound)?;
        let mut t = guess;
        let (mut low, mut high) = (-1.01 * bound, inside.re());
        for _ in 0..2 * NEWTON_STEPS {
            let (f, slope) = self.at(t);
            if f.re() > 0.0 {
                low = t.re()
            } else {
                high = t.re()
            }
            let mut next = t - f / slope;
            if T::REAL && !(next.re() >= low && next.re() <= high) {
                next = T::real(0.5 * (low + high));
            }
            let change = (next - t).size();
            t = next;
            if change <= SETTLED {
                break;
            }
        }
        Some(t)
    }

    /// A point of the line inside the body, and a first guess of where the line enters. Far from
    /// the rim the foot of the perpendicular serves; near it, the deepest point. `None` when the
    /// line misses the body.
    fn inside(&self, bound: f64) -> Option<(T, T)> {
        let middle = -self.half_q1;
        let distance = self.q0 - self.half_q1 * self.half_q1;
        let core = self.shape.rough_core();
        // Through the core of a polar profile every line hits, and `F` itself may be rough there.
        // The guess is that of the sphere of equal volume, which discs and needles stand out of.
        let within = || distance.re() < WITHIN_SPHERE && self.at(middle).0.re() < DEEP;
        if distance.re() < core * core || within() {
            return Some((middle, middle - (-distance + 1.0).root()));
        }
        let mut t = middle;
        for _ in 0..NEWTON_STEPS {
            let (slope, bend) = self.slope_and_bend(t);
            let step = slope / bend;
            t = t - step;
            if step.size() < 1e-9 {
                break;
            }
        }
        // Newton's method finds any extremum: on the flattened side of a large drop also the hump
        // of `F` between two dips, or one far outside.
        let outside = |t: T| !((t - middle).size() <= bound && self.at(t).0.re() <= 0.0);
        if T::REAL && (outside(t) || self.slope_and_bend(t).1.re() <= 0.0) {
            t = T::real(self.deepest_of_many(middle.re(), bound));
        }
        let depth = self.at(t).0;
        if T::REAL && depth.re() > 0.0 {
            return None;
        }
        let bend = self.slope_and_bend(t).1;
        if T::REAL && bend.re() <= 0.0 {
            return Some((t, T::real(0.5 * (t.re() - bound))));
        }
        Some((t, t - (-(depth * 2.0) / bend).root()))
    }

    /// The first dip of `F` below zero along the line, or its deepest point: by brute force.
    fn deepest_of_many(&self, middle: f64, bound: f64) -> f64 {
        const POINTS: i32 = 256;
        let place = |i: f64| middle + bound * i / f64::from(POINTS);
        let value = |i: f64| self.at(T::real(place(i))).0.re();
        let mut best = (f64::INFINITY, 0.0);
        for i in -POINTS..=POINTS {
            let f = value(f64::from(i));
            if f < best.0 {
                best = (f, f64::from(i));
            } else if best.0 < 0.0 {
                break;
            }
        }
        // Ternary search about the lowest point.
        let (mut low, mut high) = (best.1 - 1.0, best.1 + 1.0);
        for _ in 0..80 {
            let third = (high - low) / 3.0;
            if value(low + third) < value(high - third) { high -= third } else { low += third }
        }
        place(0.5 * (low + high))
    }

    /// First and second derivative of `F` along the line.
    fn slope_and_bend(&self, t: T) -> (T, T) {
        let q = self.q0 + (self.half_q1 * 2.0 + t) * t;
        let l = self.shape.level(q, self.z0 + self.z1 * t);
        let dq = (self.half_q1 + t) * 2.0;
        let cross = l.qz * dq * self.z1 * 2.0;
        (l.q * dq + l.z * self.z1, l.q * 2.0 + l.qq * dq * dq + cross + l.zz * self.z1 * self.z1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::RaindropModel;
    use crate::shape::samples::shapes;
    use num_complex::Complex64;

    /// Of a spheroid the difference of its half-axes, however the light falls.
    #[test]
    fn deformation_is_that_of_the_body() {
        for sun in [0.0, 0.4, 1.5] {
            let spheroid = Shape::spheroid(0.9, sun).unwrap();
            let (up, aside) = (0.9f64.powf(2.0 / 3.0), 0.9f64.powf(-1.0 / 3.0));
            assert!((spheroid.deformation() - (aside - up)).abs() < 1e-12, "{sun}");
        }
        assert_eq!(Shape::sphere().deformation(), 0.0);
    }

    /// A line enters and leaves at the surface; on the sphere the chord is `2 cos i'`.
    #[test]
    fn lines_meet_the_surface_and_chords_end_there() {
        for shape in shapes() {
            for (u, v) in [(0.0, 0.0), (0.5, -0.4), (-0.1, 0.85), (0.8, 0.2)] {
                let t = shape.entry(u, v).unwrap();
                let level = |x: Vec3<f64>| shape.slope(x.dot(x), x.dot(shape.down)).f;
                let entry = Vec3::new(u, v, t);
                assert!(level(entry).abs() < 1e-12, "{shape:?}");
                let tangent = shape.tangent(entry);
                // the first meeting: the surface looks towards the light
                assert!(tangent.normal.z < 0.0);
                let inward = (-tangent.normal + Vec3::new(0.1, 0.2, 0.0)).normalized();
                let length = shape.chord(entry, inward, &tangent);
                assert!(level(entry + inward * length).abs() < 1e-12 && length > 0.2);
                if shape.is_sphere() {
                    assert!((length + 2.0 * tangent.normal.dot(inward)).abs() < 1e-13);
                }
            }
            assert!(shape.entry(1.3, 0.3).is_none());
        }
    }

    /// The continuation of a chord to complex launch points is analytic: Cauchy and Riemann agree.
    #[test]
    fn complex_lines_continue_the_real_ones() {
        const H: f64 = 1e-5;
        for shape in shapes() {
            let entry = |du: Complex64| shape.entry(0.4 + du, Complex64::from(0.3)).unwrap();
            let i = Complex64::i();
            let real = shape.entry(0.4, 0.3).unwrap();
            assert!((entry(0.0.into()) - real).norm() < 1e-14, "{shape:?}");
            let along = (entry(H.into()) - entry((-H).into())) / (2.0 * H);
            let aside = (entry(i * H) - entry(-i * H)) / (2.0 * H * i);
            assert!((along - aside).norm() < 1e-8, "{shape:?}: {along} {aside}");
        }
    }

    /// On the flattened side of a large drop `F` has a hump between two dips: rays along the rim of
    /// its shadow find the first.
    #[test]
    fn rays_near_the_rim_of_large_drops_are_found() {
        let shape = Shape::raindrop(2.9e-3, RaindropModel::BeardChuang1987, 0.2).unwrap();
        let silhouette = shape.silhouette();
        for k in 0..48 {
            let azimuth = f64::from(k) * std::f64::consts::TAU / 48.0;
            let ((sin, cos), radius) = (azimuth.sin_cos(), silhouette.radius(azimuth));
            let inside = shape.entry(0.9999 * radius * cos, 0.9999 * radius * sin).unwrap();
            let tangent =
                shape.tangent(Vec3::new(0.9999 * radius * cos, 0.9999 * radius * sin, inside));
            assert!(tangent.normal.z <= 0.0, "{azimuth}: {:?}", tangent.normal);
            assert!(shape.entry(1.0001 * radius * cos, 1.0001 * radius * sin).is_none());
        }
    }
}
