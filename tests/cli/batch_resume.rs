//! A batch that is killed and run again ends with the same bytes as one that was left alone.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

const SWEEP: &str = "[particle]\nshape = \"sphere\"\n\
    radius_um = { from = 30, to = 120, count = 10 }\nmedium = { index = [1.333, 0.0] }\n\
    [light]\nsun_elevation_deg = [0, 10, 20, 30]\nwavelengths_nm = [450, 550, 650]\n\
    [table]\ntheta_deg = { from = 0, to = 180, count = 1801 }\n[model]\nmethod = \"rays\"\n";

fn gonio(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
    command.args(arguments).current_dir(folder).env_remove("SOURCE_DATE_EPOCH");
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    gonio(folder, arguments).output().unwrap()
}

fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn planned(sweep: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("sweep.toml"), sweep).unwrap();
    succeed(folder.path(), &["batch", "plan", "sweep.toml", "-o", "plan.jsonl"]);
    let path = folder.path().to_path_buf();
    (folder, path)
}

fn status(folder: &Path, shards: &str) -> serde_json::Value {
    let text =
        succeed(folder, &["batch", "status", "--plan", "plan.jsonl", "--dir", shards, "--json"]);
    serde_json::from_str(&text).unwrap()
}

/// Numbers that look random and are the same in every run.
fn noise(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

#[test]
fn killed_five_times_and_resumed_gives_the_same_bytes() {
    let (_keep, folder) = planned(SWEEP);
    succeed(&folder, &["batch", "run", "--plan", "plan.jsonl", "--dir", "calm"]);
    let merge = |shards: &str, output: &str| {
        succeed(
            &folder,
            &["batch", "merge", "--plan", "plan.jsonl", "--dir", shards, "-o", output],
        );
        fs::read(folder.join(output)).unwrap()
    };
    let calm = merge("calm", "calm.h5");

    let mut state = 7;
    for _ in 0..5 {
        let mut child = gonio(&folder, &["batch", "run", "--plan", "plan.jsonl", "--dir", "rough"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        sleep(Duration::from_millis(20 + noise(&mut state) % 300));
        child.kill().unwrap();
        child.wait().unwrap();
        let status = status(&folder, "rough");
        assert_eq!(status["invalid"], 0, "a killed process left a half table: {status}");
    }
    let text =
        succeed(&folder, &["batch", "run", "--plan", "plan.jsonl", "--dir", "rough", "--json"]);
    let result: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(result["done"], 40);
    assert!(merge("rough", "rough.h5") == calm, "merged files differ");
}

#[test]
fn slices_backwards_give_the_same_bytes() {
    let sweep = SWEEP.replace("count = 10", "count = 2").replace("1801", "181");
    let (_keep, folder) = planned(&sweep);
    for slice in ["2/3", "1/3", "0/3"] {
        succeed(
            &folder,
            &["batch", "shard", "--plan", "plan.jsonl", "--dir", "a", "--slice", slice],
        );
    }
    succeed(&folder, &["batch", "run", "--plan", "plan.jsonl", "--dir", "b", "--threads", "1"]);
    for shards in ["a", "b"] {
        let output = format!("{shards}.h5");
        succeed(
            &folder,
            &["batch", "merge", "--plan", "plan.jsonl", "--dir", shards, "-o", &output],
        );
    }
    assert!(fs::read(folder.join("a.h5")).unwrap() == fs::read(folder.join("b.h5")).unwrap());
    let again = succeed(
        &folder,
        &["batch", "shard", "--plan", "plan.jsonl", "--dir", "a", "--slice", "0/3"],
    );
    assert!(again.lines().all(|line| line.ends_with(" skipped")), "{again}");
}

#[test]
fn gaps_are_refused_unless_allowed() {
    let sweep = SWEEP.replace("count = 10", "count = 2").replace("1801", "181");
    let (_keep, folder) = planned(&sweep);
    succeed(&folder, &["batch", "shard", "--plan", "plan.jsonl", "--slice", "0/2"]);
    let merge = ["batch", "merge", "--plan", "plan.jsonl", "-o", "t.h5"];
    let refused = run(&folder, &merge);
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1));
    assert!(message.contains("4 of 8 tables are not computed yet"), "{message}");
    assert!(!folder.join("t.h5").exists());
    succeed(&folder, &[&merge[..], &["--allow-missing"]].concat());
    let reader = gonio::hdf5::SweepReader::open(&folder.join("t.h5")).unwrap();
    assert_eq!(reader.present().unwrap().iter().filter(|present| **present).count(), 4);
    assert!(reader.table(&[0, 1]).unwrap().slabs[0].values.iter().all(|v| v.is_nan()));
    assert!(reader.table(&[0, 0]).unwrap().slabs[0].values.iter().all(|v| *v > 0.0));
}

#[test]
fn a_damaged_shard_is_computed_again() {
    let sweep = SWEEP.replace("count = 10", "count = 1").replace("1801", "181");
    let (_keep, folder) = planned(&sweep);
    succeed(&folder, &["batch", "run", "--plan", "plan.jsonl"]);
    let plan = gonio::batch::BatchPlan::read(&folder.join("plan.jsonl")).unwrap();
    let victim = plan.tables[1].file(&folder);
    let whole = fs::read(&victim).unwrap();
    fs::write(&victim, &whole[..whole.len() / 2]).unwrap();
    assert_eq!(status(&folder, ".")["invalid"], 1);
    succeed(&folder, &["batch", "run", "--plan", "plan.jsonl"]);
    assert!(fs::read(&victim).unwrap() == whole);
}

#[test]
fn wrong_input_is_told_with_code_2() {
    let (_keep, folder) = planned(SWEEP);
    let cases: [(&[&str], &str); 7] = [
        (&["batch", "plan", "none.toml", "-o", "p"], "none.toml"),
        (&["batch", "plan", "sweep.toml", "-o", "plan.jsonl"], "the file exists"),
        (&["batch", "shard", "--plan", "none", "--slice", "0/1"], "no such file"),
        (&["batch", "shard", "--plan", "plan.jsonl", "--slice", "3/3"], "3/3"),
        (&["batch", "shard", "--plan", "plan.jsonl", "--id", "zz"], "--id = zz"),
        (&["batch", "shard", "--plan", "sweep.toml", "--slice", "0/1"], "line 1"),
        (&["batch", "status", "--plan", "plan.jsonl", "--bogus"], "--bogus"),
    ];
    for (arguments, expected) in cases {
        let output = run(&folder, arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
    for (bad, expected) in [
        ("radius_um = { from = 30, to = 120, count = 10 }\n", "radius_um = [-1, 2]\n"),
        ("sun_elevation_deg = [0, 10, 20, 30]", "sun_elevation_deg = []"),
        ("radius_um", "radius_yards"),
    ] {
        fs::write(folder.join("bad.toml"), SWEEP.replace(bad, expected)).unwrap();
        let output = run(&folder, &["batch", "plan", "bad.toml", "-o", "bad.jsonl"]);
        assert_eq!(output.status.code(), Some(2), "{expected}");
        assert!(!folder.join("bad.jsonl").exists());
    }
}

/// A table that was made of other data is never taken for the one that is asked for.
#[test]
fn data_that_changed_are_seen() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let data = |n: f64| {
        let rows = format!("wavelength_um,n\n0.4,{n}\n0.5,{n}\n0.6,{n}\n");
        fs::write(folder.join("glass.csv"), rows).unwrap();
    };
    let sweep = "[particle]\nshape = \"sphere\"\nradius_um = [2, 3]\nmedium = { file = \"glass.csv\" }\n\
        [light]\nwavelengths_nm = [500]\n[table]\ntheta_deg = [0, 90, 180]\n";
    fs::write(folder.join("sweep.toml"), sweep).unwrap();
    let plan = |output: &str| {
        succeed(folder, &["batch", "plan", "sweep.toml", "-o", output]);
        fs::read_to_string(folder.join(output)).unwrap()
    };
    let arguments = ["batch", "run", "--plan", "plan.jsonl", "--dir", "shards", "--json"];
    data(1.5);
    let before = plan("plan.jsonl");
    succeed(folder, &arguments);
    data(1.8);
    let refused = run(folder, &arguments);
    let words = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success(), "tables of other glass passed");
    assert!(words.contains("glass.csv changed since the plan was made"), "{words}");
    assert_ne!(plan("again.jsonl"), before);
    data(1.5);
    assert_eq!(plan("third.jsonl"), before);
    let result: serde_json::Value = serde_json::from_str(&succeed(folder, &arguments)).unwrap();
    assert_eq!(result["skipped"], 2, "{result}");
}
