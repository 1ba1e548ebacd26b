//! Random scenes through the whole program: every one ends with a table that `validate` accepts, or with
//! a refusal in words. No panic, no NaN, no energy out of nothing, and where the truth is known (closed
//! forms, an own Lorenz–Mie series, sums over sizes by another rule, shadows of spheroids) no error beyond
//! what the table states.
//!
//! Scenes are made from a seed, so that any of them can be had again; a failure prints its TOML.
//! `GONIO_RANDOM_SCENES` sets how many (1000 unless told), `GONIO_RANDOM_SECONDS` for how long at most,
//! `GONIO_RANDOM_SEED` where they begin; `GONIO_RANDOM_REPORT` prints what became of them. What was run is in `validation/engine.md`.

use gonio::phase_table::PhaseTable;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// What became of a scene.
enum Outcome {
    /// A table that is as it should be.
    Table(&'static str),
    /// A refusal: where, and its kind.
    Refused(String),
    /// Anything else, in words.
    Fault(String),
}

/// Scenes that long runs found wrong and that have been mended since: absorption of a list of orders, k far
/// below rounding with n < 1, terms whose light is absorbed inside.
const FOUND: [u64; 12] =
    [5444, 10384, 13471, 21359, 3621, 6855, 3305, 9309, 25127, 31723, 66395, 77645];

/// As `gonio table` does: read and check the scene, compute, check.
fn run(toml: &str) -> Outcome {
    let text = match SceneText::parse("random", toml.into()) {
        Ok(text) => text,
        Err(error) => return Outcome::Fault(format!("unreadable: {error}")),
    };
    let scene = match Scene::from_text(text, &SceneFile::default()) {
        Ok(scene) => scene,
        Err(error) => return refused("scene", &error.to_string()),
    };
    match simulate::table(&scene) {
        Ok(table) => match judged(&scene, &table) {
            Ok(by) => Outcome::Table(by),
            Err(fault) => Outcome::Fault(fault),
        },
        Err(error) => {
            let kind = format!("{error:?}");
            let kind: String =
                kind.chars().take_while(|c| c.is_alphanumeric() || *c == '(').collect();
            refused(&kind, &error.to_string())
        }
    }
}

/// A refusal says what it is about, and has no NaN where a number should be.
fn refused(kind: &str, message: &str) -> Outcome {
    if message.len() < 20 || message.contains("NaN") {
        return Outcome::Fault(format!("refused with a poor message: {kind}: {message}"));
    }
    let name = match kind {
        "scene" => message.split(" = ").next().unwrap_or_default().trim_start_matches("random: "),
        "Wrong(InvalidTable" => message.split(" = ").next().unwrap_or_default(),
        _ => "",
    };
    let name: String = name.chars().filter(|c| !c.is_ascii_digit()).collect();
    if kind.starts_with("Wrong") && std::env::var_os("GONIO_RANDOM_REPORT").is_some() {
        println!("{message}");
    }
    Outcome::Refused(format!("{kind} {name}"))
}

fn judged(scene: &Scene, table: &PhaseTable) -> Result<&'static str, String> {
    table.validate().map_err(|error| format!("validate refuses what was computed: {error}"))?;
    judge::sound(table)?;
    judge::true_to(scene, table)
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

#[test]
fn random_scenes_end_with_a_sound_table_or_a_refusal() {
    let (count, seed) = (setting("GONIO_RANDOM_SCENES", 1000), setting("GONIO_RANDOM_SEED", 1));
    let report = std::env::var_os("GONIO_RANDOM_REPORT").is_some();
    let (mut outcomes, mut faults) = (BTreeMap::<String, (u64, f64)>::new(), Vec::new());
    let mut slowest = (0.0, 0);
    let (begin, most) = (Instant::now(), setting("GONIO_RANDOM_SECONDS", u64::MAX));
    let mut tried = 0;
    for number in FOUND.into_iter().chain(seed..seed + count) {
        if begin.elapsed().as_secs() >= most {
            break;
        }
        tried += 1;
        let (toml, kind) = generator::scene(number);
        let start = Instant::now();
        let found = catch_unwind(AssertUnwindSafe(|| run(&toml)));
        let seconds = start.elapsed().as_secs_f64();
        if seconds > slowest.0 {
            slowest = (seconds, number);
        }
        let name = match found {
            Ok(Outcome::Table(by)) => format!("{kind}: table, {by}"),
            Ok(Outcome::Refused(what)) => {
                if report && what.starts_with("Wrong") {
                    println!("seed {number} REFUSED ({kind}): {what}\n{toml}");
                }
                format!("{kind}: refused: {what}")
            }
            Ok(Outcome::Fault(fault)) => {
                if report {
                    println!("seed {number} ({kind}): {fault}\n{toml}");
                }
                faults.push(format!("seed {number} ({kind}): {fault}\n{toml}"));
                format!("{kind}: FAULT")
            }
            Err(_) => {
                faults.push(format!("seed {number} ({kind}): panic\n{toml}"));
                format!("{kind}: PANIC")
            }
        };
        let entry = outcomes.entry(name).or_default();
        (entry.0, entry.1) = (entry.0 + 1, entry.1 + seconds);
    }
    if report {
        for (name, (count, seconds)) in &outcomes {
            println!("{count:7} {seconds:8.2} s  {name}");
        }
        println!("{tried} scenes, slowest: {:.1} s, seed {}", slowest.0, slowest.1);
    }
    let shown = faults.iter().take(20).cloned().collect::<Vec<_>>().join("\n");
    assert!(faults.is_empty(), "{} of {tried} scenes:\n{shown}", faults.len());
    let tables: u64 =
        outcomes.iter().filter(|(n, _)| n.contains(": table")).map(|(_, c)| c.0).sum();
    assert!(3 * tables > tried, "{tables} tables of {tried} scenes: too few to say anything");
}

/// Scenes from numbers.
mod generator {
    use std::f64::consts::TAU;
    use std::fmt::Write;

