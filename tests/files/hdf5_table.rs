//! A table on disk is the table in memory, appears whole or not at all, and equal input gives
//! equal bytes.

use crate::support::{header, slab, table};
use gonio::fault::{Blame, Fault};
use gonio::hdf5::{self, TableError, TableReader, TableWriter, WriteOptions};
use gonio::phase_table::{PhaseTable, Quantity, Slab};
use std::fs;

fn undated() -> WriteOptions {
    WriteOptions { dated: false, ..WriteOptions::default() }
}

fn assert_same(read: &PhaseTable, written: &PhaseTable) {
    let close = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() <= 1e-14 * b.abs(), "{a} {b}");
        }
    };
    close(&read.header.axes.wavelength, &written.header.axes.wavelength);
    close(&read.header.axes.theta, &written.header.axes.theta);
    close(&read.header.axes.phi, &written.header.axes.phi);
    let mut header = read.header.clone();
    close(
        &[header.radius, header.sun_elevation],
        &[written.header.radius, written.header.sun_elevation],
    );
    header.axes = written.header.axes.clone();
    header.radius = written.header.radius;
    header.sun_elevation = written.header.sun_elevation;
    assert_eq!(header, written.header);
    for (a, b) in read.slabs.iter().zip(&written.slabs) {
        close(&[a.wavelength], &[b.wavelength]);
        let mut a = a.clone();
        a.wavelength = b.wavelength;
        assert_eq!(&a, b);
    }
}

#[test]
fn what_is_read_is_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    for (number, quantity) in [Quantity::PhaseFunction, Quantity::Mueller].into_iter().enumerate() {
        for (theta, phi) in [(181, 73), (91, 1), (1001, 1441), (2, 1)] {
            if quantity == Quantity::Mueller && phi > 100 {
                continue;
            }
            for deflate in [0, 1, 9] {
                let table = table(header(3, theta, phi, quantity));
                let path = folder.path().join(format!("{number}-{theta}-{phi}-{deflate}.h5"));
                let options = WriteOptions { deflate, ..WriteOptions::default() };
                hdf5::write(&path, &table, options).unwrap();
                assert_same(&hdf5::read(&path).unwrap(), &table);
            }
        }
    }
}

#[test]
fn slabs_without_mask_or_budget_and_in_any_order() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let mut table = table(header(3, 19, 5, Quantity::PhaseFunction));
    for slab in &mut table.slabs {
        (slab.caustic_order, slab.energy) = (None, None);
    }
    let mut writer = TableWriter::create(&path, &table.header, undated()).unwrap();
    for index in [2, 0, 1] {
        writer.write_slab(index, &table.slabs[index]).unwrap();
    }
    writer.finish().unwrap();
    assert_same(&hdf5::read(&path).unwrap(), &table);
}

#[test]
fn equal_input_gives_equal_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let table = table(header(4, 361, 145, Quantity::Mueller));
    let bytes = |name: &str| {
        let path = folder.path().join(name);
        hdf5::write(&path, &table, undated()).unwrap();
        fs::read(path).unwrap()
    };
    let (first, second) = (bytes("a.h5"), bytes("b.h5"));
    assert!(first == second, "two files of the same table differ");
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert!(single.install(|| bytes("c.h5")) == first, "the number of threads shows");
}

#[test]
fn rounding_keeps_the_bits_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let table = table(header(1, 1801, 361, Quantity::PhaseFunction));
    let size = |name: &str, bit_round| {
        let path = folder.path().join(name);
        let options = WriteOptions { bit_round, ..WriteOptions::default() };
        hdf5::write(&path, &table, options).unwrap();
        (fs::metadata(&path).unwrap().len(), hdf5::read(&path).unwrap())
    };
    let (full, _) = size("full.h5", None);
    let (rounded, read) = size("rounded.h5", Some(10));
    assert!(rounded * 2 < full, "{rounded} of {full} bytes");
    for (a, b) in read.slabs[0].values.iter().zip(&table.slabs[0].values) {
        assert!((a / b - 1.0).abs() <= 0.5f32.powi(11) * 1.001);
    }
    let reader = TableReader::open(&folder.path().join("rounded.h5")).unwrap();
    assert_eq!(reader.bit_round().unwrap(), Some(10));
}

