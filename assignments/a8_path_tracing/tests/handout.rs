//! The command lines of the handout for many machines, run on one.

#![cfg(unix)]

use std::path::Path;
use std::process::Command;
use tests::binary::{Scratch, workspace_bytes};
use tests::workspace_file;

/// What stands in for GNU parallel where there is none: `-j N TEMPLATE ::: … :::+ …`.
const PARALLEL: &str = r#"
parallel() {
    local template=$3 first=() second=() second_list=
    shift 4
    for word in "$@"; do
        if [ "$word" = ":::+" ]; then second_list=1
        elif [ -n "$second_list" ]; then second+=("$word")
        else first+=("$word"); fi
    done
    for i in "${!first[@]}"; do
        local line=${template//\{1\}/${first[$i]}}
        eval "${line//\{2\}/${second[$i]}}" || return 1
    done
}
"#;

/// The code under a heading of the handout, with a smaller picture.
fn code(heading: &str) -> String {
    let readme = String::from_utf8(workspace_bytes("assignments/a8_path_tracing/README.md")).unwrap();
    let section = readme.split(&format!("### {heading}\n")).nth(1).expect("the handout has this heading");
    let blocks = section.split("\n##").next().unwrap().split("```").skip(1).step_by(2);
    let code: String = blocks.map(|block| block.trim_start_matches("sh")).collect();
    assert!(code.contains("-size 256 256"), "{code}");
    code.replace("-size 256 256", "-size 16 16")
}

/// Runs a script with the program in its path, in a folder where `scenes` is.
fn bash(scratch: &Scratch, script: &str, task: Option<u32>) {
    let folder = Path::new(env!("CARGO_BIN_EXE_a8_path_tracing")).parent().unwrap();
    let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("bash");
    command.args(["-e", "-c", script]).current_dir(scratch.path()).env("PATH", path);
    if let Some(task) = task {
        command.env("SLURM_ARRAY_TASK_ID", task.to_string());
    }
    let outcome = command.output().expect("there is a bash");
    assert!(outcome.status.success(), "{script}\n{}", String::from_utf8_lossy(&outcome.stderr));
}

fn scratch() -> Scratch {
    let scratch = Scratch::new(&[]);
    std::os::unix::fs::symlink(workspace_file("scenes").canonicalize().unwrap(), scratch.file("scenes"))
        .unwrap();
    scratch
}

/// The picture of one run, to compare with.
fn whole(scratch: &Scratch) -> Vec<u8> {
    let line = "a8_path_tracing -quiet -input scenes/scene8_02_cornell_spheres.txt -size 16 16 -spp 256 -output one.exr";
    bash(scratch, line, None);
    std::fs::read(scratch.file("one.exr")).unwrap()
}

#[test]
fn a8t7_parallel_parts_make_the_same_picture() {
    let scratch = scratch();
    let has = Command::new("sh").args(["-c", "parallel --version | grep -q GNU"]).output();
    let has = has.is_ok_and(|outcome| outcome.status.success());
    let script = format!("{}{}", if has { "" } else { PARALLEL }, code("GNU parallel"));
    bash(&scratch, &script, None);
    assert!(std::fs::read(scratch.file("whole.exr")).unwrap() == whole(&scratch));
}

#[test]
fn a8t7_array_jobs_make_the_same_picture() {
    let scratch = scratch();
    let (job, merge) = {
        let code = code("Slurm array");
        let (job, rest) = code.split_once("sbatch").expect("the job is followed by how it is sent");
        let merge = rest.lines().find(|line| line.contains("-merge")).expect("and by how it is merged");
        (job.to_owned(), merge.to_owned())
    };
    assert!(job.contains("#SBATCH --array=0-7"), "{job}");
    (0..8).for_each(|task| bash(&scratch, &job, Some(task)));
    bash(&scratch, &merge, None);
    assert!(std::fs::read(scratch.file("whole.exr")).unwrap() == whole(&scratch));
}
