//! Readers against inputs that nobody meant: sound files with bytes changed, cut, repeated and
//! swapped. Whatever comes, a reader answers: no panic, no crash, and within [`LONGEST`].
//!
//! `GONIO_FUZZ=1000000` sets how many inputs each reader gets (a few thousand by default),
//! `GONIO_FUZZ_SEED` the sequence. An input that fails is kept and named.

use crate::support::{header, table};
use gonio::batch::{BatchPlan, Sweep};
use gonio::hdf5::{self, AxisValues, SweepAxis, SweepCoordinate, SweepReader, SweepWriter};
use gonio::medium::MediumSpec;
use gonio::phase_table::Quantity;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::shape::{Mesh, MeshFormat};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// No input may take more of the processor's time, nor (asleep, or on a busy machine) more than ten
/// times as long.
const LONGEST: Duration = Duration::from_secs(20);

const SCENE: &str = include_str!("../../data/scenes/raindrop.toml");
const SPHEROID: &str = include_str!("../../data/scenes/spheroid.toml");
const SWEEP: &str = "[particle]\nshape = \"sphere\"\nradius_um = { from = 30, to = 120, count = 3 }\n\
    medium = [\"water\", { index = [1.333, 0.0] }]\n[light]\nsun_elevation_deg = [0, 10, 20]\n\
    wavelengths_nm = { from = 400, to = 700, count = 7 }\n[table]\nquantity = \"mueller\"\n\
    theta_deg = { from = 0, to = 180, count = 181 }\n[model]\nmethod = \"rays\"\n\
    [sweep]\nzip = [\"particle.radius_um\", \"light.sun_elevation_deg\"]\n";
const GLASS: &str = "REFERENCES: |\n    A. Author\nDATA:\n  - type: formula 2\n\
    \x20   wavelength_range: 0.3 2.5\n    coefficients: 0 1.03961212 0.0060006 0.2317 0.0200179\n\
    \x20 - type: tabulated k\n    data: |\n        0.300 2.8607E-06\n        0.400 1.0E-08\n\
    \x20       2.500 1.0E-05\nSPECS:\n    n_is_absolute: false\n";
const TABULATED: &str = "COMMENTS: \"x\"\nDATA:\n  - type: tabulated nk\n    data: |\n\
    \x20     0.4 1.5 0.1\n      0.5 1.4 0.2\n      0.6 1.35 0.0\n";
const CSV: &str = "# source: somebody\nwavelength_nm,n,k\n400,1.33,1e-9\n500,1.32,2e-9\n\
    600,1.31,3e-9\n700,1.30,4e-9\n";
/// The downloads of refractiveindex.info, decimal commas, quotes, permittivities, UTF-16, old Macs.
const SITE: &str = "wl,n\n0.4,1.50\n0.5,1.49\n0.6,1.48\n\nwl,k\n0.4,0.001\n0.5,0.002\n";
const COMMAS: &str = "\"Wavelength, um\";n;k\n0,40;1,50;0,001\n0,50;1,49;0,002 # c\n0,60;1,48;0\n";
const EPSILON: &str = "! a\renergy_eV\teps1\teps2\r3.0D0\t2.25\t0.003\r2.0D0\t2.22\t0.006\r";
const AGF: &str = "CC a maker\nNM F2 2 620364.360 1.62004 36.37 0 1\n\
    CD 1.34533359 0.00997743871 0.209073176 0.0470450767 0.937357162 111.886764 0 0\n\
    LD 0.32 2.5\nIT 0.32 0.0 25\nIT 0.4 0.985 25\nIT 0.7 0.998 25\n";
const WORDS: [&[u8]; 30] = [
    b"nan",
    b"inf",
    b"-1",
    b"1e308",
    b"1e-320",
    b"[[[[[[[[",
    b"{{",
    b"]",
    b"}",
    b"\"",
    b"'''",
    b"=",
    b"\n",
    b"0x",
    b"99999999999999999999",
    b"1e9",
    b"\xff\xfe",
    b"\0",
    b"# ",
    b"- ",
    b": ",
    b"&a",
    b"*a",
    b"<<",
    b"|",
    b"\t",
    b"zip",
    b"count",
    b"9999999999",
    b"\xe2\x88\x9e",
];

/// A linear congruential generator (Knuth's MMIX).
struct Noise(u64);

