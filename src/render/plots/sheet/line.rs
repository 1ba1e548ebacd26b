//! A curve: its points, clipped to the chart, thinned to pixels, drawn whole or dashed.

use super::pen::{Drawn, Pen, Place};
use plotters::prelude::*;

/// A curve of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// In the legend; empty: not there.
    pub name: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// In the units of the axes; what is not finite breaks the curve.
    pub points: Vec<(f64, f64)>,
    /// Pixels.
    pub width: u32,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Whether its points are marked in place of a line.
    pub dots: bool,
    /// What it encloses is of this colour.
    pub filled: Option<[u8; 3]>,
}

impl Curve {
    /// A whole line, two pixels wide.
    pub fn new(name: &str, colour: [u8; 3], points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self {
            name: name.into(),
            colour,
            points,
            width: 2,
            dashed: false,
            dots: false,
            filled: None,
        }
    }

    /// One pixel wide.
    #[must_use]
    pub fn thin(self) -> Self {
        Self { width: 1, ..self }
    }

    /// Dashed.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }

    /// Points marked in place of a line.
    #[must_use]
    pub fn dots(self) -> Self {
        Self { dots: true, ..self }
    }

    /// Filled within.
    #[must_use]
    pub fn filled(self, colour: [u8; 3]) -> Self {
        Self { filled: Some(colour), ..self }
    }

    /// `shares` makes of a point its place in the chart, from 0 to 1 along both axes, `pixel` of that a pixel.
    pub(super) fn draw<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        shares: impl Fn((f64, f64)) -> (f64, f64),
        pixel: impl Fn((f64, f64)) -> Place,
    ) -> Drawn<B> {
        let [r, g, b] = self.colour;
        let colour = RGBColor(r, g, b);
        let points: Vec<(f64, f64)> = self.points.iter().map(|&point| shares(point)).collect();
        if let Some([r, g, b]) = self.filled {
            let clamped = points.iter().map(|&(x, y)| (x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)));
            pen.area(clamped.map(&pixel).collect(), RGBColor(r, g, b))?;
        }
        if self.dots {
            let inside = |p: &&(f64, f64)| (0.0..=1.0).contains(&p.0) && (0.0..=1.0).contains(&p.1);
            return points.iter().filter(inside).try_for_each(|&p| pen.dot(pixel(p), colour));
        }
        for piece in pieces(&points) {
            let pixels = thinned(piece.into_iter().map(&pixel).collect());
            let strokes = if self.dashed { dashes(&pixels) } else { vec![pixels] };
            for stroke in strokes.into_iter().filter(|stroke| stroke.len() > 1) {
                pen.line(stroke, colour, self.width)?;
            }
        }
        Ok(())
    }
}

/// Stretches of a curve within the unit square.
fn pieces(points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut whole = false;
    for pair in points.windows(2) {
        let Some((from, to, reaches)) = clipped(pair[0], pair[1]) else {
            whole = false;
            continue;
        };
        match pieces.last_mut().filter(|_| whole) {
            Some(piece) => piece.push(to),
            None => pieces.push(vec![from, to]),
        }
        whole = reaches;
    }
    pieces
}

type Point = (f64, f64);

/// The part of a stretch in the unit square, and whether its end is (Liang & Barsky 1984).
fn clipped(a: Point, b: Point) -> Option<(Point, Point, bool)> {
    if ![a.0, a.1, b.0, b.1].iter().all(|v| v.is_finite()) {
        return None;
    }
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-dx, a.0), (dx, 1.0 - a.0), (-dy, a.1), (dy, 1.0 - a.1)] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            from = from.max(q / p);
        } else {
            to = to.min(q / p);
        }
    }
    let at = |t: f64| (a.0 + t * dx, a.1 + t * dy);
    (from <= to).then(|| (at(from), at(to), to >= 1.0))
}

/// Without pixels that repeat, and of many in one column the first, the highest, the lowest and the last.
fn thinned(mut pixels: Vec<Place>) -> Vec<Place> {
    pixels.dedup();
    let mut kept = Vec::new();
    for column in pixels.chunk_by(|a, b| a.0 == b.0) {
        if column.len() <= 4 {
            kept.extend_from_slice(column);
            continue;
        }
        let by = |best: fn(&&(usize, &Place), &&(usize, &Place)) -> std::cmp::Ordering| {
            let all: Vec<(usize, &Place)> = column.iter().enumerate().collect();
            all.iter().min_by(best).map_or(0, |found| found.0)
        };
        let mut places =
            vec![0, by(|a, b| a.1.1.cmp(&b.1.1)), by(|a, b| b.1.1.cmp(&a.1.1)), column.len() - 1];
        places.sort_unstable();
        places.dedup();
        kept.extend(places.into_iter().map(|place| column[place]));
    }
    kept
}

/// Pixels of a dash, and between two.
const DASH: [f64; 2] = [7.0, 5.0];

/// A line cut into dashes.
fn dashes(pixels: &[Place]) -> Vec<Vec<Place>> {
    let mut strokes = Vec::new();
    let (mut on, mut left) = (true, DASH[0]);
    let mut stroke: Vec<Place> = pixels.first().copied().into_iter().collect();
    for pair in pixels.windows(2) {
        let (mut at, end) = (
            (f64::from(pair[0].0), f64::from(pair[0].1)),
            (f64::from(pair[1].0), f64::from(pair[1].1)),
        );
        loop {
            let length = (end.0 - at.0).hypot(end.1 - at.1);
            if length <= left {
                left -= length;
                if on {
                    stroke.push(pair[1]);
                }
                break;
            }
            at = (at.0 + left / length * (end.0 - at.0), at.1 + left / length * (end.1 - at.1));
            let place = (at.0.round() as i32, at.1.round() as i32);
            if on {
                stroke.push(place);
                strokes.push(std::mem::take(&mut stroke));
            } else {
                stroke = vec![place];
            }
            on = !on;
            left = DASH[usize::from(!on)];
        }
    }
    strokes.push(stroke);
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve that leaves the chart is cut at its edge, and goes on where it comes back.
    #[test]
    fn what_leaves_is_cut_at_the_edge() {
        let points = [(0.0, 0.5), (0.4, 1.5), (0.8, 0.5), (1.0, f64::NAN), (0.9, 0.1), (1.0, 0.1)];
        let pieces = pieces(&points);
        assert_eq!(pieces.len(), 3);
        assert_eq!(pieces[0], [(0.0, 0.5), (0.2, 1.0)]);
        assert!((pieces[1][0].0 - 0.6).abs() < 1e-12 && pieces[1][1] == (0.8, 0.5));
        assert!(clipped((-1.0, 0.2), (-0.5, 0.3)).is_none());
    }

    /// A ripple within one column of pixels keeps its height.
    #[test]
    fn thinning_keeps_extremes() {
        let pixels: Vec<Place> =
            (0..100).map(|i| (5, if i == 41 { 90 } else { 10 + i % 3 })).collect();
        let kept = thinned(pixels);
        assert!(kept.len() <= 4 && kept.contains(&(5, 90)) && kept.contains(&(5, 10)));
    }

    #[test]
    fn dashes_cover_seven_of_twelve() {
        let strokes = dashes(&[(0, 0), (120, 0)]);
        let drawn: i32 =
            strokes.iter().filter(|s| s.len() > 1).map(|s| s[s.len() - 1].0 - s[0].0).sum();
        assert_eq!(drawn, 70);
    }
}
