//! Scenes that are accepted, and messages for those that are not.

use super::file::KEYS;
use super::*;
use crate::medium::MediumSpec;
use std::f64::consts::PI;

fn parse(text: &str) -> Result<Scene, SceneError> {
    let text = SceneText::parse("scene.toml", text.to_string())?;
    Scene::from_text(text, &SceneFile::default())
}

/// The message for the built-in scene with one piece of its text replaced.
fn refused(from: &str, to: &str) -> String {
    assert!(BUILT_IN.contains(from), "{from}");
    parse(&BUILT_IN.replace(from, to)).unwrap_err().to_string()
}

#[test]
fn built_in_scene_is_the_documented_one() {
    let scene = Scene::built_in(&SceneFile::default()).unwrap();
    let Particle::Raindrop { radius, model } = scene.particle else { panic!("no raindrop") };
    assert_eq!((radius, model), (0.5e-3, RaindropModel::BeardChuang1987));
    assert_eq!(scene.sun_elevation, 20f64.to_radians());
    assert_eq!((scene.wavelengths[0], scene.wavelengths[32]), (380.0 * 1e-9, 720.0 * 1e-9));
    assert_eq!((scene.theta.len(), scene.phi.len()), (1801, 361));
    assert_eq!((scene.theta[0], scene.theta[1800]), (0.0, PI));
    assert_eq!(scene.phi[360], 2.0 * PI);
    assert_eq!(scene.tolerance, 0.01);
}

#[test]
fn all_shipped_scenes_are_valid() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/scenes");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    // `bows/` holds pictures for `gonio render`: another kind of file, checked by its own reader
    let paths: Vec<_> = entries.filter(|path| path.is_file()).collect();
    assert!(paths.len() >= 3, "{paths:?}");
    for path in paths {
        Scene::load(&path, &SceneFile::default()).unwrap();
    }
}

#[test]
fn the_record_of_a_scene_gives_the_same_scene() {
    for text in [
        BUILT_IN,
        "[particle]\nshape='spheroid'\ndiameter_mm=0.3\naxis_ratio=0.9\nmedium={index=[1.5,0.1]}\n\
         [light]\nwavelengths_nm=[400, 500.5]\n[model]\norders=[0,1]\nrays_across=200\n\
         [table]\nbit_round=10\nquantity='mueller'",
    ] {
        let scene = parse(text).unwrap();
        let again = parse(&scene.toml).unwrap();
        assert_eq!(again, scene);
    }
}

#[test]
fn known_keys_are_those_of_the_structs() {
    let full = SceneFile {
        particle: ParticleKeys {
            shape: Some(Choice(ShapeName::Sphere)),
            apex_deg: Some(60.0),
            coefficients: Some(vec![1.0]),
            exponent: Some(2.0),
            file: Some("gem.obj".into()),
            file_unit: Some(Choice(LengthUnit::Metre)),
            radius_mm: Some(1.0),
            radius_um: Some(1.0),
            diameter_mm: Some(1.0),
            size_distribution: Some("kind = 'delta', radius_um = 1".parse().unwrap()),
            axis_ratio: Some(AxisRatioKey::Number(1.0)),
            canting: Some(CantingKeys { deviation_deg: 7.0 }),
            orientation: Some(OrientationKey::from(Orientation::Random)),
            model: Some(Choice(RaindropModel::BeardChuang1987)),
            temperature_c: Some(20.0),
            density_kg_m3: Some(1000.0),
            medium: Some(MediumSpec::default()),
            outside: Some(MediumSpec::default()),
            coating: Some(Vec::new()),
            index: None,
        },
        particles: Vec::new(),
        amount: AmountKeys {
            rain_rate_mm_h: Some(1.0),
            number_per_cm3: Some(1.0),
            water_content_g_m3: Some(1.0),
        },
        light: LightKeys {
            sun_elevation_deg: Some(0.0),
            wavelengths_nm: Some(Grid::List(vec![1.0])),
            frequencies_ghz: Some(Grid::List(vec![1.0])),
            bandwidth_nm: Some(1.0),
            sun_disc: Some(Choice(SunDisc::Uniform)),
        },
        table: TableKeys {
            quantity: Some(Choice(Quantity::Mueller)),
            forward_peak: Some(Choice(ForwardPeak::Point)),
            bit_round: Some(1),
            theta_deg: Some(Grid::List(vec![1.0])),
            azimuth_deg: Some(Grid::List(vec![1.0])),
        },
        model: ModelKeys {
            method: Some(Choice(Method::Rays)),
            interference: Some(Interference::Waves),
            diffraction: Some(Choice(Diffraction::None)),
            orders: Some(Orders::Auto),
            tolerance: Some(0.1),
            rays_across: Some(10),
            allow_unmet_tolerance: Some(true),
        },
    };
    let table = toml::Table::try_from(&full).unwrap();
    for (section, keys) in KEYS {
        let mut known = keys.to_vec();
        let written = table[section].as_table().unwrap();
        let mut fields: Vec<_> = written.keys().map(String::as_str).collect();
        known.sort_unstable();
        fields.sort_unstable();
        assert_eq!(fields, known, "[{section}]");
    }
    assert_eq!(table.len(), KEYS.len());
    // Laid over an empty scene nothing is lost.
    assert_eq!(SceneFile::default().overridden_by(&full), full);
}

