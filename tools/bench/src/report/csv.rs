//! Results as comma-separated values, and back.
//!
//! A line for each cell: part, table, row, column, kind, better, median, low, high; fields with
//! commas, quotes or line ends stand in quotes (RFC 4180). A word stands in place of the median.

use super::{Better, Cell, Measured, Section, Table};
use common::cli::AppError;
use std::path::Path;

const HEAD: &str = "part,table,row,column,kind,better,median,low,high";

/// A cell and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Part, title of the table, label of the row, name of the column.
    pub place: [String; 4],
    /// Which way is progress.
    pub better: Better,
    /// The figure.
    pub cell: Cell,
}

/// All cells of a section.
pub fn records(section: &Section) -> Vec<Record> {
    let mut records = Vec::new();
    for table in &section.tables {
        for row in &table.rows {
            for (column, cell) in table.columns[1..].iter().zip(&row.cells) {
                let place = [section.part, &table.title, &row.label, &column.name].map(str::to_owned);
                records.push(Record { place, better: column.better, cell: cell.clone() });
            }
        }
    }
    records
}

/// The text of records, with a head.
pub fn write<'a>(records: impl IntoIterator<Item = &'a Record>) -> String {
    let lines = records.into_iter().map(|r| line(r) + "\n");
    std::iter::once(format!("{HEAD}\n")).chain(lines).collect()
}

/// The records of a text.
///
/// # Errors
/// If it is not such a text; says in which line.
pub fn read(text: &str) -> Result<Vec<Record>, String> {
    let mut lines = split(text)?.into_iter();
    match lines.next() {
        Some((_, head)) if head.join(",") == HEAD => {}
        _ => return Err(format!("the first line must be `{HEAD}`")),
    }
    lines.map(|(number, fields)| record(fields).ok_or(format!("line {number} is no result"))).collect()
}

/// The records of a file.
///
/// # Errors
/// If it cannot be read, or is not such a file.
pub fn load(file: &Path) -> Result<Vec<Record>, AppError> {
    let bad = |what: String| AppError::Usage(format!("{}: {what}", file.display()));
    let text = std::fs::read_to_string(file).map_err(|e| bad(format!("cannot be read: {e}")))?;
    read(&text).map_err(bad)
}

/// Records as tables, in the order in which they come; the part stands before the title.
pub fn tables(records: &[Record]) -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    for record in records {
        let [part, title, row, column] = &record.place;
        let title = format!("{part}: {title}");
        let place = tables.iter().position(|t| t.title == title).unwrap_or_else(|| {
            tables.push(Table::new(&title, "", &[]));
            tables.len() - 1
        });
        tables[place].set(row, column, record.better, record.cell.clone());
    }
    tables
}

fn line(record: &Record) -> String {
    let number = |m: &Measured| [m.median, m.low, m.high].map(|x| x.to_string());
    let single = |text: String| [text, String::new(), String::new()];
    let (kind, values) = match &record.cell {
        Cell::None => ("none", single(String::new())),
        Cell::Text(text) => ("text", single(text.clone())),
        Cell::Count(count) => ("count", single(count.to_string())),
        Cell::Exact(value) => ("exact", single(value.to_string())),
        Cell::Measured(m) => ("measured", number(m)),
        Cell::Estimate(m) => ("estimate", number(m)),
        Cell::Derived(m) => ("derived", number(m)),
    };
    let better = match record.better {
        Better::Less => "less",
        Better::More => "more",
        Better::Neither => "neither",
    };
    let words = record.place.iter().map(String::as_str).chain([kind, better]);
    words.chain(values.iter().map(String::as_str)).map(quoted).collect::<Vec<_>>().join(",")
}

fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_owned(),
    }
}

fn record(fields: Vec<String>) -> Option<Record> {
    let [part, table, row, column, kind, better, values @ ..] = <[String; 9]>::try_from(fields).ok()?;
    let better = match better.as_str() {
        "less" => Better::Less,
        "more" => Better::More,
        "neither" => Better::Neither,
        _ => return None,
    };
    Some(Record { place: [part, table, row, column], better, cell: cell(&kind, &values)? })
}

