//! Means over sizes, bands and the sun's disc against brute force: plain sums over very many
//! spheres, wavelengths or points of the disc, with no thought about resonances.

use gonio::medium::{Medium, MediumSpec};
use gonio::phase_table::{ForwardPeak, Quantity};
use gonio::scene::SunDisc;
use gonio::series::mean::Ensemble;
use gonio::series::table::{Source, SphereJob, sphere_slab};
use gonio::series::{angular::AngleSet, lorenz_mie::Sphere};
use gonio::size_distribution::{SizeDistribution, SizeLaw};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// S11, S12, S33, S34 as areas per solid angle, then C_sca, C_abs, g C_sca.
struct Brute {
    elements: Vec<[f64; 4]>,
    areas: [f64; 3],
}

/// One sphere's contribution.
fn one(radius: f64, wavelength: f64, index: Complex64, set: &AngleSet) -> Brute {
    let sphere = Sphere::new(TAU * radius / wavelength, index).unwrap();
    let area = (wavelength / TAU).powi(2);
    let elements = sphere
        .amplitudes_at(set)
        .iter()
        .map(|(s1, s2)| {
            let (one, two, cross) = (s1.norm_sqr(), s2.norm_sqr(), s1 * s2.conj());
            [0.5 * (one + two), 0.5 * (two - one), cross.re, -cross.im].map(|e| e * area)
        })
        .collect();
    let (q, shadow) = (sphere.efficiencies(), PI * radius * radius);
    Brute { elements, areas: [q.q_sca, q.q_abs, q.q_sca * q.asymmetry].map(|e| e * shadow) }
}

/// Weighted sum over spheres `(radius, wavelength, index, weight)`.
fn brute<F>(count: usize, set: &AngleSet, sphere: F) -> Brute
where
    F: Fn(usize) -> (f64, f64, Complex64, f64) + Sync,
{
    let zero = || Brute { elements: vec![[0.0; 4]; set.len()], areas: [0.0; 3] };
    let add = |mut sum: Brute, other: Brute, weight: f64| {
        let pairs = sum.elements.iter_mut().flatten().zip(other.elements.iter().flatten());
        pairs.for_each(|(a, b)| *a += weight * b);
        sum.areas.iter_mut().zip(other.areas).for_each(|(a, b)| *a += weight * b);
        sum
    };
    (0..count)
        .into_par_iter()
        .fold(zero, |sum, i| {
            let (radius, wavelength, index, weight) = sphere(i);
            if weight == 0.0 { sum } else { add(sum, one(radius, wavelength, index, set), weight) }
        })
        .reduce(zero, |a, b| add(a, b, 1.0))
}

/// Relative errors of S11: root mean square and largest; then of the areas.
fn compare(name: &str, ensemble: &Ensemble, theta: &[f64], truth: &Brute) -> [f64; 3] {
    let mean = ensemble.mean(theta).unwrap();
    let errors: Vec<f64> = mean
        .elements
        .iter()
        .zip(&truth.elements)
        .map(|(a, b)| {
            // Every element by S11, which bounds it.
            (0..4).map(|e| (a[e] - b[e]).abs() / b[0]).fold(0.0, f64::max)
        })
        .collect();
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let largest = errors.iter().copied().fold(0.0, f64::max);
    let areas = [mean.scattering, mean.absorption, mean.scattering * mean.asymmetry];
    let off = areas.iter().zip(truth.areas).map(|(a, b)| (a - b).abs() / truth.areas[0]);
    let off = off.fold(0.0, f64::max);
    println!(
        "{name}: stated {:.1e}; rms {rms:.1e}, largest {largest:.1e}, areas {off:.1e}, {} spheres",
        mean.error, mean.spheres
    );
    assert!(mean.error <= ensemble.tolerance, "{name}");
    [rms, largest, off]
}

fn whole(law: SizeLaw) -> SizeDistribution {
    SizeDistribution::whole(law).unwrap()
}

fn angles(count: usize) -> Vec<f64> {
    (0..count).map(|i| PI * i as f64 / (count - 1) as f64).collect()
}

/// Steps of the brute force: few enough for every day, or enough to show 1e-4
/// (`GONIO_SLOW_CHECKS=1`). Its own error falls as 1/steps.
fn steps() -> usize {
    if std::env::var_os("GONIO_SLOW_CHECKS").is_some() { 400_000 } else { 40_000 }
}

