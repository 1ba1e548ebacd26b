//! The drop as a scene for the program and for Python; what the page is to know of the library.

use crate::drop::{Drop, checked};
use crate::message::{Reply, Request, Trouble};
use gonio::medium;
use serde::Deserialize;
use serde_json::json;
use toml::{Table, Value};

#[derive(Deserialize)]
struct Question {
    drop: Drop,
    /// Nothing: the visible.
    wavelength_nm: Option<f64>,
    sun_disc: bool,
}

/// Standard deviations of ln radius that a distribution reaches to.
const REACH: f64 = 3.0;

/// The answer: `toml`, checked by the library, and `python`, which makes a table of it.
///
/// # Errors
/// What the library refuses, by the control.
pub fn scene(request: &Request) -> Result<Reply, Trouble> {
    let asked: Question = request.parsed()?;
    let drop = &asked.drop;
    let mut keys = drop.keys()?;
    if drop.spread > 0.0
        && let Some(particle) = keys["particle"].as_table_mut()
    {
        particle.remove("radius_um");
        let reach = (REACH * drop.spread).exp();
        particle.insert(
            "size_distribution".into(),
            table([
                ("kind", "log-normal".into()),
                ("median_radius_um", drop.radius_um.into()),
                ("spread", drop.spread.into()),
                ("from_radius_um", (drop.radius_um / reach).into()),
                ("to_radius_um", (drop.radius_um * reach).into()),
            ]),
        );
    }
    let wavelengths = match asked.wavelength_nm {
        Some(nm) => Value::Array(vec![nm.into()]),
        None => axis(380.0, 720.0, 33),
    };
    let round = drop.is_round();
    if let Some(light) = keys["light"].as_table_mut() {
        light.insert("wavelengths_nm".into(), wavelengths);
        if round && asked.sun_disc {
            light.insert("sun_disc".into(), "limb-darkened".into());
        }
    }
    let azimuths = if round { Value::Array(vec![0.0.into()]) } else { axis(0.0, 360.0, 73) };
    keys.insert(
        "table".into(),
        table([
            ("theta_deg", axis(0.0, 180.0, 1801)),
            ("azimuth_deg", azimuths),
            ("quantity", "mueller".into()),
        ]),
    );
    keys.insert("model".into(), table([("method", if round { "mie" } else { "rays" }.into())]));
    checked(&keys)?;
    let toml = text(&keys);
    let python = format!(
        "import gonio\n\nscene = \"\"\"\n{toml}\"\"\"\ntable = gonio.table(scene)\nprint(table)\n"
    );
    Ok(Reply::new(json!({ "toml": toml, "python": python })))
}

/// TOML with one line per key.
fn text(keys: &Table) -> String {
    let section = |name: &str| {
        let section = keys.get(name).and_then(Value::as_table).into_iter().flatten();
        let lines: String = section.map(|(key, value)| format!("{key} = {value}\n")).collect();
        format!("[{name}]\n{lines}")
    };
    ["particle", "light", "table", "model"].map(section).join("\n")
}

fn axis(from: f64, to: f64, count: i64) -> Value {
    table([("from", from.into()), ("to", to.into()), ("count", count.into())])
}

fn table<const N: usize>(keys: [(&str, Value); N]) -> Value {
    Value::Table(keys.into_iter().map(|(key, value)| (key.to_string(), value)).collect())
}

/// The version, and media with data in all of the visible.
///
/// # Errors
/// None that is known.
pub fn about() -> Result<Reply, Trouble> {
    let media = medium::list().map_err(|error| Trouble::of(&error))?;
    let names: Vec<String> = (media.into_iter())
        .filter(|entry| entry.range.0 <= 380e-9 && entry.range.1 >= 735e-9)
        .map(|entry| entry.name)
        .collect();
    Ok(Reply::new(json!({ "version": env!("CARGO_PKG_VERSION"), "media": names })))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every kind of drop gives a scene that the library reads back.
    #[test]
    fn scenes_are_read_back() {
        for shape in ["sphere", "spheroid", "raindrop", "layered", "gradient"] {
            for spread in [0.0, 0.1] {
                let question = json!({ "op": "scene", "wavelength_nm": null, "sun_disc": true, "drop": {
                    "shape": shape, "radius_um": 300.0, "axis_ratio": 0.9, "medium": "water",
                    "temperature_c": 10.0, "core_fraction": 0.5, "core_medium": "1.4", "centre_index": 1.34,
                    "surface_index": 1.33, "sun_elevation_deg": 25.0, "spread": spread } });
                let reply = scene(&Request::new(question, Vec::new()));
                let text = match reply {
                    Ok(reply) => String::from_utf8_lossy(&reply.write()).into_owned(),
                    Err(trouble) => panic!("{shape} {spread}: {trouble:?}"),
                };
                assert!(text.contains("import gonio"), "{text}");
            }
        }
    }
}