impl Noise {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound.max(1)
    }

    /// Change `bytes` in one place or, less often, up to four.
    fn mutate(&mut self, bytes: &mut Vec<u8>) {
        for _ in 0..1 + self.below(8).saturating_sub(4) {
            let at = self.below(bytes.len());
            let end = (at + self.below(64)).min(bytes.len());
            match self.below(9) {
                _ if bytes.is_empty() => return,
                0 => bytes[at] ^= 1 << self.below(8),
                1 => bytes[at] = self.below(256) as u8,
                2 => bytes[at] = 0xff,
                3 => bytes[at..end].fill(0),
                4 => bytes[at..end].fill(0xff),
                5 => {
                    let word = WORDS[self.below(WORDS.len())];
                    bytes.splice(at..at, word.iter().copied());
                }
                6 => {
                    // Over what is there, so that everything behind keeps its place.
                    let word = WORDS[self.below(WORDS.len())];
                    let room = word.len().min(bytes.len() - at);
                    bytes[at..at + room].copy_from_slice(&word[..room]);
                }
                7 => {
                    let from = self.below(bytes.len() - (end - at) + 1);
                    bytes.copy_within(from..from + (end - at), at);
                }
                _ if self.below(8) == 0 => bytes.truncate(at),
                _ => drop(bytes.drain(at..end)),
            }
        }
    }
}

/// Calls `stop` where one input takes too long; ends with the fuzzing.
struct Watchdog {
    input: Arc<AtomicU64>,
    done: Arc<AtomicBool>,
}

impl Watchdog {
    fn start(what: &'static str, file: PathBuf) -> Watchdog {
        let (input, done) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicBool::new(false)));
        let dog = Watchdog { input: input.clone(), done: done.clone() };
        std::thread::spawn(move || {
            let mut last = (0, Instant::now(), processor_time());
            while !done.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(200));
                let now = input.load(Ordering::Relaxed);
                if now != last.0 {
                    last = (now, Instant::now(), processor_time());
                    continue;
                }
                let spent = processor_time().saturating_sub(last.2);
                if spent > LONGEST || last.1.elapsed() > 10 * LONGEST {
                    eprintln!("{what}: input {now} is not answered: {}", file.display());
                    std::process::abort();
                }
            }
        });
        dog
    }
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
    }
}

/// Time that the process has had of the processor; none where the system does not say.
fn processor_time() -> Duration {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // User and system time are the 14th and 15th fields, in hundredths of a second on Linux; the
    // second field, the name, may hold blanks.
    let fields = text.rsplit(')').next().unwrap_or_default().split_whitespace();
    Duration::from_millis(
        10 * fields.skip(11).take(2).filter_map(|t| t.parse::<u64>().ok()).sum::<u64>(),
    )
}

