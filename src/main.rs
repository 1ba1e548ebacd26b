//! The program `gonio`: parses the command line and calls the library of the same name.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
