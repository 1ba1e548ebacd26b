//! Tests of `mesh`.

use super::*;
use std::f64::consts::PI;

fn parsed(format: Format, bytes: &[u8]) -> Mesh {
    Mesh::parse("body", format, bytes).unwrap()
}

/// The same body by every format, in polygons or in triangles: the facets that it has, and its size.
#[test]
fn every_format_holds_the_same_body() {
    for (body, facets, corners) in [
        (Body::hexagonal_column(0.4).unwrap(), 8, 12),
        (Body::bullet(1.3, 0.98).unwrap(), 13, 13),
        (Body::brilliant().unwrap(), 73, 57),
    ] {
        let (polygons, triangles) = (samples::soup(&body, false), samples::soup(&body, true));
        for (format, bytes) in [
            (Format::Obj, samples::obj(&polygons)),
            (Format::Obj, samples::obj(&triangles)),
            (Format::Stl, samples::stl(&triangles, false)),
            (Format::Stl, samples::stl(&triangles, true)),
            (Format::Ply, samples::ply(&polygons, false)),
            (Format::Ply, samples::ply(&triangles, true)),
        ] {
            let mesh = parsed(format, &bytes);
            assert_eq!(mesh.body().facets().len(), facets, "{format:?}");
            assert_eq!(mesh.body().vertices().len(), corners, "{format:?}");
            assert!((mesh.radius() - 1.0).abs() < 3e-6, "{}", mesh.radius());
            assert!((mesh.body().surface() / body.surface() - 1.0).abs() < 1e-5);
            assert!((mesh.body().volume() - 4.0 / 3.0 * PI).abs() < 1e-12);
        }
    }
}

/// A cube whose faces are 2 · 20² triangles each has six facets and eight corners.
#[test]
fn facets_of_one_plane_are_joined() {
    let mesh = parsed(Format::Obj, &samples::obj(&grid(20)));
    assert_eq!(mesh.facets_of_file(), 4800);
    assert_eq!((mesh.body().facets().len(), mesh.body().vertices().len()), (6, 8));
    // of side 2
    assert!((mesh.radius() - (6.0 / PI).cbrt()).abs() < 1e-5);
}

/// A cube of side 2 about (5, 0, 0), every face a grid of triangles, corners as often as faces have them.
fn grid(n: usize) -> Soup {
    let mut soup = Soup::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let base = soup.corners.len();
            for i in 0..=n {
                for j in 0..=n {
                    let [u, v] = [i, j].map(|k| 2.0 * k as f64 / n as f64 - 1.0);
                    let mut at = [0.0; 3];
                    at[axis] = sign;
                    at[(axis + 1) % 3] = u;
                    at[(axis + 2) % 3] = v * sign;
                    soup.corners.push(DVec3::from_array(at) + 5.0 * DVec3::X);
                }
            }
            let at = |i: usize, j: usize| base + i * (n + 1) + j;
            for i in 0..n {
                for j in 0..n {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    soup.facets.extend([vec![a, b, c], vec![a, c, d]]);
                }
            }
        }
    }
    soup
}

/// Each fault by its own name and facet.
#[test]
fn faults_of_meshes_name_the_facet() {
    let good = samples::soup(&Body::hexagonal_column(1.0).unwrap(), true);
    let with = |change: &dyn Fn(&mut Soup)| {
        let mut soup = good.clone();
        change(&mut soup);
        Mesh::of("body", soup).unwrap_err().to_string()
    };
    let flipped = with(&|soup| soup.facets[6].reverse());
    assert!(flipped.starts_with("facet 7: turned inside out"), "{flipped}");
    let open = with(&|soup| drop(soup.facets.remove(19)));
    assert!(open.starts_with("facet ") && open.contains("open at its edge from ("), "{open}");
    let line = with(&|soup| soup.facets[4][2] = soup.facets[4][1]);
    assert!(line.starts_with("facet 5: it has no area"), "{line}");
    let none = with(&|soup| soup.facets[2][0] = 77);
    assert_eq!(none, "facet 3: it names corner 78, and there are 12");
    for value in [1e300, f64::INFINITY, f64::NAN] {
        let huge = with(&|soup| soup.corners[3].x = value);
        assert!(huge.contains("vertex 4") && huge.contains("below 1e100"), "{huge}");
    }
    let dent = with(&|soup| {
        // the top is a fan about a corner of its own, pulled inwards
        soup.corners.push(DVec3::new(0.0, 0.0, 0.1));
        let top = soup.corners.iter().map(|v| v.z).fold(0.0, f64::max);
        let ring: Vec<usize> = (0..12).filter(|&i| soup.corners[i].z > top - 1e-9).collect();
        soup.facets.retain(|f| !f.iter().all(|i| ring.contains(i)));
        soup.facets.extend((0..6).map(|k| vec![ring[k], ring[(k + 1) % 6], 12]));
    });
    assert!(dent.starts_with("facet ") && dent.contains("not convex"), "{dent}");
    let inside_out = with(&|soup| soup.facets.iter_mut().for_each(|f| f.reverse()));
    assert!(inside_out.starts_with("all facets are turned inside out"), "{inside_out}");
    let two = with(&|soup| {
        let far: Vec<DVec3> = soup.corners.iter().map(|v| *v + 9.0 * DVec3::X).collect();
        soup.corners.extend(far);
        let more: Vec<Vec<usize>> =
            soup.facets.iter().map(|f| f.iter().map(|i| i + 12).collect()).collect();
        soup.facets.extend(more);
    });
    assert!(two.contains("not convex"), "{two}");
    let flat = with(&|soup| soup.corners.iter_mut().for_each(|v| v.z *= 1e-9));
    assert!(flat.contains("no area") || flat.contains("thickness"), "{flat}");
}

/// What is too large is refused by what it says of itself, before it is read.
#[test]
fn masses_of_facets_are_refused() {
    let mut stl = vec![b' '; 80];
    stl.extend(400_000u32.to_le_bytes());
    stl.resize(84 + 50 * 400_000, 0);
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1000000\nproperty list uchar int vertex_indices\nend_header\n";
    let endless =
        "ply\nformat binary_little_endian 1.0\nelement nothing 999999999999\nend_header\n";
    let obj = "f 1 2 3\n".repeat(250_000);
    for (format, bytes, words) in [
        (Format::Stl, stl.as_slice(), "400000 facets, for which 0.2 GB would be taken"),
        (Format::Ply, ply.as_bytes(), "1000000 facets, for which 0.5 GB"),
        (Format::Ply, endless.as_bytes(), "element nothing has 999999999999 rows"),
        (Format::Obj, obj.as_bytes(), "250000 facets"),
        (Format::Obj, b"v 0 0 0\nf 1 2 99999999999\n", "line 2: \"99999999999\" is no corner"),
        (Format::Obj, b"", "0 flat facets"),
        (Format::Stl, b"solid ", "not read as STL"),
    ] {
        let error = Mesh::parse("body", format, bytes).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    assert_eq!(Mesh::load(Path::new("a.step")).unwrap_err(), MeshError::Ending);
}

/// What never ends is left where it is too long.
#[cfg(unix)]
#[test]
fn files_without_an_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let endless = folder.path().join("endless.obj");
    std::os::unix::fs::symlink("/dev/zero", &endless).unwrap();
    let error = Mesh::load(&endless).unwrap_err();
    assert!(matches!(error, MeshError::TooLong { .. }), "{error}");
}
