//! Picture files: bytes, round trips, and what happens when writing fails.

use super::*;
use crate::atomic::Unwritable;
use crate::math::Vec3;
use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn size(width: i64, height: i64) -> Size {
    Size::new(width, height).unwrap()
}

/// 2 x 2: red and green below, blue and a dark colour above.
fn corners() -> Film {
    let mut film = Film::new(size(2, 2));
    film.set(0, 0, Vec3::X);
    film.set(1, 0, Vec3::Y);
    film.set(0, 1, Vec3::Z);
    film.set(1, 1, Vec3::new(0.5, 0.25, 0.01));
    film
}

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let name = |entry: fs::DirEntry| entry.file_name().into_string().unwrap();
        let mut names: Vec<_> = entries.map(|entry| name(entry.unwrap())).collect();
        names.sort();
        names
    }
}

#[test]
fn tga_bytes_are_the_course_s() {
    let folder = Folder::new();
    let path = folder.path("a.tga");
    write(&path, &corners(), Transfer::Linear).unwrap();
    let mut expected = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, 0x20];
    expected.extend([255, 0, 0, 2, 63, 127]); // top row: blue, the dark colour; B G R
    expected.extend([0, 0, 255, 0, 255, 0]); // bottom row: red, green
    assert_eq!(fs::read(&path).unwrap(), expected);
}

#[test]
fn tga_sizes_are_little_endian() {
    let folder = Folder::new();
    let path = folder.path("a.tga");
    write(&path, &Film::new(size(258, 3)), Transfer::Linear).unwrap();
    let bytes = fs::read(&path).unwrap();
    assert_eq!(bytes[12..16], [2, 1, 3, 0]);
    assert_eq!(bytes.len(), 18 + 258 * 3 * 3);
}

#[test]
fn ppm_bytes() {
    let folder = Folder::new();
    let path = folder.path("a.ppm");
    write(&path, &corners(), Transfer::Linear).unwrap();
    let mut expected = b"P6\n2 2 255\n".to_vec();
    expected.extend([0, 0, 255, 127, 63, 2, 255, 0, 0, 0, 255, 0]);
    assert_eq!(fs::read(&path).unwrap(), expected);
}

#[test]
fn float_kinds_keep_their_precision() {
    let film =
        Film::from_fn(size(9, 5), |x, y| Vec3::new(x as f32 * 1e-4, 3.0 + y as f32, 1e5 / (1.0 + x as f32)));
    let folder = Folder::new();
    for (name, tolerance) in [("a.exr", 0.0), ("a.pfm", 0.0), ("a.HDR", 1.0 / 128.0)] {
        write(&folder.path(name), &film, Transfer::Srgb).unwrap();
        let back = read(&folder.path(name), Transfer::Srgb).unwrap();
        for (a, b) in film.pixels().iter().zip(back.pixels()) {
            let error = (*a - *b).abs().max_element();
            assert!(error <= tolerance * a.max_element(), "{name}: {a} {b}");
        }
    }
}

#[test]
fn every_float_value_can_be_written() {
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, f32::MAX, 1e-40, 0.0, 1.0, 1e30];
    let film = Film::from_fn(size(9, 1), |x, _| Vec3::splat(odd[x as usize]));
    let folder = Folder::new();
    for kind in Kind::ALL {
        let path = folder.path(&format!("a.{}", kind.suffix()));
        write(&path, &film, Transfer::Srgb).unwrap();
        let back = read(&path, Transfer::Srgb).unwrap();
        assert_eq!(back.size(), film.size());
        if matches!(kind, Kind::Exr | Kind::Pfm) {
            let bits = |film: &Film| film.pixels().iter().map(|c| c.x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&back), bits(&film), "{kind:?}");
        }
        if kind == Kind::Hdr {
            let reds: Vec<_> = back.pixels().iter().map(|c| c.x).collect();
            assert_eq!((reds[0], reds[2], reds[3], reds[7]), (0.0, 0.0, 0.0, 1.0));
            assert!(reds[1] > 1e38 && reds[4] > 1e38, "{reds:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn eight_bit_kinds_give_their_levels_back(
        width in 1..20_u32,
        height in 1..20_u32,
        seed in any::<u32>(),
        srgb in any::<bool>(),
    ) {
        let transfer = if srgb { Transfer::Srgb } else { Transfer::Linear };
        let film = Film::from_fn(size(width.into(), height.into()), |x, y| {
            let hash = (seed ^ (x * 7919 + y * 104_729)).wrapping_mul(2_654_435_761);
            Vec3::from_array([hash >> 24, hash >> 16, hash >> 8].map(|v| (v & 255) as f32 / 240.0))
        });
        let folder = Folder::new();
        for kind in [Kind::Tga, Kind::Png, Kind::Ppm] {
            let path = folder.path(&format!("a.{}", kind.suffix()));
            write(&path, &film, transfer).unwrap();
            let back = read(&path, transfer).unwrap();
            let result = compare(&film, &back, transfer, 0).unwrap();
            prop_assert_eq!(result.worst, None, "{:?}", kind);
        }
    }
}

