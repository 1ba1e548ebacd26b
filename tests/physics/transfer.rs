//! Light scattered many times in a layer against published tables, independent solutions and laws.

use gonio::transfer::{Expansion, Fineness, Layer, Polarisation, Side};
use std::f64::consts::PI;

fn fineness(streams: usize, polarisation: Polarisation) -> Fineness {
    Fineness { streams, polarisation, ..Fineness::default() }
}

fn layer(optical_depth: f64, albedo: f64, phase: &Expansion) -> Layer<'_> {
    Layer { optical_depth, albedo, phase, peak: 0.0, ground_albedo: 0.0 }
}

/// The sum of an expansion over 4π, at the scattering angle between a direction and the sun's light; elements 11, 12.
fn phase_function(phase: &Expansion, cosine: f64) -> f64 {
    let (mut before, mut now, mut sum) = (0.0, 1.0, 0.0);
    for (l, alpha) in phase.alpha[0].iter().enumerate() {
        let l = l as f64;
        sum += alpha * now;
        (before, now) = (now, ((2.0 * l + 1.0) * cosine * now - l * before) / (l + 1.0));
    }
    sum / (4.0 * PI)
}

/// Cosine of the scattering angle.
fn scattering(side: Side, view: f64, sun: f64, azimuth: f64) -> f64 {
    let sign = if side == Side::Lit { -1.0 } else { 1.0 };
    sign * view * sun + ((1.0 - view * view) * (1.0 - sun * sun)).sqrt() * azimuth.cos()
}

/// All of the light at a view, by the expansion.
fn radiance(layer: &Layer<'_>, side: Side, [view, sun, azimuth]: [f64; 3], by: &Fineness) -> f64 {
    let light = layer.light(sun, &[view], by).unwrap();
    let once =
        phase_function(layer.phase, scattering(side, view, sun, azimuth)) * light.once(side, view);
    light.more_at_view(side, 0, azimuth)[0] + once
}

/// Gauss–Legendre nodes and weights on 0 to 1, by bisection between the roots of neighbouring degrees' sign changes.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut before, mut now) = (1.0, x);
        for k in 1..count {
            let k = k as f64;
            (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
        }
        (now, count as f64 * (before - x * now) / (1.0 - x * x))
    };
    (0..count)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
            for _ in 0..60 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            let slope = legendre(x).1;
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// Chandrasekhar's H of isotropic scattering, from its own equation in the form that converges for every albedo.
fn h_function(albedo: f64) -> impl Fn(f64) -> f64 {
    let nodes = gauss(100);
    let mut h = vec![1.0; nodes.len()];
    let next = |h: &[f64], mu: f64| {
        let sum: f64 = nodes.iter().zip(h).map(|((x, w), h)| w * x * h / (mu + x)).sum();
        1.0 / ((1.0 - albedo).sqrt() + 0.5 * albedo * sum)
    };
    for _ in 0..2000 {
        let new: Vec<f64> = nodes.iter().map(|(x, _)| next(&h, *x)).collect();
        h.iter_mut().zip(new).for_each(|(h, new)| *h = 0.5 * (*h + new));
    }
    move |mu| {
        let sum: f64 = nodes.iter().zip(&h).map(|((x, w), h)| w * x * h / (mu + x)).sum();
        1.0 / ((1.0 - albedo).sqrt() + 0.5 * albedo * sum)
    }
}

/// Layers so deep that nothing comes back from below are Chandrasekhar's half space.
#[test]
fn deep_layers_are_the_half_space() {
    // Chandrasekhar 1960, table XI: H(1) and H(0.5) without absorption
    let conservative = h_function(1.0);
    assert!((conservative(1.0) - 2.9078).abs() < 1e-4 && (conservative(0.5) - 2.0128).abs() < 1e-4);
    let phase = Expansion::isotropic();
    let by = fineness(24, Polarisation::None);
    let mut worst = 0.0f64;
    for albedo in [0.4, 0.9, 0.99] {
        let h = h_function(albedo);
        let deep = layer(300.0, albedo, &phase);
        for (view, sun) in [(1.0, 1.0), (0.2, 0.7), (0.05, 0.1), (0.9, 0.3)] {
            let found = radiance(&deep, Side::Lit, [view, sun, 1.0], &by);
            let expected = albedo / (4.0 * PI) * sun / (sun + view) * h(view) * h(sun);
            worst = worst.max((found / expected - 1.0).abs());
        }
    }
    println!("half space, relative error {worst:.1e}");
    assert!(worst < 2e-6, "{worst}");
}

