//! Bodies of one's own: a user gives one formula, the library does the rest.
//!
//! The formula is `F(q, ζ)` of [`crate::shape`], in any unit of length and of any steepness, written in
//! [`Jet`]s so that its derivatives come with it. [`OwnBody::new`] looks along many directions from the
//! centre for the one point where `F` changes its sign, adds up the volume, and scales the body so that the
//! sphere of equal volume has radius 1.
//!
//! ```
//! use gonio::math::jet::Jet;
//! use gonio::math::scalar::Scalar;
//! use gonio::shape::{Outline, OwnBody, Shape};
//!
//! /// A spheroid with half axes 3 (horizontal) and 2 (vertical).
//! #[derive(Debug)]
//! struct Lens;
//!
//! impl Outline for Lens {
//!     fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
//!         (q - depth * depth) / 9.0 + depth * depth / 4.0 - 1.0
//!     }
//! }
//!
//! let lens = Shape::own(OwnBody::new("lens", Lens)?, 0.0);
//! let same = Shape::spheroid(2.0 / 3.0, 0.0)?;
//! let (a, b) = (lens.radius_towards(0.6, 0.0, 0.8), same.radius_towards(0.6, 0.0, 0.8));
//! assert!((a - b).abs() < 1e-12);
//! # Ok::<(), gonio::shape::ShapeError>(())
//! ```

use super::error::ShapeError;
use super::level::{Level, Slope};
use crate::math::gauss_legendre;
use crate::math::jet::Jet;
use crate::math::scalar::Scalar;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::fmt::Debug;
use std::sync::Arc;

/// The outline of a body of revolution about the vertical, as the level set of a function.
pub trait Outline: Debug + Send + Sync + 'static {
    /// `F` at `q = x·x`, the square of the distance from the centre, and the depth `ζ` below it: negative
    /// inside, positive outside. `q - ζ²` is the square of the distance from the axis.
    ///
    /// Twice differentiable, and analytic where rays meet it if rainbows are to have their dark sides
    /// (complex rays). A number from outside is `Jet::constant(T::real(…))`.
    fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T>;
}

/// [`Outline`] for the two fields that there are, so that a body can hold any.
trait AnyOutline: Debug + Send + Sync {
    fn real(&self, q: f64, depth: f64) -> Jet<f64>;
    fn complex(&self, q: Complex64, depth: Complex64) -> Jet<Complex64>;
}

impl<O: Outline> AnyOutline for O {
    fn real(&self, q: f64, depth: f64) -> Jet<f64> {
        self.level(Jet::first(q), Jet::second(depth))
    }
    fn complex(&self, q: Complex64, depth: Complex64) -> Jet<Complex64> {
        self.level(Jet::first(q), Jet::second(depth))
    }
}

/// A body by its own formula. Two are equal when they are copies of one.
#[derive(Clone, Debug)]
pub struct OwnBody(Arc<Own>);

/// Steps along an outline by which dents are looked for, and the turn to the wrong side that is rounding.
const DENT_STEPS: usize = 360;
const DENT: f64 = 1e-10;

/// What a body of one's own holds.
#[derive(Debug)]
struct Own {
    name: String,
    outline: Box<dyn AnyOutline>,
    /// Radius of the sphere of equal volume, in the unit of the formula.
    unit: f64,
    /// Makes `F` as steep at the equator as that of the sphere.
    steepness: f64,
    /// Smallest and largest distance of the surface from the centre, the sphere's radius being 1.
    radii: (f64, f64),
}

