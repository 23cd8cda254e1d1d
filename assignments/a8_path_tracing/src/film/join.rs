//! Putting together what several runs have rendered.

use super::checkpoint::Checkpoint;
use super::{Frame, Sums};
use common::tiles::Tile;
use std::collections::BTreeMap;
use std::ops::Range;

/// A part of a rendering and the name of its file.
pub struct Part {
    /// For messages.
    pub name: String,
    /// The part.
    pub checkpoint: Checkpoint,
}

/// Why parts cannot be put together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct JoinError(String);

fn refused<T>(why: String) -> Result<T, JoinError> {
    Err(JoinError(why))
}

/// Adds up the samples of parts that show the same pixels, and lays parts side by side that show
/// different ones. The outcome is that of one run, to the bit.
///
/// # Errors
/// No parts; parts of different renderings; samples or pixels that are missing or there twice.
pub fn join(parts: Vec<Part>) -> Result<Checkpoint, JoinError> {
    let Some(first) = parts.first() else { return refused("there is nothing to merge".to_owned()) };
    parts[1..].iter().try_for_each(|other| check_alike(first, other))?;
    let identity = first.checkpoint.identity.clone();
    let mut columns: BTreeMap<(u32, u32, u32, u32), Vec<Part>> = BTreeMap::new();
    for part in parts {
        let Tile { x0, y0, x1, y1 } = part.checkpoint.sums.frame.crop;
        columns.entry((y0, x0, y1, x1)).or_default().push(part);
    }
    let mut crops = columns.into_values().map(join_samples).collect::<Result<Vec<_>, _>>()?;
    let sums = if crops.len() == 1 { crops.remove(0).1 } else { join_crops(crops)? };
    Ok(Checkpoint { identity, sums })
}

fn check_alike(one: &Part, other: &Part) -> Result<(), JoinError> {
    let (a, b) = (&one.checkpoint, &other.checkpoint);
    if let Some([fact, here, there]) = a.identity.difference(&b.identity) {
        let (one, other) = (&one.name, &other.name);
        return refused(format!("'{one}' was made with {fact} {here}, but '{other}' with {fact} {there}"));
    }
    if a.sums.frame.size != b.sums.frame.size || a.sums.layout != b.sums.layout {
        return refused(format!("'{}' and '{}' are of different pictures", one.name, other.name));
    }
    if a.sums.layout.halves {
        return refused("parts made with -error cannot be merged: their pixels differ in samples".to_owned());
    }
    Ok(())
}

/// Adds up parts of the same pixels.
fn join_samples(mut parts: Vec<Part>) -> Result<(String, Sums), JoinError> {
    parts.sort_by_key(|part| (part.checkpoint.sums.samples.start, part.checkpoint.sums.samples.end));
    let mut parts = parts.into_iter();
    let Some(first) = parts.next() else { return refused("there is nothing to merge".to_owned()) };
    let (mut name, mut sums) = (first.name, first.checkpoint.sums);
    for part in parts {
        let (more, end) = (part.checkpoint.sums, sums.samples.end);
        let start = more.samples.start;
        if start > end {
            return refused(missing_samples(end..start, sums.frame));
        }
        if start < end {
            let last = end.min(more.samples.end).max(start + 1) - 1;
            return refused(format!("samples {start} to {last} are both in '{name}' and in '{}'", part.name));
        }
        add(&mut sums, &more);
        name = part.name;
    }
    Ok((name, sums))
}

fn missing_samples(samples: Range<u32>, frame: Frame) -> String {
    let crop = if frame.is_whole() { String::new() } else { format!(" of pixels {}", corners(frame.crop)) };
    format!("samples {} to {}{crop} are in none of the files", samples.start, samples.end - 1)
}

/// As `-crop` takes them.
fn corners(tile: Tile) -> String {
    format!("{} {} {} {}", tile.x0, tile.y0, tile.x1, tile.y1)
}

/// Adds samples that come next.
fn add(sums: &mut Sums, more: &Sums) {
    sums.values.iter_mut().zip(&more.values).for_each(|(sum, value)| *sum += value);
    sums.taken.iter_mut().zip(&more.taken).for_each(|(sum, count)| *sum += count);
    sums.samples.end = more.samples.end;
    sums.dropped += more.dropped;
}

