//! Tests of `accumulate`.

use super::*;
use crate::farfield::branch::knots::{PairKnot, SingleKnot};
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;

const X: f64 = 300.0;

fn theta() -> Vec<f64> {
    (0..=157).map(|k| f64::from(k) * 0.02).collect()
}

fn swept(segment: &Segment, side: Side) -> Vec<AmplitudeMatrix> {
    let samples = Samples::new(&theta());
    let mut sums = Sums::new(&samples);
    add_segment(&mut sums, &samples, segment, side, X);
    sums.amplitudes()
}

/// Path and amplitudes as cubics of the unwrapped angle, with their slopes.
fn path(t: f64) -> [f64; 2] {
    [1.0 + 0.7 * t - 0.4 * t * t + 0.05 * t * t * t, 0.7 - 0.8 * t + 0.15 * t * t]
}

fn channel(c: usize, t: f64) -> [f64; 2] {
    let c = c as f64;
    [0.3 - 0.1 * c + c * t - 0.2 * t * t * t, c - 0.6 * t * t]
}

fn cubic_segment(kind: Kind, angles: &[f64]) -> Segment {
    let knot = |&t: &f64| {
        let [path, path_slope] = path(t);
        let mut knot = SingleKnot { angle: t, path, path_slope, ..SingleKnot::default() };
        for e in 0..4 {
            let [[re, re_rate], [im, im_rate]] = [channel(2 * e, t), channel(2 * e + 1, t)];
            knot.amplitudes[e] = Complex64::new(re, im);
            knot.rates[e] = Complex64::new(re_rate, im_rate);
        }
        Knot::from(knot)
    };
    Segment { kind, knots: angles.iter().map(knot).collect() }
}

/// `x A e^{ixW}`, times `turns` of a turn: the plain sum.
fn wave(t: f64, turns: f64) -> AmplitudeMatrix {
    let factor = Complex64::cis(X * path(t)[0] + TAU * turns) * X;
    let e = |k: usize| Complex64::new(channel(2 * k, t)[0], channel(2 * k + 1, t)[0]) * factor;
    AmplitudeMatrix { s1: e(0), s2: e(1), s3: e(2), s4: e(3) }
}

fn close(found: AmplitudeMatrix, expected: AmplitudeMatrix, bound: f64) -> bool {
    (found - expected).s11().sqrt() < bound * X
}

/// Ascending and descending knots, on the near side, the far side, and a turn further: every
/// sample within has the wave of its angle, the others nothing.
#[test]
fn cubics_are_swept_as_a_plain_sum_adds_them() {
    let mut angles = [0.41, 0.5, 0.62, 0.93, 1.3, 1.313, 2.05];
    let kind = Kind::Plain { focal_lines: 3, from_axis: false };
    for (side, sign, turn) in [
        (Side::Near, 1.0, 0.0),
        (Side::Near, 1.0, TAU),
        (Side::Far, -1.0, 0.0),
        (Side::Far, -1.0, TAU),
    ] {
        for _ in 0..2 {
            let unwrapped: Vec<f64> = angles.iter().map(|a| sign * a + turn).collect();
            let found = swept(&cubic_segment(kind, &unwrapped), side);
            for (found, theta) in found.into_iter().zip(theta()) {
                let inside = (0.41..2.05).contains(&theta);
                let wave = wave(sign * theta + turn, -1.0);
                let expected = if inside { wave } else { AmplitudeMatrix::default() };
                assert!(close(found, expected, 1e-9), "{side:?} {turn} {theta}");
            }
            angles.reverse();
        }
    }
    let whole = swept(&cubic_segment(Kind::Wave, &angles), Side::Near);
    assert!(close(whole[60], wave(1.2, 0.0), 1e-11));
}