/// Mean of a distribution by equal steps over everything that counts.
fn truth(sizes: &SizeDistribution, index: Complex64, reach: (f64, f64), set: &AngleSet) -> Brute {
    let count = steps();
    let step = (reach.1 - reach.0) / count as f64;
    brute(count, set, |i| {
        let radius = reach.0 + (i as f64 + 0.5) * step;
        (radius, 550e-9, index, sizes.density(radius) * step)
    })
}

/// Few angles keep the brute force affordable; they hold the glory, the bow and the dark between.
#[test]
fn distributions_meet_brute_force() {
    let theta = angles(46);
    let set = AngleSet::new(&theta);
    let (clear, dyed) = (Complex64::new(1.334, 0.0), Complex64::new(1.5, 2e-3));
    let cases = [
        ("gamma, clear", whole(SizeLaw::gamma(5e-6, 0.1)), clear, (0.0, 30e-6)),
        ("gamma, absorbing", whole(SizeLaw::gamma(5e-6, 0.1)), dyed, (0.0, 30e-6)),
        (
            "log-normal",
            whole(SizeLaw::LogNormal { median: 3e-6, spread: 0.3 }),
            clear,
            (0.3e-6, 25e-6),
        ),
        (
            "normal, one part in ten",
            whole(SizeLaw::Normal { mean: 8e-6, deviation: 0.8e-6 }),
            clear,
            (3e-6, 13e-6),
        ),
        (
            "normal, one part in a hundred",
            whole(SizeLaw::Normal { mean: 8e-6, deviation: 0.08e-6 }),
            clear,
            (7.4e-6, 8.6e-6),
        ),
        (
            "Marshall–Palmer, cut short",
            SizeDistribution::between(SizeLaw::marshall_palmer(1.0), 4e-6, 12e-6).unwrap(),
            clear,
            (4e-6, 12e-6),
        ),
    ];
    for (name, sizes, index, reach) in cases {
        let truth = truth(&sizes, index, reach, &set);
        let medium = Medium::Constant(index);
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let ensemble = Ensemble {
                sizes: sizes.clone(),
                medium: &medium,
                wavelength: 550e-9,
                bandwidth: 0.0,
                tolerance,
                accept_unmet: false,
            };
            let [rms, largest, areas] =
                compare(&format!("{name} {tolerance:e}"), &ensemble, &theta, &truth);
            // The brute force is itself good to about 1e-4 with 4e5 steps.
            let own = 2e-4 * 4e5 / steps() as f64;
            assert!(rms < tolerance + own, "{name}: {rms:e}");
            assert!(largest < 6.0 * tolerance + own, "{name}: {largest:e}");
            assert!(areas < tolerance + 1e-5, "{name}: {areas:e}");
        }
    }
}

/// The cloud of `data/scenes/cloud_gamma.toml`, S11 at every single angle: against a run with many
/// more orders before the cut and steps, and (`GONIO_SLOW_CHECKS=1`) at some angles, forward and
/// in the glory, against a plain sum over 2^22 spheres.
#[test]
fn no_single_angle_of_a_cloud_is_off() {
    let water = MediumSpec::name("water").resolve(Path::new("")).unwrap();
    let sizes = whole(SizeLaw::gamma(10e-6, 0.1));
    let of = |wavelength, tolerance| {
        let ensemble = Ensemble {
            sizes: sizes.clone(),
            medium: &water,
            wavelength,
            bandwidth: 0.0,
            tolerance,
            accept_unmet: false,
        };
        ensemble.mean(&angles(1801)).unwrap()
    };
    let largest = |pairs: &mut dyn Iterator<Item = (f64, f64)>| {
        pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    };
    for wavelength in [380e-9, 550e-9, 720e-9] {
        let (mean, fine) = (of(wavelength, 1e-4), of(wavelength, 2e-6));
        let pairs = mean.elements.iter().zip(&fine.elements);
        let off = largest(&mut pairs.map(|(a, b)| (a[0], b[0])));
        println!("{wavelength:e} m: {off:.1e} against {} spheres", fine.spheres);
        assert!(off < 1e-4, "{wavelength:e}: {off:e}");
    }
    if std::env::var_os("GONIO_SLOW_CHECKS").is_none() {
        return;
    }
    let places: Vec<usize> = (0..=170).step_by(10).chain(1700..=1800).step_by(5).collect();
    let theta: Vec<f64> = places.iter().map(|&i| angles(1801)[i]).collect();
    let set = AngleSet::new(&theta);
    let (wavelength, count) = (550e-9, 1 << 22);
    let index = water.index(wavelength).unwrap();
    let step = 40e-6 / f64::from(count);
    let truth = brute(count as usize, &set, |i| {
        let radius = (i as f64 + 0.5) * step;
        (radius, wavelength, index, sizes.density(radius) * step)
    });
    let mean = of(wavelength, 1e-4);
    let pairs = places.iter().zip(&truth.elements).map(|(&i, b)| (mean.elements[i][0], b[0]));
    let off = largest(&mut pairs.into_iter());
    println!("plain sum: {off:.1e}");
    assert!(off < 1.2e-4, "{off:e}");
}

