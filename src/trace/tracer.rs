//! The way of a ray through the particle, from the wavefront to its exits, order by order.

use super::exit::Exit;
use super::ray::Ray;
use super::surface_event::{Event, Interface};
use crate::cancel;
use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;
use crate::shape::{Shape, Tangent};
use num_complex::Complex64;

/// Traces rays of one wavelength through one shape.
#[derive(Clone, Debug)]
pub struct Tracer<'a> {
    shape: &'a Shape,
    /// Complex index: Fresnel coefficients see all of it, the geometry its real part.
    index: Complex64,
    /// Decrease of amplitude per unit of chord length: `k₀ a κ`.
    decrement: f64,
    last_order: u32,
    interface: Interface,
}

/// A ray with less power than this is spent, and so many hits are followed at most.
const SPENT: f64 = 1e-6;
const MOST_HITS: usize = 10_000;

/// What is left of a ray's power when tracing stops, as fractions of what it brought.
#[derive(Clone, Copy, Debug, Default)]
pub struct Remainder {
    /// Power absorbed along the chords.
    pub absorbed: f64,
    /// Power still inside because it was totally reflected.
    pub totally_reflected: f64,
    /// Power still inside otherwise.
    pub truncated: f64,
}

impl<'a> Tracer<'a> {
    /// A tracer up to `last_order`; `size_parameter` matters only for absorption.
    pub fn new(shape: &'a Shape, index: Complex64, size_parameter: f64, last_order: u32) -> Self {
        let decrement = size_parameter * index.im;
        let interface = Interface { index, curved: None };
        Self { shape, index, decrement, last_order, interface }
    }

    /// The same tracer with the surface's curvature in its Fresnel coefficients (see
    /// `optics::Grazing`): waves near grazing incidence for one size parameter.
    pub fn with_curved_interface(mut self, size_parameter: f64) -> Self {
        self.interface.curved = Some(size_parameter);
        self
    }

    /// The complex index inside.
    pub fn index(&self) -> Complex64 {
        self.index
    }