#[test]
fn unknown_keys_are_named_with_line_and_suggestion() {
    let message = refused("radius_mm", "radus_mm");
    assert!(message.starts_with("scene.toml, line 4: unknown key `radus_mm`"), "{message}");
    assert!(message.contains("did you mean `radius_mm`?"), "{message}");
    let message = refused("[light]", "[lights]");
    assert!(message.contains("unknown key `lights` (did you mean `light`?)"), "{message}");
    let message = parse("radius_mm = 0.5\n").unwrap_err().to_string();
    assert!(message.contains("line 1") && message.contains("particle.radius_mm"), "{message}");
    let message = refused("from = 0, to = 180, count", "from = 0, to = 180, steps");
    assert!(message.contains("line 12") && message.contains("steps"), "{message}");
}

#[test]
fn values_are_refused_with_line_key_value_and_what_is_accepted() {
    for (from, to, parts) in [
        ("= 0.5  ", "= -0.5", &["line 4: particle.radius_mm = -0.5", "0.001 to 3 mm"][..]),
        ("= 0.5  ", "= nan", &["line 4: particle.radius_mm = NaN"]),
        ("= 0.5  ", "= 3.5", &["beard-chuang-1987", "chuang-beard-1990", "4.5"]),
        ("= 0.5  ", "= 9", &["line 4", "0.001 to 3 mm"]),
        ("= 0.5  ", "= \"half\"", &["line 4: particle.radius_mm", "expected f64"]),
        ("= 0.5  ", "= 0.5\ndiameter_mm = 1", &["line 5: particle.diameter_mm", "given twice"]),
        ("= 0.5  ", "= 0.5\naxis_ratio = 1", &["line 5: particle.axis_ratio", "spheroid"]),
        ("\"raindrop\" ", "\"raindrip\"", &["line 3", "did you mean \"raindrop\"?"]),
        ("\"water\" ", "\"watr\"", &["line 5: particle.medium"]),
        ("\"water\" ", "{ index = [1.3, -0.1] }", &["line 5: particle.medium"]),
        ("\"water\" ", "{ index = [1.0, 0.0] }", &["line 5: particle.medium", "scatters no"]),
        ("= 20", "= 90.1", &["line 8: light.sun_elevation_deg = 90.1", "-90 to 90"]),
        ("= 20", "= inf", &["line 8: light.sun_elevation_deg = inf"]),
        ("{ from = 380, to = 720, count = 33 }", "[]", &["line 9: light.wavelengths_nm", "empty"]),
        ("count = 33", "count = 0", &["line 9", "`count` must be 1 to"]),
        ("count = 33", "count = 1", &["line 9", "differ"]),
        ("count = 33", "count = -3", &["line 9: light.wavelengths_nm"]),
        ("count = 33", "count = 1e3", &["line 9: light.wavelengths_nm"]),
        ("from = 380", "from = -380", &["line 9", "-380 is not accepted", "1 to 1e9 nm"]),
        ("from = 380", "from = 900", &["line 9", "`from` must be less than `to`"]),
        (
            "to = 180",
            "to = 181",
            &[
                "line 12: table.theta_deg",
                "181, count = 1801 }: 180.095 is not accepted",
                "0 to 180 degrees",
            ],
        ),
        ("count = 1801", "count = 99999999999", &["line 12", "`count` must be"]),
        ("count = 1801", "count = 9000000", &["line 12", "GiB per wavelength"]),
        ("{ from = 0, to = 180, count = 1801 }", "[2, 1]", &["line 12", "2 is followed by 1"]),
        ("{ from = 0, to = 180, count = 1801 }", "90", &["line 12", "at least two"]),
        ("{ from = 0, to = 360, count = 361 }", "[-90, 300]", &["line 13", "spans 390"]),
        ("\"phase_function\"", "\"muller\"", &["line 14", "did you mean \"mueller\"?"]),
        ("\"rays\"", "\"mie\"", &["line 17: model.method = mie", "spheres"]),
        ("interference = true", "interference = 1", &["line 18: model.interference"]),
        ("\"auto\"", "[]", &["line 20: model.orders", "empty"]),
        ("\"auto\"", "[0, 101]", &["line 20: model.orders", "0 to 100"]),
        ("\"auto\"", "[1, 1]", &["line 20: model.orders", "twice"]),
        ("\"auto\"", "\"all\"", &["line 20: model.orders", "auto"]),
        ("= 0.01", "= 0", &["line 21: model.tolerance = 0", "1e-8 to 0.5"]),
    ] {
        let message = refused(from, to);
        for part in parts {
            assert!(message.contains(part), "{from} -> {to}: no `{part}` in: {message}");
        }
    }
}

