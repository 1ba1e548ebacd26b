//! Amplitudes of a body: what the fields on its surface radiate.
//!
//! A closed surface with the electric and magnetic field along it radiates (Stratton & Chu 1939; Schelkunoff)
//! `E = ik/4π · exp(ikr)/r · r̂ × ∫ [n × E − r̂ × (n × H)] exp(−ik r̂·r) dS`. The fields are those of all beams
//! where they start and end: plane waves on polygons, of which each leaves one Fourier transform. They are
//! the whole fields, light that falls on the body included; that one alone radiates nothing from a closed
//! surface, so what is left is the scattered field: reflection, what is sent through, and the shadow's
//! diffraction in one sum, none of it counted twice. Under total reflection the fields on a facet are not
//! nothing either; with them the power over all directions is what the optical theorem says (within 1 % from size parameter
//! 10 on), without them several per cent are missing.
//!
//! ```
//! use gonio::facets::{Body, FarField, beams::{Incidence, Settings, split}};
//! use num_complex::Complex64;
//! use std::f64::consts::PI;
//!
//! // the optical theorem: a cube face on takes out what a slab of its thickness does
//! let cube = Body::cuboid(1.0).unwrap();
//! let light = Incidence { index: 1.31.into(), size_parameter: 106.0 };
//! let beams = split(&cube, &light, &Settings::default());
//! let far_field = FarField::new(&beams, &light);
//! let ahead = far_field.amplitudes(&[(0.0, 0.0)])[0];
//! let extinction = 4.0 * PI / light.size_parameter.powi(2) * ahead.s1.re;
//!
//! let edge = light.size_parameter * (4.0 * PI / 3.0).cbrt();
//! let reflected = (0.31f64 / 2.31).powi(2);
//! let sent_through = (1.0 - reflected) * Complex64::cis(0.31 * edge) / (1.0 - reflected * Complex64::cis(2.62 * edge));
//! let slab = 2.0 * (1.0 - sent_through.re);
//! assert!((extinction / beams.shadow - slab).abs() < 0.01 * slab);
//! ```

use super::beams::{Beams, Incidence, Patch};
use super::polygon::{Polygon, SHORT, SMALL, tangent_series};
use crate::math::phase::sin_cos_turns_with;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use glam::DVec3;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Loss of amplitude along a radius below which sums do without (cross-sections never do): a beam of ten radii is
/// 1e-4 off.
const NEGLIGIBLE_LOSS: f64 = 1e-5;
/// Directions side by side.
const LANES: usize = 8;
type Lanes = [f64; LANES];

/// A patch as the sum over directions wants it: lengths in wavelengths, so that phases are turns.
#[derive(Clone, Debug)]
struct Source {
    /// Turns at the centre, and the centre.
    phase: f64,
    centre: DVec3,
    axes: [DVec3; 2],
    slope: [f64; 2],
    /// Loss along the two axes, per radian of phase: imaginary part of `q` over the wavenumber.
    loss: [f64; 2],
    /// Largest distance of a corner, and corners, each with what is left there.
    radius: f64,
    corners: Vec<[f64; 3]>,
    electric: [Field; 2],
    magnetic: [Field; 2],
    /// The polygon itself, for directions near the beam's own.
    polygon: Polygon,
    /// What is left at the centre.
    left: f64,
}

/// The far field of one body in one orientation.
#[derive(Clone, Debug)]
pub struct FarField {
    wavenumber: f64,
    index: Complex64,
    sources: Vec<Source>,
}

/// Sums of both polarisations, of the electric and the magnetic field: x, y, z of real and imaginary parts.
type Sums = [[[[Lanes; 2]; 3]; 2]; 2];
const NOTHING: Sums = [[[[[0.0; LANES]; 2]; 3]; 2]; 2];

impl FarField {
    /// Of beams that were split.
    pub fn new(beams: &Beams, light: &Incidence) -> Self {
        let wavenumber = light.size_parameter;
        let sources = beams.patches.iter().map(|p| Source::new(p, light)).collect();
        Self { wavenumber, index: light.index, sources }
    }

    /// Polygons on the surface.
    pub fn polygons(&self) -> usize {
        self.sources.len()
    }

    /// Amplitude matrices in directions (θ, φ), absolute phase relative to a wave through the centre.
    pub fn amplitudes(&self, directions: &[(f64, f64)]) -> Vec<AmplitudeMatrix> {
        let mut all = Vec::with_capacity(directions.len());
        for block in directions.chunks(LANES) {
            // lanes beyond the last direction repeat it
            let at = |k: usize| block[k.min(block.len() - 1)];
            let frames: [Frame; LANES] = std::array::from_fn(|k| Frame::new(at(k)));
            let ways: [Lanes; 3] =
                std::array::from_fn(|c| std::array::from_fn(|k| frames[k].way.to_array()[c]));
            let sums = if self.index.im * self.wavenumber > NEGLIGIBLE_LOSS {
                add_absorbing(self, &ways)
            } else {
                add_clear(self, &ways)
            };
            all.extend((0..block.len()).map(|k| self.matrix(&frames[k], &sums, k)));
        }
        all
    }

