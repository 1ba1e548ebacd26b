//! A fold caustic on a plane: where two rays of one order become one.
//!
//! With the angle `δ` from the caustic (positive on the lit side) and `q = √δ`, the two rays are one
//! analytic function of `q`, taken at `+q` and `-q`; on the dark side `q` is imaginary and the rays
//! are complex. So the sums and differences that the uniform Airy formula needs (Chester, Friedman &
//! Ursell 1957; Berry 1966) are analytic in `δ` through the caustic:
//! - mean path `(W₊ + W₋)/2` and `ζ̂` with `ζ̂^{3/2} = ¾ (W₊ - W₋)`,
//! - `g₀ = (A₊ + A₋) ζ̂^{1/4}` and `g₁ = (A₊ - A₋) ζ̂^{-1/4}`, `A = T / √|spread|`.
//!
//! `+` is the ray with the larger path; it has passed one focal line more.

use super::pair_values::{PAIR_CHANNELS, PairValues};
use super::root_path::RootPath;
use super::scattering_plane::{Node, ScannedRay, ScatteringPlane};
use crate::math::chebyshev::{self, Chebyshev};
use crate::math::scalar::Scalar;
use crate::shape::Silhouette;
use crate::trace::Exit;
use num_complex::Complex64;

/// A fold on a plane.
#[derive(Clone, Debug)]
pub struct Fold {
    /// Launch coordinate of the ray that touches the caustic.
    pub alpha: f64,
    /// Unwrapped angle of the caustic.
    pub angle: f64,
    /// +1 when larger angles are lit, -1 when smaller ones are.
    pub lit: f64,
    /// Sum of the two rays' focal lines (odd).
    pub focal_lines: u32,
    /// +1 when the ray of larger path starts at larger α.
    pub larger: f64,
    place: [f64; 2],
    /// Change of launch point per √δ of the ray of larger path.
    tangent: [f64; 2],
}

/// Growth of `|g|²` over its largest lit value that tells of a singularity nearby.
const RUNAWAY: f64 = 30.0;

/// The two rays of a fold at one δ.
#[derive(Clone, Copy, Debug)]
struct Pair {
    larger: [f64; 2],
    smaller: [f64; 2],
}

impl Fold {
    /// Refine a fold between two neighbouring rays whose spreads have opposite signs.
    pub fn between(
        plane: &ScatteringPlane,
        silhouette: &Silhouette,
        before: &ScannedRay,
        after: &ScannedRay,
    ) -> Option<Self> {
        let (mut low, mut high) = ([before.alpha, before.psi], [after.alpha, after.psi]);
        let (mut a, mut b) = (before.spread, after.spread);
        let mut middle = None;
        let mut moved_last = 0.0;
        for _ in 0..60 {
            // Regula falsi towards the root of the spread; the end that stays counts for half (Illinois).
            let share = (a / (a - b)).clamp(0.01, 0.99);
            let [alpha, psi] = [0, 1].map(|k| low[k] + share * (high[k] - low[k]));
            let node = plane.node(silhouette, alpha, psi, before.angle)?;
            let spread = node.exit.spread();
            middle = Some(node);
            let moved = (spread * a).signum();
            if moved > 0.0 {
                (low, a) = ([alpha, node.psi], spread);
                b *= if moved_last == moved { 0.5 } else { 1.0 };
            } else {
                (high, b) = ([alpha, node.psi], spread);
                a *= if moved_last == moved { 0.5 } else { 1.0 };
            }
            moved_last = moved;
            if (high[0] - low[0]).abs() < 1e-11 || spread.abs() < 1e-12 {
                break;
            }
        }
        Self::at(plane, &middle?, before, after)
    }

