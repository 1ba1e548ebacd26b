//! Words of `gonio scatter` and `gonio rays`: shapes, indices, angles and orders.

use super::UsageError;
use clap::ValueEnum;
use gonio::scene::Named;
use gonio::shape::RaindropModel;
use num_complex::Complex64;

/// Most angles accepted; more is surely a slip of the step.
const MOST_ANGLES: f64 = 1e7;

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
    pub fn check(&self) -> Result<(), UsageError> {
        let shape = match self.shape {
            ShapeKind::Sphere => "sphere",
            ShapeKind::Spheroid => "spheroid",
            ShapeKind::Raindrop => "raindrop",
        };
        match (self.axis_ratio, self.model) {
            (Some(ratio), _) if self.shape != ShapeKind::Spheroid => Err(UsageError(format!(
                "--axis-ratio {ratio}: only a spheroid has an axis ratio; the shape is {shape}"
            ))),
            (_, Some(model)) if self.shape != ShapeKind::Raindrop => Err(UsageError(format!(
                "--model {model}: only a raindrop has a shape model; the shape is {shape}"
            ))),
            _ => Ok(()),
        }
    }
}

/// The raindrop model of a name; without one, that of scenes.
pub fn raindrop_model(name: Option<&str>) -> Result<RaindropModel, UsageError> {
    let Some(name) = name else { return Ok(RaindropModel::BeardChuang1987) };
    let known = RaindropModel::NAMES;
    known.iter().find(|(word, _)| *word == name).map(|(_, model)| *model).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        UsageError(format!("--model {name}: {} are accepted", words.join(" and ")))
    })
}

/// An index given on the command line.
#[derive(Clone, Copy, Debug)]
pub struct Index(pub Complex64);

/// `1.333` or `1.333+0.001` (n+ik), as in [`gonio::medium::parse_index`].
pub fn parse_index(text: &str) -> Result<Index, String> {
    gonio::medium::parse_index(text).map(Index).map_err(|error| error.to_string())
}

/// Comma list of values and `from:to:step` ranges (both ends in), degrees, order kept.
pub fn parse_theta(text: &str) -> Result<Vec<f64>, String> {
    let accepted = "a comma list of angles 0 to 180 and from:to:step ranges is accepted";
    let wrong = |word: &str| format!("--theta {word:?}: {accepted}");
    let mut angles = Vec::new();
    for word in text.split(',') {
        let numbers = word
            .split(':')
            .map(|w| w.trim().parse::<f64>().ok().filter(|v| v.is_finite()))
            .collect::<Option<Vec<f64>>>()
            .ok_or_else(|| wrong(word))?;
        match numbers[..] {
            [angle] => angles.push(angle),
            [from, to, step] if step != 0.0 && (to - from) * step >= 0.0 => {
                let steps = (to - from) / step;
                if steps > MOST_ANGLES {
                    return Err(format!("--theta {word:?}: {steps:.1e} angles; at most 1e7"));
                }
                let count = (steps + 1e-6).floor() as usize;
                angles.extend((0..=count).map(|i| from + i as f64 * step));
            }
            _ => return Err(wrong(word)),
        }
    }
    // from + i·step may pass 180 by a rounding
    for angle in &mut angles {
        if !(*angle >= -1e-9 && *angle <= 180.0 + 1e-9) {
            return Err(format!("--theta {angle}: {accepted}"));
        }
        *angle = angle.clamp(0.0, 180.0);
    }
    Ok(angles)
}

/// `auto` (None), or a list of orders, and whether the word `diffraction` is in it.
pub fn parse_orders(text: &str) -> Result<(Option<Vec<u32>>, bool), String> {
    if text == "auto" {
        return Ok((None, false));
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
    let only_diffraction = orders.is_empty();
    Ok(((!only_diffraction).then_some(orders), diffraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_contract() {
        let theta = parse_theta("10,120:150:0.1,0").unwrap();
        assert_eq!((theta.len(), theta[0], theta[302]), (303, 10.0, 0.0));
        assert!((theta[301] - 150.0).abs() < 1e-9);
        assert!(parse_theta("190").is_err() && parse_theta("0:180:0").is_err());
        assert_eq!(parse_orders("0,1,diffraction").unwrap(), (Some(vec![0, 1]), true));
        assert_eq!(parse_orders("auto").unwrap(), (None, false));
        assert!(parse_orders("two").is_err());
    }
}
