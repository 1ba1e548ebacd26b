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
mod tests;