fn environment(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// A folder in memory where the system has a place for that: the disk would be the slowest part.
fn folder() -> tempfile::TempDir {
    let memory = Path::new("/dev/shm");
    if memory.is_dir() {
        tempfile::tempdir_in(memory).unwrap()
    } else {
        tempfile::tempdir().unwrap()
    }
}

/// Give `read` mutations of `seeds`, each also as the file `name`; it tells whether it took them.
fn fuzz(
    what: &'static str,
    default: u64,
    name: &str,
    seeds: &[Vec<u8>],
    mut read: impl FnMut(&Path, &[u8]) -> bool,
) {
    let folder = folder();
    let file = folder.path().join(name);
    let rounds = environment("GONIO_FUZZ", default);
    let mut noise = Noise(environment("GONIO_FUZZ_SEED", 1));
    let dog = Watchdog::start(what, file.clone());
    let mut taken = 0u64;
    for round in 0..rounds {
        let mut bytes = seeds[round as usize % seeds.len()].clone();
        noise.mutate(&mut bytes);
        fs::write(&file, &bytes).unwrap();
        dog.input.store(round + 1, Ordering::Relaxed);
        match catch_unwind(AssertUnwindSafe(|| read(&file, &bytes))) {
            Ok(good) => taken += u64::from(good),
            Err(panic) => {
                let kept = std::env::temp_dir().join(format!("gonio_fuzz_{what}"));
                fs::write(&kept, &bytes).unwrap();
                eprintln!("{what}: input {round} kept as {}", kept.display());
                resume_unwind(panic);
            }
        }
    }
    println!("{what}: {rounds} inputs, {taken} taken, the others refused");
    // Were all refused, or none, the inputs would test nothing.
    assert!(
        rounds < 1000 || (rounds / 100 < taken && taken < rounds),
        "{what}: {taken} of {rounds}"
    );
}

fn texts(seeds: &[&str]) -> Vec<Vec<u8>> {
    seeds.iter().map(|seed| seed.as_bytes().to_vec()).collect()
}

#[test]
fn scenes() {
    fuzz("scene", 20_000, "scene.toml", &texts(&[SCENE, SPHEROID]), |path, bytes| {
        let Ok(text) = std::str::from_utf8(bytes) else {
            return Scene::load(path, &SceneFile::default()).is_ok();
        };
        let scene = SceneText::parse("fuzz", text.to_string());
        scene.is_ok_and(|scene| Scene::from_text(scene, &SceneFile::default()).is_ok())
    });
}

#[test]
fn sweeps() {
    fuzz("sweep", 10_000, "sweep.toml", &texts(&[SWEEP]), |_, bytes| {
        let text = String::from_utf8_lossy(bytes);
        let Ok(sweep) = Sweep::parse(&text) else { return false };
        let _ = sweep.scene(&sweep.position(sweep.points() - 1));
        if sweep.points() < 50 {
            let _ = BatchPlan::from_sweep(&sweep);
        }
        true
    });
}

#[test]
fn plans() {
    let folder = folder();
    let sweep = SWEEP.replace("[\"water\", {", "{");
    let sweep = sweep.replace("0.0] }]", "0.0] }");
    let plan = BatchPlan::from_sweep(&Sweep::parse(&sweep).unwrap()).unwrap();
    let whole = folder.path().join("plan.jsonl");
    plan.write(&whole, false).unwrap();
    fuzz("plan", 10_000, "plan.jsonl", &[fs::read(&whole).unwrap()], |path, _| {
        BatchPlan::read(path).is_ok()
    });
}

fn optical_data(what: &'static str, name: &str, seeds: &[Vec<u8>]) {
    let spec = MediumSpec::parse(&format!("{{ file = \"{name}\", extrapolate = true }}")).unwrap();
    fuzz(what, 10_000, name, seeds, |path, _| {
        let medium = spec.resolve(path.parent().unwrap());
        medium.is_ok_and(|medium| medium.index(0.5e-6).is_ok())
    });
}

#[test]
fn refractive_index_info() {
    optical_data("yaml", "medium.yml", &texts(&[GLASS, TABULATED]));
}

#[test]
fn optical_csv() {
    let mut seeds = texts(&[CSV, SITE, COMMAS, EPSILON]);
    seeds.push(CSV.encode_utf16().flat_map(u16::to_le_bytes).collect());
    optical_data("csv", "medium.csv", &seeds);
}

#[test]
fn zemax_catalogue() {
    optical_data("agf", "medium.agf", &texts(&[AGF]));
}

/// Two tables over an axis of words, without dates.
fn sweep_file(folder: &Path) -> Vec<u8> {
    let path = folder.join("sweep.h5");
    let words = AxisValues::Texts(vec!["water".into(), "a longer name, such as an oil's".into()]);
    let medium = SweepCoordinate { name: "medium".into(), units: String::new(), values: words };
    let axes = [SweepAxis { coordinates: vec![medium] }];
    let options = hdf5::WriteOptions { dated: false, ..Default::default() };
    let header = header(1, 5, 1, Quantity::PhaseFunction);
    let mut writer = SweepWriter::create(&path, &header, &axes, &options).unwrap();
    for (index, slab) in table(header.clone()).slabs.iter().enumerate() {
        writer.write_slab(&[1], index, slab).unwrap();
    }
    writer.finish().unwrap();
    fs::read(path).unwrap()
}

#[test]
fn tables() {
    let folder = folder();
    let write = |name: &str, header| {
        let path = folder.path().join(name);
        let options = hdf5::WriteOptions { dated: false, ..Default::default() };
        hdf5::write(&path, &table(header), options).unwrap();
        fs::read(path).unwrap()
    };
    let seeds = [
        write("mueller.h5", header(2, 13, 5, Quantity::Mueller)),
        write("phase.h5", header(1, 5, 1, Quantity::PhaseFunction)),
        sweep_file(folder.path()),
        // A table opened and saved again by xarray: attributes are strings of any length.
        include_bytes!("../data/tables/resaved_h5netcdf.h5").to_vec(),
    ];
    fuzz("table", 4000, "table.h5", &seeds, |path, _| {
        let table = hdf5::read(path).is_ok();
        let sweep = SweepReader::open(path).is_ok_and(|sweep| {
            let present = sweep.present().is_ok();
            sweep.table(&vec![0; sweep.axes().len()]).is_ok() && present
        });
        table || sweep
    });
}

/// A hexagonal plate of quarter heights: corners, and its facets as polygons.
fn plate() -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let ring = |z: f64| {
        (0..6).map(move |k| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_3).sin_cos();
            [cos, sin, z]
        })
    };
    let sides = (0..6).map(|k| vec![k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k]);
    let ends = [(0..6).rev().collect(), (6..12).collect()];
    (ring(-0.25).chain(ring(0.25)).collect(), sides.chain(ends).collect())
}