/// The layers of van de Hulst 1980, tables 12 (isotropic) and 37 (Henyey–Greenstein, g = 0.75), as DISORT 2's test
/// problems 1 and 3 print them (double precision; irradiance π through a plane of the layer). They have 16 streams, eight
/// per hemisphere, which leaves 1e-3 in the thin layers, and 33 coefficients: with as many the numbers are the same.
#[test]
fn discrete_ordinates_agree() {
    let by = fineness(8, Polarisation::None);
    let isotropic = Expansion::isotropic();
    let haze = Expansion::henyey_greenstein(0.75, 33);
    // layer, sun, fluxes up and down (without what passes straight through), radiances up at 0.1, 0.5, 1 and down
    type Row<'a> = (f64, f64, &'a Expansion, f64, [f64; 2], [f64; 3], [f64; 3]);
    let rows: [Row<'_>; 4] = [
        (
            0.03125,
            0.2,
            &isotropic,
            0.1,
            [7.99451e-2, 7.94108e-2],
            [1.17771e-1, 2.64170e-2, 1.34041e-2],
            [1.15898e-1, 2.63324e-2, 1.33826e-2],
        ),
        (
            0.03125,
            1.0,
            &isotropic,
            0.1,
            [4.22922e-1, 4.20233e-1],
            [6.22884e-1, 1.39763e-1, 7.09192e-2],
            [6.13458e-1, 1.39337e-1, 7.08109e-2],
        ),
        (
            1.0,
            1.0,
            &haze,
            1.0,
            [2.47374e-1, 1.73849],
            [1.51159e-1, 1.01103e-1, 3.95460e-2],
            [2.13750e-1, 2.66648e-1, 3.05855],
        ),
        (
            8.0,
            1.0,
            &haze,
            1.0,
            [1.59096, 1.54958],
            [3.79740e-1, 5.19598e-1, 4.93302e-1],
            [2.36362e-1, 4.22350e-1, 6.69581e-1],
        ),
    ];
    let mut worst = [0.0f64; 3];
    for (depth, albedo, phase, sun, [up, down], lit, far) in rows {
        let here = layer(depth, albedo, phase);
        let light = here.light(sun, &[], &by).unwrap();
        let straight = (-depth / sun).exp();
        for (found, expected) in [(light.reflected, up), (light.downward - straight, down)] {
            worst[0] = worst[0].max((found * PI / expected - 1.0).abs());
        }
        for (side, expected) in [(Side::Lit, lit), (Side::Far, far)] {
            for (view, expected) in [0.1, 0.5, 1.0].into_iter().zip(expected) {
                let found = radiance(&here, side, [view, sun, 0.0], &by) * PI / sun;
                let error = (found / expected - 1.0).abs();
                println!("{depth} {side:?} {view}: {found:.6} {expected:.6} {error:.1e}");
                let which = if phase.len() == 1 { 1 } else { 2 };
                worst[which] = worst[which].max(error);
            }
        }
    }
    println!("fluxes {:.1e}, radiances {:.1e}, of haze {:.1e}", worst[0], worst[1], worst[2]);
    // what is scattered twice within the forward peak is corrected there, and not here
    assert!(worst[0] < 1e-5 && worst[1] < 1e-4 && worst[2] < 2e-2, "{worst:?}");
}