    /// From sums of fields to the matrix.
    fn matrix(&self, frame: &Frame, sums: &Sums, lane: usize) -> AmplitudeMatrix {
        let factor = self.wavenumber.powi(2) / (4.0 * PI);
        let field = |polarisation: usize, kind: usize| -> Field {
            let part = |c: usize| {
                let [re, im] = sums[polarisation][kind][c].map(|part| part[lane]);
                Complex64::new(re, im) * factor
            };
            Vec3 { x: part(0), y: part(1), z: part(2) }
        };
        // r̂ × a + b, of which the part along r̂ is not seen
        let along = |e: DVec3, field: Field| Vec3::<f64>::from(e).project(field);
        let seen = |polarisation: usize| {
            let (electric, magnetic) = (field(polarisation, 0), field(polarisation, 1));
            [frame.parallel, frame.perpendicular]
                .map(|e| along(e, magnetic) + along(e.cross(frame.way), electric))
        };
        let ([x_par, x_per], [y_par, y_per]) = (seen(0), seen(1));
        let (sin, cos) = (frame.sin_phi, frame.cos_phi);
        AmplitudeMatrix {
            s2: x_par * cos + y_par * sin,
            s3: x_par * sin - y_par * cos,
            s4: x_per * cos + y_per * sin,
            s1: x_per * sin - y_per * cos,
        }
    }
}

/// A direction with its unit vectors (see [`crate::optics`]).
struct Frame {
    way: DVec3,
    parallel: DVec3,
    perpendicular: DVec3,
    sin_phi: f64,
    cos_phi: f64,
}

impl Frame {
    fn new((theta, phi): (f64, f64)) -> Self {
        let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
        Self {
            way: DVec3::new(sin * cos_phi, sin * sin_phi, cos),
            parallel: DVec3::new(cos * cos_phi, cos * sin_phi, -sin),
            perpendicular: DVec3::new(sin_phi, -cos_phi, 0.0),
            sin_phi,
            cos_phi,
        }
    }
}

impl Source {
    fn new(patch: &Patch, light: &Incidence) -> Self {
        let (k, absorption) = (light.size_parameter, light.index.im);
        let waves = k / TAU;
        let loss = patch.lengthening.map(|slope| absorption * slope);
        let left = (-k * absorption * patch.length).exp();
        let corner = |c: &[f64; 2]| {
            let lost = k * (loss[0] * c[0] + loss[1] * c[1]);
            [waves * c[0], waves * c[1], (-lost).exp()]
        };
        Self {
            phase: waves * patch.path,
            centre: waves * patch.centre,
            axes: patch.axes,
            slope: patch.slope,
            loss,
            radius: waves * patch.polygon.radius(),
            corners: patch.polygon.corners().iter().map(corner).collect(),
            electric: patch.electric,
            magnetic: patch.magnetic,
            polygon: patch.polygon.clone(),
            left,
        }
    }

    /// The transform at `q = k × slope`, slopes being relative to the vacuum's wavenumber.
    fn transform(&self, wavenumber: f64, [x, y]: [f64; 2]) -> Complex64 {
        let q = [(x, self.loss[0]), (y, self.loss[1])];
        self.polygon.transform(q.map(|(re, im)| wavenumber * Complex64::new(re, im)))
    }

