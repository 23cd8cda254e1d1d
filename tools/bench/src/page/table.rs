//! Tables as HTML.

use super::escaped;
use crate::report::{Better, Cell, Row, Table};

/// A table that scrolls by itself, below a head that stays.
pub fn html(table: &Table) -> String {
    let heads: String = table.columns.iter().map(|c| head(&c.name, c.better)).collect();
    let best: Vec<Vec<bool>> = (0..table.columns.len() - 1).map(|c| table.best(c)).collect();
    let rows: String = table.rows.iter().enumerate().map(|(r, row)| line(row, |c| best[c][r])).collect();
    let head = match table.columns.iter().all(|c| c.name.is_empty()) {
        true => String::new(),
        false => format!("<thead><tr>{heads}</tr></thead>\n"),
    };
    format!(
        "<div class=\"scroll\">\n<table>\n<caption>{}</caption>\n{head}<tbody>\n{rows}</tbody>\n</table>\n</div>\n",
        escaped(&table.title)
    )
}

fn head(name: &str, better: Better) -> String {
    let way = match better {
        Better::Less => " <small>↓</small>",
        Better::More => " <small>↑</small>",
        Better::Neither => "",
    };
    format!("<th scope=\"col\">{}{way}</th>", escaped(name))
}

fn line(row: &Row, is_best: impl Fn(usize) -> bool) -> String {
    let data = |(c, cell): (usize, &Cell)| {
        let class = match (cell, is_best(c)) {
            (Cell::Text(_), _) => " class=\"word\"",
            (_, true) => " class=\"best\"",
            _ => "",
        };
        let (middle, around) = cell.parts();
        let around = if around.is_empty() { around } else { format!(" <small>{}</small>", escaped(&around)) };
        let mark = if row.marks[c] { " ★" } else { "" };
        format!("<td{class}>{}{around}{mark}</td>", escaped(&middle))
    };
    let cells: String = row.cells.iter().enumerate().map(data).collect();
    format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", escaped(&row.label))
}