/// The table of the two distributions "delta" and "none" is the same, bit for bit.
#[test]
fn one_size_is_one_sphere() {
    let medium = Medium::Constant(Complex64::new(1.334, 1e-4));
    let theta = angles(181);
    let job = |bandwidth| SphereJob {
        source: Source::LorenzMie,
        sizes: SizeDistribution::delta(5e-6),
        medium: &medium,
        wavelength: 550e-9,
        bandwidth,
        sun_disc: SunDisc::None,
        tolerance: 1e-3,
        allow_unmet: false,
    };
    let slab = sphere_slab(&job(0.0), &theta, Quantity::PhaseFunction, ForwardPeak::Point).unwrap();
    let single = one(5e-6, 550e-9, Complex64::new(1.334, 1e-4), &AngleSet::new(&theta));
    for (value, row) in slab.values.iter().zip(&single.elements) {
        let expected = row[0] / single.areas[0];
        assert!((f64::from(*value) / expected - 1.0).abs() < 1e-6);
    }
    assert!((slab.scattering_cross_section / single.areas[0] - 1.0).abs() < 1e-12);
}

/// A band of 30 nm about 550 nm, water with its dispersion: cos² over very many wavelengths.
#[test]
fn bands_meet_brute_force() {
    let water = MediumSpec::name("water").resolve(Path::new("")).unwrap();
    let theta = angles(46);
    let set = AngleSet::new(&theta);
    let (centre, width, radius) = (550e-9, 30e-9, 20e-6);
    let count = steps() / 2;
    let truth = brute(count, &set, |i| {
        let offset = width * (2.0 * (i as f64 + 0.5) / count as f64 - 1.0);
        let weight = (0.5 * PI * offset / width).cos().powi(2) * 2.0 / count as f64;
        (radius, centre + offset, water.index(centre + offset).unwrap(), weight)
    });
    for tolerance in [1e-2, 1e-3] {
        let ensemble = Ensemble {
            sizes: SizeDistribution::delta(radius),
            medium: &water,
            wavelength: centre,
            bandwidth: width,
            tolerance,
            accept_unmet: false,
        };
        let [rms, largest, areas] = compare("band of 30 nm", &ensemble, &theta, &truth);
        assert!(rms < tolerance + 1e-3 && largest < 6.0 * tolerance, "{rms:e} {largest:e}");
        assert!(areas < tolerance, "{areas:e}");
    }
}