    /// Local geometry: how the angle bends along the plane at the fold.
    fn at(
        plane: &ScatteringPlane,
        fold: &Node,
        before: &ScannedRay,
        after: &ScannedRay,
    ) -> Option<Self> {
        let lit = (0.5 * (before.angle + after.angle) - fold.angle).signum();
        // The kernel of the map of directions: ds(kernel) = 0.
        let (_, growing) = plane.frame(fold.angle);
        let across = plane.across();
        let row = |axis: crate::math::vec3::Vec3<f64>| {
            [fold.exit.ds[0].dot(axis), fold.exit.ds[1].dot(axis)]
        };
        let (g, a) = (row(growing), row(across));
        let larger_row = if g[0].hypot(g[1]) > a[0].hypot(a[1]) { g } else { a };
        let norm = larger_row[0].hypot(larger_row[1]);
        let mut kernel = [-larger_row[1] / norm, larger_row[0] / norm];
        let outward = [after.place[0] - before.place[0], after.place[1] - before.place[1]];
        if kernel[0] * outward[0] + kernel[1] * outward[1] < 0.0 {
            kernel = [-kernel[0], -kernel[1]];
        }
        // Angle along the kernel's line, to second order, from two probes.
        let h = 1e-3;
        let probe = |t: f64| {
            let place = [fold.place[0] + t * kernel[0], fold.place[1] + t * kernel[1]];
            plane.exit(place).map(|e| e.direction.dot(growing))
        };
        let bend = (probe(h)? + probe(-h)?) / (h * h);
        let step = (2.0 / bend.abs()).sqrt();
        let mut fold = Self {
            alpha: fold.alpha,
            angle: fold.angle,
            lit,
            focal_lines: 0,
            larger: 1.0,
            place: fold.place,
            tangent: [kernel[0] * step, kernel[1] * step],
        };
        // Which of the two has the larger path, and their focal lines, from a pair nearby.
        let delta = 1e-3;
        let pair = fold.pair_near(plane, delta, delta.sqrt())?;
        let (one, two) = (plane.exit(pair.larger)?, plane.exit(pair.smaller)?);
        fold.focal_lines = one.focal_lines + two.focal_lines;
        if one.path < two.path {
            fold.larger = -1.0;
            fold.tangent = [-fold.tangent[0], -fold.tangent[1]];
        }
        (fold.focal_lines % 2 == 1).then_some(fold)
    }

    /// The pair at a small δ > 0 from the local expansion.
    fn pair_near(&self, plane: &ScatteringPlane, delta: f64, q: f64) -> Option<Pair> {
        let angle = self.angle + self.lit * delta;
        let start = |sign: f64| {
            [self.place[0] + sign * q * self.tangent[0], self.place[1] + sign * q * self.tangent[1]]
        };
        let (larger, _) = plane.aim(angle, start(1.0))?;
        let (smaller, _) = plane.aim(angle, start(-1.0))?;
        let apart = (larger[0] - smaller[0]).hypot(larger[1] - smaller[1]);
        (apart > 0.2 * q * self.tangent[0].hypot(self.tangent[1]))
            .then_some(Pair { larger, smaller })
    }

    /// `ζ̂/δ` near the caustic: how fast the phase difference of the two rays grows.
    pub fn strength(&self, plane: &ScatteringPlane) -> Option<f64> {
        let delta = 1e-3;
        let pair = self.pair_near(plane, delta, delta.sqrt())?;
        let difference = plane.exit(pair.larger)?.path - plane.exit(pair.smaller)?.path;
        Some((0.75 * difference).abs().powf(2.0 / 3.0) / delta)
    }