#[test]
fn damaged_files_are_errors_that_name_them() {
    let film = Film::from_fn(size(20, 10), |x, y| Vec3::new(x as f32, y as f32, 3.0) / 20.0);
    let folder = Folder::new();
    for kind in Kind::ALL {
        let path = folder.path(&format!("a.{}", kind.suffix()));
        write(&path, &film, Transfer::Linear).unwrap();
        let bytes = fs::read(&path).unwrap();
        for end in (0..bytes.len()).step_by(7) {
            fs::write(&path, &bytes[..end]).unwrap();
            // Whether the last bytes matter is up to the format; a panic or a wrong size is not.
            match read(&path, Transfer::Linear) {
                Ok(back) => assert_eq!(back.size(), film.size()),
                Err(error) => assert!(error.to_string().contains("/a."), "{error}"),
            }
        }
        fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        assert!(read(&path, Transfer::Linear).is_err(), "{kind:?} cut in half");
    }
}

#[test]
fn the_content_tells_the_kind_before_the_suffix_does() {
    let folder = Folder::new();
    write(&folder.path("a.png"), &corners(), Transfer::Linear).unwrap();
    fs::rename(folder.path("a.png"), folder.path("really_a_png.tga")).unwrap();
    let back = read(&folder.path("really_a_png.tga"), Transfer::Linear).unwrap();
    assert_eq!(Transfer::Linear.levels(back.get(0, 0)), [255, 0, 0]);
    fs::write(folder.path("grey.anything"), "P2 2 1 255 7 200").unwrap();
    let back = read(&folder.path("grey.anything"), Transfer::Linear).unwrap();
    assert_eq!(Transfer::Linear.levels(back.get(1, 0)), [200; 3]);
}

#[test]
fn unknown_suffixes_list_the_known_and_the_nearest() {
    for (name, nearest) in [("a.tgaa", ".tga"), ("a.TAG", ".tga"), ("a.ong", ".png"), ("a.exe", ".exr")] {
        let text = check_output(Path::new(name), size(1, 1)).unwrap_err().to_string();
        assert!(text.contains(".tga .png .ppm .pfm .exr .hdr"), "{text}");
        assert!(text.ends_with(&format!("did you mean {nearest}?")), "{text}");
    }
    let text = check_output(Path::new("picture"), size(1, 1)).unwrap_err().to_string();
    assert!(text.contains("needs a suffix"), "{text}");
    let text = check_output(Path::new("a.jpeg2000"), size(1, 1)).unwrap_err().to_string();
    assert!(!text.contains("did you mean"), "{text}");
}

#[test]
fn outputs_are_checked_without_touching_them() {
    let folder = Folder::new();
    check_output(&folder.path("new.tga"), size(1, 1)).unwrap();
    assert!(folder.names().is_empty());
    fs::write(folder.path("old.png"), "old").unwrap();
    check_output(&folder.path("old.png"), size(1, 1)).unwrap();
    assert_eq!(fs::read(folder.path("old.png")).unwrap(), b"old");
    check_output(Path::new("bare_name.tga"), size(1, 1)).unwrap();

    let missing = check_output(&folder.path("missing/a.tga"), size(1, 1));
    assert!(matches!(missing, Err(PictureError::Unwritable(Unwritable::NoFolder { .. }))));
    fs::create_dir(folder.path("dir.tga")).unwrap();
    let is_folder = check_output(&folder.path("dir.tga"), size(1, 1));
    assert!(matches!(is_folder, Err(PictureError::Unwritable(Unwritable::IsFolder(_)))));
    let is_folder = check_output(folder.0.path(), size(1, 1));
    assert!(matches!(is_folder, Err(PictureError::Unwritable(Unwritable::IsFolder(_)))));
    let mut locked = fs::metadata(folder.path("old.png")).unwrap().permissions();
    locked.set_readonly(true);
    fs::set_permissions(folder.path("old.png"), locked).unwrap();
    let read_only = check_output(&folder.path("old.png"), size(1, 1));
    assert!(matches!(read_only, Err(PictureError::Unwritable(Unwritable::ReadOnly(_)))));
}

