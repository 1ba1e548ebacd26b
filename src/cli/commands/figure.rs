//! `gonio figure`: figures of the literature, drawn anew, with the papers' numbers beside ours.

use crate::cli::args::output::Output;
use crate::cli::command_line::command_line;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::plot::write_whole;
use crate::cli::show::{notes, progress};
use clap::Args;
use gonio::figures::{Figure, Made, Workshop, all, named};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Figures of the papers on rainbows, dispersion and varying indices, with the papers' numbers beside ours
#[derive(Args)]
#[command(after_help = "Examples: gonio figure --list
          gonio figure sadeghi-5 -o five.png
          gonio figure --all -o figures")]
pub struct FigureArgs {
    /// Which; --list shows all
    #[arg(value_name = "NAME", required_unless_present_any = ["list", "all"], conflicts_with_all = ["list", "all"])]
    name: Option<String>,
    /// PNG or SVG to write; with --all the folder, which is made where there is none
    #[arg(short, long, value_name = "FILE|FOLDER")]
    output: Option<PathBuf>,
    /// All figures into a folder, with a page that shows them
    #[arg(long, requires = "output", conflicts_with = "list")]
    all: bool,
    /// Names, captions and what to compare
    #[arg(long, conflicts_with = "output")]
    list: bool,
    /// Replace files of the same names
    #[arg(long)]
    overwrite: bool,
    /// Print name, quantity, the paper's number, ours and the difference as JSON
    #[arg(long)]
    json: bool,
}

/// Name of the page among all figures.
const PAGE: &str = "README.md";

pub fn run(args: FigureArgs) -> Result<()> {
    if args.list {
        return list(args.json);
    }
    let workshop = Workshop::telling(|note| notes::tell([note]));
    if args.all {
        let Some(folder) = &args.output else { return Err(nothing_to_do()) };
        return every(&args, folder, &workshop);
    }
    let figure = named(args.name.as_deref().unwrap_or_default())?;
    if args.output.is_none() && !args.json {
        return Err(nothing_to_do());
    }
    if let Some(path) = &args.output {
        output(figure, path).check_new(args.overwrite)?;
    }
    let made = make(figure, &workshop)?;
    if let Some(path) = &args.output {
        write_whole(path, &bytes(figure, &made, path)?)?;
    }
    if args.json {
        println!("{}", serde_json::to_string(&to_json(&[(figure, &made)]))?);
    } else {
        print(&made);
    }
    Ok(())
}

fn nothing_to_do() -> Failure {
    Failure::usage("nothing to do: give -o FILE, or --json")
}

fn output<'a>(figure: &Figure, path: &'a Path) -> Output<'a> {
    let kind =
        if figure.pictures { "a PNG (the figure holds pictures)" } else { "a PNG or an SVG" };
    Output { flag: "--output", path, kind, endings: figure.endings() }
}

fn list(json: bool) -> Result<()> {
    if json {
        let one = |f: &Figure| {
            json!({
                "name": f.name, "source": f.source, "caption": f.caption, "compare": f.compare, "scenes": f.scenes,
                "endings": f.endings(),
            })
        };
        println!("{}", serde_json::to_string(&all().map(one).collect::<Vec<_>>())?);
        return Ok(());
    }
    let mut source = "";
    for figure in all() {
        if figure.source != source {
            source = figure.source;
            println!("{source}");
        }
        println!("  {:16}{}", figure.name, figure.caption);
        println!("  {:16}to compare: {}", "", figure.compare);
    }
    Ok(())
}

fn make(figure: &Figure, workshop: &Workshop) -> Result<Made> {
    let spinner = progress::spinner(figure.name);
    let made = figure.make(workshop);
    spinner.finish_and_clear();
    let made = made.map_err(|error| Failure::from(error).while_doing(figure.name))?;
    notes::step(|| format!("{} drawn", figure.name));
    Ok(made)
}

fn bytes(figure: &Figure, made: &Made, path: &Path) -> Result<Vec<u8>> {
    let svg = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
    if svg {
        return Ok(made.svg()?.into_bytes());
    }
    let about =
        [("Title", figure.caption), ("Source", figure.source), ("Comment", &command_line())];
    Ok(made.png(&about)?)
}

/// All figures and their page; nothing is computed where one of the files is not to be replaced.
fn every(args: &FigureArgs, folder: &Path, workshop: &Workshop) -> Result<()> {
    if folder.is_file() {
        let message = format!("--output = {}: a file; --all writes a folder", folder.display());
        return Err(Failure::usage(message));
    }
    let path = |figure: &Figure| folder.join(format!("{}.png", figure.name));
    let names = all().map(path).chain([folder.join(PAGE)]);
    if folder.is_dir() {
        for path in names {
            Output { flag: "--output", path: &path, kind: "a figure", endings: &[] }
                .check_new(args.overwrite)?;
        }
    } else {
        std::fs::create_dir_all(folder)?;
    }
    let start = Instant::now();
    let mut done = Vec::new();
    for figure in all() {
        let began = Instant::now();
        let made = make(figure, workshop)?;
        write_whole(&path(figure), &bytes(figure, &made, &path(figure))?)?;
        done.push((figure, made));
        let (seconds, whole) = (began.elapsed().as_secs_f64(), start.elapsed().as_secs_f64());
        notes::step(|| format!("{}: {seconds:.1} s, {whole:.0} s in all", figure.name));
    }
    let done: Vec<(&Figure, &Made)> = done.iter().map(|(figure, made)| (*figure, made)).collect();
    write_whole(&folder.join(PAGE), page(&done).as_bytes())?;
    if args.json {
        println!("{}", serde_json::to_string(&to_json(&done))?);
    } else {
        let (count, seconds) = (done.len(), start.elapsed().as_secs_f64());
        println!("{}: {count} figures, {seconds:.0} s", folder.display());
    }
    Ok(())
}

/// The page that shows all figures: captions, what to compare, numbers.
fn page(done: &[(&Figure, &Made)]) -> String {
    let mut page = String::from(
        "# Figures\nDrawn by `gonio figure --all -o FOLDER --overwrite`: each with what to compare with the paper's, and the \
         paper's numbers beside ours (a dash where the paper has none).\n",
    );
    let mut source = "";
    for (figure, made) in done {
        if figure.source != source {
            source = figure.source;
            page += &format!("\n## {source}\n");
        }
        let Figure { name, caption, compare, .. } = figure;
        page += &format!(
            "\n### {name}\n{caption}\n\n*To compare:* {compare}.\n\n![{name}]({name}.png)\n"
        );
        if !made.numbers().is_empty() {
            page += "\nquantity | paper | ours | difference\n---|---|---|---\n";
            for number in made.numbers() {
                page += &format!(
                    "{}\n",
                    number.cells().map(|cell| cell.replace('|', "\\|")).join(" | ")
                );
            }
        }
    }
    page
}

fn print(made: &Made) {
    for number in made.numbers() {
        let [quantity, paper, ours, difference] = number.cells();
        println!("{quantity}: paper {paper}, ours {ours}, difference {difference}");
    }
}

fn to_json(done: &[(&Figure, &Made)]) -> Vec<Value> {
    let of = |(figure, made): &(&Figure, &Made)| {
        let one = |number: &gonio::figures::Number| {
            json!({
                "name": figure.name,
                "quantity": number.quantity,
                "unit": number.unit,
                "paper": number.paper,
                "ours": number.ours,
                "difference": number.difference(),
            })
        };
        made.numbers().iter().map(one).collect::<Vec<_>>()
    };
    done.iter().flat_map(of).collect()
}
