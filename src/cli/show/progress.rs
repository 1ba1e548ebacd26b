//! The bar of a long command: on a terminal only, drawn on stderr.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar that counts `length` of what is `counted`.
pub fn bar(length: usize, counted: &str) -> ProgressBar {
    let template = format!("{{bar:32}} {{pos}}/{{len}} {counted}, {{elapsed}}, {{eta}} to go");
    let style = ProgressStyle::with_template(&template);
    ProgressBar::new(length as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