    /// The shape traced.
    pub fn shape(&self) -> &'a Shape {
        self.shape
    }

    /// The highest order traced.
    pub fn last_order(&self) -> u32 {
        self.last_order
    }

    /// The exit of one order for the ray launched at `(u, v)`; `None` when it misses the particle
    /// or is totally reflected at its last meeting with the surface.
    pub fn trace_order<T: Scalar>(&self, u: T, v: T, order: u32) -> Option<Exit<T>> {
        self.follow(u, v, order, |_, _| {})
    }

    /// Follow a ray to its exit; `meet` sees it at every surface point before it goes on.
    pub(super) fn follow<T: Scalar>(
        &self,
        u: T,
        v: T,
        order: u32,
        mut meet: impl FnMut(&Ray<T>, &Tangent<T>),
    ) -> Option<Exit<T>> {
        let mut ray = self.launch(u, v)?;
        let mut tangent = self.shape.tangent(ray.position);
        meet(&ray, &tangent);
        let event = Event::new(&mut ray, &tangent, &self.interface);
        if order == 0 {
            return Some(Exit::new(0, event.reflect(&ray)));
        }
        let mut inside = event.refract(&ray, 1.0 / self.index.re)?;
        for chord in 1..=order {
            self.cross(&mut inside, &tangent);
            tangent = self.shape.tangent(inside.position);
            meet(&inside, &tangent);
            let event = Event::new(&mut inside, &tangent, &self.interface);
            if chord == order {
                return Some(Exit::new(order, event.refract(&inside, self.index.re)?));
            }
            inside = event.reflect(&inside);
        }
        None
    }

    /// Trace the ray launched at `(u, v)`; `visit` is called at every exit, in order.
    /// `None` when the ray misses the particle.
    pub fn trace<T: Scalar>(&self, u: T, v: T, visit: impl FnMut(Exit<T>)) -> Option<Remainder> {
        self.trace_with(u, v, false, visit)
    }

    /// As [`Tracer::trace`], and an absorbing particle goes on to absorb behind the last order
    /// until next to nothing is left: grazing rays, of which little leaves at each hit, give it
    /// much of what they hold.
    pub fn trace_to_the_end<T: Scalar>(
        &self,
        u: T,
        v: T,
        visit: impl FnMut(Exit<T>),
    ) -> Option<Remainder> {
        self.trace_with(u, v, self.decrement > 0.0, visit)
    }

    fn trace_with<T: Scalar>(
        &self,
        u: T,
        v: T,
        to_the_end: bool,
        mut visit: impl FnMut(Exit<T>),
    ) -> Option<Remainder> {
        let mut ray = self.launch(u, v)?;
        let mut tangent = self.shape.tangent(ray.position);
        let event = Event::new(&mut ray, &tangent, &self.interface);
        visit(Exit::new(0, event.reflect(&ray)));
        let mut remainder = Remainder::default();
        let inside = event.refract(&ray, 1.0 / self.index.re);
        let Some(mut inside) = inside.filter(|_| self.last_order > 0) else {
            remainder.truncated = 1.0 - event.reflect(&ray).power();
            return Some(remainder);
        };
        let mut totally_reflected = false;
        for order in 1..=self.last_order {
            remainder.absorbed += self.cross(&mut inside, &tangent);
            tangent = self.shape.tangent(inside.position);
            let event = Event::new(&mut inside, &tangent, &self.interface);
            let outside = event.refract(&inside, self.index.re);
            totally_reflected = outside.is_none();
            if let Some(outside) = outside {
                visit(Exit::new(order, outside));
            }
            inside = event.reflect(&inside);
        }
        let mut left = inside.power();
        if to_the_end {
            let absorbed = self.absorb_the_rest(inside, tangent);
            remainder.absorbed += absorbed;
            left -= absorbed;
        }
        if totally_reflected {
            remainder.totally_reflected = left;
        } else {
            remainder.truncated = left;
        }
        Some(remainder)
    }

    /// Power that a ray inside still loses to absorption, hit by hit until it is spent.
    fn absorb_the_rest<T: Scalar>(&self, mut inside: Ray<T>, mut tangent: Tangent<T>) -> f64 {
        let mut absorbed = 0.0;
        for _ in 0..MOST_HITS {
            if inside.power() < SPENT {
                break;
            }
            absorbed += self.cross(&mut inside, &tangent);
            tangent = self.shape.tangent(inside.position);
            let before = inside.power();
            inside = Event::new(&mut inside, &tangent, &self.interface).reflect(&inside);
            // near the critical angle an absorbing interface gives back more than it was given, by a part of
            // the order of k; on a ray caught inside it would grow with every hit
            let given_back = inside.power();
            if given_back > before {
                inside.field =
                    inside.field.map(|e| e * Complex64::from((before / given_back).sqrt()));
            }
        }
        absorbed
    }

    /// The ray at its first meeting with the surface.
    fn launch<T: Scalar>(&self, u: T, v: T) -> Option<Ray<T>> {
        cancel::checkpoint();
        let t = self.shape.entry(u, v)?;
        let (zero, one) = (T::default(), T::real(1.0));
        let unit = |x: f64, y: f64| Vec3 {
            x: Complex64::new(x, 0.0),
            y: Complex64::new(y, 0.0),
            z: Complex64::default(),
        };
        Some(Ray {
            position: Vec3::new(u, v, t),
            direction: Vec3::new(zero, zero, one),
            dx: [Vec3::new(one, zero, zero), Vec3::new(zero, one, zero)],
            ds: [Vec3::default(); 2],
            path: t,
            field: [unit(1.0, 0.0), unit(0.0, 1.0)],
            focal_lines: 0,
        })
    }

    /// Carry a ray over one chord; returns the share of power absorbed on it.
    fn cross<T: Scalar>(&self, ray: &mut Ray<T>, tangent: &Tangent<T>) -> f64 {
        let length = self.shape.chord(ray.position, ray.direction, tangent);
        if T::REAL {
            ray.focal_lines += ray.focal_lines_within(length.re());
        }
        ray.position = ray.position + ray.direction * length;
        ray.dx = [0, 1].map(|k| ray.dx[k] + ray.ds[k] * length);
        ray.path += length * self.index.re;
        if self.decrement == 0.0 {
            return 0.0;
        }
        let before = ray.power();
        let real = || (-length.re() * self.decrement).exp().into();
        let factor = if T::REAL { real() } else { (-length.complex() * self.decrement).exp() };
        ray.field = ray.field.map(|e| e * factor);
        before - ray.power()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::RaindropModel;
    use std::f64::consts::PI;

    const INDEX: f64 = 1.333;

    fn drop() -> Shape {
        Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, 0.4).unwrap()
    }

    /// Rays caught in a prolate body by total reflection, where absorption per hit is less than what the complex
    /// interface would add: they lose what they have, and no more.
    #[test]
    fn caught_rays_do_not_grow() {
        let shape = Shape::spheroid(1.15, 0.0).unwrap();
        for k in [1e-5, 1e-3, 7e-3] {
            let tracer = Tracer::new(&shape, Complex64::new(1.31, k), 15.78, 5);
            let (mut sum, mut count) = (0.0, 0.0);
            for (i, j) in (0..40).flat_map(|i| (0..40).map(move |j| (i, j))) {
                let place = |n: i32| (f64::from(n) - 19.5) / 20.0;
                let rest = tracer
                    .trace_to_the_end(place(i), place(j), |exit: Exit<f64>| sum += exit.power());
                let Some(rest) = rest else { continue };
                assert!((0.0..1.0 + 2.0 * k.sqrt()).contains(&rest.absorbed), "{rest:?}");
                sum += rest.absorbed + rest.truncated + rest.totally_reflected;
                count += 1.0;
            }
            // coefficients of an absorbing interface add up to 1 but for a part of k
            let off = sum / count - 1.0;
            assert!(off.abs() < 6.0 * k, "k = {k}: {off}");
        }
    }

    /// Path `2 (p n cos θt - cos θi)`, deviation `2 (θi - θt) + (p - 1)(π - 2 θt)`, impact as at the
    /// entry.
    #[test]
    fn rays_of_a_sphere_are_known() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 5);
        for b in [0.1, 0.5, 0.8, 0.97f64] {
            let (outside, inside) = (b.asin(), (b / INDEX).asin());
            for p in 0..=5 {
                let exit = tracer.trace_order(0.6 * b, 0.8 * b, p).unwrap();
                let order = f64::from(p);
                let path = 2.0 * (order * INDEX * inside.cos() - outside.cos());
                assert!((exit.path - path).abs() < 1e-13, "{p} {b}");
                let deviation = 2.0 * (outside - inside) + (order - 1.0) * (PI - 2.0 * inside);
                assert!((exit.direction.z - deviation.cos()).abs() < 1e-13, "{p} {b}");
                assert!((exit.reference.dot(exit.reference).sqrt() - b).abs() < 1e-13);
            }
        }
    }

    /// `|dΩ/dA| = |sin Θ Θ'/(b)|` with the deviation's slope, and the focal lines on both sides of a bow.
    #[test]
    fn the_spread_of_a_sphere_s_rays_is_known() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
        for (b, p, lines) in [(0.4, 0, 0), (0.4, 1, 2), (0.6, 2, 2), (0.95, 2, 3), (0.98, 3, 5)] {
            let exit = tracer.trace_order(b, 0.0, p).unwrap();
            let order = f64::from(p);
            let slope = 2.0 / (1.0 - b * b).sqrt() - 2.0 * order / (INDEX * INDEX - b * b).sqrt();
            let expected = (exit.scattering_angle().sin() * slope / b).abs();
            assert!((exit.spread().abs() - expected).abs() < 1e-11 * expected.max(1.0), "{p} {b}");
            assert_eq!(exit.focal_lines, lines, "{p} {b}");
        }
    }

    /// On a raindrop, by neighbouring rays: derivatives of direction and reference point, and Hamilton's
    /// `dW = -x_ref · ds`.
    #[test]
    fn differentials_are_those_of_neighbouring_rays() {
        const H: f64 = 1e-5;
        let shape = drop();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
        for p in 0..=3 {
            let at = |du: f64, dv: f64| tracer.trace_order(0.35 + du, -0.5 + dv, p).unwrap();
            let exit = at(0.0, 0.0);
            for (k, (du, dv)) in [(H, 0.0), (0.0, H)].into_iter().enumerate() {
                let (a, b) = (at(-du, -dv), at(du, dv));
                let turned = (b.direction - a.direction) * (0.5 / H) - exit.ds[k];
                assert!(turned.dot(turned).sqrt() < 1e-6, "{p}: {turned:?}");
                let moved = (b.reference - a.reference) * (0.5 / H);
                let moved = moved - exit.direction * moved.dot(exit.direction) - exit.dx[k];
                assert!(moved.dot(moved).sqrt() < 1e-6, "{p}: {moved:?}");
                let path = (b.path - a.path) / (2.0 * H) + exit.reference.dot(exit.ds[k]);
                assert!(path.abs() < 1e-7, "{p}: {path}");
            }
        }
    }

    /// One way through visits the exits that are asked for one by one, and power adds up; where the
    /// medium absorbs, but for a small part of k at every interface.
    #[test]
    fn exits_come_in_order_and_power_adds_up() {
        let shape = drop();
        for (k, bound) in [(0.0, 1e-13), (1e-4, 1e-6)] {
            let tracer = Tracer::new(&shape, Complex64::new(INDEX, k), 1000.0, 4);
            let (mut left, mut next) = (0.0, 0);
            let rest = tracer.trace(0.2, 0.7, |exit| {
                let alone = tracer.trace_order(0.2, 0.7, exit.order).unwrap();
                let found = (exit.order, exit.path, exit.spread());
                assert_eq!(found, (next, alone.path, alone.spread()));
                next += 1;
                left += exit.power();
            });
            let rest = rest.unwrap();
            assert_eq!(next, 5);
            assert!((left + rest.absorbed + rest.truncated - 1.0).abs() < bound, "{rest:?}");
            assert_eq!(rest.absorbed > 0.0, k > 0.0);
        }
        assert!(Tracer::new(&shape, INDEX.into(), 1.0, 4).trace(1.2, 0.0, |_| {}).is_none());
    }

    /// The first chord takes what Beer's law says.
    #[test]
    fn chords_absorb_by_beer_s_law() {
        let shape = drop();
        let index = Complex64::new(INDEX, 1e-4);
        let first = Tracer::new(&shape, index, 1000.0, 1);
        let mut meetings = Vec::new();
        first.trace_with_meetings(0.2, 0.7, 1, &mut meetings).unwrap();
        let chord = (meetings[1].path - meetings[0].path) / INDEX;
        let reflected = first.trace_order(0.2, 0.7, 0).unwrap().power();
        let beer = (1.0 - reflected) * (1.0 - (-2.0 * 1000.0 * 1e-4 * chord).exp());
        let rest = first.trace(0.2, 0.7, |_| {}).unwrap();
        assert!((rest.absorbed - beer).abs() < 1e-6, "{rest:?} {beer}");
        // later chords take more, out of what would be left
        let end = first.trace_to_the_end(0.2, 0.7, |_| {}).unwrap();
        assert!(end.absorbed > 1.01 * rest.absorbed, "{end:?}");
        let both = |r: &Remainder| r.absorbed + r.truncated;
        assert!((both(&end) - both(&rest)).abs() < 1e-14);
    }

    /// A complex ray with real coordinates is the real ray, and exits are analytic in them.
    #[test]
    fn complex_rays_continue_real_ones() {
        const H: f64 = 1e-5;
        let shape = drop();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 2);
        let at = |du: Complex64| tracer.trace_order(0.3 + du, Complex64::from(0.6), 2).unwrap();
        let real = tracer.trace_order(0.3, 0.6, 2).unwrap();
        let (here, i) = (at(0.0.into()), Complex64::i());
        assert!((here.path - real.path).norm() < 1e-13);
        assert!((here.spread() - real.spread()).norm() < 1e-12);
        let slope = (at(i * H).path - at(-i * H).path) / (2.0 * H * i);
        assert!((slope + real.reference.dot(real.ds[0])).norm() < 1e-7, "{slope}");
    }
}
