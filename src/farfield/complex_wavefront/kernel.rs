//! One ray's wave added to a column of scattering angles.
//!
//! With `1 - n·s` for `|n - s|²/2` the exponent is linear in the direction `n`, and along a column linear in
//! `cos θ` and `sin θ`: `ix[W + τ - sin θ c_ρ - cos θ c_z]`, `c = r + τs`. Eight angles are handled side by
//! side, plain arithmetic compiled for several instruction sets.

use super::channels::{Channels, DIRECTION, FIELDS, PATH, Place, REFERENCE};
use crate::math::fused::multiply_add;
use crate::math::phase::sin_cos_turns_with;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;
use std::f64::consts::{LN_2, LOG2_E, PI, TAU};

/// A ray of the sum, ready for columns.
pub(super) struct Ray {
    direction: Vec3<f64>,
    /// `r + τ_r s` and `W + τ_r`, in wavelengths.
    lever: Vec3<f64>,
    path: f64,
    /// `x β log₂ e`.
    narrowness: f64,
    fields: [Field; 2],
}

impl Ray {
    pub(super) fn new(channels: &Channels, weight: f64, place: Place, x: f64) -> Self {
        let vector = |at: usize| Vec3 { x: channels[at], y: channels[at + 1], z: channels[at + 2] };
        let complex = |k: usize| Complex64::new(channels[k], channels[k + 1]) * weight;
        let field = |k: usize| Vec3 { x: complex(k), y: complex(k + 2), z: complex(k + 4) };
        let s = vector(DIRECTION);
        let direction = s * (1.0 / s.dot(s).sqrt());
        let per_turn = x / TAU;
        Self {
            direction,
            lever: (vector(REFERENCE) + direction * place.real) * per_turn,
            path: (channels[PATH] + place.real) * per_turn,
            narrowness: x * place.imaginary * LOG2_E,
            fields: [field(FIELDS), field(FIELDS + 6)],
        }
    }
}

/// Angles handled side by side.
const LANES: usize = 8;
/// Waves collected before they are added.
const BATCH: usize = 64;
/// Buckets of the search for angles.
const BUCKETS: usize = 2048;

/// The wave of a ray on a column: what is linear in the sine and the cosine of the angle.
#[derive(Clone, Copy, Debug, Default)]
struct Wave {
    /// Phase in turns: constant, by sine, by cosine.
    turns: [f64; 3],
    /// Binary logarithm of the size, likewise.
    size: [f64; 3],
    /// Real and imaginary parts: along ρ and z for light parallel and perpendicular, then along φ.
    along: [[f64; 2]; 4],
    across: [[f64; 2]; 2],
    from: usize,
    to: usize,
}

/// Sums over rays in a column of directions of one azimuth.
pub(super) struct Column {
    azimuth: (f64, f64),
    sin: Vec<f64>,
    cos: Vec<f64>,
    theta: Vec<f64>,
    buckets: Vec<u32>,
    rows: [Vec<f64>; 8],
    waves: Vec<Wave>,
    size_parameter: f64,
}

impl Column {
    /// Scattering angles ascending.
    pub(super) fn new(theta: &[f64], phi: f64, size_parameter: f64) -> Self {
        let last = theta.last().copied().unwrap_or(0.0);
        let padded = theta.iter().copied().chain(std::iter::repeat_n(last, LANES));
        let (sin, cos) = padded.map(f64::sin_cos).unzip();
        let edge = |k: usize| theta.partition_point(|&t| t < PI * k as f64 / BUCKETS as f64) as u32;
        Self {
            azimuth: phi.sin_cos(),
            sin,
            cos,
            theta: theta.to_vec(),
            buckets: (0..=BUCKETS).map(edge).collect(),
            rows: std::array::from_fn(|_| vec![0.0; theta.len() + LANES]),
            waves: Vec::with_capacity(BATCH),
            size_parameter,
        }
    }

    /// Whether directions within `reach` of a centre may meet the column between two angles.
    pub(super) fn is_near(&self, centre: Vec3<f64>, reach: f64, [first, last]: [f64; 2]) -> bool {
        let (along, aside) = self.split(centre);
        let theta = along.atan2(centre.z);
        let off = aside.abs().min(1.0).asin();
        // the far half of the plane has negative angles
        off < reach
            && ((theta > first - reach && theta < last + reach)
                || (theta < 0.0 && (-theta < reach || PI + theta < reach)))
    }