#[test]
fn an_unfinished_table_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let header = header(2, 19, 5, Quantity::PhaseFunction);
    let mut writer = TableWriter::create(&path, &header, undated()).unwrap();
    writer.write_slab(0, &slab(&header, 0)).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file");
    assert!(!path.exists());
    let error = writer.finish().unwrap_err();
    assert!(error.to_string().starts_with("slab = 1"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_file_that_exists_stays_unless_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    fs::write(&path, "mine").unwrap();
    let table = table(header(1, 19, 5, Quantity::PhaseFunction));
    let error = hdf5::write(&path, &table, undated()).unwrap_err();
    assert!(matches!(error, TableError::Exists { .. }), "{error}");
    assert_eq!(error.fault(), Fault::Input);
    assert_eq!(fs::read(&path).unwrap(), b"mine");
    hdf5::write(&path, &table, WriteOptions { overwrite: true, ..undated() }).unwrap();
    assert_same(&hdf5::read(&path).unwrap(), &table);
}

#[test]
fn a_file_that_appears_meanwhile_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let header = header(1, 19, 5, Quantity::PhaseFunction);
    let mut writer = TableWriter::create(&path, &header, undated()).unwrap();
    writer.write_slab(0, &slab(&header, 0)).unwrap();
    fs::write(&path, "theirs").unwrap();
    assert!(matches!(writer.finish(), Err(TableError::Exists { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"theirs");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn wrong_input_names_field_and_value() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    let good = header(2, 19, 5, Quantity::PhaseFunction);
    let create = |change: &dyn Fn(&mut gonio::phase_table::TableHeader)| {
        let mut header = good.clone();
        change(&mut header);
        TableWriter::create(&path, &header, undated()).unwrap_err().to_string()
    };
    assert!(create(&|h| h.axes.wavelength.clear()).starts_with("wavelengths = none"));
    assert!(create(&|h| h.axes.wavelength[1] = f64::NAN).starts_with("wavelength = NaN"));
    assert!(create(&|h| h.axes.theta.clear()).starts_with("theta = none"));
    assert!(create(&|h| h.axes.theta.swap(0, 1)).contains("must ascend"));
    assert!(create(&|h| h.axes.phi[4] = 7.0).starts_with("phi = 7"));
    assert!(create(&|h| h.rotational_symmetry = true).starts_with("phi = 5 azimuths"));

    let mut writer = TableWriter::create(&path, &good, undated()).unwrap();
    let mut refuse = |index, slab: &gonio::phase_table::Slab| {
        writer.write_slab(index, slab).unwrap_err().to_string()
    };
    let first = slab(&good, 0);
    assert!(refuse(7, &first).starts_with("slab = 7: the table has 2 wavelengths"));
    assert!(refuse(1, &first).starts_with("wavelength = "));
    let small = header(2, 18, 5, Quantity::PhaseFunction);
    assert!(refuse(0, &slab(&small, 0)).starts_with("slab shape = (1, 18, 5)"));
}

#[test]
fn a_table_larger_than_the_disk_is_refused_with_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let mut header = header(1000, 19, 5, Quantity::Mueller);
    let line = |count: u32, most: f64| {
        (0..count).map(|i| most * f64::from(i) / f64::from(count)).collect::<Vec<_>>()
    };
    header.axes.theta = line(100_000, 3.0);
    header.axes.phi = line(100_000, 6.0);
    let path = folder.path().join("t.h5");
    let error = TableWriter::create(&path, &header, undated()).unwrap_err();
    assert_eq!(error.fault(), Fault::Input);
    assert!(error.to_string().contains("needs up to 640.0 TB"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// However many ranges of methods there are, they come back (an attribute may be larger than 64 KiB).
#[test]
fn many_methods_are_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.h5");
    let mut written = table(header(600, 2, 1, Quantity::PhaseFunction));
    let first = written.slabs[0].clone();
    for (index, slab) in written.slabs.iter_mut().enumerate() {
        *slab = Slab { wavelength: slab.wavelength, ..first.clone() };
        slab.methods[0].method = format!("method {}", index % 2);
    }
    hdf5::write(&path, &written, undated()).unwrap();
    let text = TableReader::open(&path).unwrap().attribute("methods").unwrap().unwrap();
    assert!(text.len() > 1 << 16, "{} bytes", text.len());
    assert_same(&hdf5::read(&path).unwrap(), &written);
}
