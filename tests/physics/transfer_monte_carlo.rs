//! A layer of drops by counting photons: an independent solution, without truncation, streams or Fourier series.
//! For validation alone: `cargo test --release --test physics transfer_monte_carlo:: -- --ignored --nocapture`.

use gonio::series::lorenz_mie::Sphere;
use gonio::transfer::{Expansion, Fineness, Layer, Polarisation, Side};
use std::f64::consts::{PI, TAU};

/// Marsaglia's xorshift64*, seeded.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A phase function at even steps of the angle, with the sum of its light up to each.
struct Phase {
    values: Vec<f64>,
    sums: Vec<f64>,
}

const STEPS: usize = 18_000;

impl Phase {
    fn of(sphere: &Sphere) -> Self {
        let theta: Vec<f64> = (0..=STEPS).map(|i| PI * i as f64 / STEPS as f64).collect();
        let power = sphere.amplitudes(&theta).into_iter();
        let power: Vec<f64> = power.map(|(s1, s2)| s1.norm_sqr() + s2.norm_sqr()).collect();
        let mut sums = vec![0.0];
        for i in 0..STEPS {
            let part = |k: usize| power[k] * theta[k].sin();
            sums.push(sums[i] + 0.5 * (part(i) + part(i + 1)) * PI / STEPS as f64);
        }
        let whole = sums[STEPS] * TAU;
        let values = power.iter().map(|value| value / whole).collect();
        let last = sums[STEPS];
        Self { values, sums: sums.into_iter().map(|sum| sum / last).collect() }
    }

    fn at(&self, cosine: f64) -> f64 {
        let place = cosine.clamp(-1.0, 1.0).acos() / PI * STEPS as f64;
        let (i, f) = ((place as usize).min(STEPS - 1), place.fract());
        (1.0 - f) * self.values[i] + f * self.values[i + 1]
    }

    fn sample(&self, dice: &mut Dice) -> f64 {
        let wanted = dice.roll();
        let i = self.sums.partition_point(|sum| *sum <= wanted).clamp(1, STEPS) - 1;
        let f = (wanted - self.sums[i]) / (self.sums[i + 1] - self.sums[i]).max(1e-300);
        PI * (i as f64 + f) / STEPS as f64
    }
}

/// A direction turned by an angle, to a random side.
fn turned([x, y, z]: [f64; 3], theta: f64, phi: f64) -> [f64; 3] {
    let (st, ct) = theta.sin_cos();
    let (sp, cp) = phi.sin_cos();
    let s = x.hypot(y);
    let (e, f) = if s > 1e-9 {
        ([x * z / s, y * z / s, -s], [-y / s, x / s, 0.0])
    } else {
        ([z.signum(), 0.0, 0.0], [0.0, 1.0, 0.0])
    };
    let turned = [0, 1, 2].map(|k| [x, y, z][k] * ct + (e[k] * cp + f[k] * sp) * st);
    let length = turned.iter().map(|v| v * v).sum::<f64>().sqrt();
    turned.map(|v| v / length)
}

/// Drops of size parameter 60, optical depth 2: light in the bow, beside it, in the dark band, at the far side.
#[test]
#[ignore = "a minute of photons"]
fn photons_agree() {
    let sphere = Sphere::new(60.0, 1.333.into()).unwrap();
    let phase = Phase::of(&sphere);
    let (depth, sun, ground) = (2.0, 0.8f64, 0.3);
    let views = [
        (Side::Lit, 0.95, 0.4),
        (Side::Lit, 0.6, 2.9),
        (Side::Lit, 0.3, 0.5),
        (Side::Far, 0.7, 2.0),
        (Side::Far, 0.4, 3.0),
    ];
    let outs = views.map(|(side, cosine, azimuth): (Side, f64, f64)| {
        let u = if side == Side::Lit { -cosine } else { cosine };
        let s = (1.0 - cosine * cosine).sqrt();
        [s * azimuth.cos(), s * azimuth.sin(), u]
    });
    let count = 20_000_000u32;
    let mut dice = Dice(88_172_645_463_325_252);
    let (mut sums, mut squares) = ([0.0f64; 5], [0.0f64; 5]);
    for _ in 0..count {
        let mut here = [0.0f64; 5];
        let mut way = [(1.0 - sun * sun).sqrt(), 0.0, sun];
        let (mut at, mut orders) = (0.0f64, 0);
        loop {
            at += -(1.0 - dice.roll()).ln() * way[2];
            if at < 0.0 {
                break;
            }
            if at > depth {
                if dice.roll() >= ground {
                    break;
                }
                at = depth;
                orders += 1;
                for (k, (side, cosine, _)) in views.into_iter().enumerate() {
                    if side == Side::Lit {
                        here[k] += (-depth / cosine).exp() / PI;
                    }
                }
                let cosine = dice.roll().sqrt();
                way = turned([0.0, 0.0, -1.0], cosine.acos(), TAU * dice.roll());
                continue;
            }
            // light scattered once is left to the closed form
            if orders > 0 {
                for (k, (side, cosine, _)) in views.into_iter().enumerate() {
                    let out = outs[k];
                    let turn = way.iter().zip(out).map(|(a, b)| a * b).sum::<f64>();
                    let left = if side == Side::Lit { at } else { depth - at };
                    here[k] += phase.at(turn) * (-left / cosine).exp() / cosine;
                }
            }
            orders += 1;
            way = turned(way, phase.sample(&mut dice), TAU * dice.roll());
        }
        for k in 0..5 {
            sums[k] += here[k];
            squares[k] += here[k] * here[k];
        }
    }
    // each photon stands for the light that falls on a unit of the layer
    let scale = sun / f64::from(count);
    let chi = sphere.legendre(200);
    let mut expansion = Expansion::zero(200);
    expansion.alpha[0] = chi.iter().enumerate().map(|(l, chi)| (2 * l + 1) as f64 * chi).collect();
    let layer = Layer {
        optical_depth: depth,
        albedo: 1.0,
        phase: &expansion,
        peak: 0.0,
        ground_albedo: ground,
    };
    for streams in [12, 24, 48] {
        let by = Fineness { streams, polarisation: Polarisation::None, ..Fineness::default() };
        let light = layer.light(sun, &[], &by).unwrap();
        for (k, (side, cosine, azimuth)) in views.into_iter().enumerate() {
            let found = light.more(side, cosine, azimuth)[0];
            // the truncated light scattered once differs from the whole by what counts as scattered again
            let u = outs[k][2];
            let turn = u * sun + outs[k][0] * (1.0 - sun * sun).sqrt();
            let p = phase.at(turn);
            let whole = p * gonio::transfer::once(side, depth, cosine, sun);
            let total = found + p * light.once(side, cosine);
            let expected = scale * sums[k] + whole;
            let n = f64::from(count);
            let noise = scale * (squares[k] - sums[k] * sums[k] / n).sqrt();
            println!(
                "{streams} streams, {side:?} {cosine} {azimuth}: {total:.6}, photons {expected:.6} ± {noise:.6}, once {whole:.6}: {:+.2} %",
                100.0 * (total / expected - 1.0)
            );
            // what is scattered twice within the peak's wings is smoothed: on the far side, near forward
            let bound = if side == Side::Lit { 0.01 } else { 0.04 };
            assert!((total - expected).abs() < bound * expected + 3.0 * noise, "{k}");
        }
    }
}
