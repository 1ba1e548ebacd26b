//! Ranges of a sweep: `{ from, to, count }`, with `spacing = "log"` if asked, or `{ from, to, step }`.

use super::{BatchError, invalid};
use crate::math::digits::to_digits;
use toml::{Table, Value};

/// Most points of a sweep.
pub(super) const MOST_POINTS: usize = 10_000_000;

/// `{ from, to, count }`, with `spacing = "log"` if asked, or `{ from, to, step }`.
pub(super) fn range_values(key: &str, range: &Table) -> Result<Vec<Value>, BatchError> {
    const ACCEPTED: &str =
        "{ from, to, count } (spacing = \"linear\" or \"log\"), or { from, to, step }";
    let wrong = || invalid(key, Value::Table(range.clone()), ACCEPTED);
    let number = |name: &str| -> Result<Option<f64>, BatchError> {
        match range.get(name) {
            None => Ok(None),
            Some(Value::Float(value)) if value.is_finite() => Ok(Some(*value)),
            Some(Value::Integer(value)) => Ok(Some(*value as f64)),
            Some(_) => Err(wrong()),
        }
    };
    let known = ["from", "to", "count", "step", "spacing"];
    if range.keys().any(|name| !known.contains(&name.as_str())) {
        return Err(wrong());
    }
    let (Some(from), Some(to)) = (number("from")?, number("to")?) else { return Err(wrong()) };
    let log = match range.get("spacing") {
        None => false,
        Some(Value::String(word)) if word == "linear" => false,
        Some(Value::String(word)) if word == "log" => true,
        Some(_) => return Err(wrong()),
    };
    let steps = match (number("count")?, number("step")?) {
        (Some(count), None) if count >= 1.0 && count.fract() == 0.0 => count - 1.0,
        (None, Some(step)) if step != 0.0 && (to - from) / step >= 0.0 => {
            ((to - from) / step * (1.0 + 1e-12)).floor()
        }
        _ => return Err(wrong()),
    };
    if steps >= MOST_POINTS as f64 || (log && !(from > 0.0 && to > 0.0)) {
        return Err(wrong());
    }
    let step = number("step")?;
    let at = |i: usize| {
        let t = if steps > 0.0 { i as f64 / steps } else { 0.0 };
        match step {
            Some(step) => from + step * i as f64,
            None if i as f64 == steps && steps > 0.0 => to,
            None if log => from * (to / from).powf(t),
            None => from + (to - from) * t,
        }
    };
    Ok((0..=steps as usize).map(|i| Value::Float(tidy(at(i)))).collect())
}

/// Free of the noise in the last digits of 0.1 + 0.2, which does not belong into names and hashes.
pub(super) fn tidy(value: f64) -> f64 {
    to_digits(value, 13)
}
