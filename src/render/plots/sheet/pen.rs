//! Lines and letters on any backend, in pixels.

use crate::render::plots::font::FONT;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// What a drawing ends with.
pub(super) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Of words, of frames and ticks, of lines behind curves.
pub(super) const INK: RGBColor = RGBColor(20, 20, 20);
pub(super) const GREY: RGBColor = RGBColor(95, 95, 95);
pub(super) const FAINT: RGBColor = RGBColor(228, 228, 228);

/// A place in pixels.
pub(super) type Place = (i32, i32);

/// What draws.
pub(super) struct Pen<'a, B: DrawingBackend> {
    pub root: &'a DrawingArea<B, Shift>,
}

impl<'a, B: DrawingBackend> Pen<'a, B> {
    pub fn new(root: &'a DrawingArea<B, Shift>) -> Self {
        Self { root }
    }

    /// Words that begin at a place, the letters' upper edge there.
    pub fn words(&self, text: &str, place: Place, size: u32, colour: RGBColor) -> Drawn<B> {
        self.anchored(text, place, size, colour, (HPos::Left, VPos::Top))
    }

    /// Words about a place.
    pub fn anchored(
        &self,
        text: &str,
        place: Place,
        size: u32,
        colour: RGBColor,
        (across, down): (HPos, VPos),
    ) -> Drawn<B> {
        let style = TextStyle::from((FONT, size)).color(&colour).pos(Pos::new(across, down));
        self.root.draw(&Text::new(text.to_owned(), place, style))
    }

    /// Words that run upwards, centred on a place.
    pub fn upwards(&self, text: &str, place: Place, size: u32) -> Drawn<B> {
        let font = (FONT, size).into_font().transform(FontTransform::Rotate270);
        let style = TextStyle::from(font).color(&INK).pos(Pos::new(HPos::Center, VPos::Center));
        self.root.draw(&Text::new(text.to_owned(), place, style))
    }

    /// Pixels that words take across.
    pub fn width(&self, text: &str, size: u32) -> i32 {
        let style = TextStyle::from((FONT, size));
        let known = self.root.estimate_text_size(text, &style).ok();
        known.map_or_else(|| width_of(text, size), |(across, _)| across as i32)
    }

    pub fn line(&self, points: Vec<Place>, colour: RGBColor, width: u32) -> Drawn<B> {
        self.root.draw(&PathElement::new(points, colour.stroke_width(width)))
    }

    pub fn area(&self, points: Vec<Place>, colour: RGBColor) -> Drawn<B> {
        self.root.draw(&Polygon::new(points, colour.filled()))
    }

    pub fn block(&self, corners: [Place; 2], colour: RGBColor) -> Drawn<B> {
        self.root.draw(&Rectangle::new(corners, colour.filled()))
    }

    pub fn frame(&self, corners: [Place; 2], colour: RGBColor) -> Drawn<B> {
        self.root.draw(&Rectangle::new(corners, colour.stroke_width(1)))
    }

    pub fn dot(&self, place: Place, colour: RGBColor) -> Drawn<B> {
        self.root.draw(&Circle::new(place, 3, colour.filled()))
    }
}

/// Pixels that words may take across, before there is anything to draw them on: DejaVu's letters are 0.62 of their size
/// wide on average.
pub(super) fn width_of(text: &str, size: u32) -> i32 {
    (0.62 * f64::from(size) * text.chars().count() as f64).ceil() as i32
}