/// Samples exactly on knots count once, the axial ray on the near side only.
#[test]
fn every_sample_counts_once() {
    for backward in [false, true] {
        // knots on samples, from the axial ray on
        let angles: Vec<f64> = (0..8)
            .map(|k| if backward { PI - 0.1 * f64::from(k) } else { 0.1 * f64::from(k) })
            .collect();
        let kind = Kind::Plain { focal_lines: 0, from_axis: true };
        let mut segment = cubic_segment(kind, &angles);
        for knot in &mut segment.knots {
            let mut one = SingleKnot { angle: knot.angle(), ..SingleKnot::default() };
            one.amplitudes[0].re = 1.0;
            *knot = one.into();
        }
        let theta = if backward { vec![2.5, 2.8, 3.0, PI] } else { vec![0.0, 0.1, 0.4, 0.65] };
        let samples = Samples::new(&theta);
        for (side, on_axis) in [(Side::Near, 1.0), (Side::Far, 0.0)] {
            let mut sums = Sums::new(&samples);
            // the far side of a segment that turns the other way about the axis
            let mut segment = segment.clone();
            if side == Side::Far {
                let axis = segment.knots[0].angle();
                for knot in &mut segment.knots {
                    let angle = 2.0 * axis - knot.angle();
                    *knot = SingleKnot { angle, ..knot.single() }.into();
                }
            }
            add_segment(&mut sums, &samples, &segment, side, X);
            for (s, theta) in sums.amplitudes().iter().zip(&theta) {
                let axial = theta.sin().abs() < 1e-9;
                let expected = X * if axial { on_axis } else { 1.0 };
                assert!((s.s1.norm() - expected).abs() < 1e-9, "{side:?} {theta}: {}", s.s1);
            }
        }
    }
}

/// Two rays of constant amplitudes whose paths part like `±⅔ ζ̂^{3/2}`: far on the lit side the uniform
/// formula is their sum, the longer one with a focal line more; on the dark side it dies away.
#[test]
fn a_pair_far_from_its_fold_is_two_rays() {
    let (longer, shorter) = (Complex64::new(0.8, 0.1), Complex64::new(-0.3, 0.5));
    let (mean, first) = (1.7, 0.6);
    let knot = |zeta: f64| {
        // analytic where both amplitudes are constant only away from the fold: lit knots alone
        let root = zeta.abs().powf(0.25);
        let (g0, g1) = ((longer + shorter) * root, (longer - shorter) / root);
        Knot::from(PairKnot {
            angle: first + zeta,
            path: mean,
            path_slope: 0.0,
            zeta,
            zeta_slope: 1.0,
            sums: [g0; 4],
            differences: [g1; 4],
        })
    };
    let kind = Kind::Pair { focal_lines: 5 };
    let lit = Segment { kind, knots: (0..=60).map(|k| knot(0.6 + 0.01 * f64::from(k))).collect() };
    for (found, theta) in swept(&lit, Side::Near).into_iter().zip(theta()) {
        let zeta: f64 = theta - first;
        if !(0.62..1.18).contains(&zeta) {
            continue;
        }
        let half = 2.0 / 3.0 * zeta.powf(1.5);
        let ray = |amplitude: Complex64, path: f64, lines: f64| {
            amplitude * Complex64::cis(X * path - 0.5 * PI * (1.0 + lines)) * X
        };
        let sum = ray(longer, mean + half, 3.0) + ray(shorter, mean - half, 2.0);
        assert!((found.s1 - sum).norm() < 3e-3 * X, "{theta}: {} {sum}", found.s1);
        assert_eq!((found.s1, found.s2), (found.s3, found.s4));
    }
    let dark =
        Segment { kind, knots: (0..=30).map(|k| knot(-0.2 - 0.01 * f64::from(k))).collect() };
    for (found, theta) in swept(&dark, Side::Near).into_iter().zip(theta()) {
        let argument = X.powf(2.0 / 3.0) * (first - theta);
        if (9.5..21.0).contains(&argument) {
            assert!(found.s1.norm() < 1e-7 * X, "{theta}: {}", found.s1);
        }
    }
}
