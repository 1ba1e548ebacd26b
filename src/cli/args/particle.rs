//! One particle as `gonio scatter` and `gonio rays` take it: its shape, its index, its orders.

use crate::cli::failure::{Failure, Result};
use clap::ValueEnum;
use gonio::scatter::DebyeTerms;
use gonio::scene::Named;
use gonio::shape::RaindropModel;
use num_complex::Complex64;

/// What the particle is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShapeKind {
    Sphere,
    Raindrop,
    Spheroid,
}

/// Flags that go with one shape only.
pub struct ShapeFlags<'a> {
    pub shape: ShapeKind,
    pub axis_ratio: Option<f64>,
    pub model: Option<&'a str>,
}

impl ShapeFlags<'_> {
    /// Refuses those of another shape.
    pub fn check(&self) -> Result<()> {
        let shape = match self.shape {
            ShapeKind::Sphere => "sphere",
            ShapeKind::Spheroid => "spheroid",
            ShapeKind::Raindrop => "raindrop",
        };
        match (self.axis_ratio, self.model) {
            (Some(ratio), _) if self.shape != ShapeKind::Spheroid => Err(Failure::usage(format!(
                "--axis-ratio {ratio}: only a spheroid has an axis ratio; the shape is {shape}"
            ))),
            (_, Some(model)) if self.shape != ShapeKind::Raindrop => Err(Failure::usage(format!(
                "--model {model}: only a raindrop has a shape model; the shape is {shape}"
            ))),
            _ => Ok(()),
        }
    }
}

/// The raindrop model of a name; without one, that of scenes.
pub fn raindrop_model(name: Option<&str>) -> Result<RaindropModel> {
    let Some(name) = name else { return Ok(RaindropModel::BeardChuang1987) };
    let known = RaindropModel::NAMES;
    known.iter().find(|(word, _)| *word == name).map(|(_, model)| *model).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        Failure::usage(format!("--model {name}: {} are accepted", words.join(" and ")))
    })
}

/// An index given on the command line.
#[derive(Clone, Copy, Debug)]
pub struct Index(pub Complex64);

/// `1.333` or `1.333+0.001` (n+ik), as in [`gonio::medium::parse_index`].
pub fn parse_index(text: &str) -> Result<Index, String> {
    gonio::medium::parse_index(text).map(Index).map_err(|error| error.to_string())
}

/// `auto`, or a list of orders with or without the word `diffraction`.
pub fn parse_orders(text: &str) -> Result<DebyeTerms, String> {
    if text == "auto" {
        return Ok(DebyeTerms::default());
    }
    let (mut orders, mut diffraction) = (Vec::new(), false);
    for word in text.split(',').map(str::trim) {
        match word.parse::<u32>() {
            Ok(order) if order <= 1000 => orders.push(order),
            _ if word == "diffraction" => diffraction = true,
            _ => {
                return Err(format!(
                    "--orders {word:?}: auto, or a comma list of orders 0 to 1000 and \
                     \"diffraction\" is accepted"
                ));
            }
        }
    }
    Ok(DebyeTerms { orders: (!orders.is_empty()).then_some(orders), diffraction })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_contract() {
        let terms = |orders, diffraction| DebyeTerms { orders, diffraction };
        assert_eq!(parse_orders("0,1,diffraction"), Ok(terms(Some(vec![0, 1]), true)));
        assert_eq!(parse_orders("diffraction"), Ok(terms(None, true)));
        assert_eq!(parse_orders("auto"), Ok(terms(None, false)));
        assert!(parse_orders("two").is_err());
    }
}