    /// Components along and across the column's half-plane.
    fn split(&self, v: Vec3<f64>) -> (f64, f64) {
        let (sin, cos) = self.azimuth;
        (v.x * cos + v.y * sin, v.y * cos - v.x * sin)
    }

    /// Add a ray's wave within the window about it (the chord at which it has died away).
    pub(super) fn add(&mut self, ray: &Ray, window: f64) {
        let s = ray.direction;
        let (along, _) = self.split(s);
        // n·s = R cos(θ - θ₀), above the limit
        let limit = 1.0 - 0.5 * window * window;
        let radius = (along * along + s.z * s.z).sqrt();
        if radius <= limit {
            return;
        }
        let (middle, half) = (along.atan2(s.z), (limit / radius).acos());
        if middle + half < 0.0 || middle - half > PI {
            // angles below -π lie above π
            return self.add_turned(ray, middle + TAU, half);
        }
        if middle - half < -PI {
            self.add_turned(ray, middle + TAU, half);
        }
        self.add_turned(ray, middle, half);
    }

    fn add_turned(&mut self, ray: &Ray, middle: f64, half: f64) {
        let (from, to) = (self.place(middle - half), self.place(middle + half));
        if from >= to {
            return;
        }
        let (along, _) = self.split(ray.direction);
        let (lever, _) = self.split(ray.lever);
        let (sin, cos) = self.azimuth;
        let [x, y] = ray.fields;
        let mixed = |a: f64, b: f64| Vec3 {
            x: x.x * a + y.x * b,
            y: x.y * a + y.y * b,
            z: x.z * a + y.z * b,
        };
        let (parallel, perpendicular) = (mixed(cos, sin), mixed(sin, -cos));
        let rho = |e: Field| e.x * cos + e.y * sin;
        let phi = |e: Field| e.y * cos - e.x * sin;
        let parts = |c: Complex64| [c.re, c.im];
        self.waves.push(Wave {
            turns: [ray.path, -lever, -ray.lever.z],
            size: [-ray.narrowness, ray.narrowness * along, ray.narrowness * ray.direction.z],
            along: [
                parts(rho(parallel)),
                parts(parallel.z),
                parts(rho(perpendicular)),
                parts(perpendicular.z),
            ],
            across: [parts(phi(parallel)), parts(phi(perpendicular))],
            from,
            to,
        });
        if self.waves.len() == BATCH {
            self.flush();
        }
    }

    /// Number of angles below this.
    fn place(&self, theta: f64) -> usize {
        if theta <= 0.0 {
            return 0;
        }
        let bucket = (theta * (BUCKETS as f64 / PI)) as usize;
        if bucket >= BUCKETS {
            return self.theta.len();
        }
        let (from, to) = (self.buckets[bucket] as usize, self.buckets[bucket + 1] as usize);
        from + self.theta[from..to].partition_point(|&t| t < theta)
    }

    fn flush(&mut self) {
        add_waves(&mut self.rows, &self.sin, &self.cos, &self.waves);
        self.waves.clear();
    }