/// Rayleigh's phase matrix in our Stokes parameters, sr⁻¹: I, Q, U of light scattered once, from the definition.
fn rayleigh_once(side: Side, [view, sun, azimuth]: [f64; 3]) -> [f64; 3] {
    let cosine = scattering(side, view, sun, azimuth);
    let i = 3.0 / (16.0 * PI) * (1.0 + cosine * cosine);
    let u = if side == Side::Lit { -view } else { view };
    // the field of a dipole along p is p across the line of sight: average over two incident directions
    let (s, s0) = ((1.0 - u * u).sqrt(), (1.0 - sun * sun).sqrt());
    let (sine, cos) = azimuth.sin_cos();
    let (parallel, perpendicular) = ([u * cos, u * sine, -s], [sine, -cos, 0.0]);
    let dot = |a: [f64; 3], b: [f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let (mut q, mut uu) = (0.0, 0.0);
    for p in [[sun, 0.0, -s0], [0.0, -1.0, 0.0]] {
        let (a, b) = (dot(p, parallel), dot(p, perpendicular));
        q += a * a - b * b;
        uu += 2.0 * a * b;
    }
    [i, 3.0 / (16.0 * PI) * q, 3.0 / (16.0 * PI) * uu]
}

/// Coulson, Dave & Sekera's tables of Rayleigh scattering as corrected by Natraj, Li & Yung 2009: optical depth
/// 0.5, the sun at μ₀ = 0.2, light upwards, ground albedo 0 and 0.8. Their Q has the opposite sign.
#[test]
fn corrected_coulson_tables() {
    type Row = ([f64; 2], [f64; 3]);
    let black: [Row; 8] = [
        ([0.02, 0.0], [0.44129802, -0.01753141, 0.0]),
        ([0.4, 0.0], [0.16889020, 0.01119511, 0.0]),
        ([1.0, 0.0], [0.05300496, 0.03755859, 0.0]),
        ([0.02, 60.0], [0.30091208, -0.15965601, 0.07365528]),
        ([0.4, 60.0], [0.12752450, -0.06066038, 0.05293867]),
        ([1.0, 60.0], [0.05300496, -0.01877930, 0.03252669]),
        ([0.02, 30.0], [0.39444956, -0.06485313, 0.04390364]),
        ([0.92, 60.0], [0.05643322, -0.01979730, 0.03822653]),
    ];
    let bright: [Row; 6] = [
        ([0.02, 0.0], [0.47382125, -0.01553672, 0.0]),
        ([0.4, 0.0], [0.23059806, 0.01144320, 0.0]),
        ([1.0, 0.0], [0.13280858, 0.03755859, 0.0]),
        ([0.02, 60.0], [0.33343531, -0.15766132, 0.07365528]),
        ([0.4, 60.0], [0.18923236, -0.06041229, 0.05293867]),
        ([1.0, 60.0], [0.13280858, -0.01877930, 0.03252669]),
    ];
    let air = Expansion::rayleigh();
    let by = fineness(40, Polarisation::Full);
    let (sun, mut worst) = (0.2, 0.0f64);
    for (ground_albedo, rows) in [(0.0, &black[..]), (0.8, &bright[..])] {
        let here = Layer { ground_albedo, ..layer(0.5, 1.0, &air) };
        let views: Vec<f64> = rows.iter().map(|row| row.0[0]).collect();
        let light = here.light(sun, &views, &by).unwrap();
        for (k, ([view, azimuth], expected)) in rows.iter().enumerate() {
            let azimuth = azimuth.to_radians();
            let more = light.more_at_view(Side::Lit, k, azimuth);
            let once = rayleigh_once(Side::Lit, [*view, sun, azimuth])
                .map(|p| p * light.once(Side::Lit, *view));
            let found = [0, 1, 2].map(|s| PI * (more[s] + once[s]));
            println!("{ground_albedo} {view} {azimuth:.2}: {found:?} {expected:?}");
            for (s, sign) in [(0, 1.0), (1, -1.0), (2, 1.0)] {
                worst = worst.max((found[s] - sign * expected[s]).abs());
            }
        }
    }
    println!("Rayleigh layer, absolute error {worst:.1e}");
    assert!(worst < 3e-6, "{worst}");
}

/// I, Q, U of light scattered once, sr⁻¹: elements 11 and 12 turned to the plane of line of sight and normal.
fn polarised_once(phase: &Expansion, side: Side, [view, sun, azimuth]: [f64; 3]) -> [f64; 3] {
    let [p11, p12, ..] = phase.elements(scattering(side, view, sun, azimuth));
    let u = if side == Side::Lit { -view } else { view };
    let (s, s0) = ((1.0 - u * u).sqrt(), (1.0 - sun * sun).sqrt());
    let (sine, cosine) = azimuth.sin_cos();
    // across the plane of scattering: the sun's direction times the line of sight
    let (light, out) = ([s0, 0.0, sun], [s * cosine, s * sine, u]);
    let across = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let normal = across(light, out);
    let (parallel, perpendicular) = ([u * cosine, u * sine, -s], [sine, -cosine, 0.0]);
    let (a, b) = (dot(normal, parallel), dot(normal, perpendicular));
    // Q in the plane of scattering is p12: along the normal it is −p12
    let (cos2, sin2) = ((a * a - b * b) / dot(normal, normal), 2.0 * a * b / dot(normal, normal));
    [p11, -p12 * cos2, -p12 * sin2].map(|p| p / (4.0 * PI))
}

/// Siewert 2000, problem IIA: an aerosol of 12 coefficients of each kind, optical depth 1, albedo 0.973527, the
/// sun at μ₀ = 0.6, light upwards at the top. Without circular polarisation, which changes the last digit. U has the
/// opposite sense there.
#[test]
fn siewert_aerosol() {
    let table = [
        [1.0, 0.0, 0.0, 0.0],
        [2.104031, 0.0, 0.0, 0.0],
        [2.095158, 3.726079, 3.615946, -0.116688],
        [1.414939, 2.202868, 2.240516, -0.209370],
        [0.703593, 1.190694, 1.139473, -0.227137],
        [0.235001, 0.391203, 0.365605, -0.144524],
        [0.064039, 0.105556, 0.082779, -0.052640],
        [0.012837, 0.020484, 0.013649, -0.012400],
        [0.002010, 0.003097, 0.001721, -0.002093],
        [0.000246, 0.000366, 0.000172, -0.000267],
        [0.000024, 0.000035, 0.000014, -0.000027],
        [0.000002, 0.000003, 0.000001, -0.000002],
    ];
    let mut phase = Expansion::zero(12);
    for (l, row) in table.iter().enumerate() {
        (0..3).for_each(|k| phase.alpha[k][l] = row[k]);
        phase.beta[0][l] = row[3];
    }
    let rows = [
        ([0.5, 0.0], [0.339136, -0.0282242, 0.0]),
        ([0.2, 0.0], [0.751295, -0.0638561, 0.0]),
        ([1.0, 180.0], [0.0506873, -0.00262388, 0.0]),
        ([0.5, 180.0], [0.0684106, 0.00196215, 0.0]),
        ([0.2, 180.0], [0.0801523, 0.00243740, 0.0]),
        ([1.0, 90.0], [0.0506873, 0.00262388, 0.0]),
        ([0.5, 90.0], [0.124626, 0.00512123, -0.00804140]),
        ([0.2, 90.0], [0.169216, 0.00696260, -0.00912219]),
    ];
    let views: Vec<f64> = rows.iter().map(|(at, _)| at[0]).collect();
    let (sun, mut worst) = (0.6, 0.0f64);
    let light = layer(1.0, 0.973527, &phase)
        .light(sun, &views, &fineness(20, Polarisation::Linear))
        .unwrap();
    for (k, ([view, azimuth], expected)) in rows.into_iter().enumerate() {
        let azimuth = f64::to_radians(azimuth);
        let more = light.more_at_view(Side::Lit, k, azimuth);
        let once = polarised_once(&phase, Side::Lit, [view, sun, azimuth]);
        let found = [0, 1, 2].map(|s| PI * (more[s] + once[s] * light.once(Side::Lit, view)));
        println!("{view} {azimuth:.2}: {found:?} {expected:?}");
        for (s, sign) in [(0, 1.0), (1, 1.0), (2, -1.0)] {
            worst = worst.max((found[s] - sign * expected[s]).abs());
        }
    }
    println!("Siewert, absolute error {worst:.1e}");
    assert!(worst < 1e-5, "{worst}");
}

/// Nothing is lost where nothing is absorbed: what does not come back from a black ground goes into it, a white
/// one throws all of it back.
#[test]
fn energy_is_kept() {
    let mut worst = 0.0f64;
    let haze = Expansion::henyey_greenstein(0.85, 100);
    for (phase, polarisation) in
        [(&Expansion::rayleigh(), Polarisation::Full), (&haze, Polarisation::None)]
    {
        for depth in [1e-4, 0.3, 5.0, 100.0] {
            for (sun, streams) in [(0.1, 12), (0.8, 24)] {
                for ground_albedo in [0.0, 0.3, 1.0] {
                    let here = Layer { ground_albedo, ..layer(depth, 1.0, phase) };
                    let light = here.light(sun, &[], &fineness(streams, polarisation)).unwrap();
                    let lost = light.reflected + (1.0 - ground_albedo) * light.downward - 1.0;
                    worst = worst.max(lost.abs());
                }
            }
        }
    }
    println!("energy lost or gained {worst:.1e}");
    assert!(worst < 1e-6, "{worst}");
}

/// Sun and observer change places: I(μ; μ₀)/μ₀ stays, with ground and polarisation.
#[test]
fn sun_and_observer_change_places() {
    let phase = Expansion::henyey_greenstein(0.7, 60);
    let mut worst = 0.0f64;
    for (phase, by) in [
        (&phase, fineness(16, Polarisation::None)),
        (&Expansion::rayleigh(), fineness(16, Polarisation::Full)),
    ] {
        let here = Layer { ground_albedo: 0.4, ..layer(1.7, 0.95, phase) };
        for (side, azimuth) in [(Side::Lit, 0.3), (Side::Lit, 2.5)] {
            let [a, b] = [[0.25, 0.9], [0.9, 0.25]].map(|[view, sun]| {
                let light = here.light(sun, &[view], &by).unwrap();
                light.more_at_view(side, 0, azimuth)[0] / sun
            });
            worst = worst.max((a / b - 1.0).abs());
        }
    }
    println!("reciprocity {worst:.1e}");
    assert!(worst < 1e-6, "{worst}");
}

/// In thin layers light is scattered once: what is scattered more often falls with the square of the depth.
#[test]
fn thin_layers_scatter_once() {
    let phase = Expansion::rayleigh();
    let by = fineness(16, Polarisation::Linear);
    let at = |depth: f64, side: Side| {
        let light = layer(depth, 1.0, &phase).light(0.6, &[0.7], &by).unwrap();
        let once = rayleigh_once(side, [0.7, 0.6, 1.0])[0] * light.once(side, 0.7);
        light.more_at_view(side, 0, 1.0)[0] / once
    };
    for side in [Side::Lit, Side::Far] {
        let (thin, thinner) = (at(1e-3, side), at(1e-4, side));
        assert!(thinner > 0.0 && thinner < 1e-3, "{thinner}");
        assert!((thin / thinner - 10.0).abs() < 2.0, "{thin} {thinner}");
    }
}

/// The peak cut off is told; what is lost by it is small, and less with more streams.
#[test]
fn forward_peaks_are_cut() {
    let phase = Expansion::henyey_greenstein(0.93, 400);
    let here = layer(2.0, 1.0, &phase);
    let place = [0.62, 0.8, 2.6];
    let fine = radiance(&here, Side::Lit, place, &fineness(60, Polarisation::None));
    let mut before = f64::INFINITY;
    for streams in [8, 16, 32] {
        let by = fineness(streams, Polarisation::None);
        let forward = here.light(0.8, &[], &by).unwrap().forward;
        assert!((forward - 0.93f64.powi(2 * streams as i32)).abs() < 1e-12);
        let error = (radiance(&here, Side::Lit, place, &by) / fine - 1.0).abs();
        println!("{streams} streams: {error:.1e}");
        assert!(error < 0.6 * before, "{streams}: {error}");
        before = error;
    }
    assert!(before < 3e-4, "{before}");
}

/// Between the nodes light is that of views asked for; the error stated is above the true one.
#[test]
fn nodes_serve_all_directions() {
    let phase = Expansion::henyey_greenstein(0.8, 200);
    let here = Layer { ground_albedo: 0.2, ..layer(1.5, 1.0, &phase) };
    let by = fineness(24, Polarisation::Linear);
    let views = [0.04, 0.11, 0.37, 0.71, 0.993, 1.0];
    let exact = here.light(0.35, &views, &by).unwrap();
    for side in [Side::Lit, Side::Far] {
        for (k, view) in views.into_iter().enumerate() {
            for azimuth in [0.1, 1.4, 3.0] {
                let (a, b) =
                    (exact.more(side, view, azimuth)[0], exact.more_at_view(side, k, azimuth)[0]);
                assert!((a / b - 1.0).abs() < 2e-4, "{side:?} {view} {azimuth}: {a} {b}");
            }
        }
    }
    let coarse = fineness(12, Polarisation::Linear);
    let (light, stated) = here.light_with_error(0.35, Side::Lit, &coarse).unwrap();
    let (mut worst, mut mean) = (0.0f64, 0.0);
    for view in [0.2, 0.5, 0.8] {
        for azimuth in [0.1, 1.4, 3.0] {
            let [a, b] = [&light, &exact].map(|light| light.more(Side::Lit, view, azimuth)[0]);
            worst = worst.max((a - b).abs());
            mean += b / 9.0;
        }
    }
    println!("stated {stated:.1e}, true {:.1e}", worst / mean);
    assert!(worst / mean < stated && stated < 0.3, "{worst} {mean} {stated}");
}

#[test]
fn impossible_layers_are_refused() {
    let phase = Expansion::isotropic();
    let by = Fineness::default();
    let good = layer(1.0, 1.0, &phase);
    for (here, sun, words) in [
        (
            Layer { optical_depth: f64::INFINITY, ..good.clone() },
            0.5,
            "optical_depth = inf: accepted are numbers above 0",
        ),
        (Layer { optical_depth: -1.0, ..good.clone() }, 0.5, "optical_depth = -1"),
        (Layer { optical_depth: f64::NAN, ..good.clone() }, 0.5, "optical_depth = NaN"),
        (Layer { albedo: 1.01, ..good.clone() }, 0.5, "albedo = 1.01: accepted are 0 to 1"),
        (
            Layer { ground_albedo: -0.1, ..good.clone() },
            0.5,
            "ground_albedo = -0.1: accepted are 0 to 1",
        ),
        (good.clone(), -0.2, "the sun above the layer"),
    ] {
        let error = here.light(sun, &[], &by).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}
