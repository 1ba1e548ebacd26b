//! `gonio scenes` and `gonio scene`: what ships with the program, to look at and to start from.

use crate::cli::failure::{Failure, Result};
use clap::{Args, Command};
use gonio::scene::{SHIPPED, SceneFile, SceneKind, Shipped};
use std::fmt::Write;

/// The scenes that come with the program
#[derive(Args)]
#[command(after_help = "Example: gonio scenes")]
pub struct ScenesArgs {
    /// Print names, kinds and descriptions as JSON
    #[arg(long)]
    json: bool,
}

/// A commented scene to start from, with every key
#[derive(Args)]
#[command(
    after_help = "Example: gonio scene --example raindrop > mine.toml && gonio table mine.toml -o mine.h5

Names: gonio scenes."
)]
pub struct SceneArgs {
    /// Which of the scenes that come with the program
    #[arg(long, value_name = "NAME", default_value = "raindrop")]
    example: String,
    /// The scene alone, without the keys that it leaves out
    #[arg(long)]
    bare: bool,
}

/// Print the list.
pub fn list(args: &ScenesArgs) -> Result<()> {
    if args.json {
        let scenes: Vec<_> = (SHIPPED.iter())
            .map(|scene| {
                let (name, about) = (scene.name, scene.about());
                serde_json::json!({ "name": name, "command": command(scene), "about": about })
            })
            .collect();
        println!("{}", serde_json::to_string(&scenes)?);
        return Ok(());
    }
    for (kind, does) in [(SceneKind::Table, "tables"), (SceneKind::Picture, "pictures")] {
        println!("Scenes of {does}:");
        for scene in SHIPPED.iter().filter(|scene| scene.kind() == Some(kind)) {
            println!("  {:30}{}", scene.name, scene.about());
        }
    }
    println!("gonio scene --example NAME > mine.toml");
    Ok(())
}

/// The command that a scene is for.
fn command(scene: &Shipped) -> &'static str {
    match scene.kind() {
        Some(SceneKind::Picture) => "render",
        _ => "table",
    }
}

/// Print one of them.
pub fn example(args: &SceneArgs) -> Result<()> {
    let Some(scene) = Shipped::named(&args.example) else {
        let names: Vec<&str> = SHIPPED.iter().map(|scene| scene.name).collect();
        let message = format!("--example {}: accepted are {}", args.example, names.join(", "));
        return Err(Failure::usage(message));
    };
    let keys = match scene.kind() {
        Some(SceneKind::Picture) => keys_of_pictures(),
        _ => keys_of_tables(),
    };
    print!("{}", if args.bare { scene.text.into() } else { completed(scene.text, &keys) });
    Ok(())
}

/// A section's name, and its keys, each with its line as a comment.
type Section = (String, Vec<(String, String)>);

/// The keys of a table's scene, with the words of their flags.
fn keys_of_tables() -> Vec<Section> {
    let flags = <SceneFile as Args>::augment_args(Command::new("keys"));
    let mut sections: Vec<Section> = Vec::new();
    for flag in flags.get_arguments() {
        let (Some(long), Some(heading)) = (flag.get_long(), flag.get_help_heading()) else {
            continue;
        };
        // the flag of a constant index is no key
        if long == "index" {
            continue;
        }
        let (section, key) = (heading.to_lowercase(), long.replace('-', "_"));
        let mut words = flag.get_help().map(ToString::to_string).unwrap_or_default();
        let values = flag.get_possible_values();
        if !values.is_empty() {
            let names: Vec<&str> = values.iter().map(|value| value.get_name()).collect();
            words += &format!(": {}", names.join(" | "));
        }
        let line = format!("# {:28}  # {words}", format!("{key} = …"));
        match sections.iter_mut().find(|(name, _)| *name == section) {
            Some((_, keys)) => keys.push((key, line)),
            None => sections.push((section, vec![(key, line)])),
        }
    }
    sections
}

/// The keys of a picture's scene, as the scene that has all of them tells.
fn keys_of_pictures() -> Vec<Section> {
    let text = Shipped::named("every_key").map_or("", |scene| scene.text);
    let mut sections: Vec<Section> = Vec::new();
    for line in text.lines() {
        if let Some(name) = section(line) {
            sections.push((name.into(), Vec::new()));
        } else if let (Some(key), Some((_, keys))) = (key(line), sections.last_mut()) {
            keys.push((key.into(), format!("# {}", line.trim_start_matches("# "))));
        }
    }
    sections
}

/// The name of the section that a line begins.
fn section(line: &str) -> Option<&str> {
    let (name, _) = line.strip_prefix('[')?.split_once(']')?;
    Some(name.trim_start_matches('['))
}

/// The key that a line gives a value to, if only as a comment.
fn key(line: &str) -> Option<&str> {
    let (key, _) = line.trim_start_matches("# ").split_once('=')?;
    let key = key.trim();
    key.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_').then_some(key)
}

/// A scene, with the keys that it leaves out as comments.
fn completed(text: &str, sections: &[Section]) -> String {
    let mut out = String::new();
    let mut lines: Vec<&str> = text.lines().collect();
    let mut left: Vec<&Section> = sections.iter().collect();
    // what several kinds of particles have is told in place of what one has
    if text.contains("[[particles]]") {
        left.retain(|(name, _)| name != "particle");
    }
    while !lines.is_empty() {
        let next = lines.iter().skip(1).position(|line| section(line).is_some());
        let block: Vec<&str> = lines.drain(..next.map_or(lines.len(), |at| at + 1)).collect();
        let end = block.iter().rposition(|line| !line.trim().is_empty()).map_or(0, |last| last + 1);
        let given: Vec<&str> = block.iter().filter_map(|line| key(line)).collect();
        block[..end].iter().for_each(|line| _ = writeln!(out, "{line}"));
        if let Some(name) = section(block[0])
            && let Some(at) = left.iter().position(|(known, _)| known == name)
        {
            let (_, keys) = left.remove(at);
            let missing = keys.iter().filter(|(key, _)| !given.contains(&key.as_str()));
            missing.for_each(|(_, line)| _ = writeln!(out, "{line}"));
        }
        block[end..].iter().for_each(|line| _ = writeln!(out, "{line}"));
    }
    for (name, keys) in left {
        _ = writeln!(out, "\n# [{name}]");
        keys.iter().for_each(|(_, line)| _ = writeln!(out, "{line}"));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing but comments is added, and no key is left out.
    #[test]
    fn every_key_is_there_and_none_is_changed() {
        for scene in SHIPPED {
            let keys = match scene.kind() {
                Some(SceneKind::Picture) => keys_of_pictures(),
                _ => keys_of_tables(),
            };
            let full = completed(scene.text, &keys);
            let parsed = |text: &str| text.parse::<toml::Table>().unwrap();
            assert_eq!(parsed(&full), parsed(scene.text), "{}", scene.name);
            let several = scene.text.contains("[[particles]]");
            for (name, keys) in keys.iter().filter(|(name, _)| !(several && name == "particle")) {
                assert!(
                    full.lines().any(|line| section(line.trim_start_matches("# ")) == Some(name))
                );
                for (wanted, _) in keys {
                    assert!(full.lines().any(|line| key(line) == Some(wanted)), "{wanted}");
                }
            }
        }
        let count =
            |sections: Vec<Section>| sections.iter().map(|(_, keys)| keys.len()).sum::<usize>();
        assert!(count(keys_of_tables()) > 30 && count(keys_of_pictures()) > 20);
    }
}
