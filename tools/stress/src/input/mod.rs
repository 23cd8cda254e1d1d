//! accuracy.md, property 18: whatever is in a file or on a command line, it is read or refused;
//! never a panic, a hang, more than 512 MiB or 10 s. Declared counts allocate nothing.
//!
//! Every `Family` of inputs has samples (the repository's own files) and a reader. Its cases are
//! numbered: every prefix, then edits of single bytes, then swaps. They are read one after the
//! other by a child process whose memory the shell limits (`watchdog`), since a limit that a
//! process could set itself would need `unsafe`. The child is this very program, told by its
//! environment what to do ([`serve`]).

mod changes;
mod checkpoints;
mod command_lines;
mod family;
mod ifs;
mod meshes;
mod pictures;
mod scenes;
mod watchdog;
mod worker;

pub use watchdog::call_worker_by;
pub use worker::serve;

use crate::Stress;
use family::{Family, Numbers};

const FAMILIES: [Family; 6] = [
    Family {
        name: "scenes",
        samples: scenes::samples,
        read: scenes::read,
        numbers: |thorough| match thorough {
            true => Numbers { prefixes: usize::MAX, edits: 60_000, swaps: 40_000 },
            false => Numbers { prefixes: 700, edits: 20_000, swaps: 14_000 },
        },
    },
    Family {
        name: "ifs",
        samples: ifs::samples,
        read: ifs::read,
        numbers: |_| Numbers { prefixes: usize::MAX, edits: 20_000, swaps: 10_000 },
    },
    Family {
        name: "meshes",
        samples: meshes::samples,
        read: meshes::read,
        numbers: |thorough| Numbers {
            prefixes: if thorough { 20_000 } else { 100 },
            edits: if thorough { 10_000 } else { 5_000 },
            swaps: if thorough { 10_000 } else { 5_000 },
        },
    },
    Family {
        name: "pictures",
        samples: pictures::samples,
        read: pictures::read,
        numbers: |thorough| Numbers {
            prefixes: 1000,
            edits: if thorough { 20_000 } else { 4_000 },
            swaps: if thorough { 20_000 } else { 4_000 },
        },
    },
    Family {
        name: "checkpoints",
        samples: checkpoints::samples,
        read: checkpoints::read,
        numbers: |_| Numbers { prefixes: usize::MAX, edits: 20_000, swaps: 20_000 },
    },
    Family {
        name: "command lines",
        samples: command_lines::samples,
        read: command_lines::read,
        numbers: |thorough| Numbers {
            prefixes: if thorough { usize::MAX } else { 8 },
            edits: 1000,
            swaps: 1500,
        },
    },
];

/// Scene files.
pub fn scenes(stress: &Stress) {
    watchdog::watch(stress, 0);
}

/// Files of iterated function systems.
pub fn ifs(stress: &Stress) {
    watchdog::watch(stress, 1);
}

/// Mesh files: OBJ, PLY, STL.
pub fn meshes(stress: &Stress) {
    watchdog::watch(stress, 2);
}

/// Picture files of every kind, as textures and skies may be.
pub fn pictures(stress: &Stress) {
    watchdog::watch(stress, 3);
}

/// Checkpoints of path tracing.
pub fn checkpoints(stress: &Stress) {
    watchdog::watch(stress, 4);
}

/// Command lines of every program.
pub fn command_lines(stress: &Stress) {
    watchdog::watch(stress, 5);
}