    /// SplitMix64 (Steele, Lea & Flood 2014).
    pub struct Random(u64);

    impl Random {
        fn next(&mut self) -> u64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        }

        fn unit(&mut self) -> f64 {
            (self.next() >> 11) as f64 / (1u64 << 53) as f64
        }

        fn even(&mut self, from: f64, to: f64) -> f64 {
            from + (to - from) * self.unit()
        }

        fn log(&mut self, from: f64, to: f64) -> f64 {
            self.even(from.ln(), to.ln()).exp()
        }

        fn chance(&mut self, share: f64) -> bool {
            self.unit() < share
        }

        fn of<T: Copy>(&mut self, among: &[T]) -> T {
            among[(self.next() % among.len() as u64) as usize]
        }
    }

    /// Kinds of scenes and how often each comes in ten thousand: those that cost seconds are few.
    const KINDS: [(&str, u32); 11] = [
        ("mie", 3000),
        ("debye", 1500),
        ("mean", 1000),
        ("sun's disc", 60),
        ("rays, sphere", 500),
        ("patches", 300),
        ("nearly a sphere", 15),
        ("spheroid", 20),
        ("raindrop", 10),
        ("refused spheroid", 400),
        ("anything", 3195),
    ];

    /// What is drawn, and how it may be.
    struct Draft {
        shape: String,
        size: String,
        index: [f64; 2],
        wavelengths: Vec<f64>,
        sun: f64,
        light: String,
        table: String,
        model: String,
    }

    /// A scene as TOML, and its kind.
    pub fn scene(number: u64) -> (String, &'static str) {
        let mut random = Random(number.wrapping_mul(0xd134_2543_de82_ef95));
        let mut place = random.next() % 10_000;
        let mut kind = "";
        for (name, share) in KINDS {
            kind = name;
            if place < u64::from(share) {
                break;
            }
            place -= u64::from(share);
        }
        let draft = match kind {
            "mie" => mie(&mut random),
            "debye" => debye(&mut random),
            "mean" => mean(&mut random),
            "sun's disc" => disc(&mut random),
            "rays, sphere" => rays_of_sphere(&mut random),
            "patches" => patches(&mut random),
            "nearly a sphere" => nearly_a_sphere(&mut random),
            "spheroid" => spheroid(&mut random),
            "raindrop" => raindrop(&mut random),
            "refused spheroid" => refused_spheroid(&mut random),
            _ => anything(&mut random),
        };
        (draft.toml(), kind)
    }

    impl Draft {
        fn toml(&self) -> String {
            let mut t = format!("[particle]\nshape = \"{}\"\n{}\n", self.shape, self.size);
            let [n, k] = self.index;
            let _ = writeln!(t, "medium = {{ index = [{n:?}, {k:?}] }}");
            let _ = writeln!(t, "[light]\nsun_elevation_deg = {:?}", self.sun);
            let nm: Vec<String> = self.wavelengths.iter().map(|w| format!("{w:?}")).collect();
            let _ = writeln!(t, "wavelengths_nm = [{}]\n{}", nm.join(", "), self.light);
            let _ = writeln!(t, "[table]\n{}\n[model]\n{}", self.table, self.model);
            t
        }
    }

    fn wavelengths(r: &mut Random) -> Vec<f64> {
        let first = if r.chance(0.1) { r.log(1.0, 1e6) } else { r.log(250.0, 2500.0) };
        let count = r.of(&[1, 1, 1, 2, 3]);
        let step = r.log(1e-3, 0.3);
        let all = (0..count).map(|i| first * (1.0 + step * f64::from(i)));
        all.filter(|nm| *nm <= 1e6).collect()
    }

    /// Micrometres of a size parameter at a wavelength in nanometres.
    fn radius_um(x: f64, nm: f64) -> f64 {
        x * nm * 1e-3 / TAU
    }

    /// Index from 0.5 to 4, with its edges.
    fn real_index(r: &mut Random) -> f64 {
        match r.next() % 10 {
            0 => 1.0 + r.log(1e-7, 0.1),
            1 => 1.0 - r.log(1e-7, 0.1),
            2 => r.of(&[0.5, 1.0, 1.333, 1.5, 4.0, 2.0, 0.75]),
            3 | 4 => r.even(0.5, 1.0),
            5 | 6 => r.even(1.2, 1.6),
            _ => r.log(0.5, 4.0),
        }
    }

    /// k from 0 to 10, with its edges.
    fn k(r: &mut Random) -> f64 {
        match r.next() % 8 {
            0..=3 => 0.0,
            4 => r.of(&[10.0, 1e-300, 1.0, 1e-16]),
            5 => r.log(1e-12, 1e-4),
            _ => r.log(1e-4, 10.0),
        }
    }

    /// k that rays can follow, or nearly.
    fn weak_k(r: &mut Random, n: f64) -> f64 {
        if r.chance(0.6) { 0.0 } else { n * r.log(1e-9, 0.032) }
    }

