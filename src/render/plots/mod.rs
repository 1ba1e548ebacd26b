//! Plots: the preview of a table, diagrams of colours, their axes and letters.

pub mod color_diagram;
pub mod font;
pub mod heat_map;
pub mod preview;
pub mod sheet;
mod ticks;
