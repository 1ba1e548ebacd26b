//! A body of every kind, for the tests of this room.

use super::{RaindropModel, Shape};

pub(super) fn shapes() -> [Shape; 4] {
    [
        Shape::sphere(),
        Shape::spheroid(0.75, 0.3).unwrap(),
        Shape::spheroid(1.4, 1.1).unwrap(),
        Shape::raindrop(1.2e-3, RaindropModel::BeardChuang1987, 0.3).unwrap(),
    ]
}
