//! The `noisefloor` command with the built-in methods.

fn main() -> std::process::ExitCode {
    noisefloor::main_with([])
}