impl PartialEq for OwnBody {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Directions from the centre, from pole to pole, in which the surface is looked for: the volume's error
/// is that of a Gauss–Legendre sum, below rounding for smooth bodies.
const DIRECTIONS: usize = 200;
/// Steps from the centre outwards in which one change of sign is to be found.
const STEPS: usize = 400;
/// Largest ratio of a body's radii: beyond, it is a needle or a disc.
const MOST_RATIO: f64 = 10.0;
const ACCEPTED: &str = "F(q, ζ) finite, negative at the centre and positive outside, with one change of \
                        sign along every line from the centre, its radii within a factor of 10";

impl OwnBody {
    /// A body by its outline; `name` is what tables and messages call it.
    ///
    /// # Errors
    /// [`ShapeError::OwnBody`] where the formula is not negative at the centre, not finite, or does not
    /// change its sign just once along a line from the centre.
    pub fn new(name: &str, outline: impl Outline) -> Result<Self, ShapeError> {
        let fault =
            |fault: String| ShapeError::OwnBody { name: name.into(), fault, accepted: ACCEPTED };
        let (mut volume, mut least, mut most) = (0.0, f64::INFINITY, 0.0f64);
        let reach = reach(&outline).map_err(fault)?;
        for (mu, weight) in gauss_legendre::nodes(DIRECTIONS) {
            let radius = radius(&outline, mu, reach).map_err(fault)?;
            volume += 0.5 * weight * radius.powi(3);
            (least, most) = (least.min(radius), most.max(radius));
        }
        let unit = volume.cbrt();
        if most > MOST_RATIO * least {
            return Err(fault(format!("its radii are {least} to {most}")));
        }
        let equator = radius(&outline, 0.0, reach).map_err(fault)?;
        let slope = outline.real(equator * equator, 0.0);
        // the sphere's F = (q - 1)/2 has a gradient of 1 at its surface
        let gradient = unit * (2.0 * equator * slope.x).hypot(slope.y);
        if !(gradient > 0.0 && gradient.is_finite()) {
            return Err(fault(format!("its gradient at the equator is {gradient}")));
        }
        // the extremes may lie between the directions
        let radii = (least / unit * 0.999, most / unit * 1.001);
        let (name, outline) = (name.into(), Box::new(outline));
        Ok(Self(Arc::new(Own { name, outline, unit, steepness: 1.0 / gradient, radii })))
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// The angle from straight down (radians) at which its outline is dented, if it is: light that has left the
    /// body could enter it there again.
    pub(crate) fn dent(&self) -> Option<f64> {
        let at = |step: usize| {
            let theta = PI * step as f64 / DENT_STEPS as f64;
            let reach = self.0.radii.1 * self.0.unit * 2.0;
            let radius = radius(self.0.outline.as_ref(), theta.cos(), reach).unwrap_or(self.0.unit);
            [radius / self.0.unit * theta.sin(), radius / self.0.unit * theta.cos()]
        };
        let points: Vec<[f64; 2]> = (0..=DENT_STEPS).map(at).collect();
        let bends = |w: &[[f64; 2]]| {
            let [a, b] =
                [[w[1][0] - w[0][0], w[1][1] - w[0][1]], [w[2][0] - w[1][0], w[2][1] - w[1][1]]];
            a[0] * b[1] - a[1] * b[0] < DENT
        };
        let place = points.windows(3).position(|w| !bends(w))?;
        Some(PI * (place + 1) as f64 / DENT_STEPS as f64)
    }

    pub(super) fn is_sphere(&self) -> bool {
        // what the margins of the extremes leave of equal radii
        self.0.radii.1 - self.0.radii.0 < 0.002 * (1.0 + 1e-9)
    }

    pub(super) fn bounding_radius(&self) -> f64 {
        self.0.radii.1
    }

    /// Every line through this core hits the body, and the formula may be singular in it.
    pub(super) fn rough_core(&self) -> f64 {
        0.5 * self.0.radii.0
    }

    /// `F` with its derivatives, in the unit and of the steepness of the other kinds.
    fn jet<T: Scalar>(&self, q: T, depth: T) -> Jet<T> {
        let (u, s) = (self.0.unit, self.0.steepness);
        let jet = if T::REAL {
            let jet = self.0.outline.real(q.re() * u * u, depth.re() * u);
            Jet {
                value: T::real(jet.value),
                x: T::real(jet.x),
                y: T::real(jet.y),
                xx: T::real(jet.xx),
                xy: T::real(jet.xy),
                yy: T::real(jet.yy),
            }
        } else {
            let jet = self.0.outline.complex(q.complex() * (u * u), depth.complex() * u);
            Jet {
                value: T::of_complex(jet.value),
                x: T::of_complex(jet.x),
                y: T::of_complex(jet.y),
                xx: T::of_complex(jet.xx),
                xy: T::of_complex(jet.xy),
                yy: T::of_complex(jet.yy),
            }
        };
        Jet {
            value: jet.value * s,
            x: jet.x * (s * u * u),
            y: jet.y * (s * u),
            xx: jet.xx * (s * u.powi(4)),
            xy: jet.xy * (s * u.powi(3)),
            yy: jet.yy * (s * u * u),
        }
    }

    pub(super) fn slope<T: Scalar>(&self, q: T, depth: T) -> Slope<T> {
        let jet = self.jet(q, depth);
        Slope { f: jet.value, q: jet.x, z: jet.y }
    }

    pub(super) fn level<T: Scalar>(&self, q: T, depth: T) -> Level<T> {
        let jet = self.jet(q, depth);
        Level { q: jet.x, z: jet.y, qq: jet.xx, qz: jet.xy, zz: jet.yy }
    }
}

/// `F` at a distance from the centre, towards the depth `μ` times that distance.
fn value(outline: &(impl AnyOutline + ?Sized), mu: f64, r: f64) -> Result<f64, String> {
    let value = outline.real(r * r, mu * r).value;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(format!("F = {value} at q = {}, ζ = {}", r * r, mu * r))
    }
}

/// A distance that holds the whole body, in the unit of the formula, and less than it by [`MOST_RATIO`]
/// times: found by doubling along the equator, from where the formula is negative.
fn reach(outline: &impl AnyOutline) -> Result<f64, String> {
    let mut low = 1e-12;
    if value(outline, 0.0, low)? >= 0.0 {
        return Err("F is not negative at the centre".into());
    }
    while value(outline, 0.0, 2.0 * low)? < 0.0 {
        low *= 2.0;
        if low > 1e12 {
            return Err("F is never positive along the equator".into());
        }
    }
    Ok(2.0 * low * MOST_RATIO)
}

/// The distance of the surface from the centre, in the unit of the formula.
fn radius(outline: &(impl AnyOutline + ?Sized), mu: f64, reach: f64) -> Result<f64, String> {
    let place = |step: usize| reach * (step as f64 / STEPS as f64).powi(2);
    let mut inside = None;
    for step in 1..=STEPS {
        let negative = value(outline, mu, place(step))? < 0.0;
        match (negative, inside) {
            (true, None) => {}
            (false, None) => inside = Some(step - 1),
            (true, Some(_)) => {
                return Err(format!("F changes its sign more than once at ζ/r = {mu}"));
            }
            (false, Some(_)) => {}
        }
    }
    let step = inside.ok_or_else(|| format!("F is negative out to {reach} at ζ/r = {mu}"))?;
    let (mut low, mut high) = (place(step), place(step + 1));
    // bisection to rounding
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if value(outline, mu, middle)? < 0.0 { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    #[derive(Debug)]
    struct Ellipse(f64, f64);

    impl Outline for Ellipse {
        fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
            let height = depth * depth;
            (q - height) / (self.0 * self.0) + height / (self.1 * self.1) - 1.0
        }
    }

    /// The same surface, normal and curvature as the library's spheroid, whatever the unit.
    #[test]
    fn an_ellipse_is_the_spheroid() {
        for unit in [1.0, 1e-4, 37.0] {
            let own = OwnBody::new("ellipse", Ellipse(1.5 * unit, 1.2 * unit)).unwrap();
            let (own, same) = (Shape::own(own, 0.3), Shape::spheroid(0.8, 0.3).unwrap());
            let i = Complex64::new(0.0, 0.05);
            for (q, z) in [(1.1 + i, 0.2 - i), (0.9 - i, 0.7 + i)] {
                let (a, b) = (own.level(q, z), same.level(q, z));
                // the steepness differs by one factor
                let factor = a.q / b.q;
                for (a, b) in [(a.z, b.z), (a.zz, b.zz)] {
                    assert!((a - b * factor).norm() < 1e-12, "{a} {b} {factor}");
                }
                assert!(a.qq.norm() < 1e-12 && a.qz.norm() < 1e-12 && factor.im.abs() < 1e-14);
            }
            let (a, b) = (own.entry(0.3, 0.4).unwrap(), same.entry(0.3, 0.4).unwrap());
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        assert!(OwnBody::new("ball", Ellipse(2.0, 2.0)).unwrap().is_sphere());
        assert!(!OwnBody::new("egg", Ellipse(2.0, 2.0001)).unwrap().is_sphere());
    }

    /// A body with flat poles, whose volume has a closed form by gamma functions.
    #[test]
    fn volume_of_a_superellipsoid() {
        #[derive(Debug)]
        struct Squircle(f64);
        impl Outline for Squircle {
            fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
                let height = depth * depth;
                (q - height).power(0.5 * self.0) + height.power(0.5 * self.0) - 1.0
            }
        }
        for (exponent, within) in [(2.0, 1e-12), (4.0, 1e-9), (2.5, 1e-6)] {
            let body = OwnBody::new("squircle", Squircle(exponent)).unwrap();
            let gamma = |k: f64| libm::tgamma(1.0 + k / exponent);
            // over that of the unit sphere
            let volume = 1.5 * gamma(1.0) * gamma(2.0) / gamma(3.0);
            assert!((body.0.unit.powi(3) / volume - 1.0).abs() < within, "{exponent}");
            let pole = Shape::own(body, 0.0).radius_towards(-1.0, 0.0, 0.0);
            assert!((pole * volume.cbrt() - 1.0).abs() < within, "{exponent}");
        }
    }

    /// What is no body is refused, with its name and what would do.
    #[test]
    fn formulas_that_bound_no_body_are_refused() {
        #[derive(Debug)]
        struct Inverted;
        impl Outline for Inverted {
            fn level<T: Scalar>(&self, q: Jet<T>, _: Jet<T>) -> Jet<T> {
                -q + 1.0
            }
        }
        #[derive(Debug)]
        struct Shell;
        impl Outline for Shell {
            fn level<T: Scalar>(&self, q: Jet<T>, _: Jet<T>) -> Jet<T> {
                (q - 1.0) * (q - 2.0) * (q - 3.0)
            }
        }
        let open = OwnBody::new("open", Ellipse(1.0, 1e9)).unwrap_err().to_string();
        assert!(open.contains("\"open\"") && open.contains("accepted"), "{open}");
        let inverted = OwnBody::new("inverted", Inverted).unwrap_err().to_string();
        assert!(inverted.contains("not negative at the centre"), "{inverted}");
        let shell = OwnBody::new("shell", Shell).unwrap_err().to_string();
        assert!(shell.contains("more than once"), "{shell}");
        let needle = OwnBody::new("needle", Ellipse(1.0, 10.5)).unwrap_err().to_string();
        assert!(needle.contains("its radii are"), "{needle}");
    }
}
