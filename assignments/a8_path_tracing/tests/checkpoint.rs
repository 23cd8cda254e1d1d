//! Checkpoints come back as they were, or not at all.

mod fake;

use a8_path_tracing::film::checkpoint::{Checkpoint, CheckpointError, decode, read, write};
use a8_path_tracing::film::{Frame, Identity};
use fake::{Fake, frame, part, size};
use std::fs;
use std::time::Duration;

fn small() -> Checkpoint {
    let fake = Fake { spread: 70, nap: Duration::ZERO };
    let identity = Identity::default().with("-seed", 3).with("-aov", "albedo normal depth");
    Checkpoint { identity, sums: part(&fake, frame(size(9, 7), [1, 2, 4, 4]), 5..8) }
}

/// The same with a checksum that fits, as a forger would have it.
fn forged(mut bytes: Vec<u8>, at: usize, value: &[u8]) -> Vec<u8> {
    bytes[at..at + value.len()].copy_from_slice(value);
    resealed(bytes)
}

/// The checksum's own definition, see its documentation.
fn resealed(mut bytes: Vec<u8>) -> Vec<u8> {
    use a7_sampling::sampler::hash::mix;
    bytes.truncate(bytes.len() - 8);
    let mut padded = bytes.clone();
    padded.resize(bytes.len() / 8 * 8 + 8, 0);
    let words = padded.chunks(8).map(|word| u64::from_le_bytes(word.try_into().unwrap()));
    let sum = words.fold(mix(bytes.len() as u64), |sum, word| mix(sum.rotate_left(1) ^ word));
    bytes.extend(sum.to_le_bytes());
    bytes
}

#[test]
fn what_is_written_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ckpt");
    let all = small();
    write(&path, &all.identity, &all.sums).unwrap();
    assert!(read(&path).unwrap() == all);
    assert_eq!(resealed(all.encode()), all.encode());
    let whole = Checkpoint { sums: part(&Fake::default(), Frame::whole(size(40, 30)), 0..3), ..all };
    write(&path, &whole.identity, &whole.sums).unwrap();
    assert!(read(&path).unwrap() == whole);
}

#[test]
fn every_prefix_and_every_changed_byte_is_refused() {
    let good = small().encode();
    for len in 0..good.len() {
        let fault = decode(&good[..len]).unwrap_err();
        assert!(fault.at <= len && !fault.what.is_empty(), "{len}: {fault:?}");
    }
    for at in 0..good.len() {
        for flip in [1, 0x80, 0xff] {
            let mut bad = good.clone();
            bad[at] ^= flip;
            let fault = decode(&bad).unwrap_err();
            assert!(fault.at <= bad.len(), "byte {at}: {fault:?}");
        }
    }
    let mut longer = good.clone();
    longer.push(0);
    assert!(decode(&longer).unwrap_err().what.contains("bytes"));
}

#[test]
fn forged_numbers_are_refused_where_they_stand() {
    let good = small().encode();
    let word = |n: u32| n.to_le_bytes().to_vec();
    for (at, value, needle) in [
        (8, word(2), "version 2"),
        (12, word(0), "no pixels"),
        (12, word(u32::MAX), "too large"),
        (20, word(4), "outside of the picture"),
        (32, word(8), "outside of the picture"),
        (36, word(9), "samples 9 to 8"),
        (40, word(u32::MAX), "cannot be"),
        (44, word(64), "not known"),
        (48, word(99), "fewer samples"),
        (52, word(1 << 30), "too many"),
        (64, word(u32::MAX), "too long"),
    ] {
        let fault = decode(&forged(good.clone(), at, &value)).unwrap_err();
        assert!(fault.what.contains(needle), "{at}: {fault:?}");
        assert!((at.saturating_sub(16)..=at).contains(&fault.at), "{at}: {fault:?}");
    }
    let sums = good.len() - 8 - 6 * 10 * 16;
    let fault = decode(&forged(good.clone(), sums - 4, &word(2))).unwrap_err();
    assert_eq!((fault.at, fault.what.as_str()), (sums - 4, "a pixel has another number of samples"));
    let fault = decode(&forged(good, sums + 16, &i128::MIN.to_le_bytes())).unwrap_err();
    assert_eq!((fault.at, fault.what.as_str()), (sums + 16, "a sum is larger than its samples can be"));
}

#[test]
fn what_is_no_checkpoint_is_told_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ckpt");
    assert!(matches!(read(&path), Err(CheckpointError::Read { .. })));
    fs::write(&path, "a poem of some length").unwrap();
    let said = read(&path).unwrap_err().to_string();
    assert!(said.contains("a.ckpt") && said.contains("at byte 0"), "{said}");
    #[cfg(target_os = "linux")]
    assert!(read("/dev/zero".as_ref()).is_err(), "and it is not read to its end, which it has not");
}
