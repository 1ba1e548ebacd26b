//! Whether two tables are of the same particles in the same light: what differs, in words.

use crate::phase_table::PhaseTable;
use toml::{Table, Value};

/// Keys of the light that change what one particle does.
const LIGHT: [&str; 3] = ["sun_elevation_deg", "bandwidth_nm", "sun_disc"];
/// Relative difference below which numbers are the same.
const SAME: f64 = 1e-9;

/// What of the particles and their light differs, first the table's, then the reference's.
pub fn differences(table: &PhaseTable, reference: &PhaseTable) -> Vec<String> {
    let scene = |of: &PhaseTable| of.header.scene_toml.parse::<Table>().unwrap_or_default();
    let (ours, theirs) = (asked(&scene(table)), asked(&scene(reference)));
    if ours.is_empty() || theirs.is_empty() {
        return of_headers(table, reference);
    }
    let mut keys: Vec<&String> = ours.keys().chain(theirs.keys()).collect();
    keys.sort();
    keys.dedup();
    let shown = |value: Option<&Value>| value.map_or("nothing".into(), Value::to_string);
    (keys.into_iter().map(|key| (key, ours.get(key), theirs.get(key))))
        .filter(|(_, one, other)| !same(*one, *other))
        .map(|(key, one, other)| format!("{key} = {} against {}", shown(one), shown(other)))
        .collect()
}

/// The keys of a scene that tell what scatters, by their whole names.
fn asked(scene: &Table) -> Table {
    let section = |name: &str| scene.get(name).and_then(Value::as_table).into_iter().flatten();
    let particle = section("particle").map(|(key, value)| (format!("particle.{key}"), value));
    let light = (section("light").filter(|(key, _)| LIGHT.contains(&key.as_str())))
        .map(|(key, value)| (format!("light.{key}"), value));
    let kinds = scene.get("particles").map(|value| ("particles".to_string(), value));
    particle.chain(light).chain(kinds).map(|(key, value)| (key, value.clone())).collect()
}

fn same(one: Option<&Value>, other: Option<&Value>) -> bool {
    let number = |value: &Value| value.as_float().or(value.as_integer().map(|i| i as f64));
    match (one, other) {
        (Some(one), Some(other)) => match (number(one), number(other)) {
            (Some(a), Some(b)) => near(a, b),
            _ => one == other,
        },
        _ => false,
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// Of tables that do not carry their scenes.
fn of_headers(table: &PhaseTable, reference: &PhaseTable) -> Vec<String> {
    let (one, other) = (&table.header, &reference.header);
    let mut found = Vec::new();
    if one.shape != other.shape {
        found.push(format!("shape {} against {}", one.shape, other.shape));
    }
    if !near(one.radius, other.radius) {
        found.push(format!("radius {} mm against {} mm", one.radius * 1e3, other.radius * 1e3));
    }
    let upright = !(one.rotational_symmetry && other.rotational_symmetry);
    if upright && !near(one.sun_elevation, other.sun_elevation) {
        let [one, other] = [one, other].map(|header| header.sun_elevation.to_degrees());
        found.push(format!("sun at {one}° against {other}°"));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase_table::{Axes, Quantity, TableHeader};

    fn table(radius: f64, scene: &str) -> PhaseTable {
        let axes = Axes { wavelength: vec![5e-7], theta: vec![0.0, 1.0], phi: vec![0.0] };
        let header = TableHeader::of_sphere(radius, axes, Quantity::PhaseFunction);
        let header = TableHeader { scene_toml: scene.into(), ..header };
        PhaseTable { header, slabs: Vec::new() }
    }

    #[test]
    fn other_drops_are_told() {
        let scene = |ratio: &str, more: &str| {
            table(1e-3, &format!("[particle]\nshape = 'spheroid'\naxis_ratio = {ratio}\n{more}"))
        };
        let [one, other] = [scene("0.9", ""), scene("0.8", "canting = 3")];
        let told = differences(&one, &other);
        assert_eq!(told[0], "particle.axis_ratio = 0.9 against 0.8");
        assert_eq!(told[1], "particle.canting = nothing against 3");
        assert_eq!(told.len(), 2);
        // another method, other angles, an integer for a float
        let more = "[light]\nsun_elevation_deg = 20\n[model]\nmethod = 'mie'";
        let less = "[light]\nsun_elevation_deg = 20.0\n[model]\nmethod = 'rays'";
        assert!(differences(&scene("1.0", more), &scene("1", less)).is_empty());
    }

    #[test]
    fn headers_serve_without_scenes() {
        assert!(
            differences(&table(1e-3, ""), &table(1e-3, "[particle]\nshape = 'sphere'")).is_empty()
        );
        let told = differences(&table(1e-3, ""), &table(2e-3, ""));
        assert_eq!(told, ["radius 1 mm against 2 mm"]);
    }
}
