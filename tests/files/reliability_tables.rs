//! Files that are cut, damaged, foreign, or interrupted while written: an answer, never a panic,
//! never half a table under the final name.

use crate::support::{header, table};
use gonio::fault::{Blame, Fault};
use gonio::hdf5::{self, TableError, TableReader, WriteOptions};
use gonio::phase_table::Quantity;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const SCENE: &str = "[particle]\nshape = \"sphere\"\nradius_um = 60\n\
    medium = { index = [1.333, 0.0] }\n[light]\nwavelengths_nm = { from = 400, to = 700, count = 7 }\n\
    [table]\ntheta_deg = { from = 0, to = 180, count = 7201 }\nquantity = \"mueller\"\n\
    [model]\nmethod = \"rays\"\n";

fn noise(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

fn small_file(folder: &Path) -> Vec<u8> {
    let path = folder.join("whole.h5");
    let table = table(header(2, 13, 5, Quantity::Mueller));
    hdf5::write(&path, &table, WriteOptions { dated: false, ..Default::default() }).unwrap();
    fs::read(path).unwrap()
}

#[test]
fn every_truncation_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let whole = small_file(folder.path());
    let path = folder.path().join("cut.h5");
    for length in (0..whole.len()).step_by(97) {
        fs::write(&path, &whole[..length]).unwrap();
        let error = hdf5::read(&path).expect_err("a cut file was read");
        assert!(error.to_string().contains("cut.h5"), "{error}");
    }
}

#[test]
fn foreign_files_are_told_what_they_lack() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("foreign.h5");
    let says = |expected: &str| {
        let error = TableReader::open(&path).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        error
    };
    says("No such file");
    fs::write(&path, "").unwrap();
    assert_eq!(says("too short").fault(), Fault::Input);
    fs::write(&path, "this is a text and no HDF5 file").unwrap();
    assert_eq!(says("not an HDF5 file").fault(), Fault::Input);
    let content = hdf5::NetcdfFile {
        dimensions: vec![("x".into(), 2)],
        variables: vec![hdf5::NetcdfVariable {
            name: "x".into(),
            dimensions: vec!["x".into()],
            values: hdf5::NetcdfValues::F64(vec![1.0, 2.0]),
            attributes: Vec::new(),
        }],
        attributes: Vec::new(),
    };
    hdf5::write_netcdf(&path, &content, true).unwrap();
    assert_eq!(says("no attribute format").fault(), Fault::Input);
    assert!(matches!(TableReader::open(folder.path()), Err(TableError::Foreign { .. })));
}

fn planned(folder: &Path, sweep: &str) {
    fs::write(folder.join("sweep.toml"), sweep).unwrap();
    let done = gonio(folder, &["batch", "plan", "sweep.toml", "-o", "plan.jsonl"]).status();
    assert!(done.unwrap().success());
}

fn gonio(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
    command.args(arguments).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

const SHARD: [&str; 6] = ["batch", "shard", "--plan", "plan.jsonl", "--slice", "0/1"];

/// `GONIO_KILLS` sets how many runs are killed (40 unless told).
#[test]
fn kill_at_any_moment_leaves_a_whole_table_or_none() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = SCENE.replace("radius_um = 60", "radius_um = { from = 30, to = 68, count = 39 }");
    let sweep = sweep.replace("count = 7201", "count = 721").replace("count = 7 }", "count = 2 }");
    planned(folder.path(), &sweep);
    let run = ["batch", "run", "--plan", "plan.jsonl", "--dir"];
    let start = Instant::now();
    assert!(gonio(folder.path(), &[&run[..], &["calm"]].concat()).status().unwrap().success());
    // Up to the time of four tables, on this machine as it is now: some runs end a table, most do not.
    let longest = 4 * start.elapsed().as_micros() as u64 / 39;

    let plan = gonio::batch::BatchPlan::read(&folder.path().join("plan.jsonl")).unwrap();
    let shards = folder.path().join("rough");
    let (mut state, mut done, mut finished) = (3, Vec::new(), 0);
    let kills = std::env::var("GONIO_KILLS").map_or(40, |count| count.parse().unwrap());
    for _ in 0..kills {
        let mut child = gonio(folder.path(), &[&run[..], &["rough"]].concat()).spawn().unwrap();
        sleep(Duration::from_micros(noise(&mut state) % longest));
        let _ = child.kill();
        child.wait().unwrap();
        let files = plan.tables.iter().map(|table| table.file(&shards));
        let now: Vec<_> = files.filter(|file| file.exists()).collect();
        let new = now.iter().filter(|file| !done.contains(*file));
        new.for_each(|file| drop(hdf5::read(file).unwrap()));
        assert!(done.iter().all(|file| now.contains(file)), "a finished table is gone");
        finished += now.len() - done.len();
        done = now;
        if done.len() == plan.tables.len() {
            fs::remove_dir_all(&shards).unwrap();
            done.clear();
        }
    }
    println!("{finished} tables were finished during {kills} killed runs");
    assert!(finished > 0, "every run was killed before it ended a table");
    assert!(gonio(folder.path(), &[&run[..], &["rough"]].concat()).status().unwrap().success());
    for table in &plan.tables {
        let (calm, rough) = (table.file(&folder.path().join("calm")), table.file(&shards));
        assert!(fs::read(calm).unwrap() == fs::read(rough).unwrap(), "{}", table.id);
    }
}

#[cfg(unix)]
#[test]
fn signals_remove_the_temporary_file() {
    let folder = tempfile::tempdir().unwrap();
    planned(folder.path(), SCENE);
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let mut seen = false;
        for delay in [40, 60, 80, 100, 20, 140] {
            let mut child = gonio(folder.path(), &SHARD).spawn().unwrap();
            sleep(Duration::from_millis(delay));
            let kill = format!("kill -{signal} {}", child.id());
            Command::new("sh").args(["-c", &kill]).status().unwrap();
            let status = child.wait().unwrap();
            seen |= status.code() == Some(code);
            let left: Vec<_> =
                fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
            let temporary = left.iter().any(|name| name.to_string_lossy().ends_with(".tmp"));
            assert!(!temporary || status.code().is_none(), "{left:?}");
            for name in left.iter().filter(|name| name.to_string_lossy().ends_with(".h5")) {
                fs::remove_file(folder.path().join(name)).unwrap();
            }
        }
        assert!(seen, "no run was interrupted by SIG{signal}");
    }
}

#[test]
fn two_runs_on_one_folder_do_not_disturb_each_other() {
    let folder = tempfile::tempdir().unwrap();
    planned(folder.path(), SCENE);
    let children: Vec<_> = (0..3).map(|_| gonio(folder.path(), &SHARD).spawn().unwrap()).collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    let plan = gonio::batch::BatchPlan::read(&folder.path().join("plan.jsonl")).unwrap();
    hdf5::read(&plan.tables[0].file(folder.path())).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}
