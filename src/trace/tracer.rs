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
mod tests;
