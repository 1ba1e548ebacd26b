//! Disks that are full, fill up, may not be written, and outputs that two programs want: the
//! message, the exit code, and nothing half-written.
//!
//! File systems are mounted in a mount namespace of the test's own (`unshare`), which ends with the
//! command. Where the system does not allow that, those tests say so and check nothing; the limit
//! on the size of files stands for the full disk then.
#![cfg(target_os = "linux")]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const SCENE: &str = "[particle]\nshape = \"sphere\"\nradius_um = 60\n\
    medium = { index = [1.333, 0.0] }\n[light]\nwavelengths_nm = { from = 400, to = 700, count = 7 }\n\
    [table]\ntheta_deg = { from = 0, to = 180, count = 7201 }\nquantity = \"mueller\"\n\
    [model]\nmethod = \"rays\"\n";

const GONIO: &str = env!("CARGO_BIN_EXE_gonio");

fn planned() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("sweep.toml"), SCENE).unwrap();
    let plan = ["batch", "plan", "sweep.toml", "-o", "plan.jsonl"];
    let done = Command::new(GONIO).args(plan).current_dir(folder.path()).output().unwrap();
    assert!(done.status.success());
    folder
}

fn shell(folder: &Path, script: &str) -> Output {
    Command::new("bash").args(["-c", script]).current_dir(folder).output().unwrap()
}

/// What a command answered.
struct Answer {
    code: Option<i32>,
    message: String,
    left: Vec<String>,
}

/// Run `script` with a tmpfs at `disk` of the folder, then list what is left on it; `None` where
/// nothing can be mounted.
fn on_a_disk(folder: &Path, options: &str, script: &str) -> Option<Answer> {
    fs::create_dir_all(folder.join("disk")).unwrap();
    let names = ["-m", "-rm"].into_iter().find(|flags| {
        let probe = format!("unshare {flags} mount -t tmpfs tmpfs disk");
        shell(folder, &probe).status.success()
    });
    let Some(flags) = names else {
        eprintln!("nothing can be mounted here: not checked");
        return None;
    };
    let whole = format!(
        "mount -t tmpfs -o {options} tmpfs disk || exit 99\n{script}\ncode=$?\nls -A disk\nexit $code"
    );
    let output = Command::new("unshare")
        .args([flags, "bash", "-c", &whole])
        .env("GONIO", GONIO)
        .current_dir(folder)
        .output()
        .unwrap();
    let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
    Some(Answer {
        code: output.status.code(),
        message: String::from_utf8_lossy(&output.stderr).into_owned(),
        left: stdout.lines().map(String::from).collect(),
    })
}

#[test]
fn a_disk_too_small_is_refused_before_anything_is_computed() {
    let folder = planned();
    let shard = "$GONIO batch shard --plan plan.jsonl --dir disk --slice 0/1";
    let table = "$GONIO table sweep.toml --no-preview -o disk/t.h5";
    for (command, code) in [(shard, 75), (table, 2)] {
        let Some(answer) = on_a_disk(folder.path(), "size=1m", command) else { return };
        assert_eq!(answer.code, Some(code), "{}", answer.message);
        assert!(answer.message.contains("the disk has 1.0 MB free"), "{}", answer.message);
        assert_eq!(answer.left, Vec::<String>::new());
    }
}

#[test]
fn a_disk_that_fills_up_is_told_and_nothing_is_left() {
    let folder = planned();
    // Once the temporary file is there, something else takes all the room.
    let meanwhile = "pid=$!\nfor _ in $(seq 2000); do ls -A disk | grep -q tmp && break; done\n\
        cat /dev/zero > disk/filler 2>/dev/null\nwait $pid; code=$?; rm disk/filler; (exit $code)";
    let shard = "$GONIO batch shard --plan plan.jsonl --dir disk --slice 0/1 >&2 &";
    let table = "$GONIO table sweep.toml --no-preview -o disk/t.h5 >&2 &";
    for (command, code) in [(shard, 75), (table, 1)] {
        // On a busy machine the filling may come before the program's look, or after its end.
        let mut answers = (0..10)
            .map(|_| on_a_disk(folder.path(), "size=5m", &format!("{command}\n{meanwhile}")));
        let Some(answer) = answers.next().unwrap() else { return };
        let full = |answer: &Answer| answer.message.contains("No space left on device");
        let answer = if full(&answer) {
            answer
        } else {
            answers.flatten().find(full).expect("the disk filled up during none of ten runs")
        };
        assert_eq!(answer.code, Some(code), "{}", answer.message);
        assert!(
            answer.message.contains("disk/") && answer.message.contains(".h5"),
            "{}",
            answer.message
        );
        assert_eq!(answer.left, Vec::<String>::new());
    }
}

