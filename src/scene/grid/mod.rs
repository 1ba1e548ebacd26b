//! Coordinates of an axis as they are written: a list, `{ from, to, count }` with both ends in, or
//! `{ from, to, step }`;
//! and the list of orders.

mod range;

pub use range::{Range, Third};

use super::Orders;
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor, value};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// Most points of one axis; more is a slip of the pen, and would be refused as too large anyway.
const MAX_COUNT: u64 = 10_000_000;

/// Values of one axis, in the unit of its key.
#[derive(Clone, Debug, PartialEq)]
pub enum Grid {
    /// The values themselves.
    List(Vec<f64>),
    /// Evenly spaced, both ends included.
    Range {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// Number of values, both ends among them.
        count: u64,
    },
}

#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RangeKeys {
    from: f64,
    to: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<f64>,
}

impl Grid {
    /// Of a range as typed; one of steps ends at its last value.
    fn of(range: Range) -> Result<Self, String> {
        let Range { from, to, third } = range;
        match third {
            Third::Count(count) if count.fract() == 0.0 && count >= 0.0 => {
                Ok(Grid::Range { from, to, count: count as u64 })
            }
            Third::Count(count) => Err(format!("\"{count}\" is not a whole number of points")),
            Third::Step(step) if step > 0.0 && to > from => {
                let steps = range.steps();
                let end = from + steps * step;
                // what rounding leaves to the end is none
                let to = if to - end < 1e-6 * step { to } else { end };
                Ok(Grid::Range { from, to, count: steps as u64 + 1 })
            }
            Third::Step(step) => Err(format!(
                "step {step} from {from} to {to}: `from` below `to`, and a step above 0"
            )),
        }
    }

    /// The coordinates, finite and at least one.
    ///
    /// # Errors
    /// What would be accepted instead.
    pub fn values(&self) -> Result<Vec<f64>, String> {
        match self {
            Grid::List(values) if values.is_empty() => {
                Err("the list is empty; give at least one value".into())
            }
            Grid::List(values) => match values.iter().find(|value| !value.is_finite()) {
                Some(value) => Err(format!("{value} is not a finite number")),
                None => Ok(values.clone()),
            },
            Grid::Range { from, to, count } => range(*from, *to, *count),
        }
    }
}

fn range(from: f64, to: f64, count: u64) -> Result<Vec<f64>, String> {
    if !(from.is_finite() && to.is_finite()) {
        return Err("`from` and `to` must be finite numbers".into());
    }
    if count == 0 || count > MAX_COUNT {
        return Err(format!("`count` must be 1 to {MAX_COUNT}"));
    }
    if count == 1 {
        return if from == to {
            Ok(vec![from])
        } else {
            Err("`count` = 1 takes one value; `from` and `to` differ".into())
        };
    }
    if from >= to {
        return Err("`from` must be less than `to`".into());
    }
    let last = (count - 1) as f64;
    // The weighted mean keeps both ends exact, and is symmetric in them.
    Ok((0..count).map(|i| (from * (last - i as f64) + to * i as f64) / last).collect())
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Grid::List(values) => {
                write!(f, "[")?;
                for (i, value) in values.iter().take(4).enumerate() {
                    write!(f, "{}{value}", if i == 0 { "" } else { ", " })?;
                }
                write!(f, "{}]", if values.len() > 4 { ", …" } else { "" })
            }
            Grid::Range { from, to, count } => {
                write!(f, "{{ from = {from}, to = {to}, count = {count} }}")
            }
        }
    }
}

/// As on the command line: `FROM:TO:COUNT`, `FROM:TO:sSTEP` or `A,B,C`.
impl FromStr for Grid {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| {
            part.trim().parse::<f64>().map_err(|_| format!("\"{part}\" is not a number"))
        };
        if let Ok(words) = <[&str; 3]>::try_from(text.split(':').collect::<Vec<_>>()) {
            let range = Range::parse(words, Third::Count)
                .map_err(|word| format!("\"{word}\" is not a number"))?;
            return Grid::of(range);
        }
        if text.contains(':') {
            return Err("accepted: FROM:TO:COUNT, FROM:TO:sSTEP, or a list A,B,C".into());
        }
        text.split(',').map(number).collect::<Result<_, _>>().map(Grid::List)
    }
}

impl Serialize for Grid {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Grid::List(values) => values.serialize(serializer),
            Grid::Range { from, to, count } => {
                let (from, to, count) = (*from, *to, Some(*count));
                RangeKeys { from, to, count, step: None }.serialize(serializer)
            }
        }
    }
}

impl<'de> Deserialize<'de> for Grid {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(GridVisitor)
    }
}

struct GridVisitor;

impl<'de> Visitor<'de> for GridVisitor {
    type Value = Grid;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(
            "a list of numbers, { from = …, to = …, count = … } or { from = …, to = …, step = … }",
        )
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Grid, A::Error> {
        Vec::deserialize(value::SeqAccessDeserializer::new(seq)).map(Grid::List)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Grid, A::Error> {
        let RangeKeys { from, to, count, step } =
            RangeKeys::deserialize(value::MapAccessDeserializer::new(map))?;
        match (count, step) {
            (Some(count), None) => Ok(Grid::Range { from, to, count }),
            (None, Some(step)) => {
                Grid::of(Range { from, to, third: Third::Step(step) }).map_err(A::Error::custom)
            }
            _ => Err(A::Error::custom(
                "one of `count` and `step` is accepted beside `from` and `to`",
            )),
        }
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Grid, E> {
        Ok(Grid::List(vec![value]))
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Grid, E> {
        Ok(Grid::List(vec![value as f64]))
    }
}

/// `auto` or a list of orders, as on the command line.
impl FromStr for Orders {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.trim() == "auto" {
            return Ok(Orders::Auto);
        }
        let order = |part: &str| {
            part.trim().parse().map_err(|_| {
                format!("\"{part}\" is not an order; accepted: auto, or a list such as 0,1,2")
            })
        };
        text.split(',').map(order).collect::<Result<_, _>>().map(Orders::List)
    }
}

impl Serialize for Orders {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Orders::Auto => serializer.serialize_str("auto"),
            Orders::List(orders) => orders.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Orders {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OrdersVisitor)
    }
}

struct OrdersVisitor;

impl<'de> Visitor<'de> for OrdersVisitor {
    type Value = Orders;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("\"auto\" or a list of whole numbers such as [0, 1, 2]")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Orders, E> {
        if text == "auto" {
            Ok(Orders::Auto)
        } else {
            Err(E::invalid_value(serde::de::Unexpected::Str(text), &self))
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Orders, A::Error> {
        Vec::deserialize(value::SeqAccessDeserializer::new(seq))
            .map(Orders::List)
            .map_err(A::Error::custom)
    }
}
