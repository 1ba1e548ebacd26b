//! The bar of a long command: on a terminal only, drawn on stderr, and not where nothing is to be said.

use super::verbosity::{Verbosity, says};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use std::time::Duration;

/// A bar that counts `length` of what is `counted`.
pub fn bar(length: usize, counted: &str) -> ProgressBar {
    styled(length, &format!("{{bar:32}} {{pos}}/{{len}} {counted}, {{elapsed}}, {{eta}} to go"))
}

/// What turns while something is done whose parts nobody counts.
pub fn spinner(what: &str) -> ProgressBar {
    let spinner = ProgressBar::new_spinner();
    if !says(Verbosity::Usual) {
        spinner.set_draw_target(ProgressDrawTarget::hidden());
    } else if !spinner.is_hidden() {
        spinner.enable_steady_tick(Duration::from_millis(200));
    }
    let style = ProgressStyle::with_template(&format!("{{spinner}} {what}, {{elapsed}}"));
    spinner
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
        .with_finish(ProgressFinish::AndClear)
}

/// A bar of this template.
pub fn styled(length: usize, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    let bar = ProgressBar::new(length as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        // a command that fails leaves no bar behind either
        .with_finish(ProgressFinish::AndClear);
    if !says(Verbosity::Usual) {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    bar
}