#[test]
fn missing_keys_and_broken_toml_are_named() {
    let message = parse("[particle]\nshape = 'sphere'").unwrap_err().to_string();
    assert!(message.contains("particle.radius_mm is missing"), "{message}");
    let message = parse("").unwrap_err().to_string();
    assert!(message.contains("particle.shape is missing"), "{message}");
    let message = parse("[particle]\nshape = 'spheroid'\nradius_mm = 1").unwrap_err().to_string();
    assert!(message.contains("particle.axis_ratio is missing"), "{message}");
    let message = parse("[particle]\nshape = = 1").unwrap_err().to_string();
    assert!(message.starts_with("scene.toml, line 2"), "{message}");
    let message = parse("particle = 3").unwrap_err().to_string();
    assert!(message.contains("line 1"), "{message}");
    let deep = format!("particle = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(parse(&deep).is_err());
}

#[test]
fn flags_replace_keys_and_are_named_in_messages() {
    let mut flags = SceneFile::default();
    flags.particle.diameter_mm = Some(2.0);
    flags.table.theta_deg = Some("10:20:3".parse().unwrap());
    let scene = Scene::built_in(&flags).unwrap();
    assert_eq!(scene.theta, [10f64, 15.0, 20.0].map(f64::to_radians));
    assert!(matches!(scene.particle, Particle::Raindrop { radius: 1e-3, .. }));

    flags.particle.diameter_mm = Some(-2.0);
    let message = Scene::built_in(&flags).unwrap_err().to_string();
    assert!(message.starts_with("--diameter-mm = -2: "), "{message}");

    flags.particle = ParticleKeys::default();
    flags.particle.shape = Some(Choice(ShapeName::Sphere));
    let scene = Scene::built_in(&flags).unwrap();
    assert_eq!(scene.particle, Particle::Sphere { radius: 0.5e-3 });
    assert_eq!(scene.method, Method::Rays);
    // the rays of the built-in scene are those of its drop
    flags.particle.shape = Some(Choice(ShapeName::Octahedron));
    assert_eq!(Scene::built_in(&flags).unwrap().method, Method::Auto);
    flags.model.method = Some(Choice(Method::Rays));
    assert!(Scene::built_in(&flags).unwrap_err().to_string().starts_with("--method = rays"));
}

#[test]
fn grids_and_orders_as_on_the_command_line() {
    let values = |text: &str| text.parse::<Grid>().and_then(|grid| grid.values());
    assert_eq!(values("0:1:3").unwrap(), [0.0, 0.5, 1.0]);
    assert_eq!(values("5,6.5").unwrap(), [5.0, 6.5]);
    assert_eq!(values("650").unwrap(), [650.0]);
    for bad in ["", "a", "1:2", "1:2:3:4", "1:2:x", "1:2:-3", "nan", "0:inf:3", "1,,2"] {
        assert!(values(bad).is_err(), "{bad}");
    }
    assert_eq!("auto".parse(), Ok(Orders::Auto));
    assert_eq!("0,2".parse(), Ok(Orders::List(vec![0, 2])));
    assert!("-1".parse::<Orders>().is_err() && "".parse::<Orders>().is_err());
    assert!("2 4".parse::<Orders>().is_err());
}