    /// Transforms in a block of directions, with the phase and loss at the centre.
    ///
    /// `ABSORBING` keeps what vanishes without loss.
    #[inline(always)]
    fn transforms<const FMA: bool, const ABSORBING: bool>(
        &self,
        wavenumber: f64,
        ways: &[Lanes; 3],
    ) -> [Lanes; 2] {
        let (mut x, mut y, mut square) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (a, b) = (self.axes[0], self.axes[1]);
        let loss = if ABSORBING { self.loss } else { [0.0; 2] };
        for k in 0..LANES {
            let [rx, ry, rz] = [ways[0][k], ways[1][k], ways[2][k]];
            x[k] = self.slope[0] - (rx * a.x + ry * a.y + rz * a.z);
            y[k] = self.slope[1] - (rx * b.x + ry * b.y + rz * b.z);
            square[k] = x[k] * x[k] + y[k] * y[k];
            if ABSORBING {
                square[k] += loss[0] * loss[0] + loss[1] * loss[1];
            }
        }
        // turns at the centre are added to those of every corner: the sum is linear in them
        let mut turns = [0.0; LANES];
        let c = self.centre;
        for k in 0..LANES {
            turns[k] = self.phase - (ways[0][k] * c.x + ways[1][k] * c.y + ways[2][k] * c.z);
        }
        let count = self.corners.len();
        let first = corner_wave::<FMA, ABSORBING>(&x, &y, &turns, &self.corners[0]);
        let mut u = first;
        let (mut sum_re, mut sum_im) = ([0.0; LANES], [0.0; LANES]);
        for corner in 0..count {
            let from = &self.corners[corner];
            let (to, v) = if corner + 1 < count {
                let to = &self.corners[corner + 1];
                (to, corner_wave::<FMA, ABSORBING>(&x, &y, &turns, to))
            } else {
                (&self.corners[0], first)
            };
            let e = [to[0] - from[0], to[1] - from[1]];
            // half a phase along the edge, radians
            let h_im = if ABSORBING { PI * (loss[0] * e[0] + loss[1] * e[1]) } else { 0.0 };
            let cross_im = if ABSORBING { loss[1] * e[0] - loss[0] * e[1] } else { 0.0 };
            let (mut h_re, mut h2, mut least) = ([0.0; LANES], [0.0; LANES], f64::INFINITY);
            for k in 0..LANES {
                h_re[k] = PI * (x[k] * e[0] + y[k] * e[1]);
                h2[k] = if ABSORBING { h_re[k] * h_re[k] + h_im * h_im } else { h_re[k] * h_re[k] };
            }
            for square in h2 {
                least = if square < least { square } else { least };
            }
            let (mut mean_re, mut mean_im) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                // −i (v − u) / 2h, by the conjugate of h over |h|²
                let (d_re, d_im) = (v[0][k] - u[0][k], v[1][k] - u[1][k]);
                if ABSORBING {
                    let half = 0.5 / h2[k];
                    let (n_re, n_im) = (d_im * half, -d_re * half);
                    mean_re[k] = n_re * h_re[k] + n_im * h_im;
                    mean_im[k] = n_im * h_re[k] - n_re * h_im;
                } else {
                    let half = 0.5 / h_re[k];
                    (mean_re[k], mean_im[k]) = (d_im * half, -d_re * half);
                }
            }
            if least < SHORT * SHORT {
                for k in 0..LANES {
                    if h2[k] < SHORT * SHORT {
                        let h = Complex64::new(h_re[k], h_im);
                        let middle = Complex64::new(u[0][k] + v[0][k], u[1][k] + v[1][k]) * 0.5;
                        let mean = middle * tangent_series(h * h);
                        (mean_re[k], mean_im[k]) = (mean.re, mean.im);
                    }
                }
            }
            for k in 0..LANES {
                let cross = x[k] * e[1] - y[k] * e[0];
                if ABSORBING {
                    sum_re[k] += cross * mean_re[k] - cross_im * mean_im[k];
                    sum_im[k] += cross * mean_im[k] + cross_im * mean_re[k];
                } else {
                    sum_re[k] += cross * mean_re[k];
                    sum_im[k] += cross * mean_im[k];
                }
            }
            u = v;
        }
        // lengths were in wavelengths, q over the wavenumber
        let scale = TAU / (wavenumber * wavenumber);
        let small = (SMALL / (TAU * self.radius)).powi(2);
        let left = if ABSORBING { self.left } else { 1.0 };
        let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
        let mut near = false;
        for k in 0..LANES {
            let over = left * scale / square[k].max(1e-300);
            (re[k], im[k]) = (sum_im[k] * over, -sum_re[k] * over);
            near |= square[k] < small;
        }
        if near {
            for k in 0..LANES {
                if square[k] < small {
                    let wave = Complex64::cis(TAU * turns[k].fract()) * left;
                    let exact = self.transform(wavenumber, [x[k], y[k]]) * wave;
                    (re[k], im[k]) = (exact.re, exact.im);
                }
            }
        }
        [re, im]
    }
}

/// `exp(i q·v)` of a corner. (A function, since closures are not always compiled into the instruction set of
/// those who call them.)
#[inline(always)]
fn corner_wave<const FMA: bool, const ABSORBING: bool>(
    x: &Lanes,
    y: &Lanes,
    turns: &Lanes,
    c: &[f64; 3],
) -> [Lanes; 2] {
    let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
    for k in 0..LANES {
        let (sin, cos) = sin_cos_turns_with::<FMA>(turns[k] + (x[k] * c[0] + y[k] * c[1]));
        (re[k], im[k]) = if ABSORBING { (c[2] * cos, c[2] * sin) } else { (cos, sin) };
    }
    [re, im]
}

#[inline(always)]
fn add<const FMA: bool, const ABSORBING: bool>(far: &FarField, ways: &[Lanes; 3]) -> Sums {
    let mut sums = NOTHING;
    for source in &far.sources {
        let [f_re, f_im] = source.transforms::<FMA, ABSORBING>(far.wavenumber, ways);
        for (polarisation, sums) in sums.iter_mut().enumerate() {
            let fields = [source.electric[polarisation], source.magnetic[polarisation]];
            for (sum, field) in sums.iter_mut().zip(fields) {
                for (part, e) in sum.iter_mut().zip([field.x, field.y, field.z]) {
                    for k in 0..LANES {
                        part[0][k] += f_re[k] * e.re - f_im[k] * e.im;
                        part[1][k] += f_re[k] * e.im + f_im[k] * e.re;
                    }
                }
            }
        }
    }
    sums
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn add_clear(far: &FarField, ways: &[Lanes; 3]) -> Sums {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        add::<true, false>(far, ways)
    } else {
        add::<false, false>(far, ways)
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn add_absorbing(far: &FarField, ways: &[Lanes; 3]) -> Sums {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        add::<true, true>(far, ways)
    } else {
        add::<false, true>(far, ways)
    }
}

#[cfg(test)]
mod tests;
