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

/// The raindrop model of a name.
pub fn raindrop_model(name: &str) -> Result<RaindropModel, UsageError> {
    let known = RaindropModel::NAMES;
    known.iter().find(|(word, _)| *word == name).map(|(_, model)| *model).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        UsageError(format!("--model {name}: {} are accepted", words.join(" and ")))
    })
}

/// An index given on the command line.
#[derive(Clone, Copy, Debug)]
pub struct Index(pub Complex64);

/// `1.333` or `1.333+0.001` (n+ik).
pub fn parse_index(text: &str) -> Result<Index, String> {
    let accepted = "n or n+k with n > 0 and k ≥ 0 (k > 0 absorbs) is accepted";
    let trimmed = text.trim().trim_end_matches('i');
    // a sign after the first character, unless it belongs to an exponent
    let split = trimmed
        .char_indices()
        .skip(1)
        .find(|&(i, c)| (c == '+' || c == '-') && !trimmed[..i].ends_with(['e', 'E']));
    let (n, k) = match split {
        Some((i, _)) => (&trimmed[..i], &trimmed[i..]),
        None => (trimmed, "0"),
    };
    let number = |word: &str| word.parse::<f64>().map_err(|_| format!("{text}: {accepted}"));
    let (n, k) = (number(n)?, number(k)?);
    if !(n.is_finite() && n > 0.0 && k.is_finite() && k >= 0.0) {
        return Err(format!("{text}: {accepted}"));
    }
    let index = Complex64::new(n, k);
    if !gonio::medium::is_plausible(index) {
        return Err(format!("{text}: {} are accepted", gonio::medium::PLAUSIBLE_INDEX));
    }
    Ok(Index(index))
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
        assert_eq!(parse_index("1.3314+0.001").unwrap().0, Complex64::new(1.3314, 0.001));
        assert_eq!(parse_index("1.3+1e-5").unwrap().0, Complex64::new(1.3, 1e-5));
        assert!(parse_index("1.3-0.1").is_err() && parse_index("nan").is_err());
        let theta = parse_theta("10,120:150:0.1,0").unwrap();
        assert_eq!((theta.len(), theta[0], theta[302]), (303, 10.0, 0.0));
        assert!((theta[301] - 150.0).abs() < 1e-9);
        assert!(parse_theta("190").is_err() && parse_theta("0:180:0").is_err());
        assert_eq!(parse_orders("0,1,diffraction").unwrap(), (Some(vec![0, 1]), true));
        assert_eq!(parse_orders("auto").unwrap(), (None, false));
        assert!(parse_orders("two").is_err());
    }
}
