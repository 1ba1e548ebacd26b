//! Files of tests: bodies in every format.

use super::soup::Soup;
use crate::shape::polyhedron::Body;
use glam::DVec3;
use std::fmt::Write;

/// Corners and facets of a body, facets cut into triangles from their first corner where asked.
pub(super) fn soup(body: &Body, triangles: bool) -> Soup {
    let fan = |corners: &[usize]| -> Vec<Vec<usize>> {
        (1..corners.len() - 1).map(|k| vec![corners[0], corners[k], corners[k + 1]]).collect()
    };
    let facets = body.facets().iter().flat_map(|facet| match triangles {
        true => fan(&facet.corners),
        false => vec![facet.corners.clone()],
    });
    Soup { corners: body.vertices().to_vec(), facets: facets.collect() }
}

pub(super) fn obj(soup: &Soup) -> Vec<u8> {
    let mut text = String::from("# a body\no body\n");
    soup.corners.iter().for_each(|v| writeln!(text, "v {:.6} {:.6} {:.6}", v.x, v.y, v.z).unwrap());
    for facet in &soup.facets {
        let corners: Vec<String> = facet.iter().map(|i| (i + 1).to_string()).collect();
        writeln!(text, "f {}", corners.join(" ")).unwrap();
    }
    text.into_bytes()
}

pub(super) fn stl(soup: &Soup, binary: bool) -> Vec<u8> {
    let mut bytes = b"solid body\n".to_vec();
    if binary {
        bytes = [b"solid but binary".to_vec(), vec![b' '; 64]].concat();
        bytes.extend((soup.facets.len() as u32).to_le_bytes());
    }
    for facet in &soup.facets {
        let corners = [0, 1, 2].map(|k| soup.corners[facet[k]]);
        if binary {
            let all = [DVec3::ZERO].into_iter().chain(corners).flat_map(|v| v.to_array());
            bytes.extend(all.flat_map(|x| (x as f32).to_le_bytes()));
            bytes.extend([0, 0]);
        } else {
            let vertex =
                |v: DVec3| format!("vertex {} {} {}\n", v.x as f32, v.y as f32, v.z as f32);
            let text = corners.map(vertex).concat();
            bytes.extend(
                format!("facet normal 0 0 0\nouter loop\n{text}endloop\nendfacet\n").bytes(),
            );
        }
    }
    if !binary {
        bytes.extend(b"endsolid body\n");
    }
    bytes
}

pub(super) fn ply(soup: &Soup, binary: bool) -> Vec<u8> {
    let format = if binary { "binary_big_endian" } else { "ascii" };
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment a body\nelement vertex {}\nproperty double x\nproperty double y\n\
         property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        soup.corners.len(),
        soup.facets.len()
    )
    .into_bytes();
    for v in &soup.corners {
        match binary {
            true => bytes.extend(v.to_array().iter().flat_map(|x| x.to_be_bytes())),
            false => bytes.extend(format!("{} {} {}\n", v.x, v.y, v.z).bytes()),
        }
    }
    for facet in &soup.facets {
        if binary {
            bytes.push(facet.len() as u8);
            bytes.extend(facet.iter().flat_map(|&i| (i as i32).to_be_bytes()));
        } else {
            let corners: Vec<String> = facet.iter().map(ToString::to_string).collect();
            bytes.extend(format!("{} {}\n", facet.len(), corners.join(" ")).bytes());
        }
    }
    bytes
}
