//! The sum on a complex wavefront: one integral for a whole order, whatever its rays do.
//!
//! Where more than two rays coalesce no formula for single rays or pairs holds, but the wave is still
//! Kirchhoff's integral over one of the order's wavefronts (Born & Wolf 1999, §8.3). Every real wavefront
//! meets focal lines somewhere. One continued to a *complex* distance `τ = τ_r + iβ` along its rays meets
//! none, since rays have real focal lines only:
//! `S(n) = -ix (x/2πi) ∬ du dv T F exp ix[W - n·r + τ(1 - n·s)]`,
//! `F = e^{-iπm/2} √c₂ √(τ - t₁) √(τ - t₂)`, principal roots, with `s` the direction of a ray, `r` where it
//! crosses the plane through the centre normal to it, `W` its path, `t₁`, `t₂` the places of its focal
//! lines, `c₂ = |s·(∂ᵤs × ∂ᵥs)|` and `m` all focal lines to infinity (Deschamps 1971, complex source
//! points; Heller 1991, frozen Gaussians). The points of stationary phase are the rays along `n`, with
//! amplitude and phase of geometrical optics, and the factor `exp -xβ(1 - n·s)` comes by itself: only rays
//! within a few `1/√(xβ)` of a direction count, some hundred whatever `x`.
//!
//! All that the integrand needs is smooth in the launch point and interpolated from a coarse grid of traced
//! rays; where it is not, beside total reflection, rays are traced one by one. The points
//! of the sum form a lattice whose steps follow from the width of the integrand.
//!
//! What is not in it: waves beside the last ray of an order, at the rim or at total reflection, where the
//! integrand goes on beyond real rays. There it errs by some percent (sphere, order 2 beyond 150°), for bows
//! made next to the rim (orders from 4 on) by more.
//!
//! ```
//! use gonio::farfield::ComplexWavefront;
//! use gonio::shape::{RaindropModel, Shape};
//! use gonio::trace::Tracer;
//!
//! let (radius, sun, x) = (2e-3, 0.35, 19_333.0);
//! let drop = Shape::raindrop(radius, RaindropModel::BeardChuang1987, sun)?;
//! let tracer = Tracer::new(&drop, 1.3314.into(), x, 2).with_curved_interface(x);
//! let primary = ComplexWavefront::new(&tracer, 2, x);
//! let column = primary.columns(&[2.40, 2.41], &[1.0]).swap_remove(0);
//! assert!(column.iter().all(|s| s.s11() > 0.0));
//! # Ok::<(), gonio::shape::ShapeError>(())
//! ```

mod channels;
mod coarse;
mod edge_cells;
mod kernel;
mod lattice;
mod sum;

pub use channels::{PLACE, Place};
pub use sum::ComplexWavefront;