/// The sun's disc against points strewn over it, with and without its dark limb.
#[test]
fn sun_disc_meets_points_strewn_over_it() {
    use gonio::color::{LimbDarkening, SUN_ANGULAR_RADIUS};
    let medium = Medium::Constant(Complex64::new(1.334, 0.0));
    let theta: Vec<f64> =
        [0.0, 0.3, 5.0, 42.0, 138.0, 140.0, 179.7, 180.0].map(f64::to_radians).into();
    let radius = 100e-6;
    let sphere = Sphere::new(TAU * radius / 550e-9, Complex64::new(1.334, 0.0)).unwrap();
    for disc in [SunDisc::Uniform, SunDisc::LimbDarkened] {
        let job = SphereJob {
            source: Source::LorenzMie,
            sizes: SizeDistribution::delta(radius),
            medium: &medium,
            wavelength: 550e-9,
            bandwidth: 0.0,
            sun_disc: disc,
            tolerance: 1e-3,
            allow_unmet: false,
        };
        let slab = sphere_slab(&job, &theta, Quantity::PhaseFunction, ForwardPeak::Point).unwrap();
        let limb = LimbDarkening::at(550e-9);
        let points = 50_000;
        for (theta, value) in theta.iter().zip(&slab.values) {
            // Sunflower: even over the disc.
            let strewn: Vec<(f64, f64)> = (0..points)
                .map(|i| {
                    let square = (i as f64 + 0.5) / points as f64;
                    let (rho, turn) =
                        (SUN_ANGULAR_RADIUS * square.sqrt(), 2.399_963_229 * i as f64);
                    let cosine = theta.cos() * rho.cos() - theta.sin() * rho.sin() * turn.cos();
                    let light = match disc {
                        SunDisc::LimbDarkened => limb.brightness((1.0 - square).sqrt()),
                        _ => 1.0,
                    };
                    (cosine.clamp(-1.0, 1.0).acos(), light)
                })
                .collect();
            let angles: Vec<f64> = strewn.iter().map(|s| s.0).collect();
            let light: f64 = strewn.iter().map(|s| s.1).sum();
            let amplitudes = sphere.amplitudes_parallel(&angles);
            let sum: f64 = amplitudes
                .iter()
                .zip(&strewn)
                .map(|((s1, s2), (_, light))| 0.5 * light * (s1.norm_sqr() + s2.norm_sqr()))
                .sum();
            let q = sphere.efficiencies();
            let x = sphere.size_parameter();
            let expected = sum / light / (PI * x * x * q.q_sca);
            let error = (f64::from(*value) / expected - 1.0).abs();
            println!("{disc:?} {:.1}°: {error:.1e}", theta.to_degrees());
            assert!(error < 1e-3, "{disc:?} {theta}: {error:e}");
        }
    }
}

/// A population of `tests/data/population_reference.json`: modes of spheres with their shares of the
/// number inside the limits.
fn mode(mode: &serde_json::Value) -> (f64, SizeDistribution, Complex64) {
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let size = &mode["size"];
    let um = |key: &str| size[key].as_f64().map(|um| um * 1e-6);
    let law = match size["kind"].as_str().unwrap() {
        "log-normal" => SizeLaw::LogNormal {
            median: um("median_radius_um").unwrap(),
            spread: match size["geometric_standard_deviation"].as_f64() {
                Some(deviation) => deviation.ln(),
                None => number(&size["spread"]),
            },
        },
        "gamma" => {
            SizeLaw::gamma(um("effective_radius_um").unwrap(), number(&size["effective_variance"]))
        }
        "modified-gamma" => SizeLaw::PowerExponential {
            exponent: number(&size["alpha"]),
            scale: 1e-6 * number(&size["b_per_um"]).powf(-1.0 / number(&size["gamma"])),
            power: number(&size["gamma"]),
        },
        other => panic!("{other}"),
    };
    let from = um("from_radius_um").unwrap_or(0.0);
    let to = um("to_radius_um").unwrap_or(f64::INFINITY);
    let sizes = SizeDistribution::between(law, from, to).unwrap();
    if let Some(inside) = size["share_of_number_inside"].as_f64() {
        assert!((sizes.share_inside() / inside - 1.0).abs() < 1e-9, "{}", sizes.share_inside());
    }
    let index = Complex64::new(number(&mode["index"][0]), number(&mode["index"][1]));
    (number(&mode["number_fraction"]), sizes, index)
}

