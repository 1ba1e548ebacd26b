//! A chart: axes, curves, strips of colours above, marks and words within.

use super::axis::Axis;
use super::legend;
use super::line::Curve;
use super::pen::{Drawn, FAINT, GREY, INK, Pen, Place, width_of};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// A bar of colours over the axis of abscissae, above the chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// Beside it.
    pub name: String,
    /// sRGB, evenly from the axis's start to its end.
    pub colours: Vec<[u8; 3]>,
}

/// A vertical line with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Where.
    pub x: f64,
    /// Beside its upper end.
    pub name: String,
}

/// Words in the chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Where they begin, in the units of the axes.
    pub at: (f64, f64),
    /// The words.
    pub text: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
}

/// Curves over two axes.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Above it.
    pub title: String,
    /// Abscissa.
    pub x: Axis,
    /// Ordinate.
    pub y: Axis,
    /// One unit is as long along both axes.
    pub equal: bool,
    /// From behind to before.
    pub curves: Vec<Curve>,
    /// From above to below.
    pub strips: Vec<Strip>,
    /// Vertical lines.
    pub marks: Vec<Mark>,
    /// Words within.
    pub labels: Vec<Label>,
}

/// Room about the chart: edge, title, words below the abscissa, words beside the ordinate.
const EDGE: i32 = 12;
const TITLE: i32 = 28;
const BELOW: i32 = 44;
const BESIDE: i32 = 24;
/// Height of a strip and of the gap below it.
const STRIP: (i32, i32) = (24, 3);
/// Letters of ticks, of axes, of marks.
const TICKS: u32 = 13;
const NAMES: u32 = 14;
const SMALL: u32 = 12;
/// Pixels between ticks at the least.
const TICK_GAP: (i32, i32) = (58, 30);

/// Where the curves are.
#[derive(Clone, Copy)]
struct Frame {
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
}

impl Frame {
    fn pixel(&self, (x, y): (f64, f64)) -> Place {
        let along = f64::from(self.left) + x * f64::from(self.right - self.left);
        let up = f64::from(self.bottom) - y * f64::from(self.bottom - self.top);
        (along.round() as i32, up.round() as i32)
    }
}

