//! From a sweep file to its points: which values are swept, and the scene of each point.

use super::range::{MOST_POINTS, range_values};
use super::{BatchError, invalid};
use crate::hdf5::position_of;
use crate::scene::{line_at, read_limited};
use std::collections::HashSet;
use std::path::Path;
use toml::{Table, Value};

/// Values that vary together: one key, or several that are paired (`[sweep] zip`).
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Dotted keys, such as `particle.radius_mm`.
    pub keys: Vec<String>,
    /// Per key, its values; all of the same length.
    pub values: Vec<Vec<Value>>,
}

impl Axis {
    /// Number of points along the axis.
    pub fn len(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// True where no value is swept.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A sweep: what stays and what varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    fixed: Table,
    /// The swept values, in the order of the merged table's dimensions.
    pub axes: Vec<Axis>,
}

impl Sweep {
    /// Read a sweep file.
    ///
    /// # Errors
    /// When it cannot be read, is too large for a sweep, and as for [`Sweep::parse`].
    pub fn load(path: &Path) -> Result<Sweep, BatchError> {
        let wrong = |error: String| BatchError::Plan { path: path.to_path_buf(), message: error };
        let text = read_limited(path).map_err(|error| wrong(error.to_string()))?;
        Sweep::parse(&text).map_err(|error| wrong(error.to_string()))
    }

    /// Read the text of a sweep file.
    ///
    /// # Errors
    /// When the text is no TOML, a range is wrong, or paired lists differ in length.
    pub fn parse(text: &str) -> Result<Sweep, BatchError> {
        let mut fixed: Table = text.parse().map_err(|error: toml::de::Error| {
            let line = error.span().map_or(0, |span| line_at(text, span.start));
            invalid("line", line, &error.message().trim().replace('\n', ", "))
        })?;
        let zip = zip_groups(fixed.remove("sweep"))?;
        let mut axes: Vec<Axis> = Vec::new();
        // Particle before light before model: the order of the dimensions of the merged table.
        for section in ["particle", "light", "model"] {
            let Some(Value::Table(keys)) = fixed.get(section) else { continue };
            for (key, value) in keys {
                let dotted = format!("{section}.{key}");
                if let (SIZES, Value::Table(distribution)) = (dotted.as_str(), value) {
                    axes.extend(distribution_axes(distribution)?);
                    continue;
                }
                if let Some(values) = swept_values(&dotted, value)? {
                    axes.push(Axis { keys: vec![dotted], values: vec![values] });
                }
            }
        }
        for group in zip {
            pair(&mut axes, &group)?;
        }
        let points = axes.iter().try_fold(1usize, |product, axis| product.checked_mul(axis.len()));
        match points {
            Some(0) => Err(invalid("sweep", "an empty list", "at least one value per list")),
            Some(points) if points <= MOST_POINTS => {
                axes.iter().try_for_each(stands_twice)?;
                Ok(Sweep { fixed, axes })
            }
            _ => {
                let accepted = format!("at most {MOST_POINTS} tables");
                Err(invalid("sweep", "the product of its lists", &accepted))
            }
        }
    }

    /// Number of points along each axis.
    pub fn shape(&self) -> Vec<usize> {
        self.axes.iter().map(Axis::len).collect()
    }

    /// Number of tables.
    pub fn points(&self) -> usize {
        self.shape().iter().product()
    }

    /// Index per axis of the point number `index`; the last axis is the fastest.
    pub fn position(&self, index: usize) -> Vec<usize> {
        position_of(index, &self.shape())
    }

