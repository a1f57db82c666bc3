//! The command `nearwall`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(nearwall_lab::command::run(std::env::args_os()))
}
