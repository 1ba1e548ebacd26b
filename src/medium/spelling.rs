//! Names as people type them: compared without case, blanks, hyphens and underscores; a misspelt one stands
//! for the nearest that is known.

/// What of a name is compared.
pub(super) fn key(name: &str) -> String {
    name.chars().filter(|c| !" -_".contains(*c)).flat_map(char::to_lowercase).collect()
}

/// The name that a misspelt one may stand for.
pub(super) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let wanted = key(name);
    known
        .map(|spelling| (strsim::levenshtein(&wanted, &key(spelling)), spelling))
        .min()
        .filter(|(d, _)| *d <= 1 + wanted.chars().count() / 3)
        .map(|(_, spelling)| spelling.to_string())
}