impl Chart {
    /// Draw it into a panel.
    pub(super) fn draw<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        corner: Place,
        size: (u32, u32),
    ) -> Drawn<B> {
        pen.words(&self.title, (corner.0 + EDGE, corner.1 + 4), 15, INK)?;
        let room = self.room(corner, size);
        let frame = if self.equal { self.squared(room) } else { room };
        self.draw_strips(pen, frame)?;
        self.draw_grid(pen, frame)?;
        let shares = |(x, y): (f64, f64)| (self.x.share(x), self.y.share(y));
        for mark in &self.marks {
            let x = frame.pixel((self.x.share(mark.x), 0.0)).0;
            pen.line(vec![(x, frame.top), (x, frame.bottom)], RGBColor(160, 160, 160), 1)?;
        }
        for curve in &self.curves {
            curve.draw(pen, shares, |share| frame.pixel(share))?;
        }
        pen.frame([(frame.left, frame.top), (frame.right, frame.bottom)], GREY)?;
        self.draw_words(pen, frame)?;
        let top = frame.bottom + BELOW;
        legend::draw(pen, &self.curves, (room.left, top), room.right - room.left)
    }

    /// The room for curves within a panel.
    fn room(&self, (x, y): Place, (width, height): (u32, u32)) -> Frame {
        let (width, height) = (width as i32, height as i32);
        let widest = |words: Vec<(f64, String)>| {
            words.iter().map(|(_, text)| width_of(text, TICKS)).max().unwrap_or(0)
        };
        let left = x + EDGE + BESIDE + widest(self.y.ticks(12));
        let names = self.strips.iter().map(|strip| width_of(&strip.name, SMALL) + 8).max();
        let right = x + width - EDGE - names.unwrap_or(14);
        let top = y + TITLE + (STRIP.0 + STRIP.1) * self.strips.len() as i32 + 4;
        let below = BELOW + legend::height(&self.curves, right - left);
        Frame { left, right, top, bottom: y + height - below - EDGE }
    }

    /// The largest frame within one in which one unit is as long along both axes.
    fn squared(&self, frame: Frame) -> Frame {
        let (wide, high) =
            (f64::from(frame.right - frame.left), f64::from(frame.bottom - frame.top));
        let per_unit = (wide / (self.x.to - self.x.from)).min(high / (self.y.to - self.y.from));
        let (across, down) =
            (per_unit * (self.x.to - self.x.from), per_unit * (self.y.to - self.y.from));
        let left = frame.left + (0.5 * (wide - across)) as i32;
        Frame { left, right: left + across as i32, bottom: frame.top + down as i32, ..frame }
    }

    fn draw_strips<B: DrawingBackend>(&self, pen: &Pen<'_, B>, frame: Frame) -> Drawn<B> {
        let first = frame.top - 4 - (STRIP.0 + STRIP.1) * self.strips.len() as i32;
        for (i, strip) in self.strips.iter().enumerate() {
            let top = first + (STRIP.0 + STRIP.1) * i as i32;
            let wide = frame.right - frame.left;
            let colour = |x: i32| {
                let share = (f64::from(x) + 0.5) / f64::from(wide);
                let place = (share * strip.colours.len() as f64) as usize;
                strip.colours[place.min(strip.colours.len() - 1)]
            };
            let mut start = 0;
            // Neighbours of one colour are one block.
            for x in 1..=wide {
                if x == wide || colour(x) != colour(start) {
                    let [r, g, b] = colour(start);
                    let corners = [(frame.left + start, top), (frame.left + x, top + STRIP.0)];
                    pen.block(corners, RGBColor(r, g, b))?;
                    start = x;
                }
            }
            let place = (frame.right + 6, top + STRIP.0 / 2);
            pen.anchored(&strip.name, place, SMALL, INK, (HPos::Left, VPos::Center))?;
        }
        Ok(())
    }

    /// Lines at ticks, their words, and those of the axes.
    fn draw_grid<B: DrawingBackend>(&self, pen: &Pen<'_, B>, frame: Frame) -> Drawn<B> {
        let (wide, high) = (frame.right - frame.left, frame.bottom - frame.top);
        for (value, words) in self.x.ticks((wide / TICK_GAP.0) as usize) {
            let x = frame.pixel((self.x.share(value), 0.0)).0;
            pen.line(vec![(x, frame.top), (x, frame.bottom + 5)], FAINT, 1)?;
            pen.line(vec![(x, frame.bottom), (x, frame.bottom + 5)], GREY, 1)?;
            let anchor = (HPos::Center, VPos::Top);
            pen.anchored(&words, (x, frame.bottom + 7), TICKS, INK, anchor)?;
        }
        for (value, words) in self.y.ticks((high / TICK_GAP.1) as usize) {
            let y = frame.pixel((0.0, self.y.share(value))).1;
            pen.line(vec![(frame.left - 5, y), (frame.right, y)], FAINT, 1)?;
            pen.line(vec![(frame.left - 5, y), (frame.left, y)], GREY, 1)?;
            let anchor = (HPos::Right, VPos::Center);
            pen.anchored(&words, (frame.left - 8, y), TICKS, INK, anchor)?;
        }
        let middle = (frame.left + frame.right) / 2;
        let anchor = (HPos::Center, VPos::Top);
        pen.anchored(&self.x.label, (middle, frame.bottom + 24), NAMES, INK, anchor)?;
        let widest = self.y.ticks((high / TICK_GAP.1) as usize);
        let widest = widest.iter().map(|(_, words)| pen.width(words, TICKS)).max().unwrap_or(0);
        let beside = (frame.left - 20 - widest, (frame.top + frame.bottom) / 2);
        pen.upwards(&self.y.label, beside, NAMES)
    }

    /// Names of marks, one below the other, and words at places.
    fn draw_words<B: DrawingBackend>(&self, pen: &Pen<'_, B>, frame: Frame) -> Drawn<B> {
        for (i, mark) in self.marks.iter().enumerate() {
            let x = frame.pixel((self.x.share(mark.x), 0.0)).0;
            // Towards the middle where there is no room.
            let room = frame.right - x > width_of(&mark.name, SMALL) + 6;
            let (across, x) = if room { (HPos::Left, x + 4) } else { (HPos::Right, x - 4) };
            let place = (x, frame.top + 5 + 15 * i as i32);
            pen.anchored(&mark.name, place, SMALL, GREY, (across, VPos::Top))?;
        }
        for Label { at, text, colour: [r, g, b] } in &self.labels {
            let place = frame.pixel((self.x.share(at.0), self.y.share(at.1)));
            let anchor = (HPos::Left, VPos::Center);
            pen.anchored(text, place, SMALL, RGBColor(*r, *g, *b), anchor)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle on axes of one scale is as wide as it is high.
    #[test]
    fn equal_scales_are_equal() {
        let chart = Chart {
            x: Axis::linear("z", -2.0, 4.0),
            y: Axis::linear("x", -1.0, 1.0),
            equal: true,
            ..Chart::default()
        };
        let frame = chart.squared(chart.room((0, 0), (600, 500)));
        let (a, b) = (frame.pixel((0.0, 0.0)), frame.pixel((1.0, 1.0)));
        let (across, up) = (f64::from(b.0 - a.0) / 6.0, f64::from(a.1 - b.1) / 2.0);
        assert!((across / up - 1.0).abs() < 0.02, "{across} {up}");
    }

    /// Strips and legend take their room from the chart, not from each other.
    #[test]
    fn room_is_shared_out() {
        let bare = Chart::default().room((0, 0), (600, 400));
        let strip = Strip { name: "all".into(), colours: vec![[9; 3]] };
        let curves = vec![Curve::new("one", [0; 3], [])];
        let full = Chart { strips: vec![strip.clone(), strip], curves, ..Chart::default() };
        let full = full.room((0, 0), (600, 400));
        assert!(full.top == bare.top + 2 * (STRIP.0 + STRIP.1) && full.bottom < bare.bottom);
    }
}
