use std::process::ExitCode;

fn main() -> ExitCode {
    depthleap::cli::main()
}