    /// The amplitudes.
    pub(super) fn finish(&mut self) -> Vec<AmplitudeMatrix> {
        self.flush();
        let x = self.size_parameter;
        let factor = Complex64::new(0.0, -x) * Complex64::new(0.0, -x / TAU);
        let at = |e: usize, i: usize| {
            Complex64::new(self.rows[2 * e][i], self.rows[2 * e + 1][i]) * factor
        };
        (0..self.theta.len())
            .map(|i| AmplitudeMatrix { s2: at(0, i), s3: at(1, i), s4: -at(2, i), s1: -at(3, i) })
            .collect()
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn add_waves(rows: &mut [Vec<f64>; 8], sin: &[f64], cos: &[f64], waves: &[Wave]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        add_with::<true>(rows, sin, cos, waves);
    } else {
        add_with::<false>(rows, sin, cos, waves);
    }
}

#[inline(always)]
fn add_with<const FMA: bool>(rows: &mut [Vec<f64>; 8], sin: &[f64], cos: &[f64], waves: &[Wave]) {
    let [r0, r1, r2, r3, r4, r5, r6, r7] = rows;
    for wave in waves {
        let mut at = wave.from;
        while at < wave.to {
            let (Some(s), Some(c)) = (lanes(sin, at), lanes(cos, at)) else { break };
            let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                let linear = |[a, b, d]: [f64; 3]| {
                    multiply_add::<FMA>(s[k], b, multiply_add::<FMA>(c[k], d, a))
                };
                let size = exp2::<FMA>(linear(wave.size));
                let (sin, cos) = sin_cos_turns_with::<FMA>(linear(wave.turns));
                re[k] = size * cos;
                im[k] = size * sin;
            }
            for (row, e) in [(&mut *r0, 0), (&mut *r2, 1)] {
                let ([ar, ai], [br, bi]) = (wave.along[2 * e], wave.along[2 * e + 1]);
                let Some(out) = lanes_mut(row, at) else { break };
                let mut fr = [0.0; LANES];
                let mut fi = [0.0; LANES];
                for k in 0..LANES {
                    fr[k] = multiply_add::<FMA>(c[k], ar, -s[k] * br);
                    fi[k] = multiply_add::<FMA>(c[k], ai, -s[k] * bi);
                    out[k] = multiply_add::<FMA>(re[k], fr[k], out[k]);
                    out[k] = multiply_add::<FMA>(-im[k], fi[k], out[k]);
                }
                let imaginary = if e == 0 { &mut *r1 } else { &mut *r3 };
                let Some(out) = lanes_mut(imaginary, at) else { break };
                for k in 0..LANES {
                    out[k] = multiply_add::<FMA>(re[k], fi[k], out[k]);
                    out[k] = multiply_add::<FMA>(im[k], fr[k], out[k]);
                }
            }
            for (row, e) in [(&mut *r4, 0), (&mut *r6, 1)] {
                let [fr, fi] = wave.across[e];
                let Some(out) = lanes_mut(row, at) else { break };
                for k in 0..LANES {
                    out[k] = multiply_add::<FMA>(re[k], fr, out[k]);
                    out[k] = multiply_add::<FMA>(-im[k], fi, out[k]);
                }
                let imaginary = if e == 0 { &mut *r5 } else { &mut *r7 };
                let Some(out) = lanes_mut(imaginary, at) else { break };
                for k in 0..LANES {
                    out[k] = multiply_add::<FMA>(re[k], fi, out[k]);
                    out[k] = multiply_add::<FMA>(im[k], fr, out[k]);
                }
            }
            at += LANES;
        }
    }
}

#[inline(always)]
fn lanes(values: &[f64], at: usize) -> Option<&[f64; LANES]> {
    values.get(at..at + LANES)?.try_into().ok()
}

#[inline(always)]
fn lanes_mut(values: &mut [f64], at: usize) -> Option<&mut [f64; LANES]> {
    values.get_mut(at..at + LANES)?.try_into().ok()
}

/// `2^x` for `x` at most a little above 0, 0 far below; relative error 3e-10.
#[inline(always)]
fn exp2<const FMA: bool>(x: f64) -> f64 {
    const ROUND: f64 = 6755399441055744.0;
    let x = x.max(-200.0);
    let shifted = x + ROUND;
    let t = x - (shifted - ROUND);
    // Taylor series of 2^t on |t| ≤ ½
    const C: [f64; 9] = [
        1.0,
        LN_2,
        0.240_226_506_959_100_7,
        0.055_504_108_664_821_58,
        0.009_618_129_107_628_477,
        0.001_333_355_814_642_844_3,
        0.000_154_035_303_933_816_1,
        0.000_015_252_733_804_059_84,
        0.000_001_321_548_679_014_431,
    ];
    let mut value = C[8];
    for k in (0..8).rev() {
        value = multiply_add::<FMA>(value, t, C[k]);
    }
    // the low bits of the shifted number are the exponent
    value * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_right() {
        for k in -1500..20 {
            let x = k as f64 * 0.1037;
            let off = exp2::<false>(x) / x.exp2() - 1.0;
            assert!(off.abs() < 5e-10, "{x}: {off}");
        }
        assert!(exp2::<false>(-1e9) < 1e-60);
    }
}