fn cell(kind: &str, values: &[String; 3]) -> Option<Cell> {
    let number = |i: usize| values[i].parse::<f64>().ok();
    let around = || Some(Measured { median: number(0)?, low: number(1)?, high: number(2)? });
    Some(match kind {
        "none" => Cell::None,
        "text" => Cell::Text(values[0].clone()),
        "count" => Cell::Count(values[0].parse().ok()?),
        "exact" => Cell::Exact(number(0)?),
        "measured" => Cell::Measured(around()?),
        "estimate" => Cell::Estimate(around()?),
        "derived" => Cell::Derived(around()?),
        _ => return None,
    })
}

/// The fields of every line that is not empty, and the line's number; quotes may hold line ends.
fn split(text: &str) -> Result<Vec<(usize, Vec<String>)>, String> {
    let (mut lines, mut fields, mut field) = (Vec::new(), Vec::new(), String::new());
    let (mut number, mut from, mut open) = (1, 1, false);
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if open && letters.next_if_eq(&'"').is_some() => field.push('"'),
            '"' => open = !open,
            ',' if !open => fields.push(std::mem::take(&mut field)),
            '\r' if !open => {}
            '\n' if !open => {
                fields.push(std::mem::take(&mut field));
                lines.push((from, std::mem::take(&mut fields)));
                from = number + 1;
            }
            letter => field.push(letter),
        }
        number += usize::from(letter == '\n');
    }
    if open {
        return Err(format!("line {from}: a quote is not closed"));
    }
    if !field.is_empty() || !fields.is_empty() {
        fields.push(field);
        lines.push((from, fields));
    }
    lines.retain(|(_, fields)| fields.len() > 1 || !fields[0].is_empty());
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section() -> Section {
        let columns = [("a, \"b\"", Better::Less), ("c", Better::More)];
        let mut table = Table::new("ratio 0.1\nof it", "row", &columns);
        let m = Measured { median: 1.0 / 3.0, low: 1e-300, high: f64::INFINITY };
        table.row("x", [Cell::Measured(m), Cell::Estimate(m)]);
        table.row("y, z", [Cell::Derived(m), Cell::Count(u64::MAX)]);
        table.row("none", [Cell::None, Cell::Text("\"so\", he\r\nsaid".to_owned())]);
        table.row("", [Cell::Exact(-0.1), Cell::Text(String::new())]);
        Section { part: "rays", tables: vec![table], ..Section::default() }
    }

    #[test]
    fn what_is_written_is_read_again() {
        let records = records(&section());
        assert_eq!(records.len(), 8);
        assert_eq!(records[2].place, ["rays", "ratio 0.1\nof it", "y, z", "a, \"b\""]);
        assert_eq!(read(&write(&records)).unwrap(), records);
        let again = tables(&records);
        assert_eq!((again.len(), again[0].title.as_str()), (1, "rays: ratio 0.1\nof it"));
        let cells = |t: &Table| t.rows.iter().map(|r| r.cells.clone()).collect::<Vec<_>>();
        assert_eq!(cells(&again[0]), cells(&section().tables[0]));
    }

    #[test]
    fn broken_texts_are_refused_with_their_line() {
        let good = write(&records(&section()));
        assert!(read("").unwrap_err().contains("first line"));
        assert!(read(&good.replace("part,", "")).unwrap_err().contains("first line"));
        let refused = |line: &str| read(&format!("{HEAD}\n\n{line}\n")).unwrap_err();
        for line in ["a,b,c,d,exact,less,1,", "a,b,c,d,exact,worse,1,,", "a,b,c,d,exact,less,one,,", "a"] {
            assert_eq!(refused(line), "line 3 is no result");
        }
        assert!(refused("a,\"b").contains("line 3: a quote"));
    }
}