/// Lays parts side by side.
fn join_crops(crops: Vec<(String, Sums)>) -> Result<Sums, JoinError> {
    let first = &crops[0].1;
    let start = crops.iter().map(|(_, sums)| sums.samples.start).min().unwrap_or_default();
    let end = crops.iter().map(|(_, sums)| sums.samples.end).max().unwrap_or_default();
    for (i, (name, sums)) in crops.iter().enumerate() {
        let Range { start: from, end: to } = sums.samples;
        if (from, to) != (start, end) {
            let missing = if from > start { start..from } else { to..end };
            return refused(missing_samples(missing, sums.frame));
        }
        let overlaps = |(_, other): &&(String, Sums)| overlap(other.frame.crop, sums.frame.crop);
        if let Some((other, _)) = crops[..i].iter().find(overlaps) {
            return refused(format!("'{other}' and '{name}' overlap: some pixels are in both"));
        }
    }
    let whole = Frame::whole(first.frame.size);
    check_complete(whole, &crops)?;
    let mut sums = Sums::new(whole, first.layout, first.samples.start).or_else(|e| refused(e.to_string()))?;
    sums.samples.end = first.samples.end;
    let done = sums.done();
    sums.taken.fill(done);
    crops.iter().for_each(|(_, part)| lay(&mut sums, part));
    Ok(sums)
}

fn overlap(a: Tile, b: Tile) -> bool {
    a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1
}

/// Parts that do not overlap cover all if they have as many pixels.
fn check_complete(whole: Frame, crops: &[(String, Sums)]) -> Result<(), JoinError> {
    let covered: usize = crops.iter().map(|(_, sums)| sums.frame.crop.area()).sum();
    let missing = whole.size.pixels() - covered;
    if missing == 0 {
        return Ok(());
    }
    let tiles: Vec<Tile> = crops.iter().map(|(_, sums)| sums.frame.crop).collect();
    let gap = first_gap(whole, &tiles);
    let rest =
        if missing > gap.area() { format!("; {missing} pixels are missing in all") } else { String::new() };
    refused(format!("pixels {} (as -crop takes them) are in none of the files{rest}", corners(gap)))
}

/// The lowest, then leftmost pixel in no tile, with as much around it as makes a free rectangle.
fn first_gap(whole: Frame, tiles: &[Tile]) -> Tile {
    let (width, height) = (whole.size.width(), whole.size.height());
    let cover = |x: u32, y: u32| {
        let point = Tile { x0: x, y0: y, x1: x + 1, y1: y + 1 };
        tiles.iter().find(|tile| overlap(**tile, point))
    };
    let mut gap = whole.crop;
    // From tile to tile, not from pixel to pixel: rows change only where a tile begins or ends.
    let mut rows: Vec<u32> = tiles.iter().map(|tile| tile.y1).chain([0]).filter(|y| *y < height).collect();
    rows.sort_unstable();
    'found: for y in rows {
        let mut x = 0;
        while x < width {
            match cover(x, y) {
                Some(tile) => x = tile.x1,
                None => {
                    (gap.x0, gap.y0) = (x, y);
                    break 'found;
                }
            }
        }
    }
    let in_row = tiles.iter().filter(|tile| (tile.y0..tile.y1).contains(&gap.y0) && tile.x0 > gap.x0);
    gap.x1 = in_row.map(|tile| tile.x0).min().unwrap_or(width);
    let above = tiles.iter().filter(|tile| tile.y0 > gap.y0 && tile.x0 < gap.x1 && gap.x0 < tile.x1);
    gap.y1 = above.map(|tile| tile.y0).min().unwrap_or(height);
    gap
}

/// Copies a part to its place.
fn lay(sums: &mut Sums, part: &Sums) {
    let (crop, stride) = (part.frame.crop, sums.layout.stride());
    let (width, row) = (sums.frame.crop.width() as usize, crop.width() as usize * stride);
    for (y, from) in (crop.y0 as usize..).zip(part.values.chunks_exact(row)) {
        let at = (y * width + crop.x0 as usize) * stride;
        sums.values[at..at + row].copy_from_slice(from);
    }
    sums.dropped += part.dropped;
}