    fn table(r: &mut Random, most_theta: u32) -> String {
        let count = (r.log(2.0, f64::from(most_theta))) as u32;
        let theta = match r.next() % 8 {
            0 => format!(
                "{{ from = {:?}, to = {:?}, count = {count} }}",
                r.even(0.0, 80.0),
                r.even(90.0, 180.0)
            ),
            1 => "[0, 180]".into(),
            2 => format!("[{:?}, {:?}, 180]", r.log(1e-9, 1.0), r.even(2.0, 179.0)),
            3 => format!("{{ from = 0, to = {:?}, count = {count} }}", r.log(1e-3, 180.0)),
            _ => format!("{{ from = 0, to = 180, count = {most_theta} }}"),
        };
        let azimuth = match r.next() % 6 {
            0 => "[0]".into(),
            1 => format!("[{:?}]", r.even(-360.0, 360.0)),
            2 => format!("[-180, {:?}, 90]", r.even(-170.0, 80.0)),
            _ => format!("{{ from = 0, to = 360, count = {} }}", r.of(&[3, 5, 9, 13])),
        };
        let quantity = r.of(&["phase_function", "phase_function", "mueller"]);
        let peak = r.of(&["cell_average", "cell_average", "point", "separate"]);
        format!(
            "theta_deg = {theta}\nazimuth_deg = {azimuth}\nquantity = \"{quantity}\"\nforward_peak = \"{peak}\""
        )
    }

    fn orders(r: &mut Random) -> String {
        match r.next() % 6 {
            0 => {
                let list: Vec<String> =
                    (0..9).filter(|_| r.chance(0.4)).map(|p: u32| p.to_string()).collect();
                if list.is_empty() { "[50]".into() } else { format!("[{}]", list.join(", ")) }
            }
            1 => format!("[{}]", r.of(&["0", "1", "2", "0, 1, 2, 3", "0, 1", "2, 0", "100"])),
            _ => "\"auto\"".into(),
        }
    }

    fn one_size(r: &mut Random, from: f64, to: f64) -> (String, Vec<f64>) {
        let wavelengths = wavelengths(r);
        let x = r.log(from, to);
        (format!("radius_um = {:?}", radius_um(x, wavelengths[0])), wavelengths)
    }

    fn mie(r: &mut Random) -> Draft {
        let (size, wavelengths) = one_size(r, 1e-4, 1e5);
        let tolerance = r.log(1e-8, 0.5);
        Draft {
            shape: "sphere".into(),
            size,
            index: [real_index(r), k(r)],
            wavelengths,
            sun: r.even(-90.0, 90.0),
            light: String::new(),
            table: table(r, 37),
            model: format!("method = \"{}\"\ntolerance = {tolerance:?}", r.of(&["mie", "auto"])),
        }
    }

    fn debye(r: &mut Random) -> Draft {
        let (size, wavelengths) = one_size(r, 1e-4, 2e4);
        Draft {
            shape: "sphere".into(),
            size,
            index: [real_index(r), k(r)],
            wavelengths,
            sun: r.even(-90.0, 90.0),
            light: String::new(),
            table: table(r, 37),
            model: format!(
                "method = \"debye\"\norders = {}\ntolerance = {:?}",
                orders(r),
                r.log(1e-6, 0.5)
            ),
        }
    }

    fn distribution(r: &mut Random, um: f64) -> String {
        let inside = match r.next() % 6 {
            0 | 1 => format!(
                "kind = \"gamma\", effective_radius_um = {um:?}, effective_variance = {:?}",
                r.log(1e-4, 0.45)
            ),
            2 | 3 => {
                format!(
                    "kind = \"log-normal\", median_radius_um = {um:?}, spread = {:?}",
                    r.log(1e-3, 1.0)
                )
            }
            4 => format!(
                "kind = \"normal\", mean_radius_um = {um:?}, deviation_um = {:?}",
                um * r.log(1e-3, 0.5)
            ),
            _ => match r.next() % 2 {
                0 => format!("kind = \"delta\", radius_um = {um:?}"),
                _ => format!(
                    "kind = \"marshall-palmer\", rain_rate_mm_h = {:?}, from_radius_um = {um:?}, to_radius_um = {:?}",
                    r.log(0.1, 100.0),
                    um * r.log(1.1, 10.0)
                ),
            },
        };
        format!("size_distribution = {{ {inside} }}")
    }

    fn mean(r: &mut Random) -> Draft {
        let wavelengths = vec![r.log(250.0, 2500.0)];
        let um = radius_um(r.log(1e-3, 8.0), wavelengths[0]);
        let light = if r.chance(0.15) {
            format!("bandwidth_nm = {:?}", wavelengths[0] * r.log(1e-3, 0.3))
        } else {
            String::new()
        };
        let size = if !light.is_empty() && r.chance(0.5) {
            format!("radius_um = {um:?}")
        } else {
            distribution(r, um)
        };
        let allow = if r.chance(0.3) { "\nallow_unmet_tolerance = true" } else { "" };
        Draft {
            shape: "sphere".into(),
            size,
            index: [real_index(r), k(r)],
            wavelengths,
            sun: 20.0,
            light,
            table: table(r, 37),
            model: format!("method = \"mie\"\ntolerance = {:?}{allow}", r.log(1e-3, 0.5)),
        }
    }

