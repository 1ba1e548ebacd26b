//! What drivers of batches rely on: sweeps over any value, zipped or not; exit codes; status; signals;
//! a process that ends with its parent.

use gonio::batch::BatchError;
use gonio::fault::Blame;
use gonio::hdf5::{AxisValues, SweepReader, TableError};
use std::fs;
use std::io::{Error, ErrorKind};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Media, temperatures, models; radius and sun paired.
const SWEEP: &str = "[particle]\nshape = \"sphere\"\n\
    radius_um = { from = 20, to = 80, count = 3, spacing = \"log\" }\nmedium = \"water\"\n\
    temperature_c = { from = 0, to = 30, step = 15 }\n\
    [light]\nsun_elevation_deg = [10, 20, 30]\nwavelengths_nm = [450, 550]\n\
    [table]\ntheta_deg = { from = 0, to = 180, count = 721 }\n\
    [model]\nmethod = [\"mie\", \"rays\"]\n\
    [sweep]\nzip = [\"particle.radius_um\", \"light.sun_elevation_deg\"]\n";

const MEDIA: &str = "[particle]\nshape = \"sphere\"\nradius_um = 2\n\
    medium = [\"water\", { index = [1.5, 0.001] }, \"ice\"]\n[light]\nwavelengths_nm = [550]\n\
    [table]\ntheta_deg = { from = 0, to = 180, count = 721 }\n[model]\nmethod = \"mie\"\n";

/// Long enough to be interrupted.
const LONG: &str = "[particle]\nshape = \"sphere\"\nradius_um = { from = 60, to = 99, count = 40 }\n\
    medium = { index = [1.333, 0.0] }\n[light]\nwavelengths_nm = { from = 400, to = 700, count = 7 }\n\
    [table]\ntheta_deg = { from = 0, to = 180, count = 7201 }\nquantity = \"mueller\"\n\
    [model]\nmethod = \"rays\"\n";