#[test]
fn sides_too_long_for_the_format_are_found_early() {
    let folder = Folder::new();
    let long = size(65_536, 1);
    assert!(matches!(
        check_output(&folder.path("a.tga"), long),
        Err(PictureError::SideTooLong { longest: 65_535, .. })
    ));
    check_output(&folder.path("a.png"), long).unwrap();
    check_output(&folder.path("a.tga"), size(65_535, 1)).unwrap();
}

#[test]
fn a_failure_keeps_the_old_file_and_leaves_no_other() {
    let folder = Folder::new();
    let path = folder.path("a.tga");
    fs::write(&path, "old").unwrap();
    write(&path, &Film::new(size(65_536, 1)), Transfer::Linear).unwrap_err();
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(folder.names(), ["a.tga"]);
}

#[cfg(unix)]
mod on_unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn permissions_are_those_of_an_ordinary_file_or_of_the_old_one() {
        let folder = Folder::new();
        fs::write(folder.path("ordinary"), "").unwrap();
        write(&folder.path("new.tga"), &corners(), Transfer::Linear).unwrap();
        assert_eq!(mode(&folder.path("new.tga")), mode(&folder.path("ordinary")));
        fs::set_permissions(folder.path("new.tga"), fs::Permissions::from_mode(0o640)).unwrap();
        write(&folder.path("new.tga"), &corners(), Transfer::Linear).unwrap();
        assert_eq!(mode(&folder.path("new.tga")), 0o640);
    }

    #[test]
    fn links_are_followed_and_stay_links() {
        let folder = Folder::new();
        fs::create_dir(folder.path("sub")).unwrap();
        fs::write(folder.path("sub/real.tga"), "old").unwrap();
        symlink("sub/real.tga", folder.path("link.tga")).unwrap();
        symlink("sub/new.tga", folder.path("dangling.tga")).unwrap();
        for name in ["link.tga", "dangling.tga"] {
            check_output(&folder.path(name), size(2, 2)).unwrap();
            write(&folder.path(name), &corners(), Transfer::Linear).unwrap();
            assert!(fs::symlink_metadata(folder.path(name)).unwrap().is_symlink());
        }
        for name in ["sub/real.tga", "sub/new.tga"] {
            assert_eq!(fs::read(folder.path(name)).unwrap().len(), 18 + 12);
        }
        symlink("loop.tga", folder.path("loop.tga")).unwrap();
        assert!(check_output(&folder.path("loop.tga"), size(2, 2)).is_err());
    }

    #[test]
    fn devices_are_written_in_place() {
        let null = Path::new("/dev/null");
        check_output(null, size(2, 2)).unwrap();
        write(null, &corners(), Transfer::Linear).unwrap();
        assert!(!fs::metadata(null).unwrap().is_file());
    }

    #[test]
    fn a_full_disk_is_an_error() {
        let full = Path::new("/dev/full");
        if full.exists() {
            let error = write(full, &corners(), Transfer::Linear).unwrap_err();
            assert!(matches!(error, PictureError::Unwritable(Unwritable::Refused { .. })), "{error}");
        }
    }
}

#[test]
fn headers_that_promise_more_than_there_is_are_refused_at_once() {
    let folder = Folder::new();
    for (name, header) in [
        ("a.ppm", &b"P6\n16384 16384\n255\nabc"[..]),
        ("a.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n\x02\x02"),
    ] {
        fs::write(folder.path(name), header).unwrap();
        let error = read(&folder.path(name), Transfer::Linear).unwrap_err();
        let cause = std::error::Error::source(&error).map(ToString::to_string).unwrap_or_default();
        assert!(cause.contains("cannot be in a file of"), "{error}: {cause}");
    }
}

/// Ours packs to a hundredth; a thousandth is what the format can do.
#[test]
fn what_packs_well_is_believed() {
    let folder = Folder::new();
    let black = Film::new(size(3000, 3000));
    write(&folder.path("black.png"), &black, Transfer::Linear).unwrap();
    let bytes = fs::metadata(folder.path("black.png")).unwrap().len();
    assert!(bytes < 27_000_000 / 50, "{bytes}");
    assert_eq!(read(&folder.path("black.png"), Transfer::Linear).unwrap().size(), black.size());
}