    /// Sample the pair's analytic functions on `[-dark, reach]` (radians from the caustic).
    /// `None` where a ray cannot be found.
    pub fn sample(
        &self,
        plane: &ScatteringPlane,
        dark: f64,
        reach: f64,
        count: usize,
    ) -> Option<Chebyshev<PAIR_CHANNELS>> {
        let deltas = chebyshev::points(count, -dark, reach);
        let first_lit = deltas.partition_point(|&d| d <= 0.0);
        let mut path = RootPath::new(self.place, self.tangent);
        let lit = deltas[first_lit..]
            .iter()
            .map(|&delta| self.lit_values(plane, &mut path, delta, delta.sqrt()))
            .collect::<Option<Vec<PairValues>>>()?;
        let largest = lit.iter().map(PairValues::size).fold(0.0, f64::max);
        let mut behind: Vec<PairValues> = Vec::new();
        for &delta in deltas[..first_lit].iter().rev() {
            let next = self.dark_values(plane, &mut path, delta)?;
            // Far behind a caustic near the rim the curved interface has poles: not that far.
            if !next.size().is_finite() || next.size() > RUNAWAY * largest {
                return None;
            }
            // Square roots of complex transfers may change sheet on the way: continuity decides.
            let known = behind.last().or(lit.first());
            let same_sheet = known.is_none_or(|known| known.agrees_with(&next));
            behind.push(if same_sheet { next } else { next.negated() });
        }
        let all = behind.into_iter().rev().chain(lit);
        let values: Vec<[f64; PAIR_CHANNELS]> = all.map(Into::into).collect();
        Some(Chebyshev::fit(&values, -dark, reach))
    }

    fn lit_values(
        &self,
        plane: &ScatteringPlane,
        path: &mut RootPath,
        delta: f64,
        q: f64,
    ) -> Option<PairValues> {
        let angle = self.angle + self.lit * delta;
        let (p1, e1) = plane.aim(angle, path.guess(q))?;
        path.add(q, p1);
        let (p2, e2) = plane.aim(angle, path.guess(-q))?;
        path.add(-q, p2);
        let difference = e1.path - e2.path;
        if difference.is_nan() || difference <= 0.0 {
            return None;
        }
        let z = (0.75 * difference / (q * q * q)).powf(2.0 / 3.0);
        let q = Complex64::new(q, 0.0);
        Some(self.values(plane, angle, &e1, &e2, q, z, 0.5 * (e1.path + e2.path)))
    }

    fn dark_values(
        &self,
        plane: &ScatteringPlane,
        path: &mut RootPath,
        delta: f64,
    ) -> Option<PairValues> {
        let angle = self.angle + self.lit * delta;
        let q = Complex64::new(0.0, (-delta).sqrt());
        let (p1, e1) = plane.aim(angle, path.guess_complex(q))?;
        path.add_imaginary(q.im, p1);
        let e2: Exit<Complex64> = plane.exit([p1[0].conj(), p1[1].conj()])?;
        // (W₊ - W₋)/q³ is real and positive
        let ratio = (e1.path - e2.path) / (q * q * q);
        if ratio.is_nan() || ratio.re <= 0.0 || ratio.im.abs() > 1e-6 * ratio.re {
            return None;
        }
        let z = (0.75 * ratio.re).powf(2.0 / 3.0);
        let mean = 0.5 * (e1.path + e2.path).re;
        Some(self.values(plane, angle, &e1, &e2, q, z, mean))
    }

    /// Mean path, ζ̂, g₀ and g₁ of two rays at `±q`; `z = ζ̂/δ`.
    #[allow(clippy::too_many_arguments)] // one formula, one place
    fn values<T: Scalar>(
        &self,
        plane: &ScatteringPlane,
        angle: f64,
        e1: &Exit<T>,
        e2: &Exit<T>,
        q: Complex64,
        z: f64,
        mean: f64,
    ) -> PairValues {
        // spread/q is analytic and of one sign at ±q; its root is the principal one
        let sign = (e1.spread().complex() / q).re.signum();
        let weight = |e: &Exit<T>, q: Complex64| 1.0 / (e.spread().complex() / q * sign).sqrt();
        let t1 = plane.transfer(e1, angle) * weight(e1, q);
        let t2 = plane.transfer(e2, angle) * weight(e2, -q);
        let quarter = z.powf(0.25);
        let pairs = [(t1.s1, t2.s1), (t1.s2, t2.s2), (t1.s3, t2.s3), (t1.s4, t2.s4)];
        PairValues {
            path: mean,
            zeta: z * (q * q).re,
            sums: pairs.map(|(a, b)| (a + b) * quarter),
            differences: pairs.map(|(a, b)| (a - b) / q / quarter),
        }
    }
}

#[cfg(test)]
mod tests;