fn triangles(facets: &[Vec<usize>]) -> Vec<[usize; 3]> {
    facets.iter().flat_map(|f| (1..f.len() - 1).map(|k| [f[0], f[k], f[k + 1]])).collect()
}

fn mesh(what: &'static str, format: MeshFormat, seeds: &[Vec<u8>]) {
    fuzz(what, 10_000, "mesh", seeds, |_, bytes| Mesh::parse("mesh", format, bytes).is_ok());
}

#[test]
fn meshes_obj() {
    let (corners, facets) = plate();
    let mut text = String::from("# plate\nmtllib plate.mtl\no plate\n");
    corners.iter().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    text += "vn 0 0 1\nvt 0 1\ns off\nusemtl ice\n";
    let of = |facet: &Vec<usize>, word: &dyn Fn(usize) -> String| -> String {
        let words: Vec<String> = facet.iter().map(|&i| word(i)).collect();
        format!("f {}\n", words.join(" "))
    };
    let plain: String = facets.iter().map(|f| of(f, &|i| (i + 1).to_string())).collect();
    let full: String =
        facets.iter().map(|f| of(f, &|i| format!("{}/1/1", i as i64 - 12))).collect();
    mesh("obj", MeshFormat::Obj, &texts(&[&(text.clone() + &plain), &(text + &full)]));
}

#[test]
fn meshes_stl() {
    let (corners, facets) = plate();
    let facets = triangles(&facets);
    let mut text = String::from("solid plate\n");
    let mut binary = [vec![b'-'; 80], (facets.len() as u32).to_le_bytes().to_vec()].concat();
    for facet in facets {
        text += "facet normal 0 0 1\nouter loop\n";
        binary.extend([0; 12]);
        for [x, y, z] in facet.map(|i| corners[i].map(|x| x as f32)) {
            text += &format!("vertex {x} {y} {z}\n");
            binary.extend([x, y, z].iter().flat_map(|x| x.to_le_bytes()));
        }
        text += "endloop\nendfacet\n";
        binary.extend([0; 2]);
    }
    text += "endsolid plate\n";
    mesh("stl", MeshFormat::Stl, &[text.into_bytes(), binary]);
}

#[test]
fn meshes_ply() {
    let (corners, facets) = plate();
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment plate\nelement vertex 12\nproperty float x\nproperty double y\n\
             property float z\nproperty uchar red\nelement face 8\nproperty list uchar int vertex_indices\n\
             end_header\n"
        )
    };
    let mut text = header("ascii");
    let mut big = header("binary_big_endian").into_bytes();
    let mut little = header("binary_little_endian").into_bytes();
    for [x, y, z] in &corners {
        text += &format!("{x} {y} {z} 7\n");
        let (u, w) = (*x as f32, *z as f32);
        big.extend([&u.to_be_bytes()[..], &y.to_be_bytes(), &w.to_be_bytes(), &[7]].concat());
        little.extend([&u.to_le_bytes()[..], &y.to_le_bytes(), &w.to_le_bytes(), &[7]].concat());
    }
    for facet in &facets {
        let words: Vec<String> = facet.iter().map(ToString::to_string).collect();
        text += &format!("{} {}\n", facet.len(), words.join(" "));
        big.push(facet.len() as u8);
        little.push(facet.len() as u8);
        for &i in facet {
            big.extend((i as i32).to_be_bytes());
            little.extend((i as i32).to_le_bytes());
        }
    }
    mesh("ply", MeshFormat::Ply, &[text.into_bytes(), big, little]);
}