    fn disc(r: &mut Random) -> Draft {
        let (size, wavelengths) = one_size(r, 1e-3, 200.0);
        Draft {
            light: format!("sun_disc = \"{}\"", r.of(&["uniform", "limb-darkened"])),
            size,
            wavelengths,
            ..mie(r)
        }
    }

    fn rays_of_sphere(r: &mut Random) -> Draft {
        let (mut size, mut wavelengths) = one_size(r, 1.0, 3e3);
        let n = real_index(r);
        if r.chance(0.03) {
            (size, wavelengths) = one_size(r, 3e3, 1e5);
        }
        let orders = orders(r);
        let tolerance = if r.chance(0.05) { r.log(1e-3, 0.02) } else { r.log(0.02, 0.5) };
        Draft {
            shape: "sphere".into(),
            size,
            index: [n, weak_k(r, n)],
            wavelengths: wavelengths[..1].to_vec(),
            sun: 20.0,
            light: String::new(),
            table: table(r, 541),
            model: format!("method = \"rays\"\norders = {orders}\ntolerance = {tolerance:?}"),
        }
    }

    fn patches(r: &mut Random) -> Draft {
        let (mut size, wavelengths) = one_size(r, 1.0, 1e4);
        let mut shape = "sphere";
        if r.chance(0.3) {
            shape = "spheroid";
            let _ = write!(size, "\naxis_ratio = {:?}", r.log(0.2, 3.0));
        } else if r.chance(0.3) {
            shape = "raindrop";
            size = format!("radius_mm = {:?}", r.log(0.3, 4.5));
        }
        let n = real_index(r);
        let (diffraction, interference) = r.of(&[
            ("none", true),
            ("none", false),
            ("gaussian", true),
            ("gaussian", false),
            ("airy", false),
        ]);
        Draft {
            shape: shape.into(),
            size,
            index: [n, weak_k(r, n)],
            wavelengths: wavelengths[..1].to_vec(),
            sun: r.even(-90.0, 90.0),
            light: String::new(),
            table: table(r, 61),
            model: format!(
                "method = \"rays\"\ndiffraction = \"{diffraction}\"\ninterference = {interference}\n\
                 rays_across = {}\norders = {}\ntolerance = {:?}",
                r.log(8.0, 40.0) as u32,
                r.of(&["\"auto\"", "[0, 1, 2]", "[2]", "[0, 1, 2, 3]"]),
                r.log(0.05, 0.5)
            ),
        }
    }

    /// Few orders and angles, so that a deformed particle costs about a second.
    fn deformed(r: &mut Random, from: f64, to: f64) -> Draft {
        let (size, wavelengths) = one_size(r, from, to);
        let n = r.of(&[1.1, 1.31, 1.333, 1.5, 2.0, 0.75]);
        Draft {
            shape: "spheroid".into(),
            size,
            index: [n, weak_k(r, n)],
            wavelengths: wavelengths[..1].to_vec(),
            sun: r.of(&[-90.0, -30.0, 0.0, 0.0, 20.0, 20.0, 55.0, 90.0]),
            light: String::new(),
            table: table(r, 37),
            model: format!(
                "method = \"{}\"\norders = {}\ntolerance = {:?}",
                r.of(&["rays", "auto"]),
                r.of(&["\"auto\"", "\"auto\"", "\"auto\"", "[0, 1]"]),
                r.log(0.1, 0.5)
            ),
        }
    }

    fn nearly_a_sphere(r: &mut Random) -> Draft {
        let mut draft = deformed(r, 10.0, 40.0);
        let off = r.log(1e-6, 1e-3);
        let ratio = 1.0 + r.of(&[-1.0, 1.0]) * off;
        let _ = write!(draft.size, "\naxis_ratio = {ratio:?}");
        draft.table = table(r, 181);
        draft
    }

    fn spheroid(r: &mut Random) -> Draft {
        let mut draft = deformed(r, 5.0, 60.0);
        let ratio = r.log(0.2, 3.0);
        let _ = write!(draft.size, "\naxis_ratio = {ratio:?}");
        draft
    }

    fn raindrop(r: &mut Random) -> Draft {
        let mut draft = deformed(r, 5.0, 60.0);
        draft.shape = "raindrop".into();
        draft.size = format!("radius_mm = {:?}", r.log(0.3, 4.5));
        if r.chance(0.4) {
            // Infrared: size parameters of a few hundred.
            draft.wavelengths = vec![r.log(5e3, 1e6)];
        }
        draft
    }

    /// Absorbing, soft or small particles that are no spheres: rays must say no.
    fn refused_spheroid(r: &mut Random) -> Draft {
        let mut draft = deformed(r, 1e-4, 1e5);
        let ratio = r.log(0.05, 12.0);
        let _ = write!(draft.size, "\naxis_ratio = {ratio:?}");
        match r.next() % 3 {
            0 => draft.index[1] = draft.index[0] * r.log(0.0301, 3.0),
            1 => draft.index[0] = 1.0 + r.of(&[1.0, -1.0]) * r.log(1e-12, 2e-5),
            _ => draft.size = format!("radius_um = 0.001\naxis_ratio = {ratio:?}"),
        }
        draft
    }