fn gonio(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
    command.args(arguments).current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output: Output = gonio(folder, arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn planned(sweep: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("sweep.toml"), sweep).unwrap();
    succeed(folder.path(), &["batch", "plan", "sweep.toml", "-o", "plan.jsonl"]);
    folder
}

fn merged(folder: &Path) -> SweepReader {
    succeed(folder, &["batch", "run", "--plan", "plan.jsonl"]);
    succeed(folder, &["batch", "merge", "--plan", "plan.jsonl", "-o", "all.h5"]);
    succeed(folder, &["validate", "all.h5"]);
    SweepReader::open(&folder.join("all.h5")).unwrap()
}

#[test]
fn temperature_and_model_with_a_paired_radius() {
    let folder = planned(SWEEP);
    let sweep = merged(folder.path());
    let names: Vec<&str> =
        sweep.axes().iter().map(|axis| axis.coordinates[0].name.as_str()).collect();
    assert_eq!(names, ["radius_um", "temperature", "method"]);
    let numbers = |axis: usize| match &sweep.axes()[axis].coordinates[0].values {
        AxisValues::Numbers(values) => values.clone(),
        AxisValues::Texts(texts) => panic!("{texts:?}"),
    };
    assert_eq!((numbers(0), numbers(1)), (vec![20.0, 40.0, 80.0], vec![0.0, 15.0, 30.0]));
    // Every table is that of its own scene, computed alone.
    let position = [2, 1, 0];
    let alone = ["table", "--shape", "sphere", "--radius-um", "80", "--temperature-c", "15"];
    let more = ["--wavelengths-nm", "450,550", "--theta-deg", "0:180:721", "--method", "mie"];
    let out = ["--sun-elevation-deg", "30", "--no-preview", "-o", "alone.h5"];
    succeed(folder.path(), &[&alone[..], &more, &out].concat());
    let alone = gonio::hdf5::read(&folder.path().join("alone.h5")).unwrap();
    let table = sweep.table(&position).unwrap();
    assert_eq!(table.slabs[1].values, alone.slabs[1].values);
    assert_eq!(table.slabs[1].index, alone.slabs[1].index);
    // The paired value is a coordinate along the radius.
    drop(sweep);
    let file = hdf5::File::open(folder.path().join("all.h5")).unwrap();
    let sun = file.dataset("sun_elevation").unwrap().read_raw::<f64>().unwrap();
    assert_eq!(sun, [10.0, 20.0, 30.0]);
}

#[test]
fn media_by_name_and_by_index() {
    let folder = planned(MEDIA);
    let sweep = merged(folder.path());
    let AxisValues::Texts(media) = &sweep.axes()[0].coordinates[0].values else {
        panic!("an axis of media has words")
    };
    assert_eq!((media[0].as_str(), media[2].as_str()), ("water", "ice"));
    assert!(media[1].contains("1.5"), "{media:?}");
    let index = |at: usize| sweep.table(&[at]).unwrap().slabs[0].index;
    assert!((index(0).re - 1.334).abs() < 2e-3, "{}", index(0));
    assert_eq!((index(1).re, index(1).im), (1.5, 0.001));
    assert!((index(2).re - 1.311).abs() < 2e-3, "{}", index(2));
}

#[test]
fn exit_codes_tell_drivers_what_to_do() {
    let path = || Path::new("t.h5").to_path_buf();
    let io = |kind: ErrorKind| BatchError::Io { path: path(), source: Error::from(kind) };
    let write = |message: &str| TableError::Write { path: path(), message: message.into() };
    let full = || TableError::DiskFull { path: path(), message: "no room".into() };
    let id = || "0123".to_string();
    let cases = [
        (BatchError::Plan { path: path(), message: "line 1".into() }, 2),
        (BatchError::Memory { id: id(), needed: 2, limit: 1 }, 2),
        (BatchError::Table(TableError::Exists { path: path() }), 2),
        (BatchError::Missing { missing: 1, total: 2, first: id() }, 1),
        (io(ErrorKind::PermissionDenied), 4),
        (io(ErrorKind::NotFound), 4),
        (BatchError::Table(write("File too large")), 4),
        (BatchError::Table(TableError::Damaged { path: path(), message: "cut".into() }), 4),
        (BatchError::Numerical { id: id(), wavelength_nm: 500.0 }, 5),
        (io(ErrorKind::StorageFull), 75),
        (io(ErrorKind::StaleNetworkFileHandle), 75),
        (io(ErrorKind::TimedOut), 75),
        (BatchError::Table(full()), 75),
        (BatchError::Table(TableError::NoSpace { path: path(), needed: 2, available: 1 }), 75),
    ];
    for (error, code) in cases {
        assert_eq!(error.exit_code(), code, "{error}");
    }
}

#[test]
fn status_counts_what_is_done_missing_and_broken() {
    let folder = planned(MEDIA);
    let status = || -> serde_json::Value {
        let text = succeed(folder.path(), &["batch", "status", "--plan", "plan.jsonl", "--json"]);
        serde_json::from_str(&text).unwrap()
    };
    assert_eq!((status()["total"].as_u64(), status()["missing"].as_u64()), (Some(3), Some(3)));
    let slice = ["batch", "shard", "--plan", "plan.jsonl", "--slice", "1/3", "--json"];
    let shard: serde_json::Value = serde_json::from_str(&succeed(folder.path(), &slice)).unwrap();
    assert_eq!((shard["status"].as_str(), status()["done"].as_u64()), (Some("computed"), Some(1)));
    let again: serde_json::Value = serde_json::from_str(&succeed(folder.path(), &slice)).unwrap();
    assert_eq!((again["status"].as_str(), &again["id"]), (Some("skipped"), &shard["id"]));
    let missing = status()["missing_ids"].as_array().unwrap().clone();
    let id = missing[0].as_str().unwrap();
    fs::write(folder.path().join(format!("{id}.h5")), "no table").unwrap();
    assert_eq!(status()["invalid_ids"], serde_json::json!([id]));
    succeed(folder.path(), &["batch", "shard", "--plan", "plan.jsonl", "--id", id]);
    assert_eq!((status()["done"].as_u64(), status()["invalid"].as_u64()), (Some(2), Some(0)));
}

#[cfg(unix)]
fn temporaries(folder: &Path) -> usize {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    names.filter(|name| name.to_string_lossy().ends_with(".tmp")).count()
}

/// Wait until the batch is writing.
#[cfg(unix)]
fn await_writing(folder: &Path) {
    let start = Instant::now();
    while temporaries(folder) == 0 {
        assert!(start.elapsed() < Duration::from_secs(60), "the batch does not start");
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_batch_leaves_nothing_half_done_and_goes_on() {
    let folder = planned(LONG);
    for (signal, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        let mut child =
            gonio(folder.path(), &["batch", "run", "--plan", "plan.jsonl"]).spawn().unwrap();
        await_writing(folder.path());
        let kill = format!("kill -{signal} {}", child.id());
        Command::new("sh").args(["-c", &kill]).status().unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(code), "SIG{signal}");
        assert_eq!(temporaries(folder.path()), 0, "SIG{signal}");
    }
    let text = succeed(folder.path(), &["batch", "status", "--plan", "plan.jsonl", "--json"]);
    let status: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(status["invalid"], 0, "{text}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_shard_ends_with_its_parent() {
    let folder = planned(LONG);
    // All forty tables take seconds: the parent is killed during the first.
    let shard = format!(
        "'{}' batch shard --plan plan.jsonl --slice 0/1 --die-with-parent & echo $!; wait",
        env!("CARGO_BIN_EXE_gonio")
    );
    let mut parent = Command::new("sh")
        .args(["-c", &shard])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    await_writing(folder.path());
    let mut line = String::new();
    let mut output = std::io::BufReader::new(parent.stdout.take().unwrap());
    std::io::BufRead::read_line(&mut output, &mut line).unwrap();
    let process = format!("/proc/{}/stat", line.trim());
    assert!(Path::new(&process).exists());
    parent.kill().unwrap();
    parent.wait().unwrap();
    // Gone, or a zombie that nobody has collected yet.
    let ended = || match fs::read_to_string(&process) {
        Ok(text) => text.rsplit(')').next().is_some_and(|rest| rest.trim_start().starts_with('Z')),
        Err(_) => true,
    };
    let start = Instant::now();
    while !ended() {
        assert!(start.elapsed() < Duration::from_secs(20), "the orphan computes on");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(temporaries(folder.path()), 0);
}
