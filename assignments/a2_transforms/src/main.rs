//! Assignment 2 as a program.

use std::process::ExitCode;

/// Diffuse light on spheres, planes, triangles and meshes under transforms; normals as colours.
#[derive(clap::Parser)]
#[command(
    name = "a2_transforms",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a2_transforms -input scenes/scene2_03_colored_lights.txt -size 200 200 -output out.tga -normals normals.tga"
)]
struct Program {
    #[command(flatten)]
    args: a2_transforms::DiffuseArgs,
}

fn main() -> ExitCode {
    let program: Program = common::cli::parse();
    common::cli::run(|| a2_transforms::run(&program.args))
}