    /// Whatever the keys allow, sense or not; the sizes of rays kept small.
    fn anything(r: &mut Random) -> Draft {
        let shape = r.of(&["sphere", "sphere", "sphere", "spheroid", "raindrop"]);
        let method = r.of(&["auto", "auto", "mie", "mie", "debye", "debye", "rays"]);
        let rays = method == "rays" || (method == "auto" && shape != "sphere");
        let mut draft = mie(r);
        draft.shape = shape.into();
        let soft = rays && shape != "sphere";
        if soft {
            // Meridians of deformed particles cost seconds: those that may be refused are tried here.
            draft.index = [draft.index[0], draft.index[0] * r.log(0.05, 3.0)];
        }
        if rays && shape == "sphere" {
            (draft.size, draft.wavelengths) = one_size(r, 0.1, 300.0);
            draft.wavelengths.truncate(1);
        }
        if r.chance(0.15) {
            let um = radius_um(r.log(1e-3, 5.0), draft.wavelengths[0]);
            draft.size = distribution(r, um);
            draft.wavelengths.truncate(1);
        }
        if shape == "raindrop" && r.chance(0.8) {
            draft.size = format!("radius_mm = {:?}", r.log(0.2, 5.0));
        }
        if (shape == "spheroid") == r.chance(0.9) {
            let _ = write!(draft.size, "\naxis_ratio = {:?}", r.log(0.05, 12.0));
        }
        if r.chance(0.05) {
            draft.light = format!("bandwidth_nm = {:?}", draft.wavelengths[0] * r.log(1e-3, 0.6));
            let um = radius_um(r.log(1e-3, 20.0), draft.wavelengths[0]);
            draft.size = format!("radius_um = {um:?}");
        }
        let tolerance = if rays { r.log(0.03, 0.6) } else { r.log(1e-3, 0.6) };
        let mut model = format!("method = \"{method}\"\ntolerance = {tolerance:?}");
        if r.chance(0.3) {
            let _ = write!(model, "\norders = {}", orders(r));
        }
        if r.chance(0.1) {
            let _ = write!(model, "\ndiffraction = \"{}\"", r.of(&["none", "gaussian", "airy"]));
        }
        if r.chance(0.1) {
            let _ = write!(model, "\ninterference = {}", r.chance(0.5));
        }
        if rays || r.chance(0.05) {
            let _ = write!(model, "\nrays_across = {}", r.log(6.0, 40.0) as u32);
        }
        draft.model = model;
        draft
    }
}

/// What is right, by ways of its own.
mod truth {
    use num_complex::Complex64;
    use std::f64::consts::PI;

    /// Efficiencies and asymmetry of a sphere.
    pub struct Sphere {
        pub extinction: f64,
        pub scattering: f64,
        pub asymmetry: f64,
    }

    /// Bohren & Huffman's own program (1983, appendix A): upward in ψ and χ, downward in D.
    pub fn mie(x: f64, m: Complex64) -> Sphere {
        let terms = (x + 4.0 * x.cbrt() + 2.0).ceil() as usize;
        let inside = (m * x).norm();
        let start = terms.max(inside as usize) + (10.0 * inside.cbrt()) as usize + 50;
        let y = m * x;
        let mut d = vec![Complex64::ZERO; start + 1];
        for n in (1..=start).rev() {
            let lead = n as f64 / y;
            d[n - 1] = lead - 1.0 / (d[n] + lead);
        }
        let (mut psi0, mut psi1, mut chi0, mut chi1) = (x.cos(), x.sin(), -x.sin(), x.cos());
        let (mut ext, mut sca, mut g) = (0.0, 0.0, 0.0);
        let mut before: Option<(Complex64, Complex64)> = None;
        for (n, &derivative) in d.iter().enumerate().take(terms + 1).skip(1) {
            let order = n as f64;
            let psi = (2.0 * order - 1.0) * psi1 / x - psi0;
            let chi = (2.0 * order - 1.0) * chi1 / x - chi0;
            let (xi, xi1) = (Complex64::new(psi, -chi), Complex64::new(psi1, -chi1));
            let of = |h: Complex64| (h * psi - psi1) / (h * xi - xi1);
            let a = of(derivative / m + order / x);
            let b = of(derivative * m + order / x);
            ext += (2.0 * order + 1.0) * (a + b).re;
            sca += (2.0 * order + 1.0) * (a.norm_sqr() + b.norm_sqr());
            g += (2.0 * order + 1.0) / (order * (order + 1.0)) * (a * b.conj()).re;
            if let Some((a1, b1)) = before {
                g += (order - 1.0) * (order + 1.0) / order * (a1 * a.conj() + b1 * b.conj()).re;
            }
            before = Some((a, b));
            (psi0, psi1, chi0, chi1) = (psi1, psi, chi1, chi);
        }
        let scale = 2.0 / (x * x);
        Sphere { extinction: scale * ext, scattering: scale * sca, asymmetry: 2.0 * g / sca }
    }

    /// Rayleigh's limit: efficiencies for scattering and absorption, with the next term of the
    /// polarisability (Bohren & Huffman 1983, eq. 5.4).
    pub fn rayleigh(x: f64, m: Complex64) -> (f64, f64) {
        let alpha = (m * m - 1.0) / (m * m + 2.0);
        let next = (m.powu(4) + 27.0 * m * m + 38.0) / (2.0 * m * m + 3.0);
        let absorbed = 4.0 * x * (alpha * (1.0 + x * x / 15.0 * alpha * next)).im;
        (8.0 / 3.0 * x.powi(4) * alpha.norm_sqr(), absorbed)
    }

    /// Silhouette of a spheroid of unit volume radius over π: vertical over horizontal axis, and the
    /// light's elevation.
    pub fn shadow(ratio: f64, elevation: f64) -> f64 {
        let (horizontal, vertical) = (ratio.powf(-1.0 / 3.0), ratio.powf(2.0 / 3.0));
        horizontal * (vertical * elevation.cos()).hypot(horizontal * elevation.sin())
    }