/// Published populations (OPAC, Deirmendjian, Hansen & Travis) by another program's amplitudes and
/// another quadrature: cross-sections and g to 1e-5, P11 and S12/S11 to 1e-3.
#[test]
fn reference_populations() {
    let text = include_str!("../data/population_reference.json");
    let reference: serde_json::Value = serde_json::from_str(text).unwrap();
    let cases = reference["cases"].as_object().unwrap();
    assert_eq!(cases.len(), 5);
    for (name, case) in cases {
        let values = &case["values"];
        let list = |key: &str| -> Vec<f64> {
            values[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
        };
        let theta: Vec<f64> = list("theta_deg").iter().map(|t| t.to_radians()).collect();
        let wavelength = case["wavelength_um"].as_f64().unwrap() * 1e-6;
        let (mut sums, mut areas) = (vec![[0.0; 2]; theta.len()], [0.0; 3]);
        for (share, sizes, index) in case["modes"].as_array().unwrap().iter().map(mode) {
            let medium = Medium::Constant(index);
            let ensemble = Ensemble {
                sizes,
                medium: &medium,
                wavelength,
                bandwidth: 0.0,
                tolerance: 1e-5,
                accept_unmet: false,
            };
            let mean = ensemble.mean(&theta).unwrap();
            assert!(mean.error <= 1e-5);
            for (sum, row) in sums.iter_mut().zip(&mean.elements) {
                sum[0] += share * row[0];
                sum[1] += share * row[1];
            }
            let forward = mean.asymmetry * mean.scattering;
            for (sum, part) in areas.iter_mut().zip([mean.scattering, mean.absorption, forward]) {
                *sum += share * part;
            }
        }
        let [scattering, absorption, forward] = areas;
        let number = |key: &str| values[key].as_f64().unwrap();
        let square = 1e-12;
        let extinction = number("c_ext_um2") * square;
        let expected = number("c_sca_um2") * square;
        let off = [
            (scattering + absorption) / extinction - 1.0,
            scattering / expected - 1.0,
            forward / scattering / number("asymmetry") - 1.0,
            absorption / (extinction - expected) - 1.0,
        ];
        println!("{name}: ext, sca, g, abs {off:?}");
        assert!(off.iter().all(|off| off.abs() < 1e-5), "{name}: {off:?}");
        let pairs = list("p11_per_sr").into_iter().zip(list("s12_over_s11"));
        for ((sum, (p, ratio)), theta) in sums.iter().zip(pairs).zip(&theta) {
            let off = sum[0] / scattering / p - 1.0;
            assert!(off.abs() < 1e-3, "{name} {theta}: {off:e}");
            let off = sum[1] / sum[0] - ratio;
            assert!(off.abs() < 1e-3, "{name} {theta}: {off:e}");
        }
    }
}

/// OPAC's fog (Hess et al. 1998): `3.04e-4 r^4 exp(-0.0562 r^1.77)` per cm³ and µm, r in µm, has the
/// extinction 0.5620 per km at 550 nm.
#[test]
fn fog_of_opac() {
    let (b, c) = (0.0562f64, 1.77);
    let law = SizeLaw::PowerExponential { exponent: 4.0, scale: 1e-6 * b.powf(-1.0 / c), power: c };
    let sizes = SizeDistribution::between(law, 0.02e-6, 50e-6).unwrap();
    // ∫ r⁴ exp(-b r^c) dr = Γ(5/c) b^(-5/c)/c; the limits leave 1e-8 of it out.
    let number = 3.04e-4 * (libm::lgamma(5.0 / c) - 5.0 / c * b.ln()).exp() / c * 1e6;
    let medium = Medium::Constant(Complex64::new(1.333, 1.96e-9));
    let (wavelength, bandwidth, tolerance) = (550e-9, 0.0, 1e-3);
    let ensemble =
        Ensemble { sizes, medium: &medium, wavelength, bandwidth, tolerance, accept_unmet: false };
    let mean = ensemble.mean(&angles(3)).unwrap();
    let per_km = 1e3 * number * (mean.scattering + mean.absorption);
    println!("{per_km} /km, g {}", mean.asymmetry);
    assert!((per_km / 0.5620 - 1.0).abs() < 2e-3, "{per_km}");
    assert!((mean.asymmetry - 0.866).abs() < 1e-3, "{}", mean.asymmetry);
}

/// Sub-micrometre particles: Rayleigh's closed form for the mean of r⁶, and means of other small
/// particles by plain sums over their sizes.
#[test]
fn small_particles() {
    let glass = Complex64::new(1.5, 0.0);
    let theta = angles(46);
    let set = AngleSet::new(&theta);
    for tolerance in [1e-2, 1e-4, 1e-7] {
        let of = |sizes: SizeDistribution, index| {
            let medium = Medium::Constant(index);
            let wavelength = 550e-9;
            let ensemble = Ensemble {
                sizes,
                medium: &medium,
                wavelength,
                bandwidth: 0.0,
                tolerance,
                accept_unmet: false,
            };
            let mean = ensemble.mean(&theta).unwrap();
            assert!(mean.error <= tolerance);
            mean
        };
        // (8π/3) k⁴ |K|² ⟨r⁶⟩; the next term is 1 + O(x²).
        let small = whole(SizeLaw::LogNormal { median: 0.5e-9, spread: 0.3 });
        let square = glass * glass;
        let polarisable = ((square - 1.0) / (square + 2.0)).norm_sqr();
        let expected = 8.0 * PI / 3.0 * (TAU / 550e-9f64).powi(4) * polarisable * small.moment(6.0);
        let mean = of(small, glass);
        let off = mean.scattering / expected - 1.0;
        assert!(off.abs() < tolerance + 1e-4, "{off:e}");
        for (sizes, index, to) in [
            (SizeLaw::gamma(30e-9, 0.1), glass, 4e-7),
            (SizeLaw::Normal { mean: 20e-9, deviation: 2e-9 }, glass, 4e-8),
            (SizeLaw::LogNormal { median: 35e-9, spread: 0.3 }, glass, 4e-7),
            (
                SizeLaw::LogNormal { median: 11.8e-9, spread: 0.69 },
                Complex64::new(1.75, 0.44),
                3e-6,
            ),
        ] {
            let sizes = whole(sizes);
            let count = 20_000;
            // Even in ln r.
            let (low, high) = (1e-10f64, to);
            let step = (high / low).ln() / f64::from(count);
            let truth = brute(count as usize, &set, |i| {
                let radius = low * ((i as f64 + 0.5) * step).exp();
                (radius, 550e-9, index, sizes.density(radius) * radius * step)
            });
            let mean = of(sizes, index);
            for (got, expected) in [
                (mean.scattering, truth.areas[0]),
                (mean.absorption, truth.areas[1]),
                (mean.asymmetry * mean.scattering, truth.areas[2]),
            ] {
                assert!(
                    (got - expected).abs() <= (tolerance + 1e-6) * expected,
                    "{got} {expected}"
                );
            }
        }
    }
}

/// A tolerance that is out of reach is a failure that says what was reached.
#[test]
fn unmet_tolerance_is_no_success() {
    use gonio::series::mean::MeanError;
    let medium = Medium::Constant(Complex64::new(1.5, 0.0));
    // Two sharp edges across resonances without end.
    let law = SizeLaw::Normal { mean: 5e-6, deviation: 1e-6 };
    let sizes = SizeDistribution::between(law, 4.999e-6, 5.001e-6).unwrap();
    let ensemble = Ensemble {
        sizes,
        medium: &medium,
        wavelength: 550e-9,
        bandwidth: 0.0,
        tolerance: 1e-13,
        accept_unmet: false,
    };
    match ensemble.mean(&angles(5)) {
        Ok(mean) => assert!(mean.error <= 1e-13),
        Err(MeanError::NotMet { asked, reached, .. }) => assert!(reached > asked),
        Err(other) => panic!("{other}"),
    }
}

/// The rule of three wavelengths and the steps of a band, where the spread of sizes is as narrow as the
/// band or narrower: against a plain sum over both.
#[test]
fn narrow_sizes_and_a_band_together() {
    let index = Complex64::new(1.4, 5e-3);
    let medium = Medium::Constant(index);
    let theta = angles(31);
    let set = AngleSet::new(&theta);
    let (centre, width, mean) = (550e-9, 20e-9, 3e-6);
    for spread in [1e-3, 1e-2, 5e-2] {
        let sizes = whole(SizeLaw::Normal { mean, deviation: spread * mean });
        let (radii, waves) = (160usize, 400usize);
        let truth = brute(radii * waves, &set, |i| {
            let place = 12.0 * ((i % radii) as f64 + 0.5) / radii as f64 - 6.0;
            let radius = mean * (1.0 + spread * place);
            let share = sizes.density(radius) * 12.0 * spread * mean / radii as f64;
            let offset = 2.0 * ((i / radii) as f64 + 0.5) / waves as f64 - 1.0;
            let weight = (0.5 * PI * offset).cos().powi(2) * 2.0 / waves as f64;
            (radius, centre + width * offset, index, share * weight)
        });
        let ensemble = Ensemble {
            sizes,
            medium: &medium,
            wavelength: centre,
            bandwidth: width,
            tolerance: 1e-3,
            accept_unmet: false,
        };
        let [rms, largest, areas] = compare(&format!("{spread}"), &ensemble, &theta, &truth);
        assert!(rms < 1e-3 && largest < 6e-3 && areas < 1e-3, "{rms:e} {largest:e} {areas:e}");
    }
}