#[test]
fn a_read_only_disk_is_told() {
    let folder = planned();
    let shard = "$GONIO batch shard --plan plan.jsonl --dir disk --slice 0/1";
    let run = "$GONIO batch run --plan plan.jsonl --dir disk >/dev/null";
    let merge = "mkdir -p s && $GONIO batch run --plan plan.jsonl --dir s >/dev/null && \
        $GONIO batch merge --plan plan.jsonl --dir s -o disk/m.h5";
    let table = "$GONIO table sweep.toml --no-preview -o disk/t.h5";
    for (command, code) in [(shard, 4), (run, 4), (merge, 4), (table, 1)] {
        let script = format!("mount -o remount,ro disk\n{command}");
        let Some(answer) = on_a_disk(folder.path(), "size=9m", &script) else { return };
        assert_eq!(answer.code, Some(code), "{command}: {}", answer.message);
        assert!(answer.message.contains("Read-only file system"), "{command}: {}", answer.message);
        assert_eq!(answer.left, Vec::<String>::new());
    }
}

#[test]
fn a_limit_on_files_is_an_error_and_leaves_nothing() {
    let folder = planned();
    let script = format!(
        "trap '' XFSZ; ulimit -f 100; exec '{GONIO}' batch shard --plan plan.jsonl --slice 0/1"
    );
    let output = shell(folder.path(), &script);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(4), "{message}");
    assert!(message.contains("cannot be written") && message.contains(".h5"), "{message}");
    assert!(message.contains("File too large"), "{message}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "sweep and plan only");
}

/// A program that a user without rights can run: the tests may run as root, whom no permission
/// stops, out of a folder that nobody else can enter.
fn as_nobody(folder: &Path, arguments: &[&str]) -> Command {
    let program = folder.join("gonio");
    if !program.exists() {
        fs::copy(GONIO, &program).unwrap();
        for path in [folder.to_path_buf(), program.clone()] {
            fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
        }
    }
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder);
    let root = shell(folder, "id -u").stdout == b"0\n";
    if root {
        const NOBODY: u32 = 65_534;
        command.uid(NOBODY).gid(NOBODY);
    }
    command
}

#[test]
fn a_folder_without_permission_is_told() {
    let folder = planned();
    let path = folder.path();
    fs::create_dir(path.join("closed")).unwrap();
    fs::set_permissions(path.join("closed"), fs::Permissions::from_mode(0o555)).unwrap();
    let secret = path.join("secret.jsonl");
    fs::copy(path.join("plan.jsonl"), &secret).unwrap();
    fs::set_permissions(&secret, fs::Permissions::from_mode(0o000)).unwrap();
    let slice = ["--slice", "0/1"];
    let cases: [(Vec<&str>, i32, &str); 5] = [
        (
            [&["batch", "shard", "--plan", "plan.jsonl", "--dir", "closed"], &slice[..]].concat(),
            4,
            "closed/",
        ),
        (
            [&["batch", "shard", "--plan", "plan.jsonl", "--dir", "closed/new"], &slice[..]]
                .concat(),
            4,
            "closed/new",
        ),
        ([&["batch", "shard", "--plan", "secret.jsonl"], &slice[..]].concat(), 4, "secret.jsonl"),
        (vec!["batch", "plan", "sweep.toml", "-o", "closed/p.jsonl"], 4, "closed/p.jsonl"),
        (vec!["table", "sweep.toml", "--no-preview", "-o", "closed/t.h5"], 1, "closed/t.h5"),
    ];
    for (arguments, code, named) in cases {
        let output = as_nobody(path, &arguments).output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
        let told = message.contains("Permission denied") && message.contains(named);
        assert!(told, "{arguments:?}: {message}");
    }
    assert_eq!(fs::read_dir(path.join("closed")).unwrap().count(), 0);
    // A folder that does not exist and cannot be made, even by root.
    let shard =
        ["batch", "shard", "--plan", "plan.jsonl", "--dir", "/proc/nowhere", "--slice", "0/1"];
    let output = Command::new(GONIO).args(shard).current_dir(path).output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stderr).contains("/proc/nowhere"));
}

fn h5_files(folder: &Path) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.to_string_lossy().contains(".h5")).collect()
}

#[test]
fn two_runs_on_one_table_end_with_one_whole_table() {
    let folder = planned();
    let path = folder.path();
    let run = |more: &[&str]| -> Vec<(Option<i32>, String)> {
        let spawn = || {
            Command::new(GONIO)
                .args([&["table", "sweep.toml", "--no-preview", "-o", "t.h5"], more].concat())
                .current_dir(path)
                .stdout(Stdio::null())
                .stderr(Stdio::piped())
                .spawn()
                .unwrap()
        };
        let children: Vec<_> = (0..3).map(|_| spawn()).collect();
        let outputs = children.into_iter().map(|child| child.wait_with_output().unwrap());
        let answer = |output: Output| {
            (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
        };
        outputs.map(answer).collect()
    };
    let answers = run(&[]);
    let won = answers.iter().filter(|(code, _)| *code == Some(0)).count();
    let late = answers
        .iter()
        .filter(|(code, text)| *code == Some(2) && text.contains("t.h5: the file exists"));
    assert_eq!((won, late.count()), (1, 2), "{answers:?}");
    gonio::hdf5::read(&path.join("t.h5")).unwrap();
    let answers = run(&["--overwrite"]);
    assert!(answers.iter().all(|(code, _)| *code == Some(0)), "{answers:?}");
    gonio::hdf5::read(&path.join("t.h5")).unwrap();
    assert_eq!(h5_files(path), [path.join("t.h5")]);
}