    /// Mean extinction and scattering cross-section and asymmetry over a density of radii, by Simpson's
    /// rule in the logarithm of the radius.
    pub fn mean(
        density: impl Fn(f64) -> f64,
        (from, to): (f64, f64),
        wavenumber: f64,
        m: Complex64,
        steps: usize,
    ) -> [f64; 3] {
        let mut sums = [0.0; 3];
        let width = (to / from).ln() / steps as f64;
        for i in 0..=steps {
            let r = from * (i as f64 * width).exp();
            let simpson = if i == 0 || i == steps { 1.0 } else { [2.0, 4.0][i % 2] };
            let number = density(r) * r * simpson * width / 3.0;
            if number == 0.0 {
                continue;
            }
            let x = wavenumber * r;
            let (q, shadow) = (mie(x, m), PI * r * r * number);
            let (mut extinction, mut scattering, mut g) = (q.extinction, q.scattering, q.asymmetry);
            if x * m.norm().max(1.0) < 0.03 {
                let (sca, abs) = rayleigh(x, m);
                (extinction, scattering, g) = (sca + abs, sca, 0.0);
            }
            sums[0] += shadow * extinction;
            sums[1] += shadow * scattering;
            sums[2] += shadow * scattering * g;
        }
        [sums[0], sums[1], sums[2] / sums[1]]
    }
}

/// Whether a table is sound in itself, and as true as it says.
mod judge {
    use super::truth;
    use gonio::phase_table::{ForwardPeak, PhaseTable, Quantity, Slab, error_theta};
    use gonio::plan::{Engine, Plan};
    use gonio::scene::{Orders, Particle, Scene, SunDisc};
    use gonio::series::debye::{DebyeSeries, Term};
    use gonio::series::lorenz_mie::Sphere;
    use num_complex::Complex64;
    use std::f64::consts::{PI, TAU};

    /// How much larger than stated an error may be.
    const HONEST: f64 = 2.5;

    fn ensure(holds: bool, words: impl FnOnce() -> String) -> Result<(), String> {
        if holds { Ok(()) } else { Err(words()) }
    }

    /// Finite, positive, in balance: without the library's own check.
    pub fn sound(table: &PhaseTable) -> Result<(), String> {
        for slab in &table.slabs {
            let (ext, sca, abs) = (
                slab.extinction_cross_section,
                slab.scattering_cross_section,
                slab.absorption_cross_section,
            );
            ensure([ext, sca, abs, slab.asymmetry].iter().all(|v| v.is_finite()), || {
                format!("cross-sections {ext:e} {sca:e} {abs:e}, g {}", slab.asymmetry)
            })?;
            ensure(sca > 0.0 && abs >= -1e-6 * ext && slab.asymmetry.abs() <= 1.0, || {
                format!("cross-sections {ext:e} {sca:e} {abs:e}, g {}", slab.asymmetry)
            })?;
            ensure((ext - sca - abs).abs() <= 1e-6 * ext, || {
                format!("balance {ext:e} {sca:e} {abs:e}")
            })?;
            ensure(slab.index.im > 0.0 || abs.abs() <= 1e-6 * ext, || {
                format!("a transparent particle absorbs {abs:e} of {ext:e}")
            })?;
            ensure(slab.values.iter().all(|v| v.is_finite()), || "a value is no number".into())?;
            elements(table, slab)?;
            let known = slab.error_estimate.is_finite();
            let met = known.then_some(slab.error_estimate <= table.header.tolerance);
            ensure(slab.tolerance_met == met, || {
                format!("tolerance_met {:?} with {}", slab.tolerance_met, slab.error_estimate)
            })?;
            let whole = table.header.axes.cover_sphere() && slab.left_out == 0.0;
            if whole && table.header.forward_peak == ForwardPeak::CellAverage {
                let sum = slab.sum(&table.header.axes);
                ensure((sum - 1.0).abs() < 1e-3, || format!("P adds up to {sum}"))?;
            }
        }
        Ok(())
    }

    /// S11 is the largest element, and polarised light no more than light.
    fn elements(table: &PhaseTable, slab: &Slab) -> Result<(), String> {
        let (_, thetas, phis) = slab.values.dim();
        for (i, j) in (0..thetas).flat_map(|i| (0..phis).map(move |j| (i, j))) {
            let s = |e: usize| f64::from(slab.values[[e, i, j]]);
            ensure(s(0) >= 0.0, || format!("S11 = {}", s(0)))?;
            if table.header.quantity == Quantity::Mueller {
                let polarised = s(4).hypot(s(8)).hypot(s(12));
                // the last bits of the faintest numbers of f32
                ensure(polarised <= s(0) * (1.0 + 1e-5) + 1e-43, || {
                    format!("unpolarised light leaves polarised by {}", polarised / s(0))
                })?;
            }
        }
        Ok(())
    }