    /// The scene file of a point.
    pub fn scene(&self, position: &[usize]) -> String {
        let mut scene = self.fixed.clone();
        for (axis, &at) in self.axes.iter().zip(position) {
            for (key, values) in axis.keys.iter().zip(&axis.values) {
                let Some((section, name)) = key.split_once('.') else { continue };
                let Some(Value::Table(keys)) = scene.get_mut(section) else { continue };
                match name.split_once('.') {
                    None => {
                        keys.insert(name.into(), values[at].clone());
                    }
                    Some((table, inner)) => {
                        if let Some(Value::Table(keys)) = keys.get_mut(table) {
                            keys.insert(inner.into(), values[at].clone());
                        }
                    }
                }
            }
        }
        scene.to_string()
    }
}

/// The key whose table may hold lists too: a sweep over effective radii, say, in one distribution.
const SIZES: &str = "particle.size_distribution";
/// Its lists that are data and not swept.
const DATA: [&str; 2] = ["number", "file"];

/// The axes within a distribution of sizes.
fn distribution_axes(distribution: &Table) -> Result<Vec<Axis>, BatchError> {
    let mut axes = Vec::new();
    let is_data = |key: &str| DATA.contains(&key) || key.starts_with("edges_");
    for (key, value) in distribution.iter().filter(|(key, _)| !is_data(key)) {
        let dotted = format!("{SIZES}.{key}");
        if let Some(values) = swept_values(&dotted, value)? {
            axes.push(Axis { keys: vec![dotted], values: vec![values] });
        }
    }
    Ok(axes)
}

/// The values of a key that is swept; `None` for one that is not.
fn swept_values(key: &str, value: &Value) -> Result<Option<Vec<Value>>, BatchError> {
    match (key, value) {
        ("light.wavelengths_nm" | "light.frequencies_ghz", _) => Ok(None),
        // A list of numbers is one choice of orders; a sweep lists such lists (or "auto").
        ("model.orders", Value::Array(list)) if list.iter().all(Value::is_integer) => Ok(None),
        (_, Value::Array(list)) => Ok(Some(list.clone())),
        (_, Value::Table(range)) if range.contains_key("from") => {
            range_values(key, range).map(Some)
        }
        _ => Ok(None),
    }
}

/// `[sweep] zip = ["a", "b"]` or `[["a", "b"], ["c", "d"]]`.
fn zip_groups(sweep: Option<Value>) -> Result<Vec<Vec<String>>, BatchError> {
    const ACCEPTED: &str = "zip = [\"particle.radius_mm\", \"light.sun_elevation_deg\"]";
    let Some(sweep) = sweep else { return Ok(Vec::new()) };
    let wrong = || invalid("sweep", sweep.to_string().trim(), ACCEPTED);
    let Value::Table(keys) = &sweep else { return Err(wrong()) };
    if keys.keys().any(|key| key != "zip") {
        return Err(wrong());
    }
    let Some(zip) = keys.get("zip") else { return Ok(Vec::new()) };
    let list = zip.as_array().ok_or_else(wrong)?;
    let names = |list: &[Value]| -> Result<Vec<String>, BatchError> {
        list.iter().map(|name| name.as_str().map(String::from).ok_or_else(wrong)).collect()
    };
    if list.iter().all(Value::is_array) {
        list.iter().map(|group| names(group.as_array().ok_or_else(wrong)?)).collect()
    } else {
        Ok(vec![names(list)?])
    }
}

/// Refuse a value, or a row of paired ones, that a list holds twice: the same table would be made twice,
/// and the merged file would have two places of one name.
fn stands_twice(axis: &Axis) -> Result<(), BatchError> {
    let row =
        |i: usize| axis.values.iter().map(|v| v[i].to_string()).collect::<Vec<_>>().join(", ");
    let mut seen = HashSet::new();
    for i in 0..axis.len() {
        let row = row(i);
        if !seen.insert(row.clone()) {
            return Err(invalid(&axis.keys.join(", "), row, "each value once"));
        }
    }
    Ok(())
}

/// Join the axes of these keys into one.
fn pair(axes: &mut Vec<Axis>, group: &[String]) -> Result<(), BatchError> {
    let mut joined: Option<Axis> = None;
    for (place, key) in group.iter().enumerate() {
        if group[..place].contains(key) {
            return Err(invalid("sweep.zip", key, "each key once"));
        }
        let Some(at) = axes.iter().position(|axis| axis.keys == [key.clone()]) else {
            return Err(invalid("sweep.zip", key, "a key whose value is a list or a range"));
        };
        match &mut joined {
            None => joined = Some(axes[at].clone()),
            Some(joined) => {
                let axis = axes.remove(at);
                if axis.len() != joined.len() {
                    let accepted =
                        format!("{} values, as many as {}", joined.len(), joined.keys[0]);
                    return Err(invalid(key, format!("{} values", axis.len()), &accepted));
                }
                joined.keys.extend(axis.keys);
                joined.values.extend(axis.values);
            }
        }
    }
    if let Some(joined) = joined {
        let first = |axis: &&mut Axis| axis.keys[0] == joined.keys[0];
        if let Some(axis) = axes.iter_mut().find(first) {
            *axis = joined;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SWEEP: &str = "[particle]\nshape = \"raindrop\"\nradius_mm = { from = 0.1, to = 1, count = 10 }\n\
        medium = [\"water\", { index = [1.33, 0.0] }]\n[light]\nsun_elevation_deg = [0, 20]\n\
        wavelengths_nm = [400, 500]\n[model]\norders = [0, 1, 2]\n";

    #[test]
    fn lists_and_ranges_multiply() {
        let sweep = Sweep::parse(SWEEP).unwrap();
        let keys: Vec<_> = sweep.axes.iter().map(|axis| axis.keys[0].as_str()).collect();
        assert_eq!(keys, ["particle.medium", "particle.radius_mm", "light.sun_elevation_deg"]);
        assert_eq!((sweep.shape(), sweep.points()), (vec![2, 10, 2], 40));
        assert_eq!(sweep.position(39), [1, 9, 1]);
        assert_eq!(sweep.position(2), [0, 1, 0]);
        let scene: Table = sweep.scene(&[1, 2, 1]).parse().unwrap();
        assert_eq!(scene["particle"]["radius_mm"].as_float(), Some(0.3));
        assert_eq!(scene["light"]["sun_elevation_deg"].as_integer(), Some(20));
        assert_eq!(scene["light"]["wavelengths_nm"].as_array().unwrap().len(), 2);
        assert_eq!(scene["model"]["orders"].as_array().unwrap().len(), 3);
        assert!(scene["particle"]["medium"].is_table());
    }

    #[test]
    fn parameters_of_a_distribution_are_swept() {
        let text = "[particle]\nshape = \"sphere\"\nsize_distribution = { kind = \"gamma\", \
            effective_radius_um = [5, 10], effective_variance = { from = 0.05, to = 0.1, count = 2 } }";
        let sweep = Sweep::parse(text).unwrap();
        let keys: Vec<_> = sweep.axes.iter().map(|axis| axis.keys[0].as_str()).collect();
        assert_eq!(
            keys,
            [
                "particle.size_distribution.effective_radius_um",
                "particle.size_distribution.effective_variance",
            ]
        );
        let scene: Table = sweep.scene(&[1, 0]).parse().unwrap();
        let sizes = &scene["particle"]["size_distribution"];
        assert_eq!(sizes["effective_radius_um"].as_integer(), Some(10));
        assert_eq!(sizes["effective_variance"].as_float(), Some(0.05));
        assert_eq!(sizes["kind"].as_str(), Some("gamma"));
    }

    #[test]
    fn ranges_by_step_and_by_logarithm() {
        let values = |range: &str| {
            let sweep = Sweep::parse(&format!("[particle]\nradius_mm = {range}"))?;
            let values: Vec<f64> =
                sweep.axes[0].values[0].iter().map(|v| v.as_float().unwrap()).collect();
            Ok::<_, BatchError>(values)
        };
        assert_eq!(
            values("{ from = 0.1, to = 0.5, step = 0.1 }").unwrap(),
            [0.1, 0.2, 0.3, 0.4, 0.5]
        );
        assert_eq!(
            values("{ from = 0.01, to = 1, count = 3, spacing = \"log\" }").unwrap(),
            [0.01, 0.1, 1.0]
        );
        assert_eq!(values("{ from = 5, to = 9, count = 1 }").unwrap(), [5.0]);
        for bad in [
            "{ from = 0, to = 1, count = 3, spacing = \"log\" }",
            "{ from = 0, to = 1, count = 0 }",
            "{ from = 0, to = 1, count = 1.5 }",
            "{ from = 0, to = 1, step = -1 }",
            "{ from = 0, to = nan, count = 2 }",
            "{ from = 0, to = 1, count = 1e9 }",
            "{ from = 0, to = 1, count = 2, bogus = 1 }",
            "[]",
        ] {
            assert!(values(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_value_twice_is_refused() {
        let twice = SWEEP.replace("[0, 20]", "[0, 20, 0]");
        let error = Sweep::parse(&twice).unwrap_err().to_string();
        assert!(error.contains("light.sun_elevation_deg = 0: each value once"), "{error}");
    }

    #[test]
    fn zipped_values_go_together() {
        let text = SWEEP.replace("count = 10", "count = 2");
        let zip = "[sweep]\nzip = [\"particle.radius_mm\", \"light.sun_elevation_deg\"]\n";
        let sweep = Sweep::parse(&format!("{text}{zip}")).unwrap();
        assert_eq!(sweep.shape(), [2, 2]);
        assert_eq!(sweep.axes[1].keys, ["particle.radius_mm", "light.sun_elevation_deg"]);
        let error = Sweep::parse(&format!("{SWEEP}{zip}")).unwrap_err().to_string();
        assert!(error.contains("2 values: 10 values, as many as particle.radius_mm"), "{error}");
        let twice = zip.replace("light.sun_elevation_deg", "particle.radius_mm");
        let error = Sweep::parse(&format!("{text}{twice}")).unwrap_err().to_string();
        assert!(error.contains("each key once"), "{error}");
        let error = Sweep::parse("[sweep]\nzip = [\"particle.shape\"]").unwrap_err().to_string();
        assert!(error.starts_with("sweep.zip = particle.shape"), "{error}");
    }

    proptest! {
        #[test]
        fn any_text_is_answered(text in "\\PC{0,200}") {
            let _ = Sweep::parse(&text);
        }

        #[test]
        fn any_range_is_answered(from in any::<f64>(), to in any::<f64>(), count in any::<f64>()) {
            let _ = Sweep::parse(&format!(
                "[particle]\nradius_mm = {{ from = {from:e}, to = {to:e}, count = {count:e} }}"
            ));
        }
    }
}