    /// Against whatever truth there is; its name.
    pub fn true_to(scene: &Scene, table: &PhaseTable) -> Result<&'static str, String> {
        let engine = Plan::new(scene).map_err(|e| e.to_string())?.engine;
        let mut by = "no truth";
        for slab in &table.slabs {
            by = match (engine, &scene.particle) {
                (Engine::LorenzMie, _) if is_mean(scene) => mean(scene, slab)?,
                (Engine::LorenzMie, _) => exact(scene, slab)?,
                (Engine::Debye, _) => debye(scene, table, slab)?,
                (_, Particle::Sphere { radius }) => {
                    sphere_by_rays(scene, table, slab, *radius, 0.0)?
                }
                (Engine::Meridians, Particle::Spheroid { radius, axis_ratio }) => {
                    deformed(scene, table, slab, *radius, *axis_ratio)?
                }
                _ => "no truth",
            };
        }
        Ok(by)
    }

    fn is_mean(scene: &Scene) -> bool {
        scene.bandwidth > 0.0
            || scene.size_distribution.as_ref().is_some_and(|sizes| sizes.single().is_none())
    }

    fn close(what: &str, found: f64, right: f64, slack: f64) -> Result<(), String> {
        ensure((found - right).abs() <= slack, || {
            format!(
                "{what} = {found:e}, right is {right:e}, {:e} off with {slack:e} allowed",
                found - right
            )
        })
    }

    /// The series of the program against another one, and Rayleigh's limit.
    fn exact(scene: &Scene, slab: &Slab) -> Result<&'static str, String> {
        // Small raindrops are spheres.
        let (Particle::Sphere { radius }
        | Particle::Raindrop { radius, .. }
        | Particle::Spheroid { radius, .. }
        | Particle::Crystal { radius, .. }
        | Particle::Own { radius, .. }) = scene.particle;
        let (x, m) = (TAU * radius / slab.wavelength, slab.index);
        let shadow = PI * radius * radius;
        let (ext, sca) =
            (slab.extinction_cross_section / shadow, slab.scattering_cross_section / shadow);
        let abs = slab.absorption_cross_section / shadow;
        let inside = x * m.norm().max(1.0);
        if inside < 0.02 {
            let (right, right_abs) = truth::rayleigh(x, m);
            // The next terms are of the order of the squared size parameter inside, over the polarisability.
            let slack = 30.0 * inside * inside;
            let resonant = 3.0 / (m * m + 2.0).norm().min(3.0);
            close("Rayleigh's Q_sca", sca, right, slack * resonant * right)?;
            close(
                "Rayleigh's Q_abs",
                abs,
                right_abs,
                slack * resonant * right_abs.abs() + 1e-12 * sca,
            )?;
            return Ok("Rayleigh");
        }
        if !(0.1..3000.0).contains(&x) || inside > 2e4 {
            return Ok("no truth");
        }
        let right = truth::mie(x, m);
        // The other program's own rounding, seen beside 60 digits: it grows where little is scattered.
        let slack = 1e-7 * (1.0 + inside / 100.0) + 1e-13 / x.powi(3) + 5e-14 / (m - 1.0).norm();
        close("Q_ext", ext, right.extinction, slack * right.extinction.abs())?;
        close("Q_sca", sca, right.scattering, slack * right.extinction.abs())?;
        if scene.sun_disc == SunDisc::None {
            close(
                "g",
                slab.asymmetry,
                right.asymmetry,
                slack * right.extinction / right.scattering,
            )?;
        }
        Ok("another Lorenz–Mie")
    }

    /// The sum of Debye terms against Lorenz–Mie, where an error is stated.
    fn debye(scene: &Scene, table: &PhaseTable, slab: &Slab) -> Result<&'static str, String> {
        exact(scene, slab)?;
        if !slab.error_estimate.is_finite() || slab.error_estimate > 0.3 {
            return Ok("no truth");
        }
        against_mie(scene, table, slab, 0.0)
    }

    /// Extinction by the optical theorem of diffraction and some Debye terms.
    fn extinction_of(list: &[u32], x: f64, m: Complex64) -> Result<f64, String> {
        let terms: Vec<Term> =
            list.iter().map(|&p| Term::Order(p)).chain([Term::Diffraction]).collect();
        let series = DebyeSeries::new(x, m).map_err(|e| e.to_string())?;
        let (s1, s2) = series.sum(&terms, &[0.0])[0];
        Ok(2.0 / (x * x) * (s1 + s2).re)
    }

    fn sphere_by_rays(
        scene: &Scene,
        table: &PhaseTable,
        slab: &Slab,
        radius: f64,
        deformed: f64,
    ) -> Result<&'static str, String> {
        let (x, m) = (TAU * radius / slab.wavelength, slab.index);
        let q = Sphere::new(x, m).map_err(|e| e.to_string())?.efficiencies();
        let shadow = PI * radius * radius;
        let stated = HONEST * slab.error_estimate + scene.tolerance + deformed;
        if stated.is_nan() {
            return Ok("no error stated");
        }
        if scene.diffraction == gonio::scene::Diffraction::Airy
            && scene.interference == gonio::scene::Interference::Waves
        {
            let ext = slab.extinction_cross_section / shadow;
            let right = match &scene.orders {
                Orders::Auto => q.q_ext,
                Orders::List(list) => extinction_of(list, x, m)?,
            };
            close("Q_ext by rays", ext, right, stated * right)?;
            let abs = slab.absorption_cross_section / shadow;
            close("Q_abs by rays", abs, q.q_abs, stated * q.q_ext)?;
        }
        if scene.orders != Orders::Auto || scene.interference != gonio::scene::Interference::Waves {
            return Ok("Q of Lorenz–Mie");
        }
        against_mie(scene, table, slab, deformed)
    }

    /// P from 10° to 170° against Lorenz–Mie within what is stated, and by bands of 4°.
    fn against_mie(
        scene: &Scene,
        table: &PhaseTable,
        slab: &Slab,
        deformed: f64,
    ) -> Result<&'static str, String> {
        let (Particle::Sphere { radius } | Particle::Spheroid { radius, .. }) = scene.particle
        else {
            return Ok("no truth");
        };
        let x = TAU * radius / slab.wavelength;
        let sphere = Sphere::new(x, slab.index).map_err(|e| e.to_string())?;
        let theta = &table.header.axes.theta;
        let scale = 1.0 / (x * x * PI * sphere.efficiencies().q_sca);
        let right: Vec<f64> = sphere
            .amplitudes_parallel(theta)
            .iter()
            .map(|(s1, s2)| 0.5 * (s1.norm_sqr() + s2.norm_sqr()) * scale)
            .collect();
        let found = |i: usize| f64::from(slab.values[[0, i, 0]]);
        // A sample whose cell reaches into twenty lobes of the forward peak is the mean over it.
        let means = table.header.forward_peak == ForwardPeak::CellAverage;
        let first = if means { 25.0 * PI / x } else { 0.0 };
        let inner_edge = |i: usize| 0.5 * (theta[i.max(1) - 1] + theta[i]);
        let (mut off, mut all, mut told, mut counted) = (0.0, 0.0, 0.0, 0);
        let (mut bands, mut stated_bands, mut filled) = (0.0, 0.0, 0);
        let mut i = 0;
        while i < theta.len() && inner_edge(i) < first {
            i += 1;
        }
        while i < theta.len() {
            let band = (theta[i] / error_theta(1)).round() as usize;
            let (mut band_off, mut band_all, mut samples) = (0.0, 0.0, 0);
            while i < theta.len() && (theta[i] / error_theta(1)).round() as usize == band {
                band_off += (found(i) - right[i]).powi(2);
                band_all += right[i].powi(2);
                (samples, i) = (samples + 1, i + 1);
            }
            if (3..43).contains(&band) {
                (off, all, counted) = (off + band_off, all + band_all, counted + samples);
                told += band_all * slab.error_by_direction[band].powi(2);
                if samples >= 8 {
                    bands += (band_off / band_all).min(1.0);
                    stated_bands += slab.error_by_direction[band].powi(2).min(1.0);
                    filled += 1;
                }
            }
        }
        // Some lists have no error.
        if counted < 20 || slab.error_estimate.is_nan() {
            return Ok("Q of Lorenz–Mie");
        }
        // Few samples of many fringes scatter about their mean square.
        let scatter = 1.0 + 4.0 / (counted as f64).sqrt();
        let (error, stated) = ((off / all).sqrt(), (told / all).sqrt());
        close(
            "P from 10 to 170 degrees",
            error,
            0.0,
            HONEST * scatter * stated + scene.tolerance.min(0.1) + deformed,
        )?;
        if filled > 20 {
            let count = f64::from(filled);
            let (error, stated) = ((bands / count).sqrt(), (stated_bands / count).sqrt());
            close("P by bands", error, 0.0, HONEST * stated + scene.tolerance.min(0.1) + deformed)?;
        }
        Ok("P of Lorenz–Mie")
    }

    /// A mean over sizes against Simpson's rule.
    fn mean(scene: &Scene, slab: &Slab) -> Result<&'static str, String> {
        let Some(sizes) = scene.size_distribution.as_ref().filter(|_| scene.bandwidth == 0.0)
        else {
            return Ok("no truth");
        };
        let (m, wavenumber) = (slab.index, TAU / slab.wavelength);
        let (from, to) = sizes.limits(1e-7, wavenumber);
        let largest = wavenumber * to;
        let resonant = m.re > 1.6 && m.im < 0.1;
        if !(0.01..60.0).contains(&largest)
            || resonant && largest > 1.0
            || largest * m.norm() > 300.0
        {
            return Ok("no truth");
        }
        let [ext, sca, g] =
            truth::mean(|r| sizes.density(r), (from.max(1e-6 * to), to), wavenumber, m, 2000);
        let slack = HONEST * slab.error_estimate + 2e-3;
        close("mean extinction", slab.extinction_cross_section, ext, slack * ext)?;
        close("mean scattering", slab.scattering_cross_section, sca, slack * sca)?;
        close("mean asymmetry", slab.asymmetry, g, slack)?;
        Ok("Simpson's rule")
    }

    /// A spheroid that is nearly a sphere against Lorenz–Mie; any against twice its shadow.
    fn deformed(
        scene: &Scene,
        table: &PhaseTable,
        slab: &Slab,
        radius: f64,
        ratio: f64,
    ) -> Result<&'static str, String> {
        let x = TAU * radius / slab.wavelength;
        let shift = 2.0 * x * (slab.index.re - 1.0).abs();
        let off = 2.0 * (ratio - 1.0).abs() * (x + shift);
        if off < 0.02 {
            return sphere_by_rays(scene, table, slab, radius, off);
        }
        let shadow = truth::shadow(ratio, scene.sun_elevation);
        let q = slab.extinction_cross_section / (2.0 * PI * radius * radius * shadow);
        // Light through the middle interferes with the shadow; the edge adds its own.
        let ratio = ratio.max(1.0 / ratio);
        let slack =
            4.0 * ratio / shift + 2.0 * ratio * x.powf(-2.0 / 3.0) + HONEST * slab.error_estimate;
        close("extinction over twice the shadow", q, 1.0, slack)?;
        Ok("shadow")
    }
}
